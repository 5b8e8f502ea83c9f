//! Transforms and spins in, places in the world out.
//!
//! Rule: a cuboid's axes are made here and nowhere else, once a frame.

use hecs::World;

use crate::components::{Spin, Transform, View, WorldTransform};
use crate::frame::Frame;

/// Overwrites the [`WorldTransform`] of every cuboid.
pub fn run(world: &mut World, _view: &View, _frame: &mut Frame) {
    for (transform, spin, place) in world.query_mut::<(&Transform, &Spin, &mut WorldTransform)>() {
        *place = world_transform(transform, *spin);
    }
}

/// Where a cuboid stands once it has turned.
pub fn world_transform(transform: &Transform, spin: Spin) -> WorldTransform {
    let turned = transform.spun(spin);
    WorldTransform {
        position: turned.position,
        axes: turned.axes(),
    }
}
