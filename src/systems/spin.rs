//! Where every cuboid stands once all have turned. Its axes are made here and nowhere else, once a frame.

use hecs::World;

use crate::components::{Transform, View, WorldTransform};
use crate::frame::Frame;

/// Overwrites the [`WorldTransform`] of every cuboid.
pub fn run(world: &mut World, view: &View, _frame: &mut Frame) {
    for (transform, place) in world.query_mut::<(&Transform, &mut WorldTransform)>() {
        *place = world_transform(transform, view.turned);
    }
}

/// Where a cuboid stands once it has turned by these degrees.
pub fn world_transform(transform: &Transform, turned: u32) -> WorldTransform {
    let turned = transform.turned(turned);
    WorldTransform {
        position: turned.position,
        axes: turned.axes(),
    }
}
