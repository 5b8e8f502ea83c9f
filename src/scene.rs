//! A scene file in, validated records and a [`World`] out; nothing else knows TOML.

use glam::DVec3;
use hecs::{Entity, World};

use crate::components::Viewpoint;

/// A scene as it is drawn: entities, and their order in the file.
pub struct Scene {
    /// The built-in name, or the path as given.
    pub name: String,
    /// Everything; spawned once, in file order.
    pub world: World,
    /// Levels where nothing is drawn.
    pub background: DVec3,
    /// In file order.
    pub cuboids: Vec<Entity>,
    /// In file order.
    pub lights: Vec<Entity>,
    /// In file order; at least one.
    pub cameras: Vec<Entity>,
}

impl Scene {
    /// Camera number `index` of the file, resolved.
    pub fn viewpoint(&self, _index: usize) -> Viewpoint {
        unimplemented!()
    }
}
