//! The renderer against an independent f64 evaluation, pixel by pixel.

use glam::DVec3;
use shadetrade::components::{LightKind, Material, Projection, ShadingMode, View};
use shadetrade::frame::{Frame, Keep, NO_TRIANGLE, display_step};
use shadetrade::scene::Scene;
use shadetrade::shading::{EXACT, TileKind};

use super::truth::{Seen, Setting};
use crate::support::scene::{draw, view_from};

/// The pixels with the same triangle in both pictures. At most a few pixels on edges may be left out.
fn shared(frame: &Frame, truth: &[Seen]) -> Vec<(usize, DVec3)> {
    let pairs = || frame.triangles().iter().zip(truth);
    let edges = pairs().filter(|(id, seen)| seen.map_or(NO_TRIANGLE, |(id, _)| id) != **id);
    let (edges, most) = (edges.count(), 4 + truth.len() / 10_000);
    assert!(edges <= most, "{edges} pixels show other triangles");
    pairs()
        .enumerate()
        .filter_map(|(pixel, (id, seen))| {
            seen.filter(|(expected, _)| expected == id)
                .map(|(_, levels)| (pixel, levels))
        })
        .collect()
}

/// Asserts that unclamped levels equal the truth; returns the largest error.
#[track_caller]
fn assert_close(frame: &Frame, setting: &Setting) -> f64 {
    let shared = shared(frame, &setting.truth());
    assert!(shared.len() > 100, "the cuboid is in sight");
    let mut worst = 0.0_f64;
    for (pixel, expected) in shared {
        let found = DVec3::from(frame.levels()[pixel].map(f64::from));
        let error = (found - expected).abs().max_element();
        assert!(
            error <= EXACT,
            "{found} is not {expected} at pixel {pixel} of {setting:?}"
        );
        worst = worst.max(error);
    }
    worst
}

/// Draws a setting and compares it with the truth; returns the largest error.
#[track_caller]
fn assert_exact(setting: &Setting) -> f64 {
    assert_close(
        &draw(&mut setting.world(), &setting.view(), Keep::Levels),
        setting,
    )
}

/// The eight pictures of the default scene, each with its camera.
fn default_settings() -> Vec<(usize, Setting)> {
    let mut settings = Vec::new();
    for camera in 0..2 {
        for projection in [Projection::Perspective, Projection::Orthographic] {
            for mode in [ShadingMode::Gouraud, ShadingMode::Phong] {
                let setting = Setting {
                    projection,
                    mode,
                    ..Setting::default_scene(camera)
                };
                settings.push((camera, setting));
            }
        }
    }
    settings
}

fn view_of_default_scene(scene: &Scene, camera: usize, setting: &Setting) -> View {
    View {
        viewpoint: view_from(scene, camera, [1, 1]).viewpoint,
        ..setting.view().shaded(setting.mode)
    }
}

#[test]
fn the_default_scene_is_within_a_twentieth_of_a_level_of_the_truth() {
    let mut scene = Scene::load(None).expect("it is built in");
    for (camera, setting) in default_settings() {
        let view = view_of_default_scene(&scene, camera, &setting);
        let frame = draw(&mut scene.world, &view, Keep::Levels);
        assert_close(&frame, &setting);
        assert!(
            frame.counts().covered_pixels > 70_000,
            "it is well in sight"
        );
        let tiles = frame.counts().tiles;
        assert!(
            tiles[TileKind::Exact as usize] > 10 * tiles[TileKind::Double as usize],
            "the path in f32 is tested"
        );
    }
}

#[test]
fn the_default_scenes_bytes_are_within_one_of_the_truth_below_tolerance_one() {
    let mut scene = Scene::load(None).expect("it is built in");
    for (camera, setting) in default_settings() {
        let truth = setting.truth();
        for tolerance in [0.0, 0.25, 0.5] {
            let view = View {
                tolerance,
                ..view_of_default_scene(&scene, camera, &setting)
            };
            let faces = draw(&mut scene.world, &view, Keep::Levels);
            let frame = draw(&mut scene.world, &view, Keep::Display);
            for (pixel, levels) in shared(&faces, &truth) {
                let [_, found @ ..] = frame.pixels()[pixel].to_be_bytes();
                let expected = levels.to_array().map(display_step);
                let differ = found.iter().zip(expected).any(|(a, b)| a.abs_diff(b) > 1);
                assert!(
                    !differ,
                    "{found:?} is not {expected:?} at pixel {pixel} of {setting:?}"
                );
            }
        }
    }
}

/// The default scene, small, in all eight settings.
fn small_settings() -> impl Iterator<Item = Setting> {
    default_settings().into_iter().map(|(_, setting)| Setting {
        size: [128, 96],
        ..setting
    })
}

#[test]
fn every_shininess_the_format_allows_is_exact() {
    for shininess in [0.0, 1e-3, 0.5, 1.0, 2.0, 76.8, 1000.0, 1e6] {
        for mut setting in small_settings() {
            setting.material.shininess = shininess;
            // In the mirror direction of a point on the face, so that the sharpest highlight is visible.
            let point = DVec3::new(1.1, 0.7, setting.half.z.copysign(setting.eye.z));
            let n = (point / setting.half).normalize();
            let o = match setting.projection {
                Projection::Perspective => (setting.eye - point).normalize(),
                Projection::Orthographic => setting.eye.normalize(),
            };
            let position = point + 9.0 * (2.0 * n.dot(o) * n - o);
            setting.lights = vec![(LightKind::Specular, DVec3::new(255.0, 2e3, 1e5), position)];
            assert_exact(&setting);
        }
    }
}

#[test]
fn lights_at_different_places_are_exact() {
    let place = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
    for mut setting in small_settings() {
        // One light shares two coordinates with the first light, another all three.
        setting.lights = vec![
            (
                LightKind::Specular,
                place(90.0, 0.0, 90.0),
                place(3.0, 9.0, 1.0),
            ),
            (
                LightKind::Diffuse,
                place(50.0, 99.0, 1.0),
                place(-9.0, 9.0, 1.0),
            ),
            (
                LightKind::Specular,
                place(0.0, 200.0, 10.0),
                place(3.0, 9.0, -4.0),
            ),
            (
                LightKind::Diffuse,
                place(30.0, 30.0, 200.0),
                place(3.0, -8.0, 1.0),
            ),
            (
                LightKind::Diffuse,
                place(120.0, 0.0, 60.0),
                place(3.0, 9.0, 1.0),
            ),
            (LightKind::Ambient, place(10.0, 20.0, 30.0), DVec3::ZERO),
            (LightKind::Ambient, place(7.0, 0.0, 0.0), DVec3::ZERO),
        ];
        assert_exact(&setting);
    }
}

#[test]
fn a_light_close_to_a_face_is_exact() {
    for above in [0.5, 0.1, 1e-2, 1e-4, 1e-8] {
        for mut setting in small_settings() {
            let position = DVec3::new(0.37, setting.half.y + above, 0.21);
            setting.lights = [LightKind::Diffuse, LightKind::Specular]
                .map(|kind| (kind, DVec3::splat(255.0), position))
                .to_vec();
            assert_exact(&setting);
        }
    }
}

#[test]
fn lights_of_thousands_of_levels_are_exact() {
    for sent in [1e3, 1e4, 1e5] {
        for mut setting in small_settings() {
            for light in &mut setting.lights {
                light.1 = DVec3::splat(sent);
            }
            assert_exact(&setting);
        }
    }
}

#[test]
fn cuboids_of_all_proportions_are_exact_from_near_and_far() {
    for half in [
        DVec3::new(0.02, 2.0, 1.0),
        DVec3::new(3.0, 0.1, 0.1),
        DVec3::splat(1.0),
    ] {
        for distance in [0.5, 1.0, 1000.0] {
            for mut setting in small_settings() {
                setting.half = half;
                setting.eye *= distance;
                setting.fov = 2.0 * (3.15 / setting.eye.length()).atan().to_degrees();
                assert_exact(&setting);
            }
        }
    }
}

#[test]
fn without_light_and_of_black_material_a_cuboid_is_black() {
    for mut setting in small_settings() {
        setting.lights.clear();
        assert_eq!(assert_exact(&setting), 0.0);
    }
    for mut setting in small_settings() {
        setting.material = Material {
            ambient: DVec3::ZERO,
            diffuse: DVec3::ZERO,
            specular: DVec3::ZERO,
            shininess: 1.0,
        };
        assert_eq!(assert_exact(&setting), 0.0);
    }
}
