//! Undo and redo. The changes of one gesture are one step: a key that is pressed or held, a drag, a turn of the wheel.

use std::sync::Arc;
use std::time::Duration;

use crate::components::Viewer;
use crate::scene::SceneRecord;

/// The memory that all states together may take, and that of an entity in a state, in bytes.
const MEMORY: usize = 64 << 20;
const ENTITY: usize = 512;
/// The most steps that are kept.
const STEPS: usize = 500;
/// A change after this time without one begins a step.
const PAUSE: Duration = Duration::from_secs(1);

/// The states that can be gone back to.
pub struct History {
    before: Vec<Arc<SceneRecord>>,
    after: Vec<Arc<SceneRecord>>,
    most: usize,
    /// The next change begins a step.
    begins: bool,
    last: Duration,
}

impl History {
    /// Has no steps; there will be about as many entities as in this state.
    pub fn new(record: &SceneRecord) -> Self {
        let entities = record.cuboid.len() + record.light.len() + record.camera.len();
        History {
            before: Vec::new(),
            after: Vec::new(),
            most: (MEMORY / (ENTITY * entities)).clamp(8, STEPS),
            begins: true,
            last: Duration::ZERO,
        }
    }

    /// A gesture begins or ends.
    pub fn end_step(&mut self) {
        self.begins = true;
    }

    /// Notes a change from `before` to `after`.
    pub fn note(&mut self, now: Duration, before: &Arc<SceneRecord>, after: &Arc<SceneRecord>) {
        if seen_as(before, after) == **after {
            return;
        }
        if self.begins || now > self.last + PAUSE {
            self.before.push(Arc::clone(before));
            if self.before.len() > self.most {
                self.before.remove(0);
            }
        }
        self.after.clear();
        (self.begins, self.last) = (false, now);
    }

    /// The state before the last step.
    pub fn undo(&mut self, present: &Arc<SceneRecord>) -> Option<SceneRecord> {
        let before = self.before.pop()?;
        self.after.push(Arc::clone(present));
        Some(seen_as(&before, present))
    }

    /// The state after the step that was last taken back.
    pub fn redo(&mut self, present: &Arc<SceneRecord>) -> Option<SceneRecord> {
        let after = self.after.pop()?;
        self.before.push(Arc::clone(present));
        Some(seen_as(&after, present))
    }
}

/// A state with the rotation, pixel and tab of another one, which undo leaves as they are.
fn seen_as(record: &SceneRecord, present: &SceneRecord) -> SceneRecord {
    let place = &present.view;
    SceneRecord {
        view: Viewer {
            turned: place.turned,
            pixel: place.pixel,
            inspector: place.inspector,
            ..record.view.clone()
        },
        ..record.clone()
    }
}
