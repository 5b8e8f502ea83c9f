//! Rotates the vertex normals of every mesh into world space.

use hecs::World;

use crate::components::{Mesh, Normals, View, WorldTransform};
use crate::frame::Frame;

/// Overwrites the [`Normals`] of every cuboid.
pub fn run(world: &mut World, _view: &View, _frame: &mut Frame) {
    for (place, mesh, normals) in world.query_mut::<(&WorldTransform, &Mesh, &mut Normals)>() {
        normals.0 = mesh.normals.map(|normal| place.axes * normal);
    }
}
