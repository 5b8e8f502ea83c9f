//! Computes the position and the axes of every cuboid, turned by the angle of the view.

use hecs::World;

use crate::components::{Transform, View, WorldTransform};
use crate::systems::frame::Frame;

/// Overwrites the [`WorldTransform`] of every cuboid.
pub fn run(world: &mut World, view: &View, _frame: &mut Frame) {
    for (transform, place) in world.query_mut::<(&Transform, &mut WorldTransform)>() {
        let turned = transform.turned(view.turned);
        *place = WorldTransform {
            position: turned.position,
            axes: turned.axes(),
        };
    }
}
