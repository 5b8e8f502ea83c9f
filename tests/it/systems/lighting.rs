//! Lighting: the illumination of a frame, and the model at the vertices.

use glam::{DVec3, dvec3};
use hecs::World;
use shadetrade::components::{
    Illumination, Lens, Light, LightKind, Normals, PointLight, Projection, ShadingMode,
    VertexColors, View,
};
use shadetrade::frame::Frame;
use shadetrade::systems::lighting;

use super::{
    MATERIAL, PROJECTIONS, ahead, at, empty_frame, light, place, read, signs, spawn_cuboid,
};

fn run(world: &mut World, view: &View) -> Frame {
    let mut frame = empty_frame();
    frame.lens = Lens::new(view);
    lighting::run(world, view, &mut frame);
    frame
}

/// The colours at the corners of an upright cube of two units at the origin under these lights, and the frame.
fn cube(lights: &[(DVec3, Light)], mode: ShadingMode, view: &View) -> ([DVec3; 8], Frame) {
    let mut world = World::new();
    let size = DVec3::splat(2.0);
    let cuboid = spawn_cuboid(&mut world, 0, at(DVec3::ZERO), size, MATERIAL, mode);
    let third = 1.0 / 3.0_f64.sqrt();
    let normals = Normals(std::array::from_fn(|corner| signs(corner) * third));
    let derived = (place(at(DVec3::ZERO)), normals);
    world.insert(cuboid, derived).expect("it was spawned");
    for (position, light) in lights {
        world.spawn((at(*position), *light));
    }
    let frame = run(&mut world, view);
    (read::<VertexColors>(&world, cuboid).0, frame)
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
    assert_eq!(run(&mut world, &view).illumination, expected);
}

#[test]
fn vertex_colours_are_computed_anew_after_a_light_went_off() {
    let view = ahead(Projection::Perspective, [8, 8]);
    let mut world = World::new();
    world.spawn((at(DVec3::X), light(LightKind::Diffuse, 10.0)));
    world.spawn((at(DVec3::X), light(LightKind::Ambient, 10.0)));
    let mut frame = run(&mut world, &view);
    assert_ne!(frame.illumination, Illumination::default());
    for light in world.query_mut::<&mut Light>() {
        light.on = false;
    }
    lighting::run(&mut world, &view, &mut frame);
    assert_eq!(frame.illumination, Illumination::default());
}

#[test]
fn ambient_light_alone_is_the_same_at_every_corner() {
    for projection in PROJECTIONS {
        let lights = [(DVec3::ZERO, light(LightKind::Ambient, 200.0))];
        let (colors, _) = cube(&lights, ShadingMode::Gouraud, &ahead(projection, [8, 8]));
        // kA is 0.1.
        assert_eq!(colors, [DVec3::splat(20.0); 8]);
    }
}

#[test]
fn gouraud_s_vertex_colours_are_the_model_at_the_vertices() {
    // Both lights are four units above the corner + + +; the eye is nine above the origin, at (0, 0, 10).
    let over = dvec3(1.0, 1.0, 5.0);
    let lights = [
        (over, light(LightKind::Diffuse, 100.0)),
        (over, light(LightKind::Specular, 100.0)),
    ];
    let view = ahead(Projection::Perspective, [8, 8]);
    let (perspective, frame) = cube(&lights, ShadingMode::Gouraud, &view);
    let view = ahead(Projection::Orthographic, [8, 8]);
    let (orthographic, _) = cube(&lights, ShadingMode::Gouraud, &view);
    // At + + +: l = (0, 0, 1), n.l = 1 / sqrt 3, and r = 2 (n.l) n - l = (2, 2, -1) / 3.
    let cosine = 1.0 / 3.0_f64.sqrt();
    // o = (-1, -1, 9) / sqrt 83 in perspective: o.r < 0. Orthographic: o = (0, 0, 1), o.r < 0 too.
    let expected = DVec3::splat(50.0 * cosine);
    assert!(perspective[7].abs_diff_eq(expected, 1e-12));
    assert!(orthographic[7].abs_diff_eq(expected, 1e-12));
    // At - + +: l = (2, 0, 4) / sqrt 20, n.l = 2 / sqrt 60, r = (-10, 4, -8) / (3 sqrt 20): o.r < 0.
    let expected = DVec3::splat(50.0 * 2.0 / 60.0_f64.sqrt());
    assert!(orthographic[6].abs_diff_eq(expected, 1e-12));
    // The lower four corners face away from the lights.
    assert_eq!(perspective[..4], [DVec3::ZERO; 4]);
    // Eight corners with one highlight each.
    let counts = frame.counts();
    assert_eq!(
        (counts.model_evaluations, counts.specular_evaluations),
        (8, 8)
    );
}

#[test]
fn a_vertex_that_reflects_the_light_to_the_eye_shows_the_highlight() {
    // At + + + r = (2, 2, -1) / 3: see above.
    let over = dvec3(1.0, 1.0, 5.0);
    let lights = [(over, light(LightKind::Specular, 100.0))];
    let shown = |eye: DVec3| {
        let mut view = ahead(Projection::Perspective, [8, 8]);
        view.viewpoint.position = eye;
        cube(&lights, ShadingMode::Gouraud, &view).0[7].x
    };
    // (7, 7, -2) is (1, 1, 1) + 9 r: o = r.
    assert!((shown(dvec3(7.0, 7.0, -2.0)) - 100.0).abs() < 1e-9);
    // o = (1, 1, 1) / sqrt 3: o.r = 1 / sqrt 3, squared by rho = 2.
    assert!((shown(dvec3(10.0, 10.0, 10.0)) - 100.0 / 3.0).abs() < 1e-9);
}

#[test]
fn a_cuboid_under_phong_has_no_vertex_colours() {
    let lights = [(DVec3::ZERO, light(LightKind::Ambient, 200.0))];
    let view = ahead(Projection::Perspective, [8, 8]);
    let (colors, frame) = cube(&lights, ShadingMode::Phong, &view);
    assert_eq!(colors, [DVec3::ZERO; 8]);
    assert_eq!(frame.counts().model_evaluations, 0);
    // Except if the view overrides the mode with Gouraud.
    let asked = View {
        shading: Some(ShadingMode::Gouraud),
        ..view
    };
    let (colors, _) = cube(&lights, ShadingMode::Phong, &asked);
    assert_eq!(colors, [DVec3::splat(20.0); 8]);
}
