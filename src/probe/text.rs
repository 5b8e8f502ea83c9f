//! The evaluation of a pixel as text, for the command line, the window and the clipboard.

use glam::DVec3;

use super::{Probe, ProbedSurface, ReferenceLevels};
use crate::components::LightKind;

/// Levels up to this are written as 0.
const NEGLIGIBLE: f64 = 1e-6;
/// Components of a vector up to this share of the largest are written as 0: they are rounding errors.
const ROUNDING: f64 = 1e-12;

impl ProbedSurface {
    /// The number of the triangle, and that of the reference if it differs.
    pub fn triangle_label(&self) -> String {
        let own = self.triangle;
        match self.reference.triangle {
            Some(other) if other != own => format!("triangle {own} (reference: {other})"),
            _ => format!("triangle {own}"),
        }
    }
}

impl Probe {
    /// The evaluation as lines of text, at most 78 characters long if names are short.
    pub fn lines(&self) -> Vec<String> {
        let [x, y] = self.pixel;
        let (Some(object), Some(surface)) = (&self.object, &self.surface) else {
            return vec![format!("pixel {x},{y}: background")];
        };
        let mut lines = vec![
            format!("pixel {x},{y}: {object}, {}", surface.triangle_label()),
            format!("  position  {}", vector(surface.position)),
            format!("  normal  n {}", vector(surface.normal)),
            format!("  to eye  o {}", vector(surface.to_eye)),
        ];
        for light in &surface.lights {
            if light.kind != LightKind::Ambient {
                lines.push(format!("  {} ({})", light.name, light.kind.name()));
                lines.push(format!("    to light  l {}", vector(light.to_light)));
                lines.push(format!("    reflected r {}", vector(light.reflected)));
            }
        }

        let heading =
            |name: &str, left: &str, right: &str| format!("  {name:<12} {left:>29}  {right:>29}");
        let row = |name: &str, cells: [[String; 3]; 2]| {
            let [left, right] = cells.map(joined);
            heading(name, &left, &right)
        };
        let factor = format!("n.l or (o.r)^{}", surface.shininess);
        lines.push(heading("exact Phong", &factor, "times strength"));
        let heads = [["n.l", "o.r", "factor"], ["r", "g", "b"]];
        lines.push(row("", heads.map(|cells| cells.map(str::to_owned))));
        for light in &surface.lights {
            let is_specular = light.kind == LightKind::Specular;
            let factors = [
                cosine(surface.normal, light.to_light),
                cosine(surface.to_eye, light.reflected.filter(|_| is_specular)),
                format!("{:.5}", light.factor),
            ];
            lines.push(row(
                &light.name,
                [factors, levels(light.strength.to_array())],
            ));
        }

        let modes = [&surface.gouraud, &surface.phong];
        lines.push(heading("levels", "Gouraud", "Phong"));
        for (index, light) in surface.lights.iter().enumerate() {
            lines.push(row(
                &light.name,
                modes.map(|mode| levels(mode.terms[index].1)),
            ));
        }
        let exact = |it: Option<ReferenceLevels>| it.map_or_else(nothing, |it| levels(it.levels));
        let references = [surface.reference.gouraud, surface.reference.phong];
        lines.push(row("drawn", modes.map(|mode| levels(mode.levels))));
        lines.push(row("reference", references.map(exact)));
        let bytes = modes.map(|mode| mode.bytes.map(|byte| byte.to_string()));
        lines.push(row("bytes", bytes));
        lines
    }
}

fn joined(cells: [String; 3]) -> String {
    cells.map(|cell| format!("{cell:>9}")).join(" ")
}

fn cosine(one: Option<DVec3>, other: Option<DVec3>) -> String {
    let cosine = one.zip(other).map(|(one, other)| one.dot(other));
    cosine.map_or_else(|| "-".to_owned(), |it| format!("{it:.5}"))
}

fn vector(vector: Option<DVec3>) -> String {
    let cells = |it: DVec3| numbers(it.to_array(), ROUNDING * it.abs().max_element());
    vector.map_or_else(|| "-".to_owned(), |it| joined(cells(it)))
}

fn levels(levels: [f64; 3]) -> [String; 3] {
    numbers(levels, NEGLIGIBLE)
}

/// The cells of a quantity that does not exist.
fn nothing() -> [String; 3] {
    ["-"; 3].map(str::to_owned)
}

/// Three decimals for 0.001 to 10000, else scientific notation, nine characters at most; 0 for magnitudes up to
/// `negligible`.
fn numbers(values: [f64; 3], negligible: f64) -> [String; 3] {
    values.map(|value| match value.abs() {
        size if size <= negligible => "0".to_owned(),
        1e-3..1e4 => format!("{value:.3}"),
        _ => format!("{value:.1e}"),
    })
}
