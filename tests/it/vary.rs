//! `vary`: ranges end where they are said to end, f32 leaves its limit where paper predicts, and the renderer never does.
//!
//! `SHADETRADE_EXTREMES=full` draws larger pictures.

use serde_json::Value;
use shadetrade::components::ShadingMode::{Gouraud, Phong, UnitVectors};
use shadetrade::output::CANCELLED;
use shadetrade::questions::job::Drawing;
use shadetrade::questions::metrics::displayed;
use shadetrade::questions::prove::Verdict::{self, Proven, Refuted};
use shadetrade::questions::vary::picture::{
    Compared, Contender, Error, REFERENCE, TEXTBOOK, errors,
};
use shadetrade::questions::vary::variable::Variable;
use shadetrade::questions::vary::{Curve, Panel, Point, Report, Request, export, measure};
use shadetrade::scene::key::Key;
use shadetrade::shading::LIMIT_0;

use crate::cli;
use crate::extremes::is_full;
use crate::support::prelude::*;
use crate::support::random_scene::case;

const SIZE: [usize; 2] = [40, 30];

/// A face two units high, seen along z, and a lamp above its middle.
const LAMP: &str = "background = [0, 0, 0]
[[cuboid]]
name = \"box\"
size = [2, 2, 2]
shading = \"gouraud\"
normals = \"face\"
material = { ambient = [0, 0, 0], diffuse = [1, 1, 1], specular = [0, 0, 0], shininess = 1 }
[[light]]
name = \"lamp\"
kind = \"diffuse\"
color = [1, 1, 1]
intensity = 255
gain = 1
position = [0, 0, 2]
[[camera]]
name = \"1\"
position = [0, 0, 9]
target = [0, 0, 0]
fov = 20
height = 3
";

fn scene(text: &str) -> SceneRecord {
    SceneRecord::of(&Scene::parse("varied", text).expect("a scene").world)
}

fn contenders() -> Vec<Contender> {
    let methods = [Method::of(Gouraud, 0.5), Method::of(Phong, 0.5)].map(Contender::from);
    methods.into_iter().chain([TEXTBOOK, REFERENCE]).collect()
}

fn drawn_errors(record: &SceneRecord, size: [usize; 2], contenders: &[Contender]) -> Vec<Error> {
    let level = Level::new();
    let found = errors(
        record,
        size,
        contenders,
        level,
        Compared::All,
        Monitor::NONE,
    );
    done(found)
}

fn variable(text: &str, record: &SceneRecord) -> Variable {
    Variable::parse(text, record).expect("a range")
}

/// Varies a key of a scene within half a level.
fn varied(record: &SceneRecord, text: &str, steps: usize) -> Report {
    let request = request(record, variable(text, record), steps);
    done(measure(&request, Monitor::NONE))
}

fn request(record: &SceneRecord, variable: Variable, steps: usize) -> Request {
    Request {
        drawing: Drawing {
            scene: Scene::spawn("varied".to_owned(), record),
            size: SIZE,
            threads: 1,
            level: Level::new(),
        },
        variables: vec![variable],
        contenders: contenders(),
        steps,
        time: None,
    }
}

/// Asserts that a method keeps half a level at the ends of its ranges and loses it within a hundredth beyond them; the error at a
/// value is infinite where nothing is drawn. Returns the number of ends within the range of the key.
fn assert_ends(panel: &Panel, curve: &Curve, error: impl Fn(f64) -> f64) -> usize {
    let variable = &panel.variable;
    let mut ends = 0;
    for [from, to] in &curve.keeps {
        for (end, way) in [(*from, -1.0), (*to, 1.0)] {
            let what = format!("{} of {} at {end}", curve.method, variable.key);
            assert!(error(end) <= 0.5, "{what}");
            if end == variable.from || end == variable.to {
                continue;
            }
            ends += 1;
            let beyond = |step: u32| {
                let share = variable.share(end) + way * 0.0101 * f64::from(step) / 16.0;
                variable.at(share.clamp(0.0, 1.0))
            };
            // Whole numbers have a step of their own.
            let next = (variable.key.last() == "segments").then_some(end + way);
            let mut beyond = (1..=16).rev().map(beyond).chain(next);
            assert!(beyond.any(|value| error(value) > 0.49), "{what}");
        }
    }
    ends
}

#[test]
fn a_range_ends_where_the_error_passes_the_tolerance() {
    let record = built_in_record();
    for text in [
        "camera.1.orbit.zoom=1..20",
        "cuboid.emerald.material.shininess=1..200",
        "light.specular.intensity=0..2",
        "cuboid.emerald.segments=1..256",
        "light.white.position.z=2..8",
    ] {
        let report = varied(&record, text, 6);
        let panel = &report.keys[0];
        for (curve, contender) in panel.curves.iter().zip(contenders()) {
            let found = |value: f64| {
                let record = panel.variable.scene(&record, value).expect("it is legal");
                drawn_errors(&record, SIZE, &[contender])[0]
            };
            for point in &curve.points {
                assert_eq!(found(point.value), point.found);
                let is_kept = point.found.pixels > 0 && point.found.error[1] <= 0.5;
                let is_inside = |it: &[f64; 2]| (it[0]..=it[1]).contains(&point.value);
                assert_eq!(curve.keeps.iter().any(is_inside), is_kept, "{text}");
            }
            assert_ends(panel, curve, |value| match found(value) {
                Error { pixels: 0, .. } => f64::INFINITY,
                Error { error, .. } => error[1],
            });
        }
    }
}

/// Cuboids that are too far away or beside the picture.
#[test]
fn values_at_which_nothing_is_drawn_are_no_evidence() {
    let record = built_in_record();
    for text in [
        "camera.1.orbit.zoom=1..1000",
        "camera.1.target.x=-40..40",
        "camera.1.target.y=40..80",
    ] {
        let report = varied(&record, text, 9);
        let panel = &report.keys[0];
        let covered = |value: f64| {
            let record = panel.variable.scene(&record, value).expect("it is legal");
            let mut world = record.spawn();
            let view = View::of(&world, SIZE);
            let counts = draw(&mut world, &view, Keep::Levels).counts();
            counts.covered_pixels
        };
        for curve in &panel.curves[..2] {
            for Point { value, found, .. } in &curve.points {
                let is_in = |ranges: &[[f64; 2]]| {
                    let mut ranges = ranges.iter();
                    ranges.any(|it| (it[0]..=it[1]).contains(value))
                };
                let is_empty = covered(*value) == 0;
                assert_eq!(found.pixels == 0, is_empty, "{text} {value}");
                assert_eq!(is_in(&curve.empty), is_empty, "{text} {value}");
                assert!(!is_empty || !is_in(&curve.keeps), "{text} {value}");
            }
            for value in curve.keeps.as_flattened() {
                assert!(covered(*value) > 0, "{text} {value}");
            }
            for value in curve.empty.as_flattened() {
                assert_eq!(covered(*value), 0, "{text} {value}");
            }
        }
        // Half a level is kept by Phong wherever it is drawn, and by Gouraud nowhere.
        let (gouraud, phong) = (&panel.curves[0], &panel.curves[1]);
        assert!(!phong.empty.is_empty() && gouraud.keeps.is_empty());
        assert_eq!(phong.keeps.is_empty(), text.contains(".y="), "{text}");
        let said = export::text(&report);
        assert!(said.contains("Nothing is drawn"), "{said}");
    }
}

/// A face two units high, three units high in the picture, and seen along z.
#[test]
fn ranges_of_a_zoom_are_heights_of_the_cuboids() {
    let mut record = scene(LAMP);
    record.view.projection = Projection::Orthographic;
    let report = varied(&record, "camera.1.orbit.zoom=1..100", 4);
    let curve = &report.keys[0].curves[1];
    let heights = curve.heights.as_ref().expect("it is a zoom");
    assert!(!heights.is_empty());
    let ends = curve.keeps.as_flattened().iter();
    for (zoom, height) in ends.zip(heights.as_flattened()) {
        let on_paper = 2.0 * SIZE[1] as f64 / (3.0 * zoom);
        assert!((height - on_paper).abs() < 1e-9, "{zoom}: {height}");
    }
    // That of a camera that is not in use, or another key, has none.
    for key in ["camera.2.orbit.zoom=1..100", "light.white.intensity=1..2"] {
        let report = varied(&built_in_record(), key, 2);
        assert!(report.keys[0].curves.iter().all(|it| it.heights.is_none()));
    }
}

/// Odd sizes have a pixel in the middle, even ones have none.
#[test]
fn heights_at_which_a_method_does_are_those_of_every_size() {
    let fine = Method::with(Gouraud, Segments::new(16), 0.5);
    for (method, tolerance, is_kept) in [
        (Method::of(Gouraud, 0.5), 0.5, false),
        (Method::of(UnitVectors, 0.0), 0.5, false),
        (fine, 2.0, true),
    ] {
        let mut record = built_in_record();
        record.view.tolerance = tolerance;
        let heights = [[40, 30], [41, 31], [95, 70]].map(|size| {
            let zoom = variable("camera.1.orbit.zoom=1..1000", &record);
            let mut request = request(&record, zoom, 31);
            request.drawing.size = size;
            request.contenders = vec![method.into()];
            let report = done(measure(&request, Monitor::NONE));
            let heights = report.keys[0].curves[0].heights.as_ref();
            // The largest from which on it does, in pixels; 0 if it does at none.
            let largest = heights.expect("it is a zoom").last();
            largest.map_or(0.0, |range| range[0])
        });
        assert_eq!(heights.iter().all(|it| *it > 0.0), is_kept, "{heights:?}");
        let [least, most] = [f64::min, f64::max].map(|of| heights.into_iter().reduce(of));
        let difference = most.expect("three") - least.expect("three");
        assert!(difference <= 1.0, "{}: {heights:?}", method.id);
    }
}

/// The largest error of a drawn picture against exact Phong in f64, which shares nothing with intervals. `None` where it shows
/// another face than the renderer.
fn judged(record: &SceneRecord, method: Method) -> Option<f64> {
    let mut world = record.spawn();
    let view = View::of(&world, SIZE);
    let truth = truth(&world, &view.shaded(Phong));
    let frame = draw(&mut world, &method.view(&view), Keep::Levels);
    let pixels = frame.levels().iter().zip(&truth.levels);
    let error = |(drawn, exact): (&[f32; 3], &[f64; 3])| {
        let channels = drawn.iter().zip(exact);
        let errors =
            channels.map(|(drawn, exact)| (displayed((*drawn).into()) - displayed(*exact)).abs());
        errors.fold(0.0, f64::max)
    };
    let is_same = frame.triangles() == truth.triangles;
    is_same.then(|| pixels.map(error).fold(0.0, f64::max))
}

/// Both sides of the ends that bisection finds, in random scenes.
#[test]
fn ends_in_random_scenes_hold_on_both_sides_before_an_independent_judge() {
    let keys = [
        "camera.random.orbit.zoom",
        "cuboid.0.material.shininess",
        "cuboid.0.segments",
        "camera.random.fov",
    ];
    let gouraud = Method::of(Gouraud, 0.5);
    let mut ends = 0;
    for case in values(&case(Gouraud), cases(6)) {
        let record = case.record(0.5);
        let key = Key::from(keys[case.seed as usize % keys.len()]);
        let variable = Variable::around(key, &record).expect("a number");
        let report = done(measure(&request(&record, variable, 5), Monitor::NONE));
        let panel = &report.keys[0];
        ends += assert_ends(panel, &panel.curves[0], |value| {
            let record = panel.variable.scene(&record, value).expect("it is legal");
            let Error { error, pixels, .. } = drawn_errors(&record, SIZE, &[gouraud.into()])[0];
            if pixels == 0 {
                return f64::INFINITY;
            }
            let [least, most] = error;
            // Proven bounds and the judge agree.
            if let Some(judged) = judged(&record, gouraud) {
                let is_within = (least - 1e-6..=most + 1e-6).contains(&judged);
                assert!(is_within, "{case:?} {value}: {judged}, {least} to {most}");
            }
            most
        });
    }
    assert!(ends > 0, "no end is within its range");
}

/// A key, its range, and values from end to end.
const VALUES: &str = "
light.white.intensity=1..100    1 10 100
light.white.intensity=1..9      1 5 9
light.white.intensity=9..1      1 5 9
light.white.position.x=-10..10  -10 -5 0 5 10
cuboid.emerald.segments=1..16   1 2 4 8 16
cuboid.emerald.segments=1..3    1 2 3";

#[test]
fn values_reach_from_end_to_end_in_even_steps() {
    let record = built_in_record();
    for row in VALUES.lines().skip(1) {
        let (text, values) = row.split_once("  ").expect("values");
        let expected: Vec<f64> = values.split_whitespace().flat_map(str::parse).collect();
        let found = variable(text, &record).values(expected.len());
        assert_eq!(found, expected, "{text}");
    }
    let few = variable("cuboid.emerald.segments=1..3", &record).values(9);
    assert_eq!(few, [1.0, 2.0, 3.0]);
}

/// The ratio of these ends exceeds the largest float, or is 0 in f64.
#[test]
fn a_range_of_any_number_of_decades_has_even_steps() {
    let record = built_in_record();
    for (ends, middle) in [
        ("1e-300..1e100", 1e-100),
        ("-1e100..-1e-300", -1e-100),
        ("1e-308..1e100", 1e-104),
        ("5e-324..1", 2.2e-162),
        ("-1e30..-1", -1e15),
    ] {
        let variable = variable(&format!("light.white.position.z={ends}"), &record);
        let values = variable.values(5);
        assert!(values.is_sorted() && values.len() == 5, "{values:?}");
        assert!((values[2] / middle - 1.0).abs() < 0.02, "{values:?}");
        for (value, share) in values.iter().zip([0.0, 0.25, 0.5, 0.75, 1.0]) {
            assert!((variable.share(*value) - share).abs() < 1e-3, "{ends}");
        }
        assert!((2..=8).contains(&variable.marks().len()), "{ends}");
    }
    // A sixth of the range is no float.
    let variable = variable("light.white.position.z=0..5e-324", &record);
    assert_eq!(variable.marks(), [0.0, 5e-324]);
    assert_eq!(variable.values(5), [0.0, 5e-324]);
}

#[test]
fn own_errors_are_against_the_definition_and_a_still_key_says_so() {
    let report = varied(&built_in_record(), "light.white.intensity=5..20", 3);
    let [gouraud, phong, textbook, reference] = &report.keys[0].curves[..] else {
        panic!("{report:?}");
    };
    for Point { found, .. } in &gouraud.points {
        assert!(found.error[0] > 50.0 && found.own_error[1] <= 0.5);
    }
    for curve in [phong, textbook, reference] {
        let mut points = curve.points.iter();
        assert!(points.all(|it| it.found.own_error == it.found.error));
    }
    assert!(reference.points.iter().all(|it| it.found.error[1] < 1e-9));
    assert!(!report.keys[0].is_still());
    let mut record = built_in_record();
    record.light[0].on = false;
    assert!(varied(&record, "light.white.intensity=5..20", 3).keys[0].is_still());
}

#[test]
fn a_cancelled_work_ends() {
    let record = built_in_record();
    let variable = variable("light.white.intensity=1..2", &record);
    let request = request(&record, variable, 2);
    let error = finished(measure(&request, CANCEL)).expect_err("it is cancelled");
    assert_eq!(error.to_string(), CANCELLED);
}

/// Gouraud with one cell on the face z = 1 under one light at height h above its middle: the error in the middle.
#[test]
fn a_lamp_above_a_face_errs_as_on_paper() {
    let record = scene(LAMP);
    let variable = variable("light.lamp.position.z=1.5..9", &record);
    for z in [1.5, 2.0, 4.0] {
        let record = variable.scene(&record, z).expect("it is legal");
        // An odd size has a pixel in the middle.
        let found = drawn_errors(&record, [41, 41], &[Method::of(Gouraud, 0.0).into()]);
        let [least, most] = found[0].error;
        // The middle has n.l = 1, the corners h / sqrt(h^2 + 2), and it lies on the diagonal between two of them.
        let h = z - 1.0;
        let on_paper = 255.0 * (1.0 - h / (h * h + 2.0).sqrt());
        let is_known = (least - on_paper).abs() < 0.06 && most - least < 1e-6;
        assert!(is_known, "{z}: {least}, {on_paper}");
    }
}

/// The scene with all lengths multiplied, and moved away from the origin.
fn moved(mut scene: SceneRecord, scale: f64, far: f64) -> SceneRecord {
    let shift = DVec3::new(far, -0.5 * far, 0.25 * far);
    let (cuboid, camera) = (&mut scene.cuboid[0], &mut scene.camera[0]);
    cuboid.size *= scale;
    camera.height *= scale;
    let lights = scene.light.iter_mut().filter_map(|it| it.position.as_mut());
    let others = [
        &mut cuboid.position,
        &mut camera.position,
        &mut camera.target,
    ];
    for place in lights.chain(others) {
        *place = *place * scale + shift;
    }
    scene.check().expect("a legal scene");
    scene
}

/// f32 has 24 bits, and a range from 1e-45 to 3e38.
#[test]
fn f32_fails_where_paper_predicts_and_the_renderer_nowhere() {
    let size = if is_full() { [128, 96] } else { [16, 12] };
    let scene = scene(include_str!("../../assets/stability/scene.toml"));
    let renderer = [0.0, 0.5].map(|tolerance| Contender::from(Method::of(Phong, tolerance)));
    let contenders = [TEXTBOOK, renderer[0], renderer[1]];
    for (scales, fars, verdict) in [
        ([0.025, 1.0, 250.0], [0.0; 3], Proven),
        ([1.0; 3], [1.0, 3.0, 10.0], Proven),
        // The last place of 1e8 in f32 is eight units.
        ([1.0; 3], [1e8, 1e11, 1e15], Refuted),
        // The square of a length overflows, or underflows to 0.
        ([1e20, 1e40, 1e96], [0.0; 3], Refuted),
        ([1e-25, 1e-40, 1e-97], [0.0; 3], Refuted),
    ] {
        for (scale, far) in scales.into_iter().zip(fars) {
            let record = moved(scene.clone(), scale, far);
            let found = drawn_errors(&record, size, &contenders);
            let [textbook, exact, half] = [0, 1, 2].map(|it| found[it].error);
            let what = format!("{scale}, {far}: {textbook:?}, {exact:?}, {half:?}");
            assert_eq!(Verdict::of(textbook, LIMIT_0), verdict, "{what}");
            assert!(exact[1] <= LIMIT_0 && half[1] <= 0.5, "{what}");
        }
    }
}

#[test]
fn the_command_writes_what_it_prints() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let line = "vary camera.1.orbit.zoom=1..100 --steps 3 --size 40x30 --seconds 0 -o out --json";
    let (status, json) = cli::json(folder.path(), line);
    assert_eq!(status, Some(0));
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).expect(name);
    let file: Value = serde_json::from_str(&read("out/vary.json")).expect("JSON");
    assert_eq!(file, json);
    let panel = &json["keys"][0];
    assert_eq!(panel["key"], "camera.1.orbit.zoom");
    let curves = panel["curves"].as_array().expect("a list");
    for (table, expected) in [
        (&json, "scene camera projection size tolerance keys"),
        (panel, "key from to logarithmic curves"),
        (&curves[0], "method points keeps heights empty"),
        (
            &curves[0]["points"][0],
            "value error own_error pixels milliseconds",
        ),
    ] {
        assert_eq!(cli::keys(table), expected);
    }
    for curve in curves {
        let is_timed =
            ["gouraud-0.5", "phong-0.5"].contains(&curve["method"].as_str().expect("a name"));
        assert_eq!(curve["points"][2]["milliseconds"].is_null(), !is_timed);
    }
    let svg = read("out/vary.svg");
    for text in [
        "camera.1.orbit.zoom",
        "gouraud-0.5",
        "textbook-f32",
        "ms",
        "Nothing is drawn",
    ] {
        assert!(svg.contains(text), "{text}");
    }
}
