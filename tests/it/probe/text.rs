//! What the probe says in words and in rows: the cause of a difference, the cost of a pixel, and the page on which it is worked out.

use fearless_simd::Level;
use glam::DVec3;
use shadetrade::components::{LightKind, NormalMode, Projection, Segments, ShadingMode, View};
use shadetrade::questions::probe::{self, Probe};
use shadetrade::reference::LightSample;
use shadetrade::scene::{BUILT_IN, Scene, SceneRecord};
use shadetrade::shading::SquareKind::{InF64, Linear, PerPixel, Quadratic};
use shadetrade::systems::frame::display_step;

use super::surface_of;

#[test]
fn the_cause_is_that_of_the_light_that_differs_most() {
    const HIGHLIGHT: [usize; 2] = [565, 327];
    const FACE: [usize; 2] = [480, 300];
    type Change = fn(&mut SceneRecord);
    let only_white: Change = |record| record.light.truncate(1);
    let lamp: Change = |record| {
        record.light.truncate(1);
        record.light[0].position = Some(DVec3::new(0.0, 0.0, 2.0));
    };
    let dark: Change = |record| record.light.clear();
    let ambient: Change = |record| drop(record.light.drain(..3));
    let cases: [([usize; 2], Change, &str); 7] = [
        // No corner has more than 3 % of the highlight: the table of the probe has 4.0 and 165.
        (HIGHLIGHT, |_| (), "No vertex lies in the highlight"),
        // At its edge a pixel has 12 % of the highlight, and a corner a quarter of that.
        ([530, 312], |_| (), "(o.r)^76.8 of light specular lies"),
        (HIGHLIGHT, ambient, "No diffuse or specular light"),
        (HIGHLIGHT, dark, "No diffuse or specular light"),
        // The light is behind the face: n.l is 0 at all of its corners but those that lean to it.
        (FACE, only_white, "A vertex faces away from light white"),
        // A lamp before the middle of the face shines past its corners' normals.
        ([485, 380], lamp, "The surface faces light white more"),
        // Blue agrees within a level, red is 21 off.
        (FACE, |_| (), "A vertex faces away from light red"),
    ];
    for (pixel, change, beginning) in cases {
        // The picture's own mode may be Phong: interpolation is still what is explained.
        for mode in [ShadingMode::Gouraud, ShadingMode::Phong] {
            let surface = surface_of(mode, pixel, change);
            let [sentence, evidence] = surface.cause().expect("the reference sees the face");
            assert!(sentence.starts_with(beginning), "{sentence}");
            if beginning.starts_with("No vertex") {
                let light = &surface.lights()[2];
                let level = format!("instead of {:.0}.", light.phong.z);
                let factor = format!("{:.2} here", light.factor);
                assert!(sentence.contains(&level) && evidence.contains(&factor));
            }
        }
    }
}

#[test]
fn unit_vectors_are_as_short_as_their_mean() {
    // Seen along z, the middle of the face z = 1 has the mean of two opposite corners: (0, 0, 1) / sqrt 3.
    let surface = surface_of(ShadingMode::UnitVectors, [480, 360], |record| {
        record.camera[0].position = DVec3::new(0.0, 0.0, 8.0);
    });
    let sample = surface.sample.as_ref().expect("the same face");
    assert!((sample.normal_length - 3.0_f64.sqrt().recip()).abs() < 1e-3);
    let [sentence, evidence] = surface.cause().expect("the reference sees the face");
    assert!(sentence.contains("too short") && evidence.contains("0.58"));
}

#[test]
fn the_cost_is_that_of_the_square() {
    use ShadingMode::{Gouraud, Phong, UnitVectors};
    for (mode, kind, words) in [
        (Phong, Quadratic, ["nine", "(quadratic)"]),
        (Phong, PerPixel, ["is evaluated", "every pixel"]),
        (Gouraud, Linear, ["not evaluated", "(linear)"]),
        (Gouraud, PerPixel, ["not evaluated", "every pixel"]),
        (UnitVectors, InF64, ["is evaluated", "f64"]),
    ] {
        let mut surface = surface_of(mode, [480, 360], |_| ());
        surface.kind = kind;
        let cost = surface.cost();
        assert!(words.iter().all(|word| cost.contains(word)), "{cost}");
    }
}

/// The numbers after this label, in the first line below `after` that has so many.
fn numbers(lines: &[String], after: &str, label: &str) -> DVec3 {
    let mut lines = lines.iter().skip_while(|line| !line.starts_with(after));
    let numbers = lines.find_map(|line| {
        let rest = line.trim_start().strip_prefix(label)?;
        let words = rest.split_whitespace();
        let numbers: Vec<f64> = words.filter_map(|word| word.parse().ok()).collect();
        (rest.starts_with(' ') && numbers.len() == 3).then(|| DVec3::from_slice(&numbers))
    });
    numbers.unwrap_or_else(|| panic!("no {label:?} after {after:?}"))
}

/// Whether a printed level is this one, rounded once: to three decimals, or to six digits below 1.
fn is_rounded(printed: DVec3, level: DVec3) -> bool {
    let error = (printed - level).abs() / level.abs().min(DVec3::ONE).max(DVec3::splat(1e-300));
    let allowed = DVec3::splat(0.000_501);
    let small = level.abs().cmplt(DVec3::ONE);
    error
        .cmple(DVec3::select(small, DVec3::splat(5.01e-6), allowed))
        .all()
}

/// As an exam gives intensities, from 0 to 1, and as levels.
#[test]
fn every_number_of_a_page_is_exact_whatever_its_size() {
    let mut random = fastrand::Rng::with_seed(5);
    let (mut pixels, mut lit) = (0, 0);
    while pixels < 240 {
        let (name, text) = BUILT_IN[random.usize(..BUILT_IN.len())];
        let mut record = SceneRecord::of(&Scene::parse(name, text).expect("it is built in").world);
        for cuboid in &mut record.cuboid {
            cuboid.normals = [NormalMode::Corner, NormalMode::Face][random.usize(..2)];
            cuboid.segments = Segments::new([1, 1, 5][random.usize(..3)]).expect("a number");
        }
        let unit = [1.0, 1.0 / 255.0][random.usize(..2)];
        for light in &mut record.light {
            light.gain *= unit;
        }
        let mut scene = Scene::spawn(name.to_owned(), &record);
        let view = View {
            projection: [Projection::Perspective, Projection::Orthographic][random.usize(..2)],
            ..View::of(&scene.world, [320, 240])
        };
        let pixel = [random.usize(..320), random.usize(..240)];
        let probe = probe::at(&mut scene, &view, pixel, Level::new()).expect("a row fits");
        let Some(surface) = &probe.surface else {
            continue;
        };
        let Some(sample) = &surface.sample else {
            continue;
        };
        let lines = probe.lines();
        let point = numbers(&lines, "P = ", "P");
        assert!((point - sample.position).length() <= 1e-8 * sample.position.length());
        for (mode, sum, of) in [
            (
                "Phong, exact",
                sample.phong,
                (|it| it.phong) as fn(&LightSample) -> DVec3,
            ),
            ("Blinn-Phong, exact", sample.blinn_phong, |it| {
                it.blinn_phong
            }),
            ("Gouraud, exact", sample.gouraud, |it| it.gouraud),
        ] {
            let printed = numbers(&lines, mode, "sum");
            assert!(is_rounded(printed, sum), "{printed} for {sum}: {lines:#?}");
            let bytes = sum.to_array().map(|level| f64::from(display_step(level)));
            assert_eq!(numbers(&lines, mode, "bytes"), DVec3::from(bytes));
            for light in &sample.lights {
                let rows = lines.iter().skip_while(|line| !line.starts_with(mode));
                let rows: Vec<String> = rows
                    .skip_while(|line| !line.contains("blue"))
                    .cloned()
                    .collect();
                let printed = numbers(&rows, "", &light.name);
                assert!(is_rounded(printed, of(light)), "{printed} for {light:?}");
            }
        }
        pixels += 1;
        let mut lights = sample.lights.iter();
        lit += usize::from(lights.any(|it| it.kind == LightKind::Specular && it.factor > 0.01));
    }
    assert!(lit >= 3, "{lit} pixels of highlights");
}

/// The middle of the highlight has more than 255 levels of red.
#[test]
fn a_page_says_which_levels_are_clamped_and_which_are_drawn() {
    for (strength, is_clamped) in [(0.1, false), (1.0, true)] {
        let surface = surface_of(ShadingMode::Phong, [565, 327], |record| {
            record
                .light
                .iter_mut()
                .for_each(|light| light.intensity *= strength);
        });
        let limit = surface.tolerance;
        let probe = Probe {
            pixel: [565, 327],
            surface: Some(surface),
        };
        let page = probe.lines().join("\n");
        assert_eq!(page.contains("clamped"), is_clamped, "{page}");
        assert!(
            page.contains(&format!("renderer draws it, within {limit}")),
            "{page}"
        );
    }
}

#[test]
fn a_page_says_what_the_reference_does_not_see() {
    let mut surface = surface_of(ShadingMode::Phong, [300, 300], |_| ());
    let triangle = surface.triangle;
    surface.sample.as_mut().expect("the same face").triangle = triangle ^ 1;
    let label = format!("(reference: {})", triangle ^ 1);
    assert!(surface.triangle_label().ends_with(&label));
    let drawn = surface.phong;
    surface.sample = None;
    let mut probe = Probe {
        pixel: [31, 7],
        surface: Some(surface),
    };
    let lines = probe.lines();
    assert_eq!(
        lines[0],
        format!("pixel 31,7: emerald, triangle {triangle}")
    );
    assert!(lines.iter().any(|line| line.contains("another face")));
    let bytes = drawn
        .to_array()
        .map(|level| display_step(level).to_string());
    let shown = lines.iter().find(|line| line.starts_with("bytes"));
    let shown: Vec<_> = shown.expect("a row").split_whitespace().skip(1).collect();
    assert_eq!(shown, bytes);
    probe.surface = None;
    assert_eq!(probe.lines(), ["pixel 31,7: background"]);
}
