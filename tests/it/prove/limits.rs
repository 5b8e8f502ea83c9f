//! Scenes with ratios of a million and more, beside those of the extremes: a rotated horizon, and eyes much nearer to a face
//! than to its middle.

use glam::{DMat3, DVec3};
use hecs::World;
use shadetrade::components::{LightKind, Material, Projection, ShadingMode, Transform, View};
use shadetrade::frame::Keep;

use super::proof;
use crate::support::random::Random;
use crate::support::scene::{draw, empty, shine, spawn_cuboid, view, white};

const WHITE: Material = white(10.0);

const MODES: [ShadingMode; 2] = [ShadingMode::Gouraud, ShadingMode::Phong];

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

#[test]
fn a_face_is_visible_at_any_distance_of_its_middle() {
    let mut random = Random(29);
    let mut undecided = 0;
    for number in 0..120 {
        let mut within = |from, to| random.within(from, to);
        let gap = [1e-3, 1e-4, 1e-5, 1e-6, 1e-7][number % 5];
        let turned = if number % 2 == 0 { 0.0 } else { 1.0 };
        let transform = Transform {
            position: DVec3::from([0.0; 3].map(|_: f64| within(-1e5, 1e5))),
            rotation: DVec3::from([0.0; 3].map(|_: f64| within(0.0, 360.0))) * turned,
        };
        let size = [DVec3::new(1e6, 1.0, 1e6), DVec3::new(1e6, 1e-3, 1.0)][number / 10 % 2];
        let along = within(1e5, 2e5);
        let side = if size.z > 1.0 {
            within(1e5, 2e5)
        } else {
            within(-0.4, 0.4)
        };
        let eye =
            transform.position + transform.axes() * DVec3::new(along, size.y / 2.0 + gap, side);
        let ahead = DVec3::new(within(-1.0, 1.0), within(-1.0, -0.1), within(-1.0, 1.0));
        let ahead = transform.axes() * ahead.normalize();
        let mut world = empty();
        spawn_cuboid(&mut world, size, transform, WHITE);
        shine(&mut world, LightKind::Ambient, 30.0, DVec3::ZERO);
        let place = eye + transform.axes() * DVec3::new(0.3, 1.0, -0.2) * gap;
        shine(&mut world, LightKind::Diffuse, 90.0, place);
        let mut view = view(
            [33, 47],
            eye,
            eye + ahead * 3.0 * gap,
            Projection::Perspective,
        );
        view.viewpoint.camera.up = DVec3::new(within(-1.0, 1.0), within(-1.0, 1.0), 0.3);
        view.viewpoint.camera.fov = [30.0, 100.0, 178.0][number % 3];
        view.tolerance = [0.5, 0.01][number % 2];
        view.shading = Some(MODES[number / 2 % 2]);
        let proof = proof(&mut world, &view);
        assert!(proof.covered > 100, "scene {number}: {proof:?}");
        assert_eq!(
            proof.refuted, 0,
            "scene {number}, {gap}: {:?}",
            proof.examples
        );
        // The rounding of f64 at 2e5 is about a thousandth of a gap of 1e-7.
        assert!(
            proof.undecided == 0 || gap < 1e-4,
            "scene {number}: {:?}",
            proof.examples
        );
        undecided += proof.undecided;
    }
    println!("{undecided} undecided");
}
