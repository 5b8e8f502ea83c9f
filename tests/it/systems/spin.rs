//! Spin: the placement of cuboids after they have turned.

use glam::{DMat3, DQuat, DVec3, dvec3};
use hecs::World;
use shadetrade::components::{Projection, Transform, View, WorldTransform};
use shadetrade::systems::spin;

use super::{ahead, at, empty_frame, place, read};
use crate::support::random::Random;

/// The placement of a cuboid that has turned by this many degrees, and its transform after that.
fn run(transform: Transform, degrees: u32) -> (WorldTransform, Transform) {
    let mut world = World::new();
    let cuboid = world.spawn((transform, WorldTransform::default()));
    let view = View {
        turned: degrees,
        ..ahead(Projection::Perspective, [8, 8])
    };
    spin::run(&mut world, &view, &mut empty_frame());
    (read(&world, cuboid), read(&world, cuboid))
}

#[test]
fn a_cuboid_without_turn_has_the_placement_of_the_scene() {
    let transform = Transform {
        position: dvec3(1.0, 2.0, 3.0),
        rotation: dvec3(10.5, 20.0, 30.0),
    };
    let (place, left) = run(transform, 0);
    assert_eq!(place.position, transform.position);
    assert_eq!(place.axes, transform.axes());
    assert_eq!(left, transform);
}

#[test]
fn a_quarter_turn_takes_y_to_z_and_leaves_the_own_x_axis() {
    let (place, left) = run(at(DVec3::splat(5.0)), 90);
    assert_eq!(
        place.axes,
        DMat3::from_cols(DVec3::X, DVec3::Z, DVec3::NEG_Y)
    );
    assert_eq!(left, at(DVec3::splat(5.0)), "the scene's own is kept");
    // Turned by 90 degrees about z first, the cuboid's own x axis is the world's y axis.
    let upright = Transform {
        rotation: DVec3::Z * 90.0,
        ..Transform::default()
    };
    let (place, _) = run(upright, 90);
    assert_eq!(place.axes, DMat3::from_cols(DVec3::Y, DVec3::Z, DVec3::X));
}

#[test]
fn a_spin_is_a_rotation_about_x_before_the_scene_s_own() {
    let mut random = Random(1);
    for degrees in (0..360).step_by(7) {
        let mut angle = || random.within(-400.0, 400.0);
        let transform = Transform {
            position: DVec3::ZERO,
            rotation: dvec3(angle(), angle(), angle()),
        };
        let (place, _) = run(transform, degrees);
        let about_x = DQuat::from_rotation_x(f64::from(degrees).to_radians());
        let expected = transform.axes() * DMat3::from_quat(about_x);
        assert!(
            place.axes.abs_diff_eq(expected, 1e-14),
            "{transform:?} by {degrees}"
        );
    }
}

#[test]
fn an_entity_without_transform_or_placement_is_not_changed() {
    let mut world = World::new();
    let placed = place(at(DVec3::ONE));
    let without_transform = world.spawn((placed,));
    let without_place = world.spawn((at(DVec3::Y),));
    let view = ahead(Projection::Perspective, [8, 8]);
    spin::run(&mut world, &view, &mut empty_frame());
    assert_eq!(read::<WorldTransform>(&world, without_transform), placed);
    assert_eq!(read::<Transform>(&world, without_place), at(DVec3::Y));
    assert!(!world.satisfies::<&WorldTransform>(without_place));
}
