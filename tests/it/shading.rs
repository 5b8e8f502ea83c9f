//! Levels computed on paper, which both the renderer and the reference have.
//!
//! A cube from -2 to 2 is seen from straight above. Its face z = 2 fills a picture of 5 x 5 pixels with centres one
//! unit apart: the middle pixel shows (0, 0, 2), the first one the corner (-2, 2, 2). The last column and row lie on
//! right and bottom edges and show the background.
//!
//! ```text
//!            x = -2 -1  0  1  2
//!   y =  2        #  #  #  #  .
//!        1        #  #  #  #  .        corner normals (+-1, +-1, 1) / sqrt 3
//!        0        #  #  #  #  .        the normal at (x, y) goes with (x / 2, y / 2, 1)
//!       -1        #  #  #  #  .
//!       -2        .  .  .  .  .
//! ```

use shadetrade::components::LightKind::{Ambient, Diffuse, Specular};
use shadetrade::components::ShadingMode::{Gouraud, Phong, UnitVectors};

use crate::support::prelude::*;

const MATERIAL: Material = Material {
    ambient: DVec3::new(0.1, 0.2, 0.3),
    diffuse: DVec3::new(0.5, 0.25, 1.0),
    specular: DVec3::new(1.0, 0.5, 0.25),
    shininess: 2.0,
};

/// The levels that every light here sends.
const SENT: DVec3 = DVec3::new(200.0, 100.0, 40.0);

/// The indices of [`views`].
const ABOVE: usize = 0;
const FROM_AN_EYE: usize = 1;

/// The face from above in orthographic projection, and of the same size in perspective from 10 units above it.
fn views() -> [View; 2] {
    [Projection::Orthographic, Projection::Perspective].map(|projection| {
        let mut view = view([5, 5], DVec3::Z * 12.0, DVec3::ZERO, projection);
        view.camera.height = 5.0;
        view.camera.fov = 2.0 * 0.25_f64.atan().to_degrees();
        view
    })
}

/// A cube from -`half` to `half` under one light.
fn cube(half: f64, shininess: f64, kind: LightKind, light: [f64; 3]) -> World {
    let mut world = empty();
    let material = Material {
        shininess,
        ..MATERIAL
    };
    let size = DVec3::splat(2.0 * half);
    spawn_cuboid(&mut world, size, at(DVec3::ZERO), material);
    spawn_light(&mut world, kind, SENT, light.into());
    world
}

/// A kind of light, and the share of it.
type Share = (LightKind, f64);

/// Asserts that a pixel of both pictures has this share of the levels that a material reflects of a light.
#[track_caller]
fn assert_share(world: &mut World, view: &View, [x, y]: [usize; 2], (kind, share): Share) {
    let coefficient = match kind {
        Ambient => MATERIAL.ambient,
        Diffuse => MATERIAL.diffuse,
        Specular => MATERIAL.specular,
    };
    let expected = coefficient * SENT * share;
    let pixel = y * view.size[0] + x;
    let exact = DVec3::from(truth(world, view).levels[pixel]);
    let mut pictures = vec![(exact, 1e-6)];
    if view.shading.is_none_or(ShadingMode::is_drawn) {
        let drawn = draw(world, view, Keep::Levels).levels()[pixel];
        pictures.push((drawn.map(f64::from).into(), 0.02));
    }
    for (found, limit) in pictures {
        let error = (found - expected).abs().max_element();
        assert!(error < limit, "{found}, not {expected}, at ({x}, {y})");
    }
}

/// A light, its position, and the shininess of the face.
type Lamp = (LightKind, [f64; 3], f64);

/// Asserts the shares of one light at points of the face.
#[track_caller]
fn assert_shares((kind, light, shininess): Lamp, view: &View, shares: &[([i32; 2], f64)]) {
    let mut world = cube(2.0, shininess, kind, light);
    for &([x, y], share) in shares {
        let pixel = [x + 2, 2 - y].map(|coordinate| coordinate as usize);
        assert_share(&mut world, view, pixel, (kind, share));
    }
}

#[test]
fn ambient_light_is_equal_everywhere_and_the_rest_is_background() {
    let views = views().map(|view| ShadingMode::ALL.map(|mode| view.shaded(mode)));
    for view in views.as_flattened() {
        let mut world = cube(2.0, 2.0, Ambient, [0.0; 3]);
        let frame = draw(&mut world, view, Keep::Levels);
        let truth = truth(&world, view);
        for (pixel, (drawn, exact)) in frame.levels().iter().zip(&truth.levels).enumerate() {
            let is_seen = pixel % 5 < 4 && pixel / 5 < 4;
            let cuboid = DVec3::new(20.0, 20.0, 12.0);
            let expected = if is_seen { cuboid } else { view.background };
            for found in [DVec3::from(drawn.map(f64::from)), DVec3::from(*exact)] {
                assert!((found - expected).length() < 1e-4, "{found} at {pixel}");
            }
        }
    }
}

#[test]
fn diffuse_light_is_proportional_to_the_cosine_between_normal_and_light() {
    // 2 above the middle. At (1, 0): n = (1, 0, 2) / sqrt 5, l = (-1, 0, 2) / sqrt 5, n.l = 3/5. At (1, 1): n = (1, 1,
    // 2) / sqrt 6, l = (-1, -1, 2) / sqrt 6, n.l = 1/3. At (-2, 2): n.l < 0, because -4 - 4 + 4 < 0.
    let lamp = (Diffuse, [0.0, 0.0, 4.0], 2.0);
    let shares = [
        ([0, 0], 1.0),
        ([1, 0], 0.6),
        ([0, -1], 0.6),
        ([1, 1], 1.0 / 3.0),
        ([-2, 2], 0.0),
    ];
    // No corner is lit, so Gouraud has no light at all.
    let dark = shares.map(|(point, _)| (point, 0.0));
    for view in views() {
        assert_shares(lamp, &view.shaded(Phong), &shares);
        assert_shares(lamp, &view.shaded(Gouraud), &dark);
    }
    // 1/4 above the middle: at (1, 0) n.l is negative, because -1 + 1/2 < 0.
    let lamp = (Diffuse, [0.0, 0.0, 2.25], 2.0);
    let shares = [([0, 0], 1.0), ([1, 0], 0.0), ([-1, -1], 0.0)];
    assert_shares(lamp, &views()[ABOVE].shaded(Phong), &shares);
}

#[test]
fn specular_light_is_the_power_of_the_cosine_between_eye_and_reflected_light() {
    let above = views()[ABOVE].shaded(Phong);
    // 2 above the middle, o = (0, 0, 1). At (1, 0): r = 2 (3/5) n - l = (11, 0, 2) / (5 sqrt 5), (o.r)^2 = 4/125.
    let lamp = (Specular, [0.0, 0.0, 4.0], 2.0);
    let shares = [([0, 0], 1.0), ([1, 0], 4.0 / 125.0), ([-2, 2], 0.0)];
    assert_shares(lamp, &above, &shares);
    // With shininess 0 the highlight covers everything in front of the light.
    let lamp = (Specular, [0.0, 0.0, 4.0], 0.0);
    assert_shares(lamp, &above, &[([1, 1], 1.0), ([-2, 2], 0.0)]);
    // A light exactly at the point has no direction.
    let lamp = (Specular, [0.0, 0.0, 2.0], 0.0);
    assert_shares(lamp, &above, &[([0, 0], 0.0)]);
    // At the corner (-2, 2): l = (-3, 0, -4) / 5, n.l = -1 / (5 sqrt 3), yet o.r = 2 (n.l) / sqrt 3 + 4/5 = 2/3.
    let lamp = (Specular, [-5.0, 2.0, -2.0], 2.0);
    for mode in [Gouraud, Phong] {
        assert_shares(lamp, &above.shaded(mode), &[([-2, 2], 0.0)]);
    }
    // At (1, 0) the eye above is reflected to (4, 0, 3) / 5.
    for shininess in [0.0, 1e-3, 0.5, 1.0, 76.8, 1e3, 1e6] {
        let lamp = (Specular, [5.0, 0.0, 5.0], shininess);
        assert_shares(lamp, &above, &[([1, 0], 1.0)]);
    }
    // The light at the eye, 10 above the middle: o.r = 2 (n.l)^2 - 1, and at (1, 0) n.l = 19 / sqrt (5 101).
    let lamp = (Specular, [0.0, 0.0, 12.0], 2.0);
    let share = (2.0_f64 * 361.0 / 505.0 - 1.0).powi(2);
    let shares = [([0, 0], 1.0), ([1, 0], share), ([0, 1], share)];
    assert_shares(lamp, &views()[FROM_AN_EYE].shaded(Phong), &shares);
}

#[test]
fn gouraud_interpolates_the_levels_at_the_corners() {
    // 3 sqrt 3 away from the corner (2, 2), which it lights fully; the other three corners face away. The weight of
    // that corner grows by a quarter per unit of x or y, on both sides of the diagonal through it and (-2, -2).
    let quarters = |x: i32, y: i32| f64::from(x.min(y) + 2) / 4.0;
    let points = (-2..2).flat_map(|x| (-1..3).map(move |y| [x, y]));
    let shares: Vec<_> = points.map(|[x, y]| ([x, y], quarters(x, y))).collect();
    for view in views() {
        let lamp = (Diffuse, [5.0, 5.0, 5.0], 2.0);
        assert_shares(lamp, &view.shaded(Gouraud), &shares);
    }
}

/// The top face of a cube, 1 below the eye and at distance 2 to 4, under a diffuse light infinitely far along +z.
///
/// Pixel (13, 17) of 25 x 25 looks 0.08 right and 0.4 down per unit of depth. It shows the point at depth 2.5 that is
/// (0.2, 1, 0.5) from the cube's centre, on the triangle of the corners (-1, 1, -1), (-1, 1, 1), (1, 1, 1) with weights
/// 0.25, 0.15, 0.6. The corners are at depths 4, 2 and 2, so their weights on the screen are as 1, 0.3, 1.2, or 0.4,
/// 0.12, 0.48.
#[test]
fn levels_or_normals_are_interpolated_as_the_mode_says() {
    let mut world = empty();
    let below = at(DVec3::new(0.0, -2.0, -3.0));
    spawn_cuboid(&mut world, DVec3::splat(2.0), below, MATERIAL);
    spawn_light(&mut world, Diffuse, SENT, DVec3::new(0.0, -1.0, 1e15));
    let mut view = view([25, 25], DVec3::ZERO, DVec3::NEG_Z, Projection::Perspective);
    view.camera.fov = 90.0;
    let [root, normal] = [3.0_f64.sqrt(), 1.29_f64.sqrt()];
    for (mode, near, share) in [
        // n.l at the corners: -1 / sqrt(3), which is clamped to 0, and twice 1 / sqrt(3). Clipping changes no colour.
        (Gouraud, 0.1, 0.75 / root),
        (Gouraud, 2.2, 0.75 / root),
        (Phong, 0.1, 0.5 / normal),
        (Phong, 2.2, 0.5 / normal),
        // On the screen, not normalised: n_z = (-0.4 + 0.12 + 0.48) / sqrt(3).
        (UnitVectors, 0.1, 0.2 / root),
        (UnitVectors, 2.0, 0.2 / root),
        // The nearest corners are nearer than the near plane, so the weights are those on the triangle:
        // n_z = (-0.25 + 0.15 + 0.6) / sqrt(3).
        (UnitVectors, 2.2, 0.5 / root),
    ] {
        view.camera.near = Some(near);
        assert_share(&mut world, &view.shaded(mode), [13, 17], (Diffuse, share));
    }
}

#[test]
fn unit_vectors_shorten_n_l_and_o() {
    let (eye, parallel) = (DVec3::Z * 5.0, Projection::Orthographic);
    let mut above = view([11, 11], eye, DVec3::ZERO, parallel);
    above.camera.height = 10.0;
    // The corners on the diagonal have n = (-+1, -+1, 1) / sqrt(3) and, under a light 1 above the face, l = (+-1, +-1, 1)
    // / sqrt(3): both shrink to (0, 0, 1 / sqrt(3)). n.l = 1 / 3, and r = 2/3 n - l points down.
    let above = above.shaded(UnitVectors);
    for (kind, share) in [(Diffuse, 1.0 / 3.0), (Specular, 0.0)] {
        let mut world = cube(1.0, 2.0, kind, [0.0, 0.0, 2.0]);
        assert_share(&mut world, &above, [5, 5], (kind, share));
    }
    // Half-way down the left edge of face z = 1 n = (-1, 0, 1) / sqrt(3), and the eye 4 above it has o = (0, +-1, 4) /
    // sqrt(17) at the corners, (0, 0, 4 / sqrt(17)) between. A light infinitely far has l = (-1, 0, 1) / sqrt(2), so
    // r = (2/3 - 1/2) sqrt(2) (-1, 0, 1) and o.r = sqrt(2) / 6 * 4 / sqrt(17).
    let mut world = cube(1.0, 1.0, Specular, [-1e15, 0.0, 1e15]);
    let [eye, target] = [5.0, 0.0].map(|z| DVec3::new(-1.0, 0.0, z));
    let mut aside = view([11, 11], eye, target, Projection::Perspective);
    aside.camera.fov = 90.0;
    let share = 2.0_f64.sqrt() / 6.0 * 4.0 / 17.0_f64.sqrt();
    let aside = aside.shaded(UnitVectors);
    assert_share(&mut world, &aside, [5, 5], (Specular, share));
}

/// The levels of a cube's face z = 1 with its own normal, in red, under a light in the plane of that face. The cube is turned
/// by these degrees. A highlight of shininess 0 is as bright as its light wherever n.l > 0, and else absent.
fn lit_from_its_plane(rotation: [f64; 3], view: &View) -> Vec<f32> {
    let mut world = empty();
    let cuboid = spawn_cuboid(&mut world, DVec3::splat(2.0), turned(rotation), MATERIAL);
    let material = Material {
        shininess: 0.0,
        ..MATERIAL
    };
    let face_normals = (material, NormalMode::Face);
    world.insert(cuboid, face_normals).expect("it was spawned");
    let axes = Transform::axes(&turned(rotation));
    spawn_light(&mut world, Specular, SENT, axes * DVec3::new(5.0, 0.3, 1.0));
    let mut view = *view;
    view.camera.position = axes * DVec3::new(-3.0, 0.7, 6.0);
    let frame = draw(&mut world, &view, Keep::Levels);
    let pixels = frame.triangles().iter().zip(frame.levels());
    let face = pixels.filter(|(id, _)| **id != TriangleId::NONE && id.face() == 4);
    face.map(|(_, levels)| levels[0]).collect()
}

#[test]
fn a_light_in_the_plane_of_a_face_with_its_own_normal_lights_all_of_it_or_nothing() {
    let ways = ShadingMode::ALL.map(|mode| [(mode, 0.0, 1), (mode, 0.5, 1), (mode, 0.5, 8)]);
    for (mode, tolerance, segments) in ways.into_iter().flatten() {
        let [mut lit, mut dark] = [0; 2];
        for degrees in 1..=30 {
            let angle = f64::from(degrees);
            let view = View {
                tolerance,
                segments: Segments::new(segments),
                ..view([40, 30], DVec3::ZERO, DVec3::ZERO, Projection::Perspective)
            };
            let face = lit_from_its_plane([7.0 * angle, 3.0 * angle, angle], &view.shaded(mode));
            assert!(face.len() > 100, "{} pixels are seen", face.len());
            let shining = face.iter().filter(|level| **level > 0.0).count();
            let what = format!("{mode:?} {tolerance} {segments} at {degrees}");
            assert!([0, face.len()].contains(&shining), "{what}: {shining}");
            lit += usize::from(shining > 0);
            dark += usize::from(shining == 0);
        }
        // Rounding decides for each rotation.
        assert!(lit > 0 && dark > 0, "{mode:?}: {lit} lit, {dark} dark");
    }
}
