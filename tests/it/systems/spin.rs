//! Spin: the placement of cuboids after they have turned.

use glam::{DMat3, DQuat};
use shadetrade::systems::spin;

use super::{ahead, empty_frame, place, read};
use crate::support::prelude::*;
use crate::support::scene;

/// The placement of a cuboid that has turned by this many degrees. Its transform stays.
fn run(transform: Transform, degrees: u32) -> WorldTransform {
    let mut world = World::new();
    let cuboid = world.spawn((transform, WorldTransform::default()));
    let view = View {
        turned: degrees,
        ..ahead(Projection::Perspective, [8, 8])
    };
    spin::run(&mut world, &view, &mut empty_frame());
    assert_eq!(read::<Transform>(&world, cuboid), transform);
    read(&world, cuboid)
}

#[test]
fn a_spin_is_a_rotation_about_x_before_the_scene_s_own() {
    let mut random = Random(1);
    for degrees in (0..360).step_by(7) {
        let transform = scene::placed(random.around(9.0), random.around(400.0));
        let placed = run(transform, degrees);
        let about_x = DQuat::from_rotation_x(f64::from(degrees).to_radians());
        let expected = transform.axes() * DMat3::from_quat(about_x);
        let is_right = placed.axes.abs_diff_eq(expected, 1e-14);
        assert!(is_right, "{transform:?} by {degrees}");
        assert!(placed == place(transform) || degrees > 0, "{transform:?}");
    }
}
