//! Undo and redo: the states of the scene, each with the name of the change that led to it.
//!
//! Changes of one thing within a second are one step, as are all those of a drag.

use std::sync::Arc;
use std::time::Duration;

use egui::util::undoer::{Settings, Undoer};
use serde_json::{Value, json};

use super::recording::patch;
use crate::scene::{SceneRecord, ViewRecord};

/// The memory that all states together may take, in bytes.
const MEMORY: usize = 64 << 20;
/// The most steps that are kept.
const STEPS: usize = 500;
/// The memory of an entity in a state, in bytes.
const ENTITY: usize = 512;

/// The states that can be gone back to.
pub struct History {
    undoer: Undoer<Arc<SceneRecord>>,
    /// The subject of the last change, which a change of the same continues.
    subject: String,
}

impl History {
    /// Starts at this state.
    pub fn new(record: &Arc<SceneRecord>) -> Self {
        let entities = record.cuboid.len() + record.light.len() + record.camera.len();
        let mut undoer = Undoer::with_settings(Settings {
            max_undos: (MEMORY / (ENTITY * entities)).clamp(8, STEPS),
            stable_time: 1.0,
            auto_save_interval: f32::INFINITY,
        });
        undoer.add_undo(record);
        History {
            undoer,
            subject: String::new(),
        }
    }

    /// Notes a change from `before` to `after`.
    pub fn note(&mut self, now: Duration, before: &Arc<SceneRecord>, after: &Arc<SceneRecord>) {
        let (before, after) = (undoable(before), undoable(after));
        if before == after {
            return;
        }
        // The step before ends even if nothing was fed since.
        self.undoer.feed_state(now.as_secs_f64(), &before);
        let (subject, _) = change(&before, &after);
        if subject != self.subject {
            self.undoer.add_undo(&before);
        }
        self.subject = subject;
        self.undoer.feed_state(now.as_secs_f64(), &after);
    }

    /// Ends a step that has not changed for a second.
    pub fn feed(&mut self, now: Duration, present: &Arc<SceneRecord>) {
        if self.undoer.is_in_flux() {
            self.undoer
                .feed_state(now.as_secs_f64(), &undoable(present));
        }
    }

    /// The state before the last change, and the name of that change.
    pub fn undo(&mut self, present: &Arc<SceneRecord>) -> Option<(SceneRecord, String)> {
        self.subject.clear();
        let now = undoable(present);
        let before = self.undoer.undo(&now)?;
        let label = label(before, &now);
        Some((seen_as(before, present), label))
    }

    /// The state that was last taken back, and the name of its change.
    pub fn redo(&mut self, present: &Arc<SceneRecord>) -> Option<(SceneRecord, String)> {
        self.subject.clear();
        let now = undoable(present);
        let after = self.undoer.redo(&now)?;
        let label = label(&now, after);
        Some((seen_as(after, present), label))
    }

    pub fn has_undo(&self, present: &Arc<SceneRecord>) -> bool {
        self.undoer.has_undo(&undoable(present))
    }

    pub fn has_redo(&self, present: &Arc<SceneRecord>) -> bool {
        self.undoer.has_redo(&undoable(present))
    }
}

/// A state without the rotation, the probed pixel, the magnification and the open tab, which undo leaves as they are.
fn undoable(record: &Arc<SceneRecord>) -> Arc<SceneRecord> {
    let view = placed(&record.view, &ViewRecord::default());
    if view == record.view {
        return Arc::clone(record);
    }
    let record = SceneRecord::clone(record);
    Arc::new(SceneRecord { view, ..record })
}

/// A state that was kept, with the rotation, pixel, magnification and tab of another one.
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
        magnifier: place.magnifier,
        inspector: place.inspector,
        ..view.clone()
    }
}

/// The subject of the first difference between two states, and its new value where that is a word or a number: "white" and
/// "on", "emerald size" and nothing, "tolerance" and "1.0".
fn change(before: &SceneRecord, after: &SceneRecord) -> (String, String) {
    // Records can be written as JSON.
    let patch = json!(patch(before, after).unwrap_or_default());
    let (path, value) = (&patch[0]["path"], &patch[0]["value"]);
    let keys: Vec<&str> = path.as_str().unwrap_or_default().split('/').collect();
    let name = |kind: &str, place: &str| {
        let place: usize = place.parse().unwrap_or_default();
        match kind {
            "cuboid" => after.cuboid[place].name.clone(),
            "light" => after.light[place].name.clone(),
            _ => after.camera[place].name.clone(),
        }
    };
    let subject = match keys[..] {
        [_, "view", key, ..] => key.to_owned(),
        [_, "background", ..] => "background".to_owned(),
        [_, kind, place, "on"] => name(kind, place),
        [_, kind, place, key, ..] => format!("{} {key}", name(kind, place)),
        [_, kind] => format!("number of {kind}s"),
        _ => String::new(),
    };
    let value = match value {
        Value::Bool(on) => if *on { "on" } else { "off" }.to_owned(),
        Value::String(word) => word.clone(),
        Value::Number(number) if keys.len() < 5 => number.to_string(),
        _ => String::new(),
    };
    (subject, value)
}

/// "white on", "emerald size", "camera 2".
fn label(before: &SceneRecord, after: &SceneRecord) -> String {
    let (subject, value) = change(before, after);
    format!("{subject} {value}").trim().to_owned()
}
