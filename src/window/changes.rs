//! The difference between two states of a scene: whether it is an edit, another view, or another method.

use crate::scene::SceneRecord;

/// Whether a state has edits that are not saved. Switching lights and modes and moving the camera is looking.
pub fn has_edits(state: &SceneRecord, saved: &SceneRecord) -> bool {
    state.background != saved.background
        || differ(&state.light, &saved.light, |it, saved| it.on = saved.on)
        || differ(&state.cuboid, &saved.cuboid, |it, saved| {
            it.shading = saved.shading;
        })
        || differ(&state.camera, &saved.camera, |it, saved| {
            it.orbit = saved.orbit;
        })
}

/// Whether two states show the scene otherwise, whatever the method.
pub fn is_another_view(before: &SceneRecord, after: &SceneRecord) -> bool {
    let (one, other) = (&before.view, &after.view);
    one.camera != other.camera
        || (one.projection, one.turned) != (other.projection, other.turned)
        || before.background != after.background
        || before.light != after.light
        || before.camera != after.camera
        || differ(&before.cuboid, &after.cuboid, |it, other| {
            it.shading = other.shading;
        })
}

/// Whether two states of one view are drawn by different methods.
pub fn is_another_method(before: &SceneRecord, after: &SceneRecord) -> bool {
    before.view.tolerance != after.view.tolerance || before.cuboid != after.cuboid
}

/// Whether two lists of entities differ after `forget` has overwritten fields of the first.
fn differ<T: Clone + PartialEq>(one: &[T], other: &[T], forget: impl Fn(&mut T, &T)) -> bool {
    let differ = |(one, other): (&T, &T)| {
        one != other && {
            let mut one = one.clone();
            forget(&mut one, other);
            one != *other
        }
    };
    one.len() != other.len() || one.iter().zip(other).any(differ)
}
