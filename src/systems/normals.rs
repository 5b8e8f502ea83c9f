//! Rotates the vertex normals of every mesh into world space.

use hecs::World;

use crate::components::{Mesh, NormalMode, Normals, View, WorldTransform};
use crate::frame::Frame;

/// Overwrites the [`Normals`] of every cuboid.
pub fn run(world: &mut World, _view: &View, _frame: &mut Frame) {
    for (place, mesh, mode, normals) in
        world.query_mut::<(&WorldTransform, &Mesh, &NormalMode, &mut Normals)>()
    {
        *normals = match mode {
            NormalMode::Corner => Normals::Corner(mesh.normals.map(|normal| place.axes * normal)),
            NormalMode::Face => Normals::Face([0, 1, 2].map(|axis| place.axes.col(axis))),
        };
    }
}
