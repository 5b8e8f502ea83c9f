//! What the probe says in words and in rows: the cause of a difference, the cost of a pixel, and the page on which it is worked out.

use shadetrade::questions::probe::Probe;
use shadetrade::reference::LightSample;
use shadetrade::scene::BUILT_IN;
use shadetrade::shading::SquareKind::{InF64, Linear, PerPixel, Quadratic};
use shadetrade::systems::frame::display_step;

use super::{at, surface_of};
use crate::support::prelude::*;

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

/// The three numbers after this label, in its first row of a page.
fn numbers(page: &str, label: &str) -> DVec3 {
    let numbers = page.lines().find_map(|line| {
        let rest = line.trim_start().strip_prefix(label)?;
        let words = rest.split_whitespace();
        let numbers: Vec<f64> = words.filter_map(|word| word.parse().ok()).collect();
        (rest.starts_with(' ') && numbers.len() == 3).then(|| DVec3::from_slice(&numbers))
    });
    numbers.unwrap_or_else(|| panic!("no {label:?} in {page}"))
}

type Term = fn(&LightSample) -> DVec3;

/// Digits of numbers are tested where they are written. Levels are large, or those of an exam, from 0 to 1.
#[test]
fn a_page_has_the_terms_the_sum_and_the_bytes_of_each_mode() {
    let mut lit = 0;
    let is_near = |printed: DVec3, level: DVec3| {
        let least = DVec3::splat(1e-6).max(level.abs() * 1e-5);
        let rounding = DVec3::select(
            level.abs().cmplt(DVec3::ONE),
            least,
            least.max(DVec3::splat(6e-4)),
        );
        (printed - level).abs().cmple(rounding).all()
    };
    for (index, pixel) in
        (0..120).map(|index| (index, [100 + 6 * (index % 20), 90 + 10 * (index / 20)]))
    {
        let (name, text) = BUILT_IN[index % BUILT_IN.len()];
        let scene = Scene::parse(name, text).expect("it is built in");
        let mut record = SceneRecord::of(&scene.world);
        for cuboid in &mut record.cuboid {
            cuboid.normals = NormalMode::ALL[index / 4 % 2];
            cuboid.segments = Segments::new([1, 1, 5][index % 3]).expect("a number");
        }
        for light in &mut record.light {
            light.gain *= [1.0, 1.0 / 255.0][index / 8 % 2];
        }
        record.view.projection = Projection::ALL[index / 2 % 2];
        let mut scene = Scene::spawn(name.to_owned(), &record);
        let view = View::of(&scene.world, [320, 240]);
        let probe = at(&mut scene, &view, pixel);
        let sample = probe.surface.as_ref().and_then(|it| it.sample.as_ref());
        let Some(sample) = sample else {
            continue;
        };
        let page = probe.lines().join("\n");
        assert!(is_near(numbers(&page, "P"), sample.position));
        let modes: [(_, _, Term); 3] = [
            ("\nPhong, exact", sample.phong, |it| it.phong),
            ("\nBlinn-Phong, exact", sample.blinn_phong, |it| {
                it.blinn_phong
            }),
            ("\nGouraud, exact", sample.gouraud, |it| it.gouraud),
        ];
        for (heading, sum, of) in modes {
            let (_, part) = page.split_once(heading).expect("a heading");
            let (_, part) = part.split_once("blue").expect("a row of terms");
            assert!(is_near(numbers(part, "sum"), sum), "{sum}: {page}");
            let bytes = sum.to_array().map(|level| f64::from(display_step(level)));
            assert_eq!(numbers(part, "bytes"), DVec3::from(bytes));
            for light in &sample.lights {
                assert!(is_near(numbers(part, &light.name), of(light)), "{page}");
            }
        }
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
            let lights = record.light.iter_mut();
            lights.for_each(|light| light.intensity *= strength);
        });
        let limit = format!("renderer draws it, within {}", surface.tolerance);
        let probe = Probe {
            pixel: [565, 327],
            surface: Some(surface),
        };
        let page = probe.lines().join("\n");
        assert_eq!(page.contains("clamped"), is_clamped, "{page}");
        assert!(page.contains(&limit), "{page}");
    }
}

#[test]
fn a_page_says_what_the_reference_does_not_see() {
    let mut surface = surface_of(ShadingMode::Phong, [300, 300], |_| ());
    let triangle = surface.triangle;
    let drawn = surface.phong;
    surface.sample = None;
    let mut probe = Probe {
        pixel: [31, 7],
        surface: Some(surface),
    };
    let lines = probe.lines();
    let title = format!("pixel 31,7: emerald, triangle {triangle}");
    assert_eq!(lines[0], title);
    assert!(lines.iter().any(|line| line.contains("another face")));
    let bytes = drawn.to_array().map(|level| f64::from(display_step(level)));
    assert_eq!(numbers(&lines.join("\n"), "bytes"), DVec3::from(bytes));
    probe.surface = None;
    assert_eq!(probe.lines(), ["pixel 31,7: background"]);
}
