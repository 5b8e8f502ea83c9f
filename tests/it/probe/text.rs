//! What the probe says in words and in rows: the cause of a difference, the cost of a pixel, and every number.

use glam::DVec3;
use shadetrade::components::{LightKind, ShadingMode};
use shadetrade::frame::display_step;
use shadetrade::probe::Probe;
use shadetrade::scene::SceneRecord;
use shadetrade::shading::SquareKind::{InF64, Linear, PerPixel, Quadratic};

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

/// Asserts that a cell shows this value: 0, three decimals, or two digits and a power of ten.
fn assert_shows(cell: &str, value: f64) {
    assert!(cell.len() <= 9, "{cell}");
    let shown: f64 = cell.parse().expect("a number");
    let allowed = if value.abs() <= 1e-6 {
        assert_eq!(cell, "0");
        1e-6
    } else if (1e-3..1e4).contains(&value.abs()) {
        5.1e-4
    } else {
        0.06 * value.abs()
    };
    assert!((shown - value).abs() <= allowed, "{cell} for {value}");
}

#[test]
fn the_text_shows_every_value_in_rows() {
    let strengths = [1e-9, 0.5, 7e5];
    let surface = surface_of(ShadingMode::Phong, [300, 300], |record| {
        for (light, strength) in record.light.iter_mut().zip(strengths) {
            light.intensity *= strength;
        }
    });
    let mut probe = Probe {
        pixel: [31, 7],
        surface: Some(surface.clone()),
    };
    let lines = probe.lines();
    let head = format!("pixel 31,7: emerald, triangle {}", surface.triangle);
    assert_eq!(lines[0], head);
    assert!(lines.iter().all(|line| line.len() <= 45), "{lines:?}");
    // The first row of this name below a heading.
    let cells = |lines: &[String], heading: &str, name: &str| -> Vec<String> {
        let words = lines.iter().map(|line| line.split_whitespace());
        let mut below = words.skip_while(|words| words.clone().next() != Some(heading));
        let row = below.find(|words| words.clone().next() == Some(name));
        row.expect(name).skip(1).map(str::to_owned).collect()
    };
    let assert_row = |heading: &str, name: &str, values: DVec3| {
        let cells = cells(&lines, heading, name);
        for (index, value) in values.to_array().into_iter().enumerate() {
            assert_shows(&cells[index], value);
        }
    };
    for light in surface.lights() {
        assert_row("strength", &light.name, light.strength);
        assert_row("Gouraud", &light.name, light.gouraud);
        assert_row("Phong", &light.name, light.phong);
        let heading = format!("  {} ({})", light.name, light.kind.name());
        assert_eq!(lines.contains(&heading), light.kind != LightKind::Ambient);
        let row = cells(&lines, "factor", &light.name);
        let factor: f64 = row[2].parse().expect("a number");
        assert!((factor - light.factor).abs() < 1e-5, "{row:?}");
        assert_eq!(row[1] == "-", light.kind != LightKind::Specular, "{row:?}");
    }
    assert_eq!(cells(&lines, "factor", "n.l"), ["o.r", "factor"]);
    // Gouraud by hand, from the rows of the vertices.
    let numbers = |name: &str| -> Vec<f64> {
        let at = lines.iter().position(|line| line.contains("factor at"));
        let cells = cells(&lines[at.expect("a heading")..], "factor", name);
        let numbers = cells.iter().map(|it| it.parse().expect("a number"));
        numbers.collect()
    };
    let weights = numbers("weight");
    for light in surface.lights() {
        let factors = numbers(&light.name);
        let terms = weights.iter().zip(factors).map(|(w, factor)| w * factor);
        let sum: f64 = terms.sum();
        assert!((light.strength * sum - light.gouraud).length() < 1e-4 * light.strength.length());
    }
    let exact = surface.sample.as_ref().expect("the same face");
    assert!(exact.position.x < -1.0);
    assert_row("pixel", "position", exact.position);
    for (mode, drawn, exact) in [
        ("Gouraud", surface.gouraud, exact.gouraud),
        ("Phong", surface.phong, exact.phong),
    ] {
        assert_row(mode, "drawn", drawn);
        assert_row(mode, "reference", exact);
        let bytes = drawn.to_array().map(|level| f64::from(display_step(level)));
        assert_row(mode, "bytes", DVec3::from(bytes));
    }

    // At an edge the reference may see another triangle, or another face.
    let surface = probe.surface.as_mut().expect("set above");
    let other = surface.triangle ^ 1;
    surface.sample.as_mut().expect("the same face").triangle = other;
    let label = format!("(reference: {other})");
    assert!(surface.triangle_label().ends_with(&label));
    surface.sample = None;
    let lines = probe.lines();
    assert!(lines[2].ends_with("n -"), "{lines:?}");
    assert_eq!(cells(&lines, "Phong", "reference"), ["-"; 3]);
    probe.surface = None;
    assert_eq!(probe.lines(), ["pixel 31,7: background"]);
}
