//! The illumination model of the reference.

use glam::DVec3;
use shadetrade::components::{Light, LightKind, Material, ShadingMode};
use shadetrade::frame::NO_TRIANGLE;

use super::scenes::{
    MATERIAL, close, cube_of, cube_under, draw, level, orthographic, sample, spawn_light, view,
};

#[test]
fn under_a_light_the_diffuse_term_is_full_in_phong_and_a_mean_of_corners_in_gouraud() {
    // At the middle of the face l = n. At a corner (1, 1, 1) / sqrt(3) . (-1, -1, 3) / sqrt(11) = 1 / sqrt(33).
    let world = cube_under(LightKind::Diffuse, [0.0, 0.0, 4.0]);
    let view = view([11, 11], [0.0, 0.0, 5.0], [0.0; 3]);
    close(level(&world, &view.shaded(ShadingMode::Phong), 5, 5), 100.0);
    close(
        level(&world, &view.shaded(ShadingMode::Gouraud), 5, 5),
        100.0 / 33.0_f64.sqrt(),
    );
}

/// The middle of the face z = 1 under a specular light at (3, 0, 5), so that l = (0.6, 0, 0.8), seen from `eye`.
fn highlight(eye: [f64; 3], shininess: f64) -> f64 {
    let world = cube_of(
        Material {
            shininess,
            ..MATERIAL
        },
        LightKind::Specular,
        [3.0, 0.0, 5.0],
    );
    level(&world, &view([11, 11], eye, [0.0, 0.0, 1.0]), 5, 5)
}

#[test]
fn the_highlight_is_the_power_of_the_cosine_to_the_mirror_direction() {
    // r = 2 * 0.8 (0, 0, 1) - (0.6, 0, 0.8) = (-0.6, 0, 0.8), and the highlight is at most kE * 100.
    for (eye, shininess, expected) in [
        // o = r, for every exponent.
        ([-3.0, 0.0, 5.0], 0.0, 50.0),
        ([-3.0, 0.0, 5.0], 76.8, 50.0),
        ([-3.0, 0.0, 5.0], 1e6, 50.0),
        // o = (0.6, 0, 0.8), so o.r = -0.36 + 0.64 = 0.28.
        ([3.0, 0.0, 5.0], 2.0, 50.0 * 0.28 * 0.28),
        ([3.0, 0.0, 5.0], 0.5, 50.0 * 0.28_f64.sqrt()),
        // o = (-0.8, 0, 0.6), so o.r = 0.48 + 0.48 = 0.96.
        ([-4.0, 0.0, 4.0], 76.8, 50.0 * 0.96_f64.powf(76.8)),
        // o = (0.96, 0, 0.28), so o.r = -0.352; 0^0 = 1.
        ([9.6, 0.0, 3.8], 2.0, 0.0),
        ([9.6, 0.0, 3.8], 0.0, 50.0),
    ] {
        close(highlight(eye, shininess), expected);
    }
}

#[test]
fn a_narrow_highlight_is_right_where_its_cosine_is_nearly_one() {
    // An eye turned from r by the angle a sees cos(a)^rho = exp(-rho (a^2 / 2 + a^4 / 12)): a = 1e-3, rho = 1e6.
    let (sin, cos) = 1e-3_f64.sin_cos();
    let eye = [-3.0 * cos + 4.0 * sin, 0.0, 1.0 + 4.0 * cos + 3.0 * sin];
    let expected = 50.0 * (-0.5 - 1e-6_f64 / 12.0).exp();
    assert!((highlight(eye, 1e6) - expected).abs() < 1e-6);
}

#[test]
fn a_light_behind_the_surface_adds_neither_term() {
    let material = Material {
        shininess: 0.0,
        ..MATERIAL
    };
    for kind in [LightKind::Diffuse, LightKind::Specular] {
        let world = cube_of(material, kind, [0.0, 0.0, 0.999]);
        let view = view([11, 11], [0.0, 0.0, 5.0], [0.0; 3]);
        close(level(&world, &view, 5, 5), 0.0);
    }
}

#[test]
fn a_light_exactly_at_the_point_has_no_direction_and_adds_nothing() {
    let mut world = cube_under(LightKind::Diffuse, [0.0, 0.0, 1.0]);
    spawn_light(&mut world, LightKind::Specular, [0.0, 0.0, 1.0]);
    let seen = sample(&world, &orthographic([11, 11]), 5, 5);
    assert_eq!(seen.phong, DVec3::ZERO);
    assert!(
        seen.lights
            .iter()
            .all(|light| light.to_light.is_none() && light.reflected.is_none())
    );
}

#[test]
fn ambient_light_is_constant_and_the_background_fills_the_rest() {
    let world = cube_under(LightKind::Ambient, [0.0; 3]);
    for mode in [
        ShadingMode::Gouraud,
        ShadingMode::Phong,
        ShadingMode::UnitVectors,
    ] {
        let truth = draw(
            &world,
            &view([20, 20], [1.0, 2.0, 3.0], [0.0; 3]).shaded(mode),
        );
        for (levels, id) in truth.levels.iter().zip(&truth.triangles) {
            let expected = if *id == NO_TRIANGLE {
                [1.0, 2.0, 3.0]
            } else {
                [10.0; 3]
            };
            levels
                .iter()
                .zip(expected)
                .for_each(|(observed, expected)| close(*observed, expected));
        }
    }
}

#[test]
fn a_light_that_is_off_is_left_out() {
    let mut world = cube_under(LightKind::Diffuse, [0.0, 0.0, 4.0]);
    world
        .query_mut::<&mut Light>()
        .into_iter()
        .for_each(|light| light.on = false);
    let seen = sample(&world, &orthographic([11, 11]), 5, 5);
    assert_eq!(
        (seen.phong, seen.gouraud, seen.lights.len()),
        (DVec3::ZERO, DVec3::ZERO, 0)
    );
}

#[test]
fn colours_and_coefficients_multiply_channel_by_channel() {
    let material = Material {
        diffuse: DVec3::new(0.5, 0.25, 2.0),
        ..MATERIAL
    };
    let mut world = cube_of(material, LightKind::Diffuse, [0.0, 0.0, 4.0]);
    world
        .query_mut::<&mut Light>()
        .into_iter()
        .for_each(|light| light.color = DVec3::new(1.0, 0.5, 3.0));
    let seen = sample(&world, &orthographic([11, 11]), 5, 5);
    assert!(
        (seen.phong - DVec3::new(50.0, 12.5, 600.0)).length() < 1e-9,
        "{}",
        seen.phong
    );
}
