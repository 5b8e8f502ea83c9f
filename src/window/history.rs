//! Undo and redo. The changes of one gesture are one step: a key that is pressed or held, a drag, a turn of the wheel.

use std::sync::Arc;

use egui::util::undoer::{Settings, Undoer};

use crate::components::Viewer;
use crate::scene::SceneRecord;

/// The memory that all states together may take, and that of an entity in a state, in bytes.
const MEMORY: usize = 64 << 20;
const ENTITY: usize = 512;
/// The most steps that are kept.
const STEPS: usize = 500;

/// A state that can be gone back to. States that differ in rotation or pixel only are equal: undo leaves these as they
/// are.
#[derive(Clone)]
pub struct State(pub Arc<SceneRecord>);

impl State {
    /// The view with the rotation and pixel of another one.
    pub fn view_as(&self, present: &Viewer) -> Viewer {
        Viewer {
            turned: present.turned,
            pixel: present.pixel,
            ..self.0.view.clone()
        }
    }
}

impl PartialEq for State {
    /// Compared in every frame, so it copies no entities.
    fn eq(&self, other: &State) -> bool {
        let (one, another) = (&*self.0, &*other.0);
        Arc::ptr_eq(&self.0, &other.0)
            || one.camera == another.camera
                && one.light == another.light
                && one.cuboid == another.cuboid
                && one.background == another.background
                && self.view_as(&another.view) == another.view
    }
}

/// The states to go back to. There will be about as many entities as in `record`.
pub fn history(record: &SceneRecord) -> Undoer<State> {
    let entities = record.cuboid.len() + record.light.len() + record.camera.len();
    Undoer::with_settings(Settings {
        max_undos: (MEMORY / (ENTITY * entities)).clamp(8, STEPS),
        // A gesture is one step. After a second without a change the next one begins a step.
        auto_save_interval: f32::INFINITY,
        ..Settings::default()
    })
}
