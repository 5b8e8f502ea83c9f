//! `shadetrade probe`: its values are right and add up, and its output has the format that scripts rely on.

mod text;

use std::process::Command;

use fearless_simd::Level;
use glam::DVec3;
use serde_json::Value;
use shadetrade::components::{LightKind, Mesh, ShadingMode, Transform, View};
use shadetrade::frame::{Frame, Keep, NO_TRIANGLE, Workers};
use shadetrade::probe::{self, Probe, ProbedSurface};
use shadetrade::reference;
use shadetrade::scene::{LightRecord, Scene, SceneRecord};
use shadetrade::shading::TileKind;
use shadetrade::systems;
use shadetrade::trade::metrics::pixel_error;

use crate::support::scene::{draw, view_from};

fn probe(arguments: &[&str]) -> Value {
    let output = Command::new(env!("CARGO_BIN_EXE_shadetrade"))
        .arg("probe")
        .args(arguments)
        .arg("--json")
        .output()
        .expect("the program runs");
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    serde_json::from_slice(&output.stdout).expect("JSON and nothing else on standard output")
}

fn triple(value: &Value) -> [f64; 3] {
    [0, 1, 2].map(|index| value[index].as_f64().expect("a number"))
}

fn length(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[test]
fn the_vectors_meet_their_definitions() {
    let probe = probe(&["--pixel", "480,300"]);
    let (position, normal, to_eye) = (
        triple(&probe["position"]),
        triple(&probe["normal"]),
        triple(&probe["to_eye"]),
    );
    assert_eq!(probe["object"], "emerald");
    assert!(
        (position[2] - 1.0).abs() < 1e-12,
        "the pixel shows the face z = 1: {position:?}"
    );
    // Corner normals are interpolated over a face: n is (x / 2, y / 1.5, z) normalised.
    let along = [position[0] / 2.0, position[1] / 1.5, position[2]];
    for axis in 0..3 {
        assert!((normal[axis] - along[axis] / length(along)).abs() < 1e-12);
        // The eye of camera 1 is at (7, 5, 8).
        let eye = [7.0, 5.0, 8.0];
        let away: [f64; 3] = std::array::from_fn(|axis| eye[axis] - position[axis]);
        assert!((to_eye[axis] - away[axis] / length(away)).abs() < 1e-12);
    }
    for light in probe["lights"].as_array().expect("lights") {
        if light["kind"] == "ambient" {
            assert!(light["to_light"].is_null() && light["reflected"].is_null());
            continue;
        }
        let (l, r) = (triple(&light["to_light"]), triple(&light["reflected"]));
        for axis in 0..3 {
            assert!((r[axis] - (2.0 * dot(normal, l) * normal[axis] - l[axis])).abs() < 1e-12);
        }
    }
}

#[test]
fn terms_add_up_to_the_reference_and_the_renderer_keeps_its_tolerance() {
    for (tolerance, allowed) in [("0", 0.05), ("0.5", 0.5), ("4", 4.0)] {
        for pixel in ["480,300", "600,250", "700,400", "520,260"] {
            let probe = probe(&["--pixel", pixel, "--tolerance", tolerance]);
            for mode in ["gouraud", "phong"] {
                let reference = triple(&probe["reference"][mode]["levels"]);
                let levels = triple(&probe[mode]["levels"]);
                assert_ne!(
                    levels, reference,
                    "the levels of the renderer, not of the reference"
                );
                let terms = probe[mode]["terms"].as_object().expect("terms by light");
                assert_eq!(terms.keys().count(), 4);
                for channel in 0..3 {
                    let sum: f64 = terms.values().map(|term| triple(term)[channel]).sum();
                    assert!((sum - reference[channel]).abs() < 1e-9, "{mode} at {pixel}");
                    let shown = |level: f64| level.clamp(0.0, 255.0);
                    let error = (shown(levels[channel]) - shown(reference[channel])).abs();
                    assert!(
                        error <= allowed,
                        "{mode} at {pixel}: {error} levels at tolerance {tolerance}"
                    );
                    let byte = (shown(levels[channel]) + 0.5).floor();
                    assert_eq!(probe[mode]["bytes"][channel].as_f64(), Some(byte));
                }
            }
        }
    }
}

#[test]
fn factor_times_strength_is_phongs_term_and_the_factor_follows_from_the_cosines() {
    let mut scene = Scene::load(None).expect("it is built in");
    let view = view_from(&scene, 0, [96, 72]);
    let mut lit = 0;
    for pixel in (0..96 * 72).step_by(7).map(|at| [at % 96, at / 96]) {
        let probe = probe::at(&mut scene, &view, pixel, Level::new()).expect("a row fits");
        let Some(surface) = probe.surface else {
            continue;
        };
        let [normal, to_eye] = [surface.normal, surface.to_eye].map(|it| it.expect("no edge"));
        for (light, (_, term)) in surface.lights.iter().zip(&surface.phong.terms) {
            for (strength, term) in light.strength.to_array().iter().zip(term) {
                assert!((light.factor * strength - term).abs() <= 1e-12 * term.abs());
            }
            let Some((to_light, reflected)) = light.to_light.zip(light.reflected) else {
                assert_eq!(light.factor, 1.0);
                continue;
            };
            let cosine = normal.dot(to_light);
            let expected = match light.kind {
                LightKind::Diffuse => cosine.max(0.0),
                _ if cosine > 0.0 => to_eye.dot(reflected).max(0.0).powf(76.8),
                _ => 0.0,
            };
            assert!((light.factor - expected).abs() < 1e-9, "at {pixel:?}");
            lit += usize::from(expected > 0.1);
        }
    }
    assert!(lit > 100, "{lit}");
}

#[test]
fn on_diagonals_the_reference_shows_the_same_triangle_and_nothing_is_null() {
    let mut on_diagonals = 0;
    for turn in 0..24 {
        let mut scene = Scene::load(None).expect("it is built in");
        for (transform, _) in scene.world.query_mut::<(&mut Transform, &Mesh)>() {
            transform.rotation.x = 15.0 * f64::from(turn);
        }
        let view = View {
            tolerance: 0.5,
            ..view_from(&scene, 0, [480, 360]).shaded(ShadingMode::Phong)
        };
        let truth = reference::picture(&scene.world, &view, 0..360, &|| false, &|_| ())
            .expect("it is not cancelled");
        let mut frame = Frame::new(Keep::Levels, Workers::alone(Level::new()));
        systems::draw(&mut scene.world, &view, &mut frame).expect("a small picture fits");
        let triangles = frame.triangles();
        for (pixel, (&own, &other)) in triangles.iter().zip(&truth.triangles).enumerate() {
            assert!(
                own == other || own / 2 != other / 2,
                "at {pixel} of turn {turn}"
            );
            // Every 37th pixel that has the face's other triangle to its right.
            let next = triangles
                .get(pixel + 1)
                .is_some_and(|&next| next == own ^ 1);
            if own != other || !next || pixel % 37 > 0 {
                continue;
            }
            on_diagonals += 1;
            let place = [pixel % 480, pixel / 480];
            let probe = probe::at(&mut scene, &view, place, Level::new()).expect("a row fits");
            let surface = probe.surface.expect("a face is seen");
            assert_eq!(surface.triangle, own);
            assert_eq!(surface.reference.triangle, Some(other));
            assert!(surface.position.is_some() && surface.normal.is_some());
            assert_eq!([surface.lights.len(), surface.phong.terms.len()], [4; 2]);
            let exact = surface.reference.phong.expect("the same face").levels;
            assert_eq!(exact, truth.levels[pixel]);
            assert!(pixel_error(surface.phong.levels, exact) <= view.tolerance);
        }
    }
    assert!(on_diagonals > 20, "{on_diagonals} pixels lie on a diagonal");
}

#[test]
fn the_background_and_lights_that_are_off_appear_nowhere() {
    let background = probe(&["--pixel", "0,0"]);
    assert_eq!(
        background,
        serde_json::json!({"pixel": [0, 0], "object": null})
    );
    let probe = probe(&["--pixel", "480,300", "--lights", "white,ambient"]);
    let names = |lights: &Value| {
        lights
            .as_object()
            .map(|it| it.keys().cloned().collect::<Vec<_>>())
    };
    let expected = ["white", "ambient"].map(str::to_owned);
    assert_eq!(names(&probe["phong"]["terms"]), Some(expected.to_vec()));
    assert_eq!(probe["lights"].as_array().map(Vec::len), Some(2));
}

#[test]
fn levels_beyond_f32_are_those_of_the_reference() {
    // 1e20 of an intensity of 1e20 is 1e40 in the first channel, beyond the largest f32 of 3e38; 1e-20 of it is 1.
    let surface = surface_of(ShadingMode::Phong, [480, 300], |record| {
        record.cuboid[0].material.ambient = DVec3::new(1e20, 1e-20, 0.0);
        record.light = vec![LightRecord::new("sky", LightKind::Ambient, 1e20, [0.0; 3])];
    });
    for mode in [surface.gouraud, surface.phong] {
        let [red, green, blue] = mode.levels;
        assert!((red / 1e40 - 1.0).abs() < 1e-12, "{red}");
        assert!((green - 1.0).abs() < 1e-6 && blue == 0.0, "{green}");
        assert_eq!(mode.bytes, [255, 1, 0]);
    }
}

/// The evaluation of a pixel of the default scene after a change of the scene.
fn surface_of(
    mode: ShadingMode,
    pixel: [usize; 2],
    change: impl Fn(&mut SceneRecord),
) -> ProbedSurface {
    let mut record = SceneRecord::of(&Scene::load(None).expect("it is built in").world);
    change(&mut record);
    let mut scene = Scene::spawn(String::new(), &record);
    let view = view_from(&scene, 0, [960, 720]).shaded(mode);
    let probe = probe::at(&mut scene, &view, pixel, Level::new()).expect("a row fits");
    probe.surface.expect("a face is seen")
}

#[test]
fn a_section_is_every_pixel_of_the_row_on_one_face() {
    let mut scene = Scene::load(None).expect("it is built in");
    let view = view_from(&scene, 0, [96, 72]).shaded(ShadingMode::Phong);
    let level = Level::new();
    let at = |scene: &mut Scene, pixel| probe::at(scene, &view, pixel, level).expect("a row fits");
    for pixel in [[40, 36], [62, 30], [48, 18], [2, 2]] {
        let section = probe::section(&mut scene, &view, pixel, level).expect("a row fits");
        let first = section[0].pixel[0];
        for (index, probe) in section.iter().enumerate() {
            assert_eq!(*probe, at(&mut scene, [first + index, pixel[1]]));
        }
        let face = |probe: &Probe| probe.surface.as_ref().map(|it| it.triangle / 2);
        let own = face(&at(&mut scene, pixel));
        assert!(section.iter().all(|probe| face(probe) == own));
        assert_eq!(
            section.len() == 1,
            own.is_none(),
            "the background is one pixel"
        );
        if own.is_some() {
            for beside in [first - 1, first + section.len()] {
                assert_ne!(face(&at(&mut scene, [beside, pixel[1]])), own);
            }
        }
    }
}

#[test]
fn the_pixels_of_squares_add_up_to_the_squares_that_were_drawn() {
    let mut scene = Scene::load(None).expect("it is built in");
    let mut all = 0;
    for (mode, tolerance) in [(ShadingMode::Phong, 0.5), (ShadingMode::Gouraud, 4.0)] {
        let view = view_from(&scene, 0, [480, 360])
            .shaded(mode)
            .with_tolerance(tolerance);
        let frame = draw(&mut scene.world, &view, Keep::Levels);
        let mut squares = [0.0; TileKind::ALL.len()];
        for (y, row) in frame.triangles().chunks_exact(480).enumerate() {
            let mut x = 0;
            while let Some(from) = row[x..].iter().position(|id| *id != NO_TRIANGLE) {
                let section = probe::section(&mut scene, &view, [x + from, y], Level::new());
                let section = section.expect("a row fits");
                x += from + section.len();
                for surface in section.iter().filter_map(|probe| probe.surface.as_ref()) {
                    squares[surface.drawn.kind as usize] += 1.0 / surface.drawn.pixels as f64;
                }
            }
        }
        // Squares of few pixels are evaluated before they are cut, so their number tells nothing of their side.
        for kind in TileKind::ALL.into_iter().take(4) {
            let (found, drawn) = (squares[kind as usize], frame.counts().tiles[kind as usize]);
            assert!(
                (found - drawn as f64).abs() < 1e-6,
                "{mode:?}, {kind:?}: {found} of {drawn}"
            );
            all += drawn;
        }
    }
    assert!(all > 200, "{all}");
}
