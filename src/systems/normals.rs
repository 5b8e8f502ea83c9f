//! Rotates the vertex normals of every mesh into world space.

use hecs::World;

use crate::components::{Mesh, NormalMode, Normals, View, WorldTransform};
use crate::systems::frame::Frame;

/// Overwrites the [`Normals`] of every cuboid.
pub fn run(world: &mut World, _view: &View, _frame: &mut Frame) {
    for (place, mesh, mode, normals) in
        world.query_mut::<(&WorldTransform, &Mesh, &NormalMode, &mut Normals)>()
    {
        *normals = Normals::new(*mode, mesh, place.axes);
    }
}
