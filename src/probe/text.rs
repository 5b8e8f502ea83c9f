//! The evaluation of a pixel as text, for the command line, the window and the clipboard, and as JSON.

use glam::DVec3;
use serde_json::{Map, Value, json};

use super::{Probe, ProbedSurface};
use crate::components::{LightKind, TRIANGLES};
use crate::frame::display_step;
use crate::reference::{LightSample, Sample};

/// Levels up to this are written as 0.
const NEGLIGIBLE: f64 = 1e-6;
/// Components of a vector up to this share of the largest are written as 0: they are rounding errors.
const ROUNDING: f64 = 1e-12;

/// The levels under one mode.
type Levels<T> = fn(&T) -> DVec3;

impl ProbedSurface {
    /// The number of the triangle, and the reference's number if it differs.
    pub fn triangle_label(&self) -> String {
        let own = self.triangle;
        match &self.sample {
            Some(sample) if sample.triangle != own => {
                format!("triangle {own} (reference: {})", sample.triangle)
            }
            _ => format!("triangle {own}"),
        }
    }
}

impl Probe {
    /// The evaluation as lines of text, at most 45 characters long if names are short.
    pub fn lines(&self) -> Vec<String> {
        let [x, y] = self.pixel;
        let Some(surface) = &self.surface else {
            return vec![format!("pixel {x},{y}: background")];
        };
        let (sample, lights) = (surface.sample.as_ref(), surface.lights());
        let [normal, to_eye] = [sample.map(|it| it.normal), sample.map(|it| it.to_eye)];
        let (object, triangle) = (&surface.object, surface.triangle_label());
        let mut lines = vec![
            format!("pixel {x},{y}: {object}, {triangle}"),
            format!("  position  {}", vector(sample.map(|it| it.position))),
            format!("  normal  n {}", vector(normal)),
            format!("  to eye  o {}", vector(to_eye)),
        ];
        for light in lights {
            if light.kind != LightKind::Ambient {
                lines.push(format!("  {} ({})", light.name, light.kind.name()));
                lines.push(format!("    to light  l {}", vector(light.to_light)));
                lines.push(format!("    reflected r {}", vector(light.reflected)));
            }
        }

        let mut row = |name: &str, cells: &str| lines.push(format!("  {name:<12} {cells:>29}"));
        let power = format!("n.l or (o.r)^{}", surface.shininess);
        row("factor", &power);
        row("", &joined(["n.l", "o.r", "factor"]));
        for light in lights {
            let is_specular = light.kind == LightKind::Specular;
            let factors = joined([
                cosine(normal, light.to_light),
                cosine(to_eye, light.reflected.filter(|_| is_specular)),
                format!("{:.5}", light.factor),
            ]);
            row(&light.name, &factors);
        }
        if let Some(sample) = sample {
            let decimals = |numbers: [f64; 3]| joined(numbers.map(|it| format!("{it:.5}")));
            row("factor at", &joined(vertices(sample)));
            row("weight", &decimals(sample.weights));
            for light in lights {
                row(&light.name, &decimals(light.vertex_factors));
            }
        }
        let channels = joined(["r", "g", "b"]);
        row("strength", &channels);
        for light in lights {
            row(&light.name, &levels(light.strength));
        }
        let modes: [(_, _, Levels<LightSample>, Levels<Sample>); 2] = [
            ("Gouraud", surface.gouraud, |it| it.gouraud, |it| it.gouraud),
            ("Phong", surface.phong, |it| it.phong, |it| it.phong),
        ];
        for (mode, drawn, term, exact) in modes {
            row(mode, &channels);
            for light in lights {
                row(&light.name, &levels(term(light)));
            }
            row("drawn", &levels(drawn));
            let exact = sample.map_or_else(|| joined(["-"; 3]), |it| levels(exact(it)));
            row("reference", &exact);
            row("bytes", &joined(bytes(drawn)));
        }
        lines
    }

    /// The evaluation as JSON. A quantity that does not exist or is not finite is null.
    pub fn json(&self) -> Value {
        let Some(surface) = &self.surface else {
            return json!({"pixel": self.pixel, "object": null});
        };
        let sample = surface.sample.as_ref();
        let shaded = |levels: DVec3, term: Levels<LightSample>| {
            let terms = surface.lights().iter();
            let terms = terms.map(|light| (light.name.clone(), json!(term(light))));
            json!({
                "levels": levels,
                "terms": terms.collect::<Map<_, _>>(),
                "bytes": bytes(levels),
            })
        };
        json!({
            "pixel": self.pixel,
            "object": surface.object,
            "triangle": surface.triangle,
            "position": sample.map(|it| it.position),
            "normal": sample.map(|it| it.normal),
            "to_eye": sample.map(|it| it.to_eye),
            "lights": surface.lights(),
            "gouraud": shaded(surface.gouraud, |light| light.gouraud),
            "phong": shaded(surface.phong, |light| light.phong),
            "reference": {
                "triangle": sample.map(|it| it.triangle),
                "gouraud": sample.map(|it| json!({"levels": it.gouraud})),
                "phong": sample.map(|it| json!({"levels": it.phong})),
            },
        })
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

/// The levels after the display step.
fn bytes(levels: DVec3) -> [u8; 3] {
    levels.to_array().map(display_step)
}

/// Three cells of a row.
fn joined<T: ToString>(cells: [T; 3]) -> String {
    cells
        .map(|cell| format!("{:>9}", cell.to_string()))
        .join(" ")
}

fn cosine(one: Option<DVec3>, other: Option<DVec3>) -> String {
    let cosine = one.zip(other).map(|(one, other)| one.dot(other));
    cosine.map_or_else(|| "-".to_owned(), |it| format!("{it:.5}"))
}

fn vector(vector: Option<DVec3>) -> String {
    let cells = |it: DVec3| numbers(it, ROUNDING * it.abs().max_element());
    vector.map_or_else(|| "-".to_owned(), cells)
}

fn levels(levels: DVec3) -> String {
    numbers(levels, NEGLIGIBLE)
}

/// Three decimals for 0.001 to 10000, else scientific notation, nine characters at most; 0 for magnitudes up to
/// `negligible`.
fn numbers(values: DVec3, negligible: f64) -> String {
    joined(values.to_array().map(|value| match value.abs() {
        size if size <= negligible => "0".to_owned(),
        1e-3..1e4 => format!("{value:.3}"),
        _ => format!("{value:.1e}"),
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_errors_of_a_vector_are_written_as_zero() {
        for (numbers, expected) in [
            ([-1.0, 1e-17, -1e-17], ["-1.000", "0", "0"]),
            ([-1e-17, 1e-17, 2e-17], ["-1.0e-17", "1.0e-17", "2.0e-17"]),
            ([0.0; 3], ["0"; 3]),
        ] {
            let text = vector(Some(DVec3::from(numbers)));
            let cells: Vec<&str> = text.split_whitespace().collect();
            assert_eq!(cells, expected);
        }
    }
}
