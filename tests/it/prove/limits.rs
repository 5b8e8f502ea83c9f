//! A horizon with ratios of a million and more, rotated.

use glam::{DMat3, DVec3};
use hecs::World;
use shadetrade::components::{LightKind, Material, Projection, Transform, View};
use shadetrade::frame::Keep;

use crate::support::scene::{draw, empty, shine, spawn_cuboid, view};

/// A floor of this length with its top 1 below the eye, which looks horizontally. The whole scene is rotated about x.
fn floor(length: f64, light: DVec3, ahead: DVec3, degrees: f64) -> (World, View) {
    let turn = DMat3::from_rotation_x(degrees.to_radians());
    let mut world = empty();
    let transform = Transform {
        position: turn * DVec3::NEG_Y,
        rotation: DVec3::X * degrees,
    };
    let material = Material {
        specular: DVec3::splat(0.7),
        diffuse: DVec3::splat(0.6),
        ambient: DVec3::splat(0.1),
        shininess: 20.0,
    };
    spawn_cuboid(
        &mut world,
        DVec3::new(length, 2.0, length),
        transform,
        material,
    );
    for kind in LightKind::ALL {
        shine(&mut world, kind, 300.0, turn * light);
    }
    let eye = turn * DVec3::Y;
    let mut view = view([65, 65], eye, eye + turn * ahead, Projection::Perspective);
    view.viewpoint.camera.up = turn * DVec3::Y;
    view.viewpoint.camera.fov = 60.0;
    (world, view)
}

#[test]
fn a_floor_rotated_with_its_eye_has_the_same_horizon() {
    let light = DVec3::new(0.0, 1e12, -3e12);
    let rows = [0.0, 7.0].map(|degrees| {
        let (mut world, view) = floor(1e12, light, DVec3::new(0.2, 0.0, -1.0), degrees);
        draw(&mut world, &view, Keep::Levels).levels()[32 * 65..33 * 65].to_vec()
    });
    for (x, (level, turned)) in rows[0].iter().zip(&rows[1]).enumerate() {
        for (one, other) in level.iter().zip(turned) {
            assert!(
                (one - other).abs() < 0.1,
                "column {x}: {level:?}, {turned:?}"
            );
        }
    }
}
