//! The illumination model of the reference, and its interpolation over a triangle.

use glam::DVec3;
use hecs::World;
use shadetrade::components::{Light, LightKind, Material, ShadingMode, overwrite};
use shadetrade::frame::NO_TRIANGLE;

use super::scenes::{
    MATERIAL, close, cube_of, cube_under, draw, level, orthographic, sample, spawn_cuboid,
    spawn_light, view,
};

/// The middle of the face z = 1 under a specular light at (3, 0, 5), so that l = (0.6, 0, 0.8), seen from `eye`.
fn highlight(eye: [f64; 3], shininess: f64) -> f64 {
    let material = Material {
        shininess,
        ..MATERIAL
    };
    let world = cube_of(material, LightKind::Specular, [3.0, 0.0, 5.0]);
    level(&world, &view([11, 11], eye, [0.0, 0.0, 1.0]), 5, 5)
}

#[test]
fn the_highlight_is_the_power_of_the_cosine_to_the_mirror_direction() {
    // r = 2 * 0.8 (0, 0, 1) - (0.6, 0, 0.8) = (-0.6, 0, 0.8), and the highlight is at most kE * 100.
    for (eye, shininess, expected) in [
        // o = r, for every exponent.
        ([-3.0, 0.0, 5.0], 0.0, 50.0),
        ([-3.0, 0.0, 5.0], 1e6, 50.0),
        // o = (0.6, 0, 0.8), so o.r = -0.36 + 0.64 = 0.28.
        ([3.0, 0.0, 5.0], 2.0, 50.0 * 0.28 * 0.28),
        ([3.0, 0.0, 5.0], 0.5, 50.0 * 0.28_f64.sqrt()),
        // o = (0.96, 0, 0.28), so o.r = -0.352; 0^0 = 1.
        ([9.6, 0.0, 3.8], 2.0, 0.0),
        ([9.6, 0.0, 3.8], 0.0, 50.0),
    ] {
        close(highlight(eye, shininess), expected);
    }
}

#[test]
fn a_light_behind_the_surface_or_exactly_at_the_point_adds_neither_term() {
    let material = Material {
        shininess: 0.0,
        ..MATERIAL
    };
    for z in [0.999, 1.0] {
        let mut world = cube_of(material, LightKind::Diffuse, [0.0, 0.0, z]);
        spawn_light(&mut world, LightKind::Specular, [0.0, 0.0, z]);
        let seen = sample(&world, &orthographic([11, 11]), 5, 5);
        assert_eq!(seen.phong, DVec3::ZERO);
        for light in seen.lights {
            let vectors = [light.to_light, light.reflected];
            assert_eq!(vectors.map(|it| it.is_none()), [z == 1.0; 2]);
        }
    }
}

#[test]
fn ambient_light_is_constant_and_the_background_fills_the_rest() {
    use ShadingMode::{Gouraud, Phong, UnitVectors};
    let world = cube_under(LightKind::Ambient, [0.0; 3]);
    let view = view([20, 20], [1.0, 2.0, 3.0], [0.0; 3]);
    for mode in [Gouraud, Phong, UnitVectors] {
        let truth = draw(&world, &view.shaded(mode));
        for (levels, id) in truth.levels.iter().zip(&truth.triangles) {
            let is_background = *id == NO_TRIANGLE;
            let expected = if is_background {
                [1.0, 2.0, 3.0]
            } else {
                [10.0; 3]
            };
            let pairs = levels.iter().zip(expected);
            pairs.for_each(|(observed, expected)| close(*observed, expected));
        }
    }
}

#[test]
fn a_light_that_is_off_is_left_out() {
    let mut world = cube_under(LightKind::Diffuse, [0.0, 0.0, 4.0]);
    let off = Light {
        kind: LightKind::Diffuse,
        color: DVec3::ONE,
        intensity: 1.0,
        gain: 1.0,
        on: false,
    };
    overwrite(&mut world, &off);
    let seen = sample(&world, &orthographic([11, 11]), 5, 5);
    let levels = (seen.phong, seen.gouraud, seen.lights.len());
    assert_eq!(levels, (DVec3::ZERO, DVec3::ZERO, 0));
}

/// The top face of a cube, 1 below the eye and at distance 2 to 4, under a diffuse light infinitely far along +z;
/// `near` is in world units.
///
/// Pixel (13, 17) of 25 x 25 looks 0.08 right and 0.4 down per unit of depth. It shows the point at depth 2.5 that is
/// (0.2, 1, 0.5) from the cube's centre, on the triangle of the corners (-1, 1, -1), (-1, 1, 1), (1, 1, 1) with weights
/// 0.25, 0.15, 0.6. The corners are at depths 4, 2 and 2, so their weights on the screen are as 1, 0.3, 1.2, or 0.4,
/// 0.12, 0.48.
fn receding_top(mode: ShadingMode, near: f64) -> f64 {
    let mut world = World::new();
    spawn_cuboid(&mut world, [2.0; 3], [0.0, -2.0, -3.0]);
    spawn_light(&mut world, LightKind::Diffuse, [0.0, -1.0, 1e15]);
    let mut view = view([25, 25], [0.0; 3], [0.0, 0.0, -1.0]).shaded(mode);
    view.viewpoint.camera.near = Some(near);
    level(&world, &view, 13, 17)
}

#[test]
fn levels_or_normals_are_interpolated_as_the_mode_says() {
    let [root, normal] = [3.0_f64.sqrt(), 1.29_f64.sqrt()];
    for (mode, near, expected) in [
        // n.l at the corners: -1 / sqrt(3), which is clamped to 0, and twice 1 / sqrt(3). Clipping changes no colour.
        (ShadingMode::Gouraud, 0.1, 75.0 / root),
        (ShadingMode::Gouraud, 2.2, 75.0 / root),
        (ShadingMode::Phong, 0.1, 50.0 / normal),
        (ShadingMode::Phong, 2.2, 50.0 / normal),
        // On the screen, not normalised: n_z = (-0.4 + 0.12 + 0.48) / sqrt(3).
        (ShadingMode::UnitVectors, 0.1, 20.0 / root),
        (ShadingMode::UnitVectors, 2.0, 20.0 / root),
        // The nearest corners are nearer than the near plane, so the weights are those on the triangle:
        // n_z = (-0.25 + 0.15 + 0.6) / sqrt(3).
        (ShadingMode::UnitVectors, 2.2, 50.0 / root),
    ] {
        close(receding_top(mode, near), expected);
    }
}

#[test]
fn unit_vectors_shorten_n_l_and_o() {
    // The corners on the diagonal have n = (-+1, -+1, 1) / sqrt(3) and, under a light 1 above the face, l = (+-1, +-1, 1)
    // / sqrt(3): both shrink to (0, 0, 1 / sqrt(3)). n.l = 1 / 3, and r = 2/3 n - l points down.
    let above = orthographic([11, 11]).shaded(ShadingMode::UnitVectors);
    for (kind, expected) in [
        (LightKind::Diffuse, 100.0 / 3.0),
        (LightKind::Specular, 0.0),
    ] {
        let world = cube_under(kind, [0.0, 0.0, 2.0]);
        close(level(&world, &above, 5, 5), expected);
    }
    // Half-way down the left edge of face z = 1 n = (-1, 0, 1) / sqrt(3), and the eye 4 above it has o = (0, +-1, 4) /
    // sqrt(17) at the corners, (0, 0, 4 / sqrt(17)) between. A light infinitely far has l = (-1, 0, 1) / sqrt(2), so
    // r = (2/3 - 1/2) sqrt(2) (-1, 0, 1) and o.r = sqrt(2) / 6 * 4 / sqrt(17).
    let material = Material {
        shininess: 1.0,
        ..MATERIAL
    };
    let world = cube_of(material, LightKind::Specular, [-1e15, 0.0, 1e15]);
    let aside = view([11, 11], [-1.0, 0.0, 5.0], [-1.0, 0.0, 0.0]);
    let level = level(&world, &aside.shaded(ShadingMode::UnitVectors), 5, 5);
    close(level, 50.0 * 2.0_f64.sqrt() / 6.0 * 4.0 / 17.0_f64.sqrt());
}
