//! What the probe says in words and in rows: the cause of a difference, the cost of a pixel, and the page on which it is worked out.

use fearless_simd::Level;
use glam::DVec3;
use shadetrade::components::{LightKind, NormalMode, Projection, Segments, ShadingMode, View};
use shadetrade::questions::probe::{self, Probe, ProbedSurface};
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

/// The numbers of a page as they are printed, and the page worked out again from them by the formula of the README.
struct Page {
    lines: Vec<String>,
    /// The next line.
    at: usize,
    /// The significant digits, from the width of a column.
    digits: i32,
}

impl Page {
    fn of(probe: &Probe) -> Self {
        let lines = probe.lines();
        let is_weights = |line: &&String| line.starts_with("weights");
        let width = lines.iter().find(is_weights).expect("weights").len();
        Page {
            digits: (width as i32 - 9) / 3 - 6,
            lines,
            at: 0,
        }
    }

    /// The numbers after this label, at least this many, in the first line below the last that was read.
    fn numbers(&mut self, label: &str, least: usize) -> Vec<f64> {
        let numbers = |line: &String| -> Option<Vec<f64>> {
            let rest = line.trim_start().strip_prefix(label)?;
            let words = rest.split_whitespace();
            let numbers: Vec<f64> = words.filter_map(|word| word.parse().ok()).collect();
            let is_label = rest.is_empty() || rest.starts_with(' ');
            (is_label && numbers.len() >= least).then_some(numbers)
        };
        let mut below = self.lines[self.at..].iter().map(numbers).enumerate();
        let found = below.find_map(|(place, numbers)| Some((place, numbers?)));
        let (place, numbers) = found.unwrap_or_else(|| panic!("{label:?} in {:#?}", self.lines));
        self.at += place + 1;
        numbers
    }

    fn after(&mut self, label: &str) -> Vec<f64> {
        self.numbers(label, 0)
    }

    fn vector(&mut self, label: &str) -> DVec3 {
        DVec3::from_slice(&self.numbers(label, 3))
    }

    /// Half a unit of the last digit of a number of this size.
    fn half(&self, size: f64) -> f64 {
        let exponent = size.abs().max(f64::MIN_POSITIVE).log10().floor() as i32;
        0.501 * 10.0_f64.powi(exponent - self.digits + 1)
    }

    #[track_caller]
    fn assert_result(&self, printed: DVec3, worked_out: DVec3) {
        for (printed, exact) in printed.to_array().into_iter().zip(worked_out.to_array()) {
            // Rounding errors of a vector are printed as 0.
            let allowed = self.half(exact).max(1e-12 * worked_out.length());
            assert!(
                (printed - exact).abs() <= allowed,
                "{printed} for {exact}: {:#?}",
                self.lines
            );
        }
    }

    #[track_caller]
    fn assert_levels(&self, printed: DVec3, worked_out: DVec3) {
        let allowed = 0.000_501_f64.max(1e-6 * worked_out.abs().max_element());
        let error = (printed - worked_out).abs().max_element();
        assert!(
            error <= allowed,
            "{printed} for {worked_out}: {:#?}",
            self.lines
        );
    }

    fn sum(&mut self, terms: &[DVec3]) -> DVec3 {
        let sum = self.vector("sum");
        self.assert_levels(sum, terms.iter().sum());
        let bytes = (sum.clamp(DVec3::ZERO, DVec3::splat(255.0)) + 0.5).floor();
        assert_eq!(self.vector("bytes"), bytes);
        sum
    }

    /// Works everything out again. Returns the sums under Phong and Gouraud.
    fn check(&mut self, surface: &ProbedSurface) -> [DVec3; 2] {
        self.after("vertices: P and N of each");
        let vertices = self.at;
        let corners: Vec<[DVec3; 2]> = (0..3)
            .map(|corner| {
                ["P", "N"].map(|name| {
                    let line = &self.lines[vertices + 2 * corner + usize::from(name == "N")];
                    let (_, numbers) = line.split_once(name).expect("a label");
                    let numbers = numbers
                        .split_whitespace()
                        .map(|it| it.parse().expect("a number"));
                    DVec3::from_slice(&numbers.collect::<Vec<_>>())
                })
            })
            .collect();
        let weights = self.vector("weights").to_array();
        let blend = |of: usize| {
            (0..3)
                .map(|it| corners[it][of] * weights[it])
                .sum::<DVec3>()
        };
        let point = self.vector("P");
        self.assert_result(point, blend(0));
        let n = self.vector("n");
        self.assert_result(n, blend(1).normalize());
        if surface.eye.is_some() {
            let eye = self.vector("O");
            let start = self.at;
            let o = self.vector("o");
            self.assert_result(o, (eye - point).normalize());
            self.at = start;
        }
        let o = self.vector("o");
        let (mut strengths, mut terms) = (Vec::new(), Vec::new());
        for light in surface.lights() {
            self.after(&format!("{}: {}", light.name, light.kind.name()));
            let mut factor = 1.0;
            if light.kind != LightKind::Ambient {
                let away = self.vector("L") - point;
                let l = self.vector("l");
                self.assert_result(l, away.normalize());
                let one = |value: f64| DVec3::splat(value);
                let cosine = self.after("n.l =")[0];
                self.assert_result(one(cosine), one(n.dot(l)));
                factor = cosine.max(0.0);
                if light.kind == LightKind::Specular && cosine > 0.0 {
                    let r = self.vector("r");
                    self.assert_result(r, 2.0 * cosine * n - l);
                    let cosine = self.after("o.r =")[0];
                    self.assert_result(one(cosine), one(o.dot(r)));
                    let shininess = surface.material.shininess;
                    factor = self.after(&format!("(o.r)^{shininess} ="))[0];
                    self.assert_result(one(factor), one(cosine.max(0.0).powf(shininess)));
                }
            }
            let [mut strength, mut term] = [DVec3::ZERO; 2];
            for (channel, name) in ["red", "green", "blue"].into_iter().enumerate() {
                let [a, b, c, d, product] = self.after(name)[..] else {
                    panic!("{:#?}", self.lines);
                };
                strength[channel] = product;
                term[channel] = product;
                self.assert_levels(DVec3::splat(product), DVec3::splat(a * b * c * d));
                if light.kind != LightKind::Ambient {
                    let [by, product] = self.after("x")[..] else {
                        panic!("{:#?}", self.lines);
                    };
                    assert_eq!(by, factor);
                    term[channel] = product;
                    self.assert_levels(DVec3::splat(product), DVec3::splat(strength[channel] * by));
                }
            }
            strengths.push(strength);
            terms.push(term);
        }
        self.after("Phong");
        for (light, term) in surface.lights().iter().zip(&terms) {
            assert_eq!(self.vector(&light.name), *term);
        }
        let phong = self.sum(&terms);
        self.after("Gouraud: each factor at the vertices,");
        let mut factors = Vec::new();
        for light in surface.lights() {
            let at_vertices = self.vector(&light.name);
            factors.push(self.after("factor =")[0]);
            let sum = at_vertices.dot(weights.into());
            self.assert_result(DVec3::splat(factors[factors.len() - 1]), DVec3::splat(sum));
        }
        terms.clear();
        for (index, light) in surface.lights().iter().enumerate() {
            let term = self.vector(&light.name);
            self.assert_levels(term, strengths[index] * factors[index]);
            terms.push(term);
        }
        [phong, self.sum(&terms)]
    }
}

#[test]
fn every_result_of_a_page_follows_from_its_numbers_and_is_exact() {
    let mut random = fastrand::Rng::with_seed(5);
    let (mut pixels, mut lit) = (0, 0);
    while pixels < 200 {
        let (name, text) = BUILT_IN[random.usize(..BUILT_IN.len())];
        let mut record = SceneRecord::of(&Scene::parse(name, text).expect("it is built in").world);
        for cuboid in &mut record.cuboid {
            cuboid.normals = [NormalMode::Corner, NormalMode::Face][random.usize(..2)];
            cuboid.segments = Segments::new([1, 1, 5][random.usize(..3)]).expect("a number");
        }
        let mut scene = Scene::spawn(name.to_owned(), &record);
        let view = View {
            projection: [Projection::Perspective, Projection::Orthographic][random.usize(..2)],
            ..View::of(&scene.world, [320, 240])
        };
        let pixel = [random.usize(..320), random.usize(..240)];
        let probe = probe::at(&mut scene, &view, pixel, Level::new()).expect("a row fits");
        let Some((surface, sample)) =
            (probe.surface.as_ref()).and_then(|surface| Some((surface, surface.sample.as_ref()?)))
        else {
            continue;
        };
        let sums = Page::of(&probe).check(surface);
        for (sum, exact) in sums.into_iter().zip([sample.phong, sample.gouraud]) {
            let error = (sum - exact).abs() / exact.abs().max(DVec3::ONE);
            assert!(
                error.max_element() < 1e-3,
                "{sum} for {exact}: {pixel:?} of {name}"
            );
        }
        pixels += 1;
        let lights = sample.lights.iter();
        lit += usize::from(
            lights
                .clone()
                .any(|it| it.kind == LightKind::Specular && it.factor > 0.01),
        );
    }
    assert!(lit >= 3, "{lit} pixels of highlights");
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
