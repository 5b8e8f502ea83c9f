//! Lighting: the illumination of a frame, and the model at the vertices.

use glam::dvec3;
use shadetrade::questions::metrics::{Picture, compare};
use shadetrade::shading::LIMIT_0;
use shadetrade::systems::{lighting, projection};

use super::{MATERIAL, ahead, at, empty_frame, light, place, read};
use crate::support::prelude::*;

fn run(world: &mut World, view: &View) -> Frame {
    let mut frame = empty_frame();
    projection::run(world, view, &mut frame);
    lighting::run(world, view, &mut frame);
    frame
}

#[test]
fn a_light_that_is_off_is_left_out_and_lights_at_one_place_are_one() {
    let off = |kind| Light {
        on: false,
        ..light(kind, 1e3)
    };
    let mut world = World::new();
    for (position, light) in [
        (DVec3::X, light(LightKind::Diffuse, 10.0)),
        (DVec3::Y, off(LightKind::Diffuse)),
        (DVec3::X, light(LightKind::Specular, 3.0)),
        (DVec3::X, off(LightKind::Specular)),
        (DVec3::ZERO, light(LightKind::Ambient, 5.0)),
        (DVec3::Z, light(LightKind::Ambient, 2.0)),
        (DVec3::ZERO, off(LightKind::Ambient)),
        (DVec3::X, light(LightKind::Diffuse, 4.0)),
    ] {
        world.spawn((at(position), light));
    }
    let view = ahead(Projection::Perspective, [8, 8]);
    let expected = Illumination {
        ambient: DVec3::splat(7.0),
        points: vec![PointLight {
            position: DVec3::X,
            diffuse: DVec3::splat(14.0),
            specular: DVec3::splat(3.0),
        }],
    };
    assert_eq!(*run(&mut world, &view).illumination(), expected);
}

#[test]
fn with_face_normals_the_model_is_evaluated_at_the_corners_of_each_visible_face() {
    // A light four units above the corner + + + of a cube of two units, which is seen from straight ahead.
    let over = dvec3(1.0, 1.0, 5.0);
    let mut world = World::new();
    let cuboid = spawn_cuboid(&mut world, DVec3::splat(2.0), at(DVec3::ZERO), MATERIAL);
    let derived = (place(at(DVec3::ZERO)), Normals::Face(DVec3::AXES));
    world.insert(cuboid, derived).expect("it was spawned");
    world.spawn((at(over), light(LightKind::Diffuse, 100.0)));
    let view = ahead(Projection::Perspective, [8, 8]).shaded(ShadingMode::Gouraud);
    let frame = run(&mut world, &view);
    // The front face has the normal (0, 0, 1). At + + + n.l = 1, at - - + n.l = 4 / sqrt(4 + 4 + 16). kD is 0.5.
    let [lower, .., upper, _] = read::<VertexColors>(&world, cuboid).of_face(4);
    assert!(upper.abs_diff_eq(DVec3::splat(50.0), 1e-12), "{upper}");
    let expected = DVec3::splat(50.0 * 4.0 / 24.0_f64.sqrt());
    assert!(lower.abs_diff_eq(expected, 1e-12), "{lower}");
    // The other five are not seen.
    assert_eq!(frame.counts().model_evaluations, 4);
}

/// The evaluations of the model in a picture of one cube, which is 20 units wide and high.
fn evaluations(centre: [f64; 3], size: f64, segments: u32, mode: NormalMode) -> u64 {
    let mut world = World::new();
    spawn_cuboid(&mut world, DVec3::splat(size), at(centre.into()), MATERIAL);
    overwrite(&mut world, &mode);
    let mut view = ahead(Projection::Orthographic, [80, 80]).shaded(ShadingMode::Gouraud);
    view.segments = Segments::new(segments);
    let frame = draw(&mut world, &view, Keep::Display);
    frame.counts().model_evaluations
}

#[test]
fn grids_are_lit_only_for_faces_in_the_picture() {
    let inside = [[0.0, 0.0], [9.5, -9.5]];
    let outside = [
        [12.0, 0.0],
        [-12.0, 0.0],
        [0.0, 12.0],
        [0.0, -12.0],
        [12.0, 12.0],
    ];
    for centre in inside.into_iter().chain(outside) {
        let faces = u64::from(inside.contains(&centre));
        for mode in [NormalMode::Corner, NormalMode::Face] {
            let evaluations = evaluations([centre[0], centre[1], 0.0], 2.0, 4, mode);
            assert_eq!(evaluations, faces * 25, "{mode:?} at {centre:?}");
        }
    }
}

#[test]
fn of_a_grid_only_the_points_of_cells_in_the_picture_are_lit() {
    // The picture shows a tenth of a face of 200 units, and some of its cells in part; one more on
    // each side may be lit.
    for (centre, [least, most]) in [
        ([0.0, 0.0], [26 * 26, 30 * 30]),
        // The lower left corner of the face is the middle of the picture: 10 units are 12.8 cells.
        ([100.0, 100.0], [14 * 14, 16 * 16]),
        ([95.0, 0.0], [20 * 26, 22 * 30]),
    ] {
        let centre = [centre[0], centre[1], -95.0];
        let evaluations = evaluations(centre, 200.0, 256, NormalMode::Corner);
        assert!(
            (least..=most).contains(&evaluations),
            "{evaluations} at {centre:?}"
        );
    }
}

#[test]
fn pixels_light_the_points_of_their_cells_where_these_are_smaller_than_pixels() {
    // A cube of two units, on a picture 20 units wide and high.
    for (side, is_dense) in [(10, true), (400, true), (1100, false)] {
        let mut world = World::new();
        spawn_cuboid(&mut world, DVec3::splat(2.0), at(DVec3::ZERO), MATERIAL);
        shine(&mut world, LightKind::Specular, 200.0, dvec3(3.0, 2.0, 9.0));
        let view = View {
            segments: Segments::new(256),
            ..ahead(Projection::Orthographic, [side; 2]).shaded(ShadingMode::Gouraud)
        };
        let frame = draw(&mut world, &view, Keep::Levels);
        let (counts, points) = (frame.counts(), 257 * 257);
        let pixels = counts.covered_pixels;
        assert_eq!(pixels, (side / 10).pow(2) as u64);
        let expected = if is_dense { 3 * pixels } else { points };
        assert_eq!(counts.model_evaluations, expected, "{side}");
        let exact = truth(&world, &view);
        let error = compare(Picture::from(&frame), Picture::from(&exact)).error;
        assert!(error.expect("a cube is there").max < LIMIT_0, "{side}");
    }
}
