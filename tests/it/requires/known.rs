//! Scenes with required parts and errors known on paper.

use shadetrade::components::LightKind::{Ambient, Diffuse, Specular};
use shadetrade::components::Projection::{Orthographic, Perspective};
use shadetrade::components::ShadingMode::{Gouraud, Phong};
use shadetrade::questions::requires::{Change, Part};
use shadetrade::reference::Rule;

use super::{change, cubes, from_z, required};
use crate::support::prelude::*;

/// Asserts that the largest error encloses the known one, narrowly.
#[track_caller]
fn assert_error(change: Change, known: f64) {
    let [least, most] = change.largest_error;
    let is_known = least <= known + 1e-9 && known <= most + 1e-9;
    assert!(is_known && most - least < 1e-6, "{known}: {change:?}");
}

/// A cube at the origin.
fn origin() -> Transform {
    at(DVec3::ZERO)
}

fn shaded(mode: ShadingMode, mut scene: Scene) -> Scene {
    overwrite(&mut scene.world, &mode);
    scene
}

#[test]
fn a_light_is_required_where_the_tolerance_is_less_than_it_adds() {
    let view = from_z(8.0, Perspective);
    for mode in [Gouraud, Phong] {
        let behind = cubes(&[origin()], &[(Diffuse, 200.0, DVec3::Z * -10.0)], &view);
        let light = change(&shaded(mode, behind), &view, Part::Light(0));
        assert_error(light, 0.0);
        assert_eq!(light.pixels, 0);
    }
    // n.l is 1 in the middle of the face.
    let scene = cubes(&[origin()], &[(Diffuse, 0.2, DVec3::Z * 10.0)], &view);
    for (tolerance, is_required) in [(0.5, false), (0.201, false), (0.199, true), (0.0, true)] {
        let view = view.with_tolerance(tolerance);
        let light = change(&scene, &view, Part::Light(0));
        assert_error(light, 0.2);
        let found = [!light.keeps(tolerance), light.pixels > 0];
        assert_eq!(found, [is_required; 2], "{tolerance}");
    }
}

#[test]
fn a_depth_test_is_required_where_the_order_of_the_file_differs_from_that_of_depth() {
    let [left, right] = [DVec3::X * -1.5, DVec3::X * 1.5].map(at);
    let [near, far] = [DVec3::Z * 2.0, DVec3::new(0.5, 0.0, -2.0)].map(at);
    // The edge of the rotated cuboid sticks out of the other's face; it is painted over the face or not at all.
    let [straight, through] = [origin(), turned(DVec3::Y * 45.0)];
    for projection in Projection::ALL {
        for (places, is_required) in [
            (&[straight][..], false),
            (&[left, right], false),
            (&[far, near], false),
            (&[near, far], true),
            (&[straight, through], true),
            (&[through, straight], true),
        ] {
            let view = from_z(16.0, projection);
            let mut scene = cubes(places, &[(Ambient, 50.0, DVec3::ZERO)], &view);
            for (number, material) in (1..).zip(scene.world.query_mut::<&mut Material>()) {
                material.ambient = DVec3::splat(f64::from(number));
            }
            let depth = change(&scene, &view, Part::Rule(Rule::DepthTest));
            assert_error(depth, if is_required { 50.0 } else { 0.0 });
        }
    }
}

#[test]
fn a_cuboid_behind_another_is_not_required() {
    let [near, far] = [DVec3::Z * 2.0, DVec3::Z * -2.0].map(at);
    let view = from_z(16.0, Perspective);
    // Both have one colour, so the far one cannot be told from the near one in front of it, but it is smaller on the
    // screen.
    for (places, expected) in [([near, far], [true, false]), ([far, near], [false, true])] {
        let scene = cubes(&places, &[(Ambient, 50.0, DVec3::ZERO)], &view);
        let required = |cuboid| !change(&scene, &view, Part::Cuboid(cuboid)).keeps(0.5);
        assert_eq!([0, 1].map(required), expected);
    }
}

#[test]
fn parallel_rays_do_not_require_perspective_correct_interpolation() {
    let place = DVec3::new(3.0, 2.0, 4.0);
    let lights = [(Diffuse, 200.0, place), (Specular, 200.0, place)];
    for mode in [Gouraud, Phong] {
        for projection in Projection::ALL {
            let eye = DVec3::new(3.0, 2.0, 2.5);
            let view = view([49, 37], eye, DVec3::ZERO, projection).with_tolerance(0.5);
            let scene = shaded(mode, cubes(&[origin()], &lights, &view));
            let interpolation = change(&scene, &view, Part::Rule(Rule::PerspectiveCorrect));
            match projection {
                Perspective => assert!(interpolation.largest_error[0] > 5.0),
                Orthographic => assert_error(interpolation, 0.0),
            }
        }
    }
}

/// The error of affine interpolation on a square grows with the range of depth. With depths z and q z at two opposite
/// edges and levels that differ by d between them, its maximum is d (sqrt(q) - 1) / (sqrt(q) + 1).
#[test]
fn affine_interpolation_suffices_from_the_distance_computed_on_paper() {
    const TURN: f64 = 40.0;
    let turned = turned(DVec3::X * TURN);
    // Far away along the square's own y axis: n.l is 1 / sqrt(3) at two corners and negative at the others.
    let light = turned.axes() * DVec3::Y * 1e9;
    let differ = 100.0 / 3.0_f64.sqrt();
    let root = (1.0 + 0.5 / differ) / (1.0 - 0.5 / differ);
    let distance = TURN.to_radians().sin() * (root * root + 1.0) / (root * root - 1.0);
    assert!((20.0..80.0).contains(&distance), "{distance}");
    for (share, known) in [(1.0, 0.5), (1.01, 0.495), (0.99, 0.505)] {
        let mut view = from_z(share * distance, Perspective);
        view.camera.fov = 2.0 * (1.5 / distance).atan().to_degrees();
        view.size = [9, 2001];
        let mut scene = cubes(&[turned], &[(Diffuse, 100.0, light)], &view);
        for mesh in scene.world.query_mut::<&mut Mesh>() {
            *mesh = Mesh::cuboid(DVec3::new(2.0, 2.0, 1e-9));
        }
        let scene = shaded(Gouraud, scene);
        let interpolation = change(&scene, &view, Part::Rule(Rule::PerspectiveCorrect));
        for end in interpolation.largest_error {
            assert!((end - known).abs() < 1e-3, "{share}: {interpolation:?}");
        }
    }
}

#[test]
fn with_a_shininess_of_zero_only_the_gate_ends_a_highlight() {
    let view = from_z(8.0, Perspective);
    let mut scene = cubes(&[origin()], &[(Specular, 300.0, DVec3::Z * -10.0)], &view);
    for material in scene.world.query_mut::<&mut Material>() {
        material.shininess = 0.0;
    }
    assert_error(change(&scene, &view, Part::Light(0)), 0.0);
    // Half of 300, which the background of 20 levels does not hide.
    let gate = change(&scene, &view, Part::Rule(Rule::SpecularGate));
    assert_error(gate, 150.0);
    let face = change(&scene, &view, Part::Cuboid(0));
    assert_eq!(gate.pixels, face.pixels, "every pixel of the face");
}

/// The lamp is behind the face. In its middle n.l is -1, so without the clamp 100 of its 150 levels are taken away.
#[test]
fn without_the_clamp_a_lamp_behind_a_face_takes_light_away() {
    let view = from_z(8.0, Perspective);
    let behind = DVec3::Z * -10.0;
    let lights = [(Ambient, 150.0, DVec3::ZERO), (Diffuse, 100.0, behind)];
    let scene = cubes(&[origin()], &lights, &view);
    assert_error(change(&scene, &view, Part::Rule(Rule::DiffuseClamp)), 100.0);
    let before = cubes(&[origin()], &[(Diffuse, 100.0, DVec3::Z * 1e9)], &view);
    assert_error(change(&before, &view, Part::Rule(Rule::DiffuseClamp)), 0.0);
}

#[test]
fn without_normalisation_normals_are_shorter_by_sqrt_3_in_the_middle_of_a_face() {
    let view = from_z(8.0, Perspective);
    let short = 200.0 * (1.0 - 1.0 / 3.0_f64.sqrt());
    let scene = cubes(&[origin()], &[(Diffuse, 200.0, DVec3::Z * 1e13)], &view);
    assert_error(change(&scene, &view, Part::Rule(Rule::UnitNormal)), short);
    // Gouraud has n.l of the corners, 1 / sqrt(3), everywhere. The shading of the view does not matter.
    for view in [&view, &view.shaded(Gouraud)] {
        assert_error(change(&scene, view, Part::EveryPixel(0)), short);
    }
    let scene = shaded(Gouraud, scene);
    assert_error(change(&scene, &view, Part::Rule(Rule::UnitNormal)), 0.0);
    let mut parts = shadetrade::questions::requires::parts(&scene).into_iter();
    assert!(!parts.any(|(part, _)| part == Part::EveryPixel(0)));
}

#[test]
fn a_near_plane_is_required_where_it_clips() {
    for projection in Projection::ALL {
        let mut view = from_z(4.0, projection);
        let scene = cubes(&[origin()], &[(Ambient, 100.0, DVec3::ZERO)], &view);
        // The face is at distance 3. Behind the eye only parallel lines of sight reach it.
        let behind = if projection == Perspective { 0.0 } else { 80.0 };
        for (eye, near, known) in [(4.0, 2.9, 0.0), (4.0, 3.1, 80.0), (-4.0, 0.1, behind)] {
            view.camera.position = DVec3::Z * eye;
            view.camera.target = DVec3::Z * (eye - 1.0);
            view.camera.near = Some(near);
            assert_error(change(&scene, &view, Part::Rule(Rule::NearPlane)), known);
        }
    }
}

/// Two intersecting cuboids, clipped by the near plane, lit from the side and from behind, far from the origin.
#[test]
fn a_scene_that_requires_every_part() {
    let centre = DVec3::splat(3e6);
    // A light nearly opposite to the eye grazes faces from the front and from behind.
    let [side, behind] = [DVec3::new(4.0, 2.0, 1.0), DVec3::new(-4.0, -1.5, -3.6)];
    let lights = [
        (Diffuse, 200.0, centre + side),
        (Specular, 400.0, centre + behind),
        (Ambient, 20.0, DVec3::ZERO),
    ];
    let mut view = from_z(1.0, Perspective);
    view.camera.position = centre + DVec3::new(2.0, 2.2, 1.8);
    view.camera.target = centre;
    view.camera.near = Some(2.0);
    view.camera.fov = 70.0;
    let places = [0.0, 45.0].map(|degrees| placed(centre, DVec3::Y * degrees));
    let mut scene = cubes(&places, &lights, &view);
    for material in scene.world.query_mut::<&mut Material>() {
        material.shininess = 2.0;
    }
    let parts = shadetrade::questions::requires::parts(&scene);
    let all: Vec<String> = parts.into_iter().map(|(_, name)| name).collect();
    assert_eq!(required(&scene, &view), all);
}

/// From this distance f64 cannot tell where on a cuboid a pixel lies, or whether it lies on it at all.
#[test]
fn an_undecided_part_is_required() {
    let lights = [
        (Ambient, 100.0, DVec3::ZERO),
        (Diffuse, 100.0, DVec3::Z * 8.0),
    ];
    let mut view = from_z(8.0, Perspective);
    view.camera.position = DVec3::new(1.0, 0.7, 1.3) * 1e22;
    view.camera.fov = 1e-20;
    let scene = cubes(&[origin()], &lights, &view);
    for part in [Part::Cuboid(0), Part::Light(1)] {
        let change = change(&scene, &view, part);
        assert_eq!((change.largest_error[0], change.pixels), (0.0, 0));
        assert!(!change.keeps(0.5), "{part:?}: {change:?}");
    }
}

#[test]
fn with_face_normals_a_face_towards_the_light_is_brighter_by_sqrt_3_than_under_corner_normals() {
    let view = from_z(8.0, Perspective);
    // n.l is 1 on the face, and 1 / sqrt(3) at its corners under corner normals.
    let change_of = |mode| {
        let scene = cubes(&[origin()], &[(Diffuse, 200.0, DVec3::Z * 1e13)], &view);
        change(&shaded(mode, scene), &view, Part::CornerNormals(0))
    };
    let brighter = 200.0 * (1.0 - 1.0 / 3.0_f64.sqrt());
    assert_error(change_of(Gouraud), brighter);
    // Phong's normal is the face's in the middle of the face, and the corners' near them.
    let [least, most] = change_of(Phong).largest_error;
    let is_known = 0.8 * brighter < least && most <= brighter + 1e-9;
    assert!(is_known, "{least} to {most}");
    // A cuboid that has face normals does not need others.
    let mut sharp = cubes(&[origin()], &[], &view);
    overwrite(&mut sharp.world, &NormalMode::Face);
    let mut parts = shadetrade::questions::requires::parts(&sharp).into_iter();
    assert!(!parts.any(|(part, _)| matches!(part, Part::CornerNormals(_))));
}
