//! Interpolation over a triangle in the reference.

use hecs::World;
use shadetrade::components::{LightKind, Material, ShadingMode};

use super::scenes::{
    MATERIAL, close, cube_of, cube_under, level, orthographic, spawn_cuboid, spawn_light, view,
};

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
fn unit_vectors_lose_the_highlight_and_two_thirds_of_the_diffuse_light_in_the_middle() {
    // The corners on the diagonal have n = (-+1, -+1, 1) / sqrt(3) and, under a light 1 above the face, l = (+-1, +-1, 1)
    // / sqrt(3): both shrink to (0, 0, 1 / sqrt(3)). n.l = 1 / 3, and r = 2/3 n - l points down.
    let view = orthographic([11, 11]).shaded(ShadingMode::UnitVectors);
    for (kind, expected) in [
        (LightKind::Diffuse, 100.0 / 3.0),
        (LightKind::Specular, 0.0),
    ] {
        let world = cube_under(kind, [0.0, 0.0, 2.0]);
        close(level(&world, &view, 5, 5), expected);
    }
}

#[test]
fn unit_vectors_shorten_o_and_so_reduce_the_highlight() {
    // Half-way down the left edge of face z = 1 n = (-1, 0, 1) / sqrt(3), and the eye 4 above it has o = (0, +-1, 4) /
    // sqrt(17) at the corners, (0, 0, 4 / sqrt(17)) between. A light infinitely far has l = (-1, 0, 1) / sqrt(2), so
    // r = (2/3 - 1/2) sqrt(2) (-1, 0, 1) and o.r = sqrt(2) / 6 * 4 / sqrt(17).
    let world = cube_of(
        Material {
            shininess: 1.0,
            ..MATERIAL
        },
        LightKind::Specular,
        [-1e15, 0.0, 1e15],
    );
    let view = view([11, 11], [-1.0, 0.0, 5.0], [-1.0, 0.0, 0.0]);
    let view = view.shaded(ShadingMode::UnitVectors);
    close(
        level(&world, &view, 5, 5),
        50.0 * 2.0_f64.sqrt() / 6.0 * 4.0 / 17.0_f64.sqrt(),
    );
}
