//! Sentences about a pixel: the cause of the difference between interpolation and exact Phong, and the cost.

use super::{DrawnPixel, ProbedSurface};
use crate::components::{LightKind, ShadingMode};
use crate::report::words::short;
use crate::shading::TileKind;
use crate::trade::metrics::displayed;

/// Levels that differ by less than this agree: no eye tells them apart.
const AGREE: f64 = 1.0;
/// A vertex lies outside a highlight if its factor is less than this share of the pixel's.
const OUTSIDE: f64 = 0.1;

impl ProbedSurface {
    /// The cause of the difference between interpolation and exact Phong in a channel, and its evidence. The interpolation
    /// is that of the picture, or Gouraud's if the picture is Phong's. `None` if the reference sees another face.
    pub fn cause(&self, channel: usize) -> Option<[String; 2]> {
        let exact = self.reference.phong?.levels[channel];
        if self.drawn.mode == ShadingMode::UnitVectors {
            let drawn = self.drawn.levels[channel];
            return Some([
                format!(
                    "Interpolated unit vectors are too short: {} instead of {}.",
                    level(drawn),
                    level(exact)
                ),
                format!(
                    "n has length {:.2} here, so n.l and o.r are no cosines.",
                    self.normal_length
                ),
            ]);
        }
        let interpolated = self.reference.gouraud?.levels[channel];
        let difference = |index: &usize| {
            let light = &self.lights[*index];
            (light.gouraud[channel] - light.phong[channel]).abs()
        };
        let lights = 0..self.lights.len();
        let most = lights.max_by(|one, other| difference(one).total_cmp(&difference(other)));
        let Some(light) = most.map(|index| &self.lights[index]) else {
            return Some(["No light is on.".to_owned(), String::new()]);
        };
        let factor = match light.kind {
            LightKind::Ambient => "1".to_owned(),
            LightKind::Diffuse => "n.l".to_owned(),
            LightKind::Specular => format!("(o.r)^{}", self.shininess),
        };
        let [a, b, c] = light.at_corners.map(|it| format!("{it:.2}"));
        let evidence = format!(
            "{factor} of {} is {a}, {b} and {c} at the vertices, and {:.2} here.",
            light.name, light.factor
        );
        let error = (displayed(interpolated) - displayed(exact)).abs();
        if error < AGREE {
            let cause = if (interpolated - exact).abs() < AGREE {
                "Light changes nearly linearly here"
            } else {
                "Both are beyond the levels of the display"
            };
            let agreement = format!("{cause}: Gouraud and Phong agree within {}.", level(error));
            return Some([agreement, evidence]);
        }
        let name = &light.name;
        let [here, most] = [
            light.factor,
            light.at_corners.into_iter().fold(0.0, f64::max),
        ];
        let numbers = [light.gouraud, light.phong].map(|term| level(term[channel]));
        let is_less = light.gouraud[channel] < light.phong[channel];
        let cause = match light.kind {
            LightKind::Specular if is_less && most < OUTSIDE * here => {
                format!(
                    "No vertex lies in the highlight of {name}, so interpolation cannot find it"
                )
            }
            LightKind::Specular if is_less => {
                format!("The highlight of {name} rises over a straight line between the vertices")
            }
            LightKind::Specular => {
                format!(
                    "A vertex is nearer to the highlight of {name}, which interpolation spreads"
                )
            }
            _ if is_less && here > most => {
                format!("The surface faces {name} more here than at any vertex")
            }
            _ if light.at_corners.contains(&0.0) => {
                format!(
                    "{name} is behind a vertex, where n.l ends at 0; a straight line begins there"
                )
            }
            _ if is_less => {
                format!("n.l of {name} rises over a straight line between the vertices")
            }
            _ => format!("n.l of {name} falls below a straight line between the vertices"),
        };
        let sentence = format!("{cause}: {}.", numbers.join(" instead of "));
        Some([sentence, evidence])
    }
}

impl DrawnPixel {
    /// The evaluations of the model in the square of the pixel, compared with one at every pixel.
    pub fn cost(&self) -> String {
        let (pixels, within) = (self.pixels, self.tolerance);
        let is_evaluated = matches!(self.kind, TileKind::Exact | TileKind::Double);
        match self.mode {
            ShadingMode::Gouraud if is_evaluated => {
                "No evaluation of the model: the levels of three vertices, interpolated at every pixel.".to_owned()
            }
            ShadingMode::Gouraud => format!(
                "No evaluation of the model: its square of {pixels} pixels has a {} colour between the levels of three \
                 vertices, within {within}.",
                self.kind.name()
            ),
            _ if is_evaluated => {
                format!("An evaluation of the model ({}), as at every pixel of its square.", self.kind.name())
            }
            _ => format!(
                "Nine evaluations of the model instead of {pixels}: its square of {pixels} pixels has a {} colour, \
                 certified within {within}.",
                self.kind.name()
            ),
        }
    }
}

/// A level, or a difference of levels, with few digits.
fn level(value: f64) -> String {
    match value.abs() {
        10.0.. => format!("{value:.0}"),
        _ => short(Some(value)),
    }
}
