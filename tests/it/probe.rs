//! `shadetrade probe`: its values are right and add up, and its output has the format that scripts rely on.

mod text;

use serde::Deserialize;
use serde_json::{Value, json};
use shadetrade::questions::metrics::pixel_error;
use shadetrade::questions::probe::{self, Probe, ProbedSurface};

use crate::cli::keys;
use crate::extremes::enlarged;
use crate::support::prelude::*;

/// The JSON of the command.
fn probe(line: &str) -> Value {
    let folder = std::env::temp_dir();
    let (status, json) = crate::cli::json(&folder, &format!("probe {line} --json"));
    assert_eq!(status, Some(0));
    json
}

/// What happened at a pixel.
fn at(scene: &mut Scene, view: &View, pixel: [usize; 2]) -> Probe {
    probe::at(scene, view, pixel, Level::new()).expect("a row fits")
}

/// Three numbers.
fn triple(value: &Value) -> DVec3 {
    DVec3::deserialize(value).expect("three numbers")
}

#[test]
fn terms_add_up_to_the_reference_and_the_renderer_keeps_its_tolerance() {
    for (tolerance, allowed) in [("0", 0.05), ("0.5", 0.5), ("4", 4.0)] {
        for pixel in ["480,300", "600,250", "700,400", "520,260"] {
            let probe = probe(&format!("--pixel {pixel} --tolerance {tolerance}"));
            let of_probe =
                "pixel object triangle position normal to_eye lights gouraud phong reference";
            assert_eq!(keys(&probe), of_probe);
            let of_light = "name kind to_light reflected half_vector half_vector_factor";
            assert_eq!(keys(&probe["lights"][0]), of_light);
            assert_eq!(
                keys(&probe["reference"]),
                "triangle gouraud phong blinn_phong"
            );
            for mode in ["gouraud", "phong"] {
                assert_eq!(keys(&probe[mode]), "levels terms bytes");
                assert_eq!(keys(&probe[mode]["terms"]), "white red specular ambient");
                let levels = triple(&probe[mode]["levels"]);
                let reference = triple(&probe["reference"][mode]["levels"]);
                // The levels are those of the renderer, not of the reference.
                assert_ne!(levels, reference);
                let terms = probe[mode]["terms"].as_object().expect("terms by light");
                let sum: DVec3 = terms.values().map(triple).sum();
                assert!((sum - reference).length() < 1e-9, "{mode} at {pixel}");
                let error = pixel_error(levels.to_array(), reference.to_array());
                assert!(error <= allowed, "{error} at {pixel}, {tolerance}");
                let shown = (levels.clamp(DVec3::ZERO, DVec3::splat(255.0)) + 0.5).floor();
                assert_eq!(triple(&probe[mode]["bytes"]), shown);
            }
        }
    }
}

#[test]
fn vectors_and_factors_meet_their_definitions_and_factor_times_strength_is_phongs_term() {
    let mut scene = built_in();
    // The cuboid is cut off on the left and on the right.
    let view = view_from(&scene, 0, [32, 72]);
    let mut lit = 0;
    for pixel in (0..32 * 72).step_by(3).map(|at| [at % 32, at / 32]) {
        let Some(surface) = at(&mut scene, &view, pixel).surface else {
            continue;
        };
        let sample = surface.sample.expect("no edge");
        let (normal, to_eye) = (sample.normal, sample.to_eye);
        let away = view.camera.position - sample.position;
        assert!((to_eye - away.normalize()).length() < 1e-12);
        // Corner normals are interpolated over a face.
        let along = sample.position / DVec3::new(2.0, 1.5, 1.0);
        assert!((normal - along.normalize()).length() < 1e-12);
        for light in &sample.lights {
            let error = (light.factor * light.strength - light.phong).abs();
            assert!(error.cmple(1e-12 * light.phong.abs()).all(), "{light:?}");
            let Some((to_light, reflected)) = light.to_light.zip(light.reflected) else {
                assert_eq!(light.factor, 1.0);
                continue;
            };
            let cosine = normal.dot(to_light);
            assert!((reflected - (2.0 * cosine * normal - to_light)).length() < 1e-12);
            let half = light.half_vector.expect("l is not -o");
            assert!((half - (to_light + to_eye).normalize()).length() < 1e-12);
            if let Some(factor) = light.half_vector_factor {
                let gate = f64::from(u8::from(cosine > 0.0));
                let expected = gate * normal.dot(half).max(0.0).powf(4.0 * 76.8);
                assert!((factor - expected).abs() < 1e-9, "at {pixel:?}");
            }
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
    let (mut on_diagonals, size) = (0, enlarged([240, 180]));
    for turn in 0..24 {
        let mut scene = built_in();
        for (transform, _) in scene.world.query_mut::<(&mut Transform, &Mesh)>() {
            transform.rotation.x = 15.0 * f64::from(turn);
        }
        let view = View {
            tolerance: 0.5,
            ..view_from(&scene, 0, size).shaded(ShadingMode::Phong)
        };
        let truth = truth(&scene.world, &view);
        let triangles = draw(&mut scene.world, &view, Keep::Levels);
        let triangles = triangles.triangles();
        for (pixel, (&own, &other)) in triangles.iter().zip(&truth.triangles).enumerate() {
            let is_same = own == other || own.face_id() != other.face_id();
            assert!(is_same, "at {pixel} of turn {turn}");
            // Every 11th pixel that has the face's other triangle to its right.
            let next = triangles.get(pixel + 1);
            let is_last = next.is_some_and(|it| it.face_id() == own.face_id() && *it != own);
            if own != other || !is_last || pixel % 11 > 0 {
                continue;
            }
            on_diagonals += 1;
            let place = [pixel % size[0], pixel / size[0]];
            let surface = at(&mut scene, &view, place).surface;
            let surface = surface.expect("a face is seen");
            assert_eq!(surface.triangle, own.triangle());
            let sample = surface.sample.as_ref().expect("the same face");
            let found = (sample.triangle, sample.lights.len());
            assert_eq!(found, (other.triangle(), 4));
            let exact = sample.phong.to_array();
            assert_eq!(exact, truth.levels[pixel]);
            assert!(pixel_error(surface.phong.to_array(), exact) <= view.tolerance);
        }
    }
    assert!(on_diagonals > 20, "{on_diagonals} pixels lie on a diagonal");
}

#[test]
fn the_background_and_lights_that_are_off_appear_nowhere() {
    let background = json!({"pixel": [0, 0], "object": null});
    assert_eq!(probe("--pixel 0,0"), background);
    let probe = probe("--pixel 480,300 --lights white,ambient");
    assert_eq!(keys(&probe["phong"]["terms"]), "white ambient");
    assert_eq!(probe["lights"].as_array().map(Vec::len), Some(2));
}

#[test]
fn levels_beyond_f32_are_those_of_the_reference() {
    // 1e20 of an intensity of 1e20 is 1e40 in the first channel, beyond the largest f32 of 3e38; 1e-20 of it is 1.
    let surface = surface_of(ShadingMode::Phong, [480, 300], |record| {
        record.cuboid[0].material.ambient = DVec3::new(1e20, 1e-20, 0.0);
        record.light = vec![records::light("sky", LightKind::Ambient, 1e20, [0.0; 3])];
    });
    for levels in [surface.gouraud, surface.phong] {
        let [red, green, blue] = levels.to_array();
        assert!((red / 1e40 - 1.0).abs() < 1e-12, "{red}");
        assert!((green - 1.0).abs() < 1e-6 && blue == 0.0, "{green}");
    }
}

/// The evaluation of a pixel of the default scene after a change of the scene.
fn surface_of(
    mode: ShadingMode,
    pixel: [usize; 2],
    change: impl Fn(&mut SceneRecord),
) -> ProbedSurface {
    let mut scene = changed(change);
    let view = view_from(&scene, 0, [960, 720]).shaded(mode);
    let surface = at(&mut scene, &view, pixel).surface;
    surface.expect("a face is seen")
}

#[test]
fn levels_of_blinn_phong_are_those_of_its_picture() {
    let mut differing = 0;
    for column in (400..600).step_by(5) {
        let surface = surface_of(ShadingMode::BlinnPhong, [column, 330], |record| {
            record.light[2].position = Some(DVec3::new(-6.0, 6.0, 10.0));
        });
        let sample = surface.sample.expect("no edge");
        let error = (sample.blinn_phong - DVec3::from(surface.drawn)).abs();
        assert!(error.max_element() < 1e-9, "{sample:?}");
        let difference = (sample.blinn_phong - sample.phong).abs();
        differing += usize::from(difference.max_element() > 1.0);
    }
    assert!(differing > 2, "{differing}");
}

#[test]
fn on_a_grid_the_vertices_are_those_of_the_pixel_s_cell() {
    let surface = surface_of(ShadingMode::Phong, [480, 300], |record| {
        record.cuboid[0].segments = Segments::new(8).expect("a number");
    });
    let lights = built_in_record().light;
    let sample = surface.sample.as_ref().expect("no edge");
    let (size, vertices) = (DVec3::new(4.0, 3.0, 2.0), sample.vertices);
    let sum =
        |of: &dyn Fn(usize) -> DVec3| (0..3).map(|i| sample.weights[i] * of(i)).sum::<DVec3>();
    assert!((sum(&|i| vertices[i] * size) - sample.position).length() < 1e-12);
    let labels = vertices.map(|vertex| {
        // The pixel shows the face z = 1, whose grid has 8 x 8 cells.
        let [column, row, across] = (8.0 * (vertex + 0.5)).to_array();
        assert!([column, row].iter().all(|it| it.fract() == 0.0) && across == 8.0);
        format!("{column},{row}")
    });
    let probe = Probe {
        pixel: [480, 300],
        surface: Some(surface.clone()),
    };
    let page = probe.lines().join("\n");
    let (_, gouraud) = page.split_once("Gouraud, exact").expect("a heading");
    let row: Vec<_> = gouraud
        .lines()
        .nth(2)
        .expect("a row")
        .split_whitespace()
        .collect();
    assert_eq!(row, labels);
    for (light, own) in sample.lights.iter().zip(lights) {
        let term = sum(&|i| light.strength * light.vertex_factors[i]);
        assert!((term - light.gouraud).length() < 1e-9, "{light:?}");
        for (vertex, factor) in vertices.into_iter().zip(light.vertex_factors) {
            let to_light = (own.position.unwrap_or_default() - vertex * size).normalize();
            let known = match light.kind {
                LightKind::Ambient => 1.0,
                LightKind::Diffuse => vertex.normalize().dot(to_light).max(0.0),
                LightKind::Specular => continue,
            };
            assert!((factor - known).abs() < 1e-12, "{light:?}");
        }
    }
}

#[test]
fn a_section_is_every_pixel_of_the_row_on_one_face() {
    let mut scene = built_in();
    let view = view_from(&scene, 0, [96, 72]).shaded(ShadingMode::Phong);
    let at = |scene: &mut Scene, pixel| at(scene, &view, pixel);
    for pixel in [[40, 36], [62, 30], [48, 18], [2, 2]] {
        let section = probe::section(&mut scene, &view, pixel, Level::new());
        let section = section.expect("a row fits");
        let first = section[0].pixel[0];
        for (index, probe) in section.iter().enumerate() {
            assert_eq!(*probe, at(&mut scene, [first + index, pixel[1]]));
        }
        let face = |probe: &Probe| probe.surface.as_ref().map(|it| it.triangle / 2);
        let own = face(&at(&mut scene, pixel));
        assert!(section.iter().all(|probe| face(probe) == own));
        // The background is one pixel.
        assert_eq!(section.len() == 1, own.is_none());
        if own.is_some() {
            for beside in [first - 1, first + section.len()] {
                assert_ne!(face(&at(&mut scene, [beside, pixel[1]])), own);
            }
        }
    }
}

#[test]
fn a_section_of_a_scene_with_many_lights_has_fewer_pixels() {
    let mut record = built_in_record();
    let faint = records::light("faint", LightKind::Ambient, 1e-3, DVec3::ZERO);
    let section = |record: &SceneRecord| {
        let mut scene = Scene::spawn("many".to_owned(), record);
        let view = view_from(&scene, 0, [480, 36]);
        let section = probe::section(&mut scene, &view, [241, 18], Level::new());
        section.expect("a row fits")
    };
    let all = section(&record);
    for step in [2, 3] {
        // So many lights for each term.
        record.light = vec![faint.clone(); step * 20_000_usize.div_ceil(all.len())];
        let some = section(&record);
        let few = all.len() / step;
        assert!((few..=few + 2).contains(&some.len()), "{}", some.len());
        let own = all.iter().find(|it| it.pixel[0] == 241);
        let kept = [all.first(), all.last(), own];
        let is_kept = |it: &Probe| some.iter().any(|other| other.pixel == it.pixel);
        assert!(kept.into_iter().flatten().all(is_kept), "{step}");
    }
}
