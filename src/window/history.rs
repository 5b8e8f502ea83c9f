//! Undo and redo. The changes of one gesture are one step: a key that is pressed or held, a drag, a turn of the wheel.

use std::sync::Arc;
use std::time::Duration;

use crate::scene::{SceneRecord, ViewRecord};

/// The memory that all states together may take, and that of an entity in a state, in bytes.
const MEMORY: usize = 64 << 20;
const ENTITY: usize = 512;
/// The most steps that are kept.
const STEPS: usize = 500;
/// A change after this time without one begins a step.
const PAUSE: Duration = Duration::from_secs(1);

type States = Vec<Arc<SceneRecord>>;

/// The states that can be gone back to.
pub struct History {
    before: States,
    after: States,
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
        let (before, after) = (undoable(before), undoable(after));
        if before == after {
            return;
        }
        if self.begins || now > self.last + PAUSE {
            self.before.push(before);
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
        self.after.push(undoable(present));
        Some(seen_as(&before, present))
    }

    /// The state after the step that was last taken back.
    pub fn redo(&mut self, present: &Arc<SceneRecord>) -> Option<SceneRecord> {
        let after = self.after.pop()?;
        self.before.push(undoable(present));
        Some(seen_as(&after, present))
    }

    pub fn has_undo(&self) -> bool {
        !self.before.is_empty()
    }

    pub fn has_redo(&self) -> bool {
        !self.after.is_empty()
    }
}

/// A state without the rotation, the probed pixel and the open tab, which undo leaves as they are.
fn undoable(record: &Arc<SceneRecord>) -> Arc<SceneRecord> {
    let view = placed(&record.view, &ViewRecord::default());
    if view == record.view {
        return Arc::clone(record);
    }
    let record = SceneRecord::clone(record);
    Arc::new(SceneRecord { view, ..record })
}

/// A state that was kept, with the rotation, pixel and tab of another one.
fn seen_as(record: &SceneRecord, present: &SceneRecord) -> SceneRecord {
    SceneRecord {
        view: placed(&record.view, &present.view),
        ..record.clone()
    }
}

fn placed(view: &ViewRecord, place: &ViewRecord) -> ViewRecord {
    ViewRecord {
        turned: place.turned,
        pixel: place.pixel,
        inspector: place.inspector,
        ..view.clone()
    }
}
