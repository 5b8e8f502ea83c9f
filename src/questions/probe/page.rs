//! A pixel worked out as on a page of a textbook. Each number is that of the exact evaluation, rounded once.
//!
//! ```text
//! vertices, weights --> P, n, o --> each light: l, n.l, r, o.r --> factor x strength = term --> sum --> bytes
//! ```
//! A value has one number on the page: sums are those of unrounded terms. The renderer's levels differ from the exact ones
//! by the tolerance, and say so.

use std::fmt::Display;

use glam::DVec3;

use super::{Probe, ProbedSurface, Source, bytes};
use crate::components::{LightKind, ShadingMode, TRIANGLES};
use crate::output::one_line;
use crate::output::words::CHANNELS;
use crate::reference::{LightSample, Sample};
use crate::shading::limit;

/// The significant digits of vectors and factors. A power multiplies their relative error by the exponent.
const DIGITS: usize = 9;
/// The significant digits of a level below 1 and of a very large one.
const OF_LEVEL: usize = 6;
/// Components of a vector up to this share of the largest are printed as 0: they are rounding errors.
const ROUNDING: f64 = 1e-12;
/// The width of the label before three numbers, and of each number.
const LABEL: usize = 9;
const CELL: usize = 13;

impl Probe {
    /// The evaluation as lines of text, 51 letters long if names are short.
    pub fn lines(&self) -> Vec<String> {
        let [x, y] = self.pixel;
        let Some(surface) = &self.surface else {
            return vec![format!("pixel {x},{y}: background")];
        };
        let (object, triangle) = (one_line(&surface.object), surface.triangle);
        let heading = format!("pixel {x},{y}: {object}, triangle {triangle}");
        let mut page = Page(vec![heading]);
        if let Some(sample) = &surface.sample {
            page.work_out(surface, sample);
        } else {
            page.begin("The reference sees another face, at an edge.");
        }
        let limit = limit(surface.tolerance);
        let drawn = [("Phong", surface.phong), ("Gouraud", surface.gouraud)];
        for (mode, levels) in drawn {
            page.begin(&format!("{mode} as the renderer draws it, within {limit}"));
            page.result_levels("levels", levels);
        }
        if surface.mode == ShadingMode::Flat {
            page.begin("Flat: one colour for the whole face");
            page.result_levels("levels", surface.drawn.into());
        }
        page.0
    }
}

/// Lines of text.
struct Page(Vec<String>);

impl Page {
    /// Works out the exact levels under Phong, Blinn-Phong and Gouraud.
    fn work_out(&mut self, surface: &ProbedSurface, sample: &Sample) {
        self.vectors(surface, sample);
        for (source, light) in surface.sources.iter().zip(&sample.lights) {
            self.begin(&format!(
                "{}: {}",
                one_line(&source.name),
                source.light.kind.name()
            ));
            self.factor(source, light, surface.material.shininess, sample);
            self.strength(surface, source, light);
        }
        self.begin("Phong, exact");
        self.sum(sample, |light| light.phong, sample.phong);
        self.begin("Blinn-Phong, exact: n.h in place of o.r,");
        self.say("with four times the shininess");
        self.sum(sample, |light| light.blinn_phong, sample.blinn_phong);
        self.begin("Gouraud, exact: each factor at the vertices,");
        self.say("and the sum of weight x factor");
        self.cells("", vertices(sample));
        for light in &sample.lights {
            self.numbers(&one_line(&light.name), light.vertex_factors.into());
            let factor = DVec3::from(light.vertex_factors).dot(sample.weights.into());
            self.result("factor", factor);
        }
        self.sum(sample, |light| light.gouraud, sample.gouraud);
    }

    /// The term of each light, and their sum.
    fn sum(&mut self, sample: &Sample, term: impl Fn(&LightSample) -> DVec3, sum: DVec3) {
        self.cells("", CHANNELS);
        for light in &sample.lights {
            self.levels(&one_line(&light.name), term(light));
        }
        self.result_levels("sum", sum);
    }

    /// The weights of the vertices; P, n and o.
    fn vectors(&mut self, surface: &ProbedSurface, sample: &Sample) {
        self.begin("vertices: P and N of each");
        for (name, [point, normal]) in vertices(sample).iter().zip(surface.vertices) {
            self.vector(&format!("{name} P"), point);
            self.vector(&format!("{name} N"), normal);
        }
        self.numbers("weights", sample.weights.into());
        self.begin("P = sum of weight x P");
        self.vector("P", sample.position);
        self.say("n = sum of weight x N, to length 1");
        self.vector("n", sample.normal);
        if let Some(eye) = surface.eye {
            self.say("o = eye O - P, to length 1");
            self.vector("O", eye);
        } else {
            self.say("o: against the view direction");
        }
        self.vector("o", sample.to_eye);
    }

    /// The factor of a light's strength: 1, max(0, n.l), or max(0, o.r)^rho where n.l > 0.
    fn factor(&mut self, source: &Source, light: &LightSample, shininess: f64, sample: &Sample) {
        // An ambient light, and one at P, have no direction.
        let (Some(l), Some(r)) = (light.to_light, light.reflected) else {
            return;
        };
        self.vector("L", source.place);
        self.say("l = L - P, to length 1");
        self.vector("l", l);
        let cosine = sample.normal.dot(l);
        self.result("n.l", cosine);
        if source.light.kind == LightKind::Specular && cosine > 0.0 {
            self.say("r = 2 (n.l) n - l");
            self.vector("r", r);
            self.result("o.r", sample.to_eye.dot(r));
            self.result(&format!("max(0, o.r)^{shininess}"), light.factor);
            if let (Some(h), Some(factor)) = (light.half_vector, light.half_vector_factor) {
                self.say("Blinn-Phong: h = l + o, to length 1");
                self.vector("h", h);
                self.result("n.h", sample.normal.dot(h));
                self.result(&format!("max(0, n.h)^{}", 4.0 * shininess), factor);
            }
        }
    }

    /// The strength of a light by channel, and its term.
    fn strength(&mut self, surface: &ProbedSurface, source: &Source, sample: &LightSample) {
        let (light, material) = (&source.light, &surface.material);
        let (name, coefficient) = match light.kind {
            LightKind::Ambient => ("kA", material.ambient),
            LightKind::Diffuse => ("kD", material.diffuse),
            LightKind::Specular => ("kE", material.specular),
        };
        self.say(&format!("{name} x color x intensity x gain"));
        for channel in 0..3 {
            let factors = [
                coefficient[channel],
                light.color[channel],
                light.intensity,
                light.gain,
            ];
            let product = factors.map(text).join(" x ");
            let label = format!("{:<6} {product}", CHANNELS[channel]);
            self.equation(&label, &level_text(sample.strength[channel]));
            if light.kind != LightKind::Ambient {
                let label = format!("       x {}", text(sample.factor));
                self.equation(&label, &level_text(sample.phong[channel]));
            }
        }
    }

    /// Levels, and the bytes that are shown of them.
    fn result_levels(&mut self, label: &str, levels: DVec3) {
        self.levels(label, levels);
        self.cells("bytes", bytes(levels));
        if levels.max_element() > 255.0 {
            self.say("clamped: a level above 255 is shown as 255");
        }
    }

    /// A part of the page.
    fn begin(&mut self, heading: &str) {
        self.0.extend([String::new(), heading.to_owned()]);
    }

    fn say(&mut self, text: &str) {
        self.0.push(format!("  {text}"));
    }

    fn cells<T: Display>(&mut self, label: &str, cells: [T; 3]) {
        let cells = cells.map(|cell| format!(" {:>CELL$}", cell.to_string()));
        self.0.push(format!("{label:<LABEL$}{}", cells.concat()));
    }

    fn numbers(&mut self, label: &str, values: DVec3) {
        self.cells(label, values.to_array().map(text));
    }

    /// A vector without the rounding errors of its small components.
    fn vector(&mut self, label: &str, vector: DVec3) {
        let least = ROUNDING * vector.abs().max_element();
        let is_exact = vector.abs().cmpgt(DVec3::splat(least));
        self.numbers(label, DVec3::select(is_exact, vector, DVec3::ZERO));
    }

    fn levels(&mut self, label: &str, levels: DVec3) {
        self.cells(label, levels.to_array().map(level_text));
    }

    /// A line with one result at its end.
    fn result(&mut self, label: &str, value: f64) {
        self.equation(label, &text(value));
    }

    fn equation(&mut self, label: &str, result: &str) {
        let width = (LABEL + 3 * (CELL + 1)).saturating_sub(result.len());
        let label = format!("  {label} =");
        self.0.push(format!("{label:<width$}{result}"));
    }
}

fn text(value: f64) -> String {
    significant(value, DIGITS)
}

/// A level with three decimals; one below 1, and a large one, with significant digits.
fn level_text(level: f64) -> String {
    match level.abs() {
        1.0..1e4 => format!("{level:.3}"),
        _ => significant(level, OF_LEVEL),
    }
}

/// A number with this many significant digits, without zeros at its end.
fn significant(value: f64, digits: usize) -> String {
    let scientific = format!("{value:.*e}", digits - 1);
    let rounded: f64 = scientific.parse().unwrap_or(value);
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
        let mut page = Page(Vec::new());
        page.vector("n", DVec3::new(-1.0, 1e-17, 0.5));
        let words: Vec<&str> = page.0[0].split_whitespace().collect();
        assert_eq!(words, ["n", "-1", "0", "0.5"]);
    }

    #[test]
    fn a_level_has_its_digits_however_small_it_is() {
        for (level, text) in [
            (0.0, "0"),
            (0.292_210_49, "0.29221"),
            (4.5e-7, "4.5e-7"),
            (211.298_49, "211.298"),
            (12_345.67, "12345.7"),
        ] {
            assert_eq!(level_text(level), text);
        }
    }
}
