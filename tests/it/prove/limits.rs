//! Scenes with ratios of a million and more: horizons, lines of sight through edges, corners much brighter than others,
//! and eyes much nearer to a face than to its middle. No pixel is refuted, and all are proven if f64 suffices.

use glam::{DMat3, DVec3};
use hecs::World;
use shadetrade::components::{LightKind, Material, Projection, ShadingMode, Transform, View};
use shadetrade::frame::Keep;

use super::proof;
use crate::support::random::Random;
use crate::support::scene::{at, draw, empty, spawn_cuboid, spawn_light, view};

const WHITE: Material = Material {
    ambient: DVec3::ONE,
    diffuse: DVec3::ONE,
    specular: DVec3::ONE,
    shininess: 10.0,
};

const MODES: [ShadingMode; 2] = [ShadingMode::Gouraud, ShadingMode::Phong];

/// Proves every pixel in these modes and at tolerances 0, 1e-4 and 0.5.
fn assert_proven(world: &mut World, view: &View, modes: &[ShadingMode], what: &str) {
    for (index, mode) in modes.iter().cycle().take(3 * modes.len()).enumerate() {
        let view = View {
            shading: Some(*mode),
            tolerance: [0.0, 1e-4, 0.5][index / modes.len()],
            ..view.clone()
        };
        let proof = proof(world, &view);
        let covered = proof.covered;
        assert!(
            covered > 100,
            "{what}, {mode:?}: {covered} pixels are covered"
        );
        assert_eq!(
            (proof.refuted, proof.undecided),
            (0, 0),
            "{what}, {mode:?}, tolerance {}: {:?}",
            view.tolerance,
            proof.examples
        );
    }
}

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
        spawn_light(&mut world, kind, DVec3::splat(300.0), turn * light);
    }
    let eye = turn * DVec3::Y;
    let mut view = view([65, 65], eye, eye + turn * ahead, Projection::Perspective);
    view.viewpoint.camera.up = turn * DVec3::Y;
    view.viewpoint.camera.fov = 60.0;
    (world, view)
}

#[test]
fn the_row_at_the_horizon_of_a_floor_shows_its_far_end_or_the_background() {
    for length in [1e6, 1e12] {
        let light = DVec3::Y * length;
        for ahead in [DVec3::X, DVec3::new(0.54, 1e-5, -0.84)] {
            for degrees in [0.0, 7.0] {
                let (mut world, view) = floor(length, light, ahead, degrees);
                let what = format!("{length}, {light}, {ahead}, {degrees}");
                assert_proven(&mut world, &view, &MODES, &what);
            }
        }
    }
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
fn an_eye_just_above_a_face_shows_its_far_edge() {
    for gap in [4e-5, 4e-8, 4e-12] {
        let mut world = empty();
        spawn_cuboid(
            &mut world,
            DVec3::new(2.0, 3.0, 4.0),
            at(DVec3::ZERO),
            WHITE,
        );
        spawn_light(
            &mut world,
            LightKind::Ambient,
            DVec3::splat(30.0),
            DVec3::ZERO,
        );
        for kind in [LightKind::Diffuse, LightKind::Specular] {
            spawn_light(
                &mut world,
                kind,
                DVec3::splat(90.0),
                DVec3::new(-2.0, 6.0, 5.7),
            );
        }
        for ahead in [DVec3::new(-1.006, 0.0, 0.641), DVec3::NEG_X] {
            let eye = DVec3::new(-0.164, 1.5 + gap, 1.133);
            let mut view = view([97, 81], eye, eye + ahead, Projection::Perspective);
            view.viewpoint.camera.up = DVec3::new(0.01, 1.0, 0.02);
            view.viewpoint.camera.fov = 100.0;
            view.viewpoint.camera.near = Some(gap / 4.0);
            assert_proven(&mut world, &view, &MODES, &format!("{gap}, {ahead}"));
        }
    }
}

#[test]
fn a_line_of_sight_exactly_through_an_edge_may_show_either_side() {
    // In a picture with odd sides the middle line of sight is exact: it lies in the plane of the face x = 1 and passes
    // through its edge.
    for (eye, target) in [
        (DVec3::new(1.0, 0.976, 6.0), DVec3::new(1.0, 0.976, 0.0)),
        (DVec3::new(1.0, 1.5, 6.0), DVec3::new(1.0, 1.5, 2.0)),
        (DVec3::new(9.0, 1.5, 2.0), DVec3::new(1.0, 1.5, 2.0)),
    ] {
        for up in [DVec3::Y, DVec3::new(0.01, 1.0, 0.02)] {
            for projection in Projection::ALL {
                let mut world = empty();
                let size = DVec3::new(2.0, 3.0, 4.0);
                spawn_cuboid(&mut world, size, at(DVec3::ZERO), WHITE);
                let place = DVec3::new(9.3, -3.4, 11.5);
                for kind in LightKind::ALL {
                    spawn_light(&mut world, kind, DVec3::splat(60.0), place);
                }
                let mut view = view([97, 81], eye, target, projection);
                view.viewpoint.camera.up = up;
                let what = format!("{eye}, {up}, {projection:?}");
                assert_proven(&mut world, &view, &MODES, &what);
            }
        }
    }
}

#[test]
fn a_corner_of_any_brightness_does_not_affect_the_triangles_without_it() {
    // Beside each corner of the face z = 1.
    for (x, y) in [(2.1, 1.6), (2.1, -1.6), (-2.1, 1.6), (-2.1, -1.6)] {
        for levels in [1e12, 1e16, 1e18, 1e29] {
            let mut world = empty();
            spawn_cuboid(
                &mut world,
                DVec3::new(4.0, 3.0, 2.0),
                at(DVec3::ZERO),
                WHITE,
            );
            spawn_light(
                &mut world,
                LightKind::Ambient,
                DVec3::splat(100.0),
                DVec3::ZERO,
            );
            let place = DVec3::new(x, y, 1.1);
            spawn_light(&mut world, LightKind::Diffuse, DVec3::splat(levels), place);
            let projection = Projection::ALL[usize::from(levels > 1e15 && x > 0.0)];
            let view = view([80, 60], DVec3::new(3.0, 2.0, 9.0), DVec3::ZERO, projection);
            let what = format!("{x} {y}, {levels}, {projection:?}");
            assert_proven(&mut world, &view, &[ShadingMode::Gouraud], &what);
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
        spawn_light(
            &mut world,
            LightKind::Ambient,
            DVec3::splat(30.0),
            DVec3::ZERO,
        );
        let place = eye + transform.axes() * DVec3::new(0.3, 1.0, -0.2) * gap;
        spawn_light(&mut world, LightKind::Diffuse, DVec3::splat(90.0), place);
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
