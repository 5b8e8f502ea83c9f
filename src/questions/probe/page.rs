//! A pixel worked out as on a page of a textbook: each result follows from the numbers printed above it, to its last digit.
//!
//! ```text
//! vertices, weights --> P, n, o --> each light: l, n.l, r, o.r --> factor x strength = term --> sum --> bytes
//! ```
//! Numbers have as many digits as the levels need.

use std::fmt::Display;
use std::ops::RangeInclusive;

use glam::DVec3;

use super::json::bytes;
use super::{Probe, ProbedSurface, Source};
use crate::components::{LightKind, ShadingMode, TRIANGLES};
use crate::output::words::CHANNELS;
use crate::reference::Sample;

/// The significant digits of a number.
const DIGITS: RangeInclusive<usize> = 6..=13;
/// The digits are enough if the sums are this near to the exact levels: in levels, or as a share of more than one level.
const NEAR: f64 = 4e-4;
/// Components of a vector up to this share of the largest are printed as 0: they are rounding errors.
const ROUNDING: f64 = 1e-12;
/// The width of the label before three numbers.
const LABEL: usize = 9;

impl Probe {
    /// The evaluation as lines of text, at most 45 letters long if names are short and few digits suffice.
    pub fn lines(&self) -> Vec<String> {
        let [x, y] = self.pixel;
        let Some(surface) = &self.surface else {
            return vec![format!("pixel {x},{y}: background")];
        };
        let mut page = Page::new(*DIGITS.start());
        if let Some(sample) = &surface.sample {
            for digits in DIGITS {
                page = Page::new(digits);
                let sums = page.work_out(surface, sample);
                let near = |(sum, exact): (DVec3, DVec3)| {
                    let error = (sum - exact).abs() / exact.abs().max(DVec3::ONE);
                    error.max_element() <= NEAR
                };
                if sums
                    .into_iter()
                    .zip([sample.phong, sample.gouraud])
                    .all(near)
                {
                    break;
                }
            }
        } else {
            page.begin("The reference sees another face, at an edge.");
        }
        let mut drawn = vec![
            ("Phong as the renderer draws it", surface.phong),
            ("Gouraud as the renderer draws it", surface.gouraud),
        ];
        if surface.mode == ShadingMode::Flat {
            drawn.push(("Flat: one colour for the whole face", surface.drawn.into()));
        }
        for (heading, levels) in drawn {
            page.begin(heading);
            page.levels("levels", levels);
            page.cells("bytes", bytes(levels));
        }
        let (object, triangle) = (&surface.object, surface.triangle_label());
        page.lines
            .insert(0, format!("pixel {x},{y}: {object}, {triangle}"));
        page.lines
    }
}

/// Lines of text. A method that prints numbers returns them as they are printed.
struct Page {
    digits: usize,
    lines: Vec<String>,
}

impl Page {
    fn new(digits: usize) -> Self {
        let lines = Vec::new();
        Page { digits, lines }
    }

    /// Works out the exact levels under Phong and under Gouraud.
    fn work_out(&mut self, surface: &ProbedSurface, sample: &Sample) -> [DVec3; 2] {
        let (weights, vectors) = self.vectors(surface, sample);
        let mut terms = Vec::new();
        for source in &surface.sources {
            self.begin(&format!("{}: {}", source.name, source.light.kind.name()));
            let factor = self.factor(source, surface.material.shininess, vectors);
            let [strength, term] = self.strength(surface, source, factor);
            terms.push((source, strength, term));
        }
        self.begin("Phong");
        self.cells("", CHANNELS);
        for (source, _, term) in &terms {
            self.levels(&source.name, *term);
        }
        let phong = self.sum(terms.iter().map(|(_, _, term)| *term).sum());
        self.begin("Gouraud: each factor at the vertices,");
        self.say("and the sum of weight x factor");
        self.cells("", vertices(sample));
        let mut sum = DVec3::ZERO;
        let mut rows = Vec::new();
        for ((source, strength, _), light) in terms.iter().zip(&sample.lights) {
            let factors = self.numbers(&source.name, light.vertex_factors.into());
            let factor = self.result("factor", weights.dot(factors));
            rows.push((&source.name, *strength * factor));
        }
        self.cells("", CHANNELS);
        for (name, term) in rows {
            sum += self.levels(name, term);
        }
        [phong, self.sum(sum)]
    }

    /// The weights of the vertices; P, n and o.
    fn vectors(&mut self, surface: &ProbedSurface, sample: &Sample) -> (DVec3, [DVec3; 3]) {
        self.begin("vertices: P and N of each");
        let mut corners = Vec::new();
        for (name, corner) in vertices(sample).iter().zip(surface.vertices) {
            let point = self.vector(&format!("{name} P"), corner[0]);
            corners.push([point, self.vector(&format!("{name} N"), corner[1])]);
        }
        let weights = self.numbers("weights", sample.weights.into());
        let blend = |of: usize| -> DVec3 {
            let parts = corners.iter().zip(weights.to_array());
            parts.map(|(corner, weight)| corner[of] * weight).sum()
        };
        self.begin("P = sum of weight x P");
        let point = self.vector("P", blend(0));
        self.say("n = sum of weight x N, to length 1");
        let normal = self.vector("n", blend(1).normalize_or_zero());
        let to_eye = if let Some(eye) = surface.eye {
            self.say("o = eye O - P, to length 1");
            (self.vector("O", eye) - point).normalize_or_zero()
        } else {
            self.say("o: against the view direction");
            sample.to_eye
        };
        let to_eye = self.vector("o", to_eye);
        (weights, [point, normal, to_eye])
    }

    /// The factor of a light's strength: 1, max(0, n.l), or max(0, o.r)^rho where n.l > 0.
    fn factor(&mut self, source: &Source, shininess: f64, [point, n, o]: [DVec3; 3]) -> f64 {
        let kind = source.light.kind;
        if kind == LightKind::Ambient {
            return 1.0;
        }
        let place = self.vector("L", source.place);
        self.say("l = L - P, to length 1");
        let l = self.vector("l", (place - point).normalize_or_zero());
        let cosine = self.result("n.l", n.dot(l));
        if kind == LightKind::Diffuse || cosine <= 0.0 {
            return cosine.max(0.0);
        }
        self.say("r = 2 (n.l) n - l");
        let r = self.vector("r", 2.0 * cosine * n - l);
        let cosine = self.result("o.r", o.dot(r)).max(0.0);
        self.result(&format!("(o.r)^{shininess}"), cosine.powf(shininess))
    }

    /// The strength of a light by channel, and its term.
    fn strength(&mut self, surface: &ProbedSurface, source: &Source, factor: f64) -> [DVec3; 2] {
        let (light, material) = (&source.light, &surface.material);
        let (name, coefficient) = match light.kind {
            LightKind::Ambient => ("kA", material.ambient),
            LightKind::Diffuse => ("kD", material.diffuse),
            LightKind::Specular => ("kE", material.specular),
        };
        self.say(&format!("{name} x color x intensity x gain"));
        let [mut strength, mut term] = [DVec3::ZERO; 2];
        for channel in 0..3 {
            let factors = [
                coefficient[channel],
                light.color[channel],
                light.intensity,
                light.gain,
            ];
            let factors = factors.map(|it| self.rounded(it));
            let product = factors.map(|it| it.to_string()).join(" x ");
            let label = format!("{:<6} {product}", CHANNELS[channel]);
            strength[channel] = self.level(&label, factors.iter().product());
            term[channel] = strength[channel];
            if light.kind != LightKind::Ambient {
                let label = format!("       x {}", self.text(factor));
                term[channel] = self.level(&label, strength[channel] * factor);
            }
        }
        [strength, term]
    }

    /// The sum of terms, its clamped levels and their bytes.
    fn sum(&mut self, sum: DVec3) -> DVec3 {
        let sum = self.levels("sum", sum);
        self.cells("bytes", bytes(sum));
        sum
    }

    /// A part of the page.
    fn begin(&mut self, heading: &str) {
        self.lines.push(String::new());
        self.lines.push(heading.to_owned());
    }

    fn say(&mut self, text: &str) {
        self.lines.push(format!("  {text}"));
    }

    fn cells<T: Display>(&mut self, label: &str, cells: [T; 3]) {
        let width = self.digits + 5;
        let cells = cells.map(|cell| format!(" {:>width$}", cell.to_string()));
        self.lines
            .push(format!("{label:<LABEL$}{}", cells.concat()));
    }

    fn numbers(&mut self, label: &str, values: DVec3) -> DVec3 {
        self.cells(label, values.to_array().map(|value| self.text(value)));
        values.to_array().map(|value| self.rounded(value)).into()
    }

    /// A vector without the rounding errors of its small components.
    fn vector(&mut self, label: &str, vector: DVec3) -> DVec3 {
        let least = ROUNDING * vector.abs().max_element();
        self.numbers(
            label,
            DVec3::select(vector.abs().cmpgt(DVec3::splat(least)), vector, DVec3::ZERO),
        )
    }

    fn levels(&mut self, label: &str, levels: DVec3) -> DVec3 {
        self.cells(label, levels.to_array().map(level_text));
        levels
            .to_array()
            .map(|level| number(&level_text(level)))
            .into()
    }

    /// A line with one result at its end.
    fn result(&mut self, label: &str, value: f64) -> f64 {
        let result = self.text(value);
        self.equation(label, &result)
    }

    fn level(&mut self, label: &str, level: f64) -> f64 {
        self.equation(label, &level_text(level))
    }

    fn equation(&mut self, label: &str, result: &str) -> f64 {
        let width = LABEL + 3 * (self.digits + 6) - result.len();
        self.lines
            .push(format!("{:<width$}{result}", format!("  {label} =")));
        number(result)
    }

    fn text(&self, value: f64) -> String {
        significant(value, self.digits)
    }

    fn rounded(&self, value: f64) -> f64 {
        number(&self.text(value))
    }
}

/// The number that a text shows.
fn number(text: &str) -> f64 {
    text.parse().unwrap_or(f64::NAN)
}

/// A level with three decimals; a large one with six digits.
fn level_text(level: f64) -> String {
    match level.abs() {
        1e4.. => significant(level, 6),
        _ => format!("{level:.3}"),
    }
}

/// A number with this many significant digits, without zeros at its end.
fn significant(value: f64, digits: usize) -> String {
    let scientific = format!("{value:.*e}", digits - 1);
    let rounded = number(&scientific);
    match rounded.abs() {
        size if size == 0.0 || (1e-3..1e7).contains(&size) => rounded.to_string(),
        _ => format!("{rounded:e}"),
    }
}

/// The names of the vertices: the numbers of the corners, or the column and the row of the face's grid, from 0.
fn vertices(sample: &Sample) -> [String; 3] {
    if sample.segments == 1 {
        return TRIANGLES[sample.triangle].map(|corner| corner.to_string());
    }
    let axis = sample.triangle / 4;
    sample.vertices.map(|vertex| {
        let number = |along: usize| (vertex[along % 3] + 0.5) * sample.segments as f64;
        format!("{:.0},{:.0}", number(axis + 1), number(axis + 2))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_their_digits_and_rounding_errors_of_a_vector_are_zero() {
        for (value, text) in [
            (0.0, "0"),
            (-0.123_456_78, "-0.123457"),
            (127.5, "127.5"),
            (999_999.96, "1000000"),
            (1e7, "1e7"),
            (-1.234_567_8e-4, "-1.23457e-4"),
            (2.5e-17, "2.5e-17"),
        ] {
            assert_eq!(significant(value, 6), text);
        }
        let mut page = Page::new(6);
        let printed = page.vector("n", DVec3::new(-1.0, 1e-17, 0.5));
        assert_eq!(printed, DVec3::new(-1.0, 0.0, 0.5));
    }
}
