//! Values computed on paper.
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

use glam::DVec3;
use shadetrade::components::{Light, LightKind, Material, Projection, ShadingMode, View, ordered};
use shadetrade::frame::{Keep, NO_TRIANGLE};
use shadetrade::scene::Scene;

use super::truth::Setting;
use crate::support::scene::{at, draw, empty, spawn_cuboid, spawn_light, view};

const MATERIAL: Material = Material {
    ambient: DVec3::new(0.1, 0.2, 0.3),
    diffuse: DVec3::new(0.5, 0.25, 1.0),
    specular: DVec3::new(1.0, 0.5, 0.25),
    shininess: 2.0,
};

/// The levels that every light here sends.
const SENT: DVec3 = DVec3::new(200.0, 100.0, 40.0);

const MODES: [ShadingMode; 3] = [
    ShadingMode::Gouraud,
    ShadingMode::Phong,
    ShadingMode::UnitVectors,
];

/// A light: its kind and position.
type Lamp = (LightKind, [f64; 3]);

/// The face in orthographic projection.
fn from_above() -> View {
    let mut view = view(
        [5, 5],
        DVec3::Z * 12.0,
        DVec3::ZERO,
        Projection::Orthographic,
    );
    view.viewpoint.camera.height = 5.0;
    view
}

/// The same face of the same size in perspective, the eye 10 units above it.
fn from_an_eye() -> View {
    let mut view = view(
        [5, 5],
        DVec3::Z * 12.0,
        DVec3::ZERO,
        Projection::Perspective,
    );
    view.viewpoint.camera.fov = 2.0 * 0.25_f64.atan().to_degrees();
    view
}

/// The levels of all pixels.
fn picture(material: Material, lamps: &[Lamp], view: &View, mode: ShadingMode) -> Vec<DVec3> {
    let mut world = empty();
    spawn_cuboid(&mut world, DVec3::splat(4.0), at(DVec3::ZERO), material);
    for &(kind, position) in lamps {
        spawn_light(&mut world, kind, SENT, position.into());
    }
    let frame = draw(&mut world, &view.shaded(mode), Keep::Levels);
    let levels = frame.levels().iter();
    levels
        .map(|levels| DVec3::from(levels.map(f64::from)))
        .collect()
}

/// The index of the pixel that shows (x, y, 2).
fn pixel(x: i32, y: i32) -> usize {
    ((2 - y) * 5 + x + 2) as usize
}

/// The factor of one light at some points of the face.
#[track_caller]
fn assert_shares(lamp: Lamp, view: &View, mode: ShadingMode, shares: &[([i32; 2], f64)]) {
    let coefficient = match lamp.0 {
        LightKind::Ambient => MATERIAL.ambient,
        LightKind::Diffuse => MATERIAL.diffuse,
        LightKind::Specular => MATERIAL.specular,
    };
    let picture = picture(MATERIAL, &[lamp], view, mode);
    for &([x, y], share) in shares {
        let (found, expected) = (picture[pixel(x, y)], coefficient * SENT * share);
        assert!(
            (found - expected).abs().max_element() < 1e-4,
            "{lamp:?} gives {found}, not {expected} at ({x}, {y})"
        );
    }
}

#[test]
fn ambient_light_is_equal_everywhere() {
    for mode in MODES {
        for view in [from_above(), from_an_eye()] {
            let picture = picture(MATERIAL, &[(LightKind::Ambient, [0.0; 3])], &view, mode);
            for (pixel, levels) in picture.iter().enumerate() {
                let seen = pixel % 5 < 4 && pixel / 5 < 4;
                let expected = if seen {
                    DVec3::new(20.0, 20.0, 12.0)
                } else {
                    view.background
                };
                assert!((*levels - expected).length() < 1e-4, "{levels} at {pixel}");
            }
        }
    }
}

#[test]
fn diffuse_light_is_proportional_to_the_cosine_between_normal_and_light() {
    // 2 above the middle. At (1, 0): n = (1, 0, 2) / sqrt 5, l = (-1, 0, 2) / sqrt 5, n.l = 3/5. At (1, 1): n = (1, 1,
    // 2) / sqrt 6, l = (-1, -1, 2) / sqrt 6, n.l = 1/3. At (-2, 2): n.l < 0, because -4 - 4 + 4 < 0.
    let shares = [
        ([0, 0], 1.0),
        ([1, 0], 0.6),
        ([0, -1], 0.6),
        ([1, 1], 1.0 / 3.0),
        ([-2, 2], 0.0),
    ];
    let lamp = (LightKind::Diffuse, [0.0, 0.0, 4.0]);
    assert_shares(lamp, &from_above(), ShadingMode::Phong, &shares);
    assert_shares(lamp, &from_an_eye(), ShadingMode::Phong, &shares);
    // 1/4 above the middle: at (1, 0) n.l is negative, because -1 + 1/2 < 0.
    let shares = [([0, 0], 1.0), ([1, 0], 0.0), ([-1, -1], 0.0)];
    let lamp = (LightKind::Diffuse, [0.0, 0.0, 2.25]);
    assert_shares(lamp, &from_above(), ShadingMode::Phong, &shares);
}

#[test]
fn specular_light_is_the_power_of_the_cosine_between_eye_and_reflected_light() {
    // 2 above the middle, o = (0, 0, 1). At (1, 0): r = 2 (3/5) n - l = (11, 0, 2) / (5 sqrt 5), (o.r)^2 = 4/125.
    let lamp = (LightKind::Specular, [0.0, 0.0, 4.0]);
    let shares = [([0, 0], 1.0), ([1, 0], 4.0 / 125.0), ([-2, 2], 0.0)];
    assert_shares(lamp, &from_above(), ShadingMode::Phong, &shares);
    // The light at the eye, 10 above the middle: o.r = 2 (n.l)^2 - 1, and at (1, 0) n.l = 19 / sqrt (5 101).
    let lamp = (LightKind::Specular, [0.0, 0.0, 12.0]);
    let cosine = 2.0 * 361.0 / 505.0 - 1.0;
    let shares = [
        ([0, 0], 1.0),
        ([1, 0], cosine * cosine),
        ([0, 1], cosine * cosine),
    ];
    assert_shares(lamp, &from_an_eye(), ShadingMode::Phong, &shares);
}

#[test]
fn the_middle_of_a_highlight_has_full_strength_for_any_shininess() {
    // At (1, 0) the eye above is reflected to (4, 0, 3) / 5.
    for shininess in [0.0, 1e-3, 0.5, 1.0, 76.8, 1e3, 1e6] {
        let material = Material {
            shininess,
            ..MATERIAL
        };
        let lamp = (LightKind::Specular, [5.0, 0.0, 5.0]);
        let found = picture(material, &[lamp], &from_above(), ShadingMode::Phong)[pixel(1, 0)];
        let expected = MATERIAL.specular * SENT;
        assert!(
            (found - expected).length() < 0.05,
            "{found} at shininess {shininess}"
        );
    }
}

#[test]
fn a_highlight_of_shininess_zero_covers_everything_in_front_of_its_light() {
    let material = Material {
        shininess: 0.0,
        ..MATERIAL
    };
    let lamp = (LightKind::Specular, [0.0, 0.0, 4.0]);
    let picture = picture(material, &[lamp], &from_above(), ShadingMode::Phong);
    assert_eq!(picture[pixel(1, 1)], MATERIAL.specular * SENT);
    assert_eq!(picture[pixel(-2, 2)], DVec3::ZERO);
}

#[test]
fn a_light_behind_the_surface_makes_no_highlight_even_if_its_reflection_meets_the_eye() {
    // At the corner (-2, 2): l = (-3, 0, -4) / 5, n.l = -1 / (5 sqrt 3), yet o.r = 2 (n.l) / sqrt 3 + 4/5 = 2/3.
    for mode in [ShadingMode::Gouraud, ShadingMode::Phong] {
        let lamp = (LightKind::Specular, [-5.0, 2.0, -2.0]);
        assert_shares(lamp, &from_above(), mode, &[([-2, 2], 0.0)]);
    }
}

#[test]
fn gouraud_interpolates_the_levels_at_the_corners() {
    // 3 sqrt 3 away from the corner (2, 2), which it lights fully; the other three corners face away. The weight of
    // that corner grows by a quarter per unit of x or y, on both sides of the diagonal through it and (-2, -2).
    let quarters = |x: i32, y: i32| f64::from(x.min(y) + 2) / 4.0;
    let shares: Vec<_> = (-2..2)
        .flat_map(|x| (-1..3).map(move |y| ([x, y], quarters(x, y))))
        .collect();
    let lamp = (LightKind::Diffuse, [5.0, 5.0, 5.0]);
    assert_shares(lamp, &from_above(), ShadingMode::Gouraud, &shares);
    assert_shares(lamp, &from_an_eye(), ShadingMode::Gouraud, &shares);
}

#[test]
fn gouraud_misses_a_light_over_the_middle_of_a_face() {
    let shares = [([0, 0], 0.0), ([1, 0], 0.0), ([1, 1], 0.0)];
    let lamp = (LightKind::Diffuse, [0.0, 0.0, 4.0]);
    assert_shares(lamp, &from_above(), ShadingMode::Gouraud, &shares);
}

#[test]
fn at_a_vertex_all_modes_are_equal() {
    let lamps = [
        (LightKind::Ambient, [0.0; 3]),
        (LightKind::Diffuse, [-1.0, 5.0, 6.0]),
        (LightKind::Diffuse, [-7.0, 1.0, 2.5]),
        (LightKind::Specular, [-9.0, 5.0, 7.0]),
    ];
    for view in [from_above(), from_an_eye()] {
        for lamps in [&lamps[..1], &lamps[1..2], &lamps[2..3], &lamps[3..], &lamps] {
            let corner = |mode| picture(MATERIAL, lamps, &view, mode)[pixel(-2, 2)];
            let [gouraud, phong, unit_vectors] = MODES.map(corner);
            assert!((gouraud - phong).length() < 1e-3, "{gouraud} {phong}");
            assert!(
                (gouraud - unit_vectors).length() < 1e-3,
                "{gouraud} {unit_vectors}"
            );
            assert!(gouraud.min_element() > 1.0, "{lamps:?} reach it: {gouraud}");
        }
    }
}

#[test]
fn a_light_that_a_vertex_reflects_to_the_eye_has_full_strength_there_in_every_mode() {
    let vertex = DVec3::new(-2.0, 2.0, 2.0);
    let (n, o) = (vertex.normalize(), (DVec3::Z * 12.0 - vertex).normalize());
    let mirrored = 2.0 * n.dot(o) * n - o;
    for shininess in [0.0, 0.5, 1.0, 76.8, 1e3, 1e4, 1e6] {
        for reach in [0.7, 3.0, 11.0] {
            let material = Material {
                shininess,
                ..MATERIAL
            };
            let lamp = (LightKind::Specular, (vertex + mirrored * reach).to_array());
            for mode in MODES {
                let found = picture(material, &[lamp], &from_an_eye(), mode)[pixel(-2, 2)];
                let error = (found - MATERIAL.specular * SENT).abs().max_element();
                assert!(
                    error < 0.05,
                    "{mode:?} errs by {error} at shininess {shininess}"
                );
            }
        }
    }
}

#[test]
fn lights_add_up() {
    let mut scene = Scene::load(None).expect("it is built in");
    let view = View {
        size: [320, 240],
        background: DVec3::ZERO,
        ..crate::support::scene::view(
            [0, 0],
            DVec3::new(7.0, 5.0, 8.0),
            DVec3::ZERO,
            Projection::Perspective,
        )
    };
    for mode in [ShadingMode::Gouraud, ShadingMode::Phong] {
        let mut with = |on: &dyn Fn(usize) -> bool| {
            for (index, &light) in ordered::<Light>(&scene.world).iter().enumerate() {
                let light = scene
                    .world
                    .query_one_mut::<&mut shadetrade::components::Light>(light);
                light.expect("it is a light").on = on(index);
            }
            draw(&mut scene.world, &view.shaded(mode), Keep::Levels)
        };
        let all = with(&|_| true);
        let none = with(&|_| false);
        let single: Vec<_> = (0..4).map(|index| with(&|other| other == index)).collect();
        for (pixel, levels) in all.levels().iter().enumerate() {
            let sum = |channel: usize| {
                single
                    .iter()
                    .map(|frame| frame.levels()[pixel][channel])
                    .sum::<f32>()
            };
            for channel in 0..3 {
                // Five pictures, each within 0.05 level.
                let difference = levels[channel] - sum(channel);
                assert!(difference.abs() < 0.25, "{mode:?}: {difference} at {pixel}");
            }
            let ambient = if all.triangles()[pixel] == NO_TRIANGLE {
                0.0
            } else {
                30.0
            };
            let alone = DVec3::from(single[3].levels()[pixel].map(f64::from));
            assert!((alone - ambient).length() < 1e-4, "{alone} at {pixel}");
            assert_eq!(none.levels()[pixel], [0.0; 3], "no light, no colour");
        }
    }
}

#[test]
fn the_shortcut_is_drawn_alike_at_any_tolerance() {
    let setting = Setting {
        mode: ShadingMode::UnitVectors,
        ..Setting::default_scene(0)
    };
    let [exact, loose] = [0.0, 4.0].map(|tolerance| {
        let view = View {
            tolerance,
            ..setting.view()
        };
        let frame = draw(&mut setting.world(), &view, Keep::Display);
        (frame.counts(), frame.pixels().to_vec())
    });
    assert!(exact == loose, "{:?}, not {:?}", loose.0, exact.0);
}
