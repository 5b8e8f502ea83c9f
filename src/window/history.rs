//! Undo and redo: the states of the scene, each with the name of the change that led to it.
//!
//! Changes of one thing within a second are one step, as are all those of a drag.

use std::sync::Arc;
use std::time::Duration;

use egui::util::undoer::{Settings, Undoer};
use serde::Serialize;
use serde_json::Value;

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
        let subject = Difference::between(&before, &after).subject;
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
        let label = Difference::between(before, &now).label();
        Some((seen_as(before, present), label))
    }

    /// The state that was last taken back, and the name of its change.
    pub fn redo(&mut self, present: &Arc<SceneRecord>) -> Option<(SceneRecord, String)> {
        self.subject.clear();
        let now = undoable(present);
        let after = self.undoer.redo(&now)?;
        let label = Difference::between(&now, after).label();
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

/// The first difference between two states: the name of what changed, and its new value where that is a word.
struct Difference {
    subject: String,
    value: String,
}

impl Difference {
    fn between(before: &SceneRecord, after: &SceneRecord) -> Difference {
        entity("light", &before.light, &after.light)
            .or_else(|| entity("cuboid", &before.cuboid, &after.cuboid))
            .or_else(|| entity("camera", &before.camera, &after.camera))
            .unwrap_or_else(|| field("", &json(&before.view), &json(&after.view)))
    }

    /// "white on", "emerald size", "camera 2".
    fn label(&self) -> String {
        format!("{} {}", self.subject, self.value).trim().to_owned()
    }
}

/// The first difference among entities of a kind.
fn entity<T: PartialEq + Serialize>(kind: &str, before: &[T], after: &[T]) -> Option<Difference> {
    if before.len() != after.len() {
        let verb = if before.len() < after.len() {
            "added"
        } else {
            "removed"
        };
        return Some(Difference {
            subject: format!("{kind} {verb}"),
            value: String::new(),
        });
    }
    let mut pairs = before.iter().zip(after);
    let (before, after) = pairs.find(|(before, after)| before != after)?;
    let (before, after) = (json(before), json(after));
    let name = after["name"].as_str().unwrap_or(kind);
    Some(field(name, &before, &after))
}

/// The first key that differs.
fn field(name: &str, before: &Value, after: &Value) -> Difference {
    let empty = serde_json::Map::new();
    let [before, after] = [before, after].map(|value| value.as_object().unwrap_or(&empty));
    let mut keys = before.keys().chain(after.keys());
    let key = keys.find(|key| before.get(*key) != after.get(*key));
    let key = key.map_or("background", String::as_str);
    let value = match (key, after.get(key)) {
        // A light that is on is the default, which is left out.
        ("on", value) => if value == Some(&Value::Bool(false)) {
            "off"
        } else {
            "on"
        }
        .to_owned(),
        (_, Some(Value::String(word))) => word.clone(),
        (_, Some(Value::Number(number))) => number.to_string(),
        _ => String::new(),
    };
    let subject = if key == "on" {
        name.to_owned()
    } else {
        format!("{name} {key}").trim().to_owned()
    };
    Difference { subject, value }
}

fn json(record: &impl Serialize) -> Value {
    serde_json::to_value(record).unwrap_or_default()
}
