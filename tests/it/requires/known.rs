//! Scenes with required parts and errors known on paper.

use glam::DVec3;
use hecs::World;
use shadetrade::components::{
    LightKind, Material, Projection, ShadingMode, Transform, View, overwrite,
};
use shadetrade::reference::Rule;
use shadetrade::requires::{Change, Part};
use shadetrade::scene::Scene;

use super::{WHITE, change, required, scene_of};
use crate::support::scene::{at, empty, shine, spawn_cuboid, view};

/// Odd sides, so that the middle of the picture is a pixel centre.
const SIZE: [usize; 2] = [49, 37];

/// A view from +z towards the origin, in perspective, at half a level.
fn from_z(distance: f64) -> View {
    View {
        tolerance: 0.5,
        ..view(
            SIZE,
            DVec3::Z * distance,
            DVec3::ZERO,
            Projection::Perspective,
        )
    }
}

/// A cuboid with edges of 2 at the origin.
fn cube() -> World {
    let mut world = empty();
    spawn_cuboid(&mut world, DVec3::splat(2.0), at(DVec3::ZERO), WHITE);
    world
}

fn lit(world: &mut World, kind: LightKind, levels: f64, position: DVec3) {
    shine(world, kind, levels, position);
}

/// Asserts that the largest error encloses the known one, narrowly.
#[track_caller]
fn assert_error(change: Change, known: f64) {
    let [least, most] = change.largest_error;
    assert!(
        least <= known + 1e-9 && known <= most + 1e-9,
        "{known}: {change:?}"
    );
    assert!(most - least < 1e-6, "{change:?}");
}

/// Sets the shading mode of all cuboids.
fn shaded(mode: ShadingMode, mut scene: Scene) -> Scene {
    overwrite(&mut scene.world, &mode);
    scene
}

#[test]
fn a_light_behind_every_face_in_sight_is_not_required() {
    for mode in [ShadingMode::Gouraud, ShadingMode::Phong] {
        let mut world = cube();
        lit(&mut world, LightKind::Diffuse, 200.0, DVec3::Z * -10.0);
        let view = from_z(8.0);
        let scene = shaded(mode, scene_of(world, &view));
        let light = change(&scene, &view, Part::Light(0));
        assert_error(light, 0.0);
        assert_eq!(light.pixels, 0);
    }
}

#[test]
fn a_faint_light_is_required_where_the_tolerance_is_less_than_it_adds() {
    let mut world = cube();
    // n.l is 1 in the middle of the face.
    lit(&mut world, LightKind::Diffuse, 0.2, DVec3::Z * 10.0);
    let view = from_z(8.0);
    let scene = scene_of(world, &view);
    for (tolerance, is_required) in [(0.5, false), (0.201, false), (0.199, true), (0.0, true)] {
        let view = view.with_tolerance(tolerance);
        let light = change(&scene, &view, Part::Light(0));
        assert_error(light, 0.2);
        assert_eq!(!light.keeps(tolerance), is_required, "{tolerance}");
        assert_eq!(light.pixels > 0, is_required, "{tolerance}");
    }
}

#[test]
fn a_depth_test_is_required_where_the_order_of_the_file_differs_from_that_of_depth() {
    let turned = |position: DVec3, degrees: f64| Transform {
        position,
        rotation: DVec3::Y * degrees,
    };
    let [left, right] = [DVec3::X * -1.5, DVec3::X * 1.5].map(at);
    let [near, far] = [DVec3::Z * 2.0, DVec3::new(0.5, 0.0, -2.0)].map(at);
    // The edge of the rotated cuboid sticks out of the other's face; it is painted over the face or not at all.
    let [straight, through] = [0.0, 45.0].map(|degrees| turned(DVec3::ZERO, degrees));
    for projection in Projection::ALL {
        for (cuboids, is_required) in [
            (vec![straight], false),
            (vec![left, right], false),
            (vec![far, near], false),
            (vec![near, far], true),
            (vec![straight, through], true),
            (vec![through, straight], true),
        ] {
            let mut world = empty();
            for (number, cuboid) in (1..).zip(&cuboids) {
                let material = Material {
                    ambient: DVec3::splat(f64::from(number)),
                    ..WHITE
                };
                spawn_cuboid(&mut world, DVec3::splat(2.0), *cuboid, material);
            }
            lit(&mut world, LightKind::Ambient, 50.0, DVec3::ZERO);
            let view = View {
                projection,
                ..from_z(16.0)
            };
            let scene = scene_of(world, &view);
            let depth = change(&scene, &view, Part::Rule(Rule::DepthTest));
            assert_error(depth, if is_required { 50.0 } else { 0.0 });
        }
    }
}

#[test]
fn a_cuboid_behind_another_is_not_required() {
    let [near, far] = [DVec3::Z * 2.0, DVec3::Z * -2.0];
    let required = |places: &[DVec3]| {
        let mut world = empty();
        for place in places {
            spawn_cuboid(&mut world, DVec3::splat(2.0), at(*place), WHITE);
        }
        lit(&mut world, LightKind::Ambient, 50.0, DVec3::ZERO);
        let view = from_z(16.0);
        let scene = scene_of(world, &view);
        [0, 1].map(|cuboid| !change(&scene, &view, Part::Cuboid(cuboid)).keeps(0.5))
    };
    // Both have one colour, so the far one cannot be told from the near one in front of it, but it is smaller on the
    // screen.
    assert_eq!(required(&[near, far]), [true, false]);
    assert_eq!(required(&[far, near]), [false, true]);
}

#[test]
fn parallel_rays_do_not_require_perspective_correct_interpolation() {
    for mode in [ShadingMode::Gouraud, ShadingMode::Phong] {
        let mut world = cube();
        lit(
            &mut world,
            LightKind::Diffuse,
            200.0,
            DVec3::new(3.0, 2.0, 4.0),
        );
        lit(
            &mut world,
            LightKind::Specular,
            200.0,
            DVec3::new(3.0, 2.0, 4.0),
        );
        let eye = DVec3::new(3.0, 2.0, 2.5);
        for projection in Projection::ALL {
            let view = View {
                tolerance: 0.5,
                ..view(SIZE, eye, DVec3::ZERO, projection)
            };
            let scene = shaded(mode, scene_of(std::mem::take(&mut world), &view));
            let interpolation = change(&scene, &view, Part::Rule(Rule::PerspectiveCorrect));
            match projection {
                Projection::Perspective => assert!(interpolation.largest_error[0] > 5.0),
                Projection::Orthographic => assert_error(interpolation, 0.0),
            }
            world = scene.world;
        }
    }
}

/// The error of affine interpolation on a square grows with the range of depth. With depths z and q z at two opposite
/// edges and levels that differ by d between them, its maximum is d (sqrt(q) - 1) / (sqrt(q) + 1).
#[test]
fn affine_interpolation_suffices_from_the_distance_computed_on_paper() {
    const TURN: f64 = 40.0;
    let turned = Transform {
        position: DVec3::ZERO,
        rotation: DVec3::X * TURN,
    };
    // Far away along the square's own y axis: n.l is 1 / sqrt(3) at two corners and negative at the others.
    let light = turned.axes() * DVec3::Y * 1e9;
    let levels = 100.0;
    let differ = levels / 3.0_f64.sqrt();
    let half_depth = TURN.to_radians().sin();
    let tolerance = 0.5;
    let root = (1.0 + tolerance / differ) / (1.0 - tolerance / differ);
    let distance = half_depth * (root * root + 1.0) / (root * root - 1.0);
    let error = |distance: f64| {
        let mut world = empty();
        spawn_cuboid(&mut world, DVec3::new(2.0, 2.0, 1e-9), turned, WHITE);
        lit(&mut world, LightKind::Diffuse, levels, light);
        let mut view = from_z(distance);
        view.viewpoint.camera.fov = 2.0 * (1.5 / distance).atan().to_degrees();
        view.size = [9, 2001];
        let scene = shaded(ShadingMode::Gouraud, scene_of(world, &view));
        change(&scene, &view, Part::Rule(Rule::PerspectiveCorrect))
    };
    assert!((20.0..80.0).contains(&distance), "{distance}");
    let [least, most] = error(distance).largest_error;
    assert!(
        (least - tolerance).abs() < 1e-3 && (most - tolerance).abs() < 1e-3,
        "{least} to {most}"
    );
    assert!(error(distance * 1.01).keeps(tolerance));
    assert!(!error(distance * 0.99).keeps(tolerance));
}

#[test]
fn with_a_shininess_of_zero_only_the_gate_ends_a_highlight() {
    let mut world = empty();
    let material = Material {
        shininess: 0.0,
        ..WHITE
    };
    spawn_cuboid(&mut world, DVec3::splat(2.0), at(DVec3::ZERO), material);
    lit(&mut world, LightKind::Specular, 300.0, DVec3::Z * -10.0);
    let view = from_z(8.0);
    let scene = scene_of(world, &view);
    assert_error(change(&scene, &view, Part::Light(0)), 0.0);
    // Half of 300, which the background of 20 levels does not hide.
    let gate = change(&scene, &view, Part::Rule(Rule::SpecularGate));
    assert_error(gate, 150.0);
    let face = change(&scene, &view, Part::Cuboid(0));
    assert_eq!(gate.pixels, face.pixels, "every pixel of the face");
}

#[test]
fn without_normalisation_normals_are_shorter_by_sqrt_3_in_the_middle_of_a_face() {
    let mut world = cube();
    lit(&mut world, LightKind::Diffuse, 200.0, DVec3::Z * 1e13);
    let view = from_z(8.0);
    let short = 200.0 * (1.0 - 1.0 / 3.0_f64.sqrt());
    let scene = shaded(ShadingMode::Phong, scene_of(world, &view));
    assert_error(change(&scene, &view, Part::Rule(Rule::UnitNormal)), short);
    // Gouraud has n.l of the corners, 1 / sqrt(3), everywhere.
    assert_error(change(&scene, &view, Part::EveryPixel(0)), short);
    // The shading of the view does not matter.
    let forced = view.shaded(ShadingMode::Gouraud);
    assert_error(change(&scene, &forced, Part::EveryPixel(0)), short);
    let scene = shaded(ShadingMode::Gouraud, scene);
    assert_error(change(&scene, &view, Part::Rule(Rule::UnitNormal)), 0.0);
}

#[test]
fn a_near_plane_is_required_where_it_clips() {
    for projection in Projection::ALL {
        let mut world = cube();
        lit(&mut world, LightKind::Ambient, 100.0, DVec3::ZERO);
        let mut view = View {
            projection,
            ..from_z(4.0)
        };
        let scene = scene_of(world, &view);
        // The face is at distance 3.
        for (near, known) in [(2.9, 0.0), (3.1, 80.0)] {
            view.viewpoint.camera.near = Some(near);
            assert_error(change(&scene, &view, Part::Rule(Rule::NearPlane)), known);
        }
        // Behind the eye, where only parallel lines of sight reach.
        view.viewpoint.position = DVec3::Z * -4.0;
        view.viewpoint.camera.target = DVec3::Z * -5.0;
        view.viewpoint.camera.near = Some(0.1);
        let known = if projection == Projection::Perspective {
            0.0
        } else {
            80.0
        };
        assert_error(change(&scene, &view, Part::Rule(Rule::NearPlane)), known);
    }
}

/// Two intersecting cuboids, clipped by the near plane, lit from the side and from behind, far from the origin.
#[test]
fn a_scene_that_requires_every_part() {
    let origin = DVec3::splat(3e6);
    let mut world = empty();
    let material = Material {
        shininess: 2.0,
        ..WHITE
    };
    for degrees in [0.0, 45.0] {
        let turned = Transform {
            position: origin,
            rotation: DVec3::Y * degrees,
        };
        spawn_cuboid(&mut world, DVec3::splat(2.0), turned, material);
    }
    let eye = DVec3::new(2.0, 2.2, 1.8);
    // A light nearly opposite to the eye grazes faces from the front and from behind.
    let [side, behind] = [DVec3::new(4.0, 2.0, 1.0), DVec3::new(-4.0, -1.5, -3.6)];
    lit(&mut world, LightKind::Diffuse, 200.0, origin + side);
    lit(&mut world, LightKind::Specular, 400.0, origin + behind);
    lit(&mut world, LightKind::Ambient, 20.0, DVec3::ZERO);
    let mut view = view(SIZE, origin + eye, origin, Projection::Perspective);
    view.tolerance = 0.5;
    view.viewpoint.camera.near = Some(2.0);
    view.viewpoint.camera.fov = 70.0;
    let scene = scene_of(world, &view);
    let required = required(&scene, &view);
    let parts = shadetrade::requires::parts(&scene);
    let all: Vec<String> = parts.into_iter().map(|(_, name)| name).collect();
    assert_eq!(required, all);
}

/// From this distance f64 cannot tell where on a cuboid a pixel lies, or whether it lies on it at all.
#[test]
fn an_undecided_part_is_required() {
    let mut world = cube();
    lit(&mut world, LightKind::Ambient, 100.0, DVec3::ZERO);
    lit(&mut world, LightKind::Diffuse, 100.0, DVec3::Z * 8.0);
    let mut view = from_z(8.0);
    view.viewpoint.position = DVec3::new(1.0, 0.7, 1.3) * 1e22;
    view.viewpoint.camera.fov = 1e-20;
    let scene = scene_of(world, &view);
    for part in [Part::Cuboid(0), Part::Light(1)] {
        let change = change(&scene, &view, part);
        assert_eq!(
            (change.largest_error[0], change.pixels),
            (0.0, 0),
            "{part:?}"
        );
        assert!(!change.keeps(0.5), "{part:?}: {change:?}");
    }
}
