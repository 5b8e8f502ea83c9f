//! Sentences about a pixel: the cause of the difference between interpolation and exact Phong, and the cost.

use super::ProbedSurface;
use crate::components::{LightKind, ShadingMode};
use crate::output::words::{CHANNELS, short};
use crate::questions::metrics::displayed;
use crate::reference::{LightSample, Sample};
use crate::shading::SquareKind;

/// Levels that differ by less than this agree: no eye tells them apart.
const AGREE: f64 = 1.0;
/// A vertex lies outside a highlight if its factor is less than this share of the pixel's.
const OUTSIDE: f64 = 0.1;
/// Less than this of a specular light is no highlight.
const DARK: f64 = 1e-3;

impl ProbedSurface {
    /// The channel in which a shortcut and exact Phong differ most, and their difference in displayed levels. The
    /// shortcut is the picture's if it is flat or by the reference, else Gouraud's. `None` if the reference sees another face.
    pub fn error(&self) -> Option<(usize, f64)> {
        let sample = self.sample.as_ref()?;
        let shortcut = match self.mode {
            ShadingMode::Flat | ShadingMode::UnitVectors | ShadingMode::BlinnPhong => self.drawn,
            _ => sample.gouraud.to_array(),
        };
        let phong = sample.phong.to_array().map(displayed);
        let error = |channel: usize| (displayed(shortcut[channel]) - phong[channel]).abs();
        let errors = [2, 1, 0].map(|channel| (channel, error(channel)));
        // The first of equal ones.
        errors
            .into_iter()
            .max_by(|one, other| one.1.total_cmp(&other.1))
    }

    /// The light whose term interpolation misses most in a channel; `None` if no diffuse or specular light is on.
    fn missed(&self, channel: usize) -> Option<&LightSample> {
        let difference =
            |light: &LightSample| (light.gouraud[channel] - light.phong[channel]).abs();
        let all = self.lights().iter();
        let lights = all.filter(|light| light.kind != LightKind::Ambient);
        lights.max_by(|one, other| difference(one).total_cmp(&difference(other)))
    }

    /// The factors at the vertices of which [`Self::cause`] speaks.
    pub fn vertex_factors(&self) -> Option<[f64; 3]> {
        if !matches!(self.mode, ShadingMode::Gouraud | ShadingMode::Phong) {
            return None;
        }
        let (channel, _) = self.error()?;
        Some(self.missed(channel)?.vertex_factors)
    }

    /// Why a face with one normal has no highlight, if it has none.
    fn dull(&self) -> Option<String> {
        let sample = self.sample.as_ref()?;
        let [one, others @ ..] = self.vertices.map(|[_, normal]| normal);
        let is_dull = |it: &&LightSample| it.kind == LightKind::Specular && it.factor < DARK;
        let light = sample.lights.iter().find(is_dull)?;
        let toward = light.reflected?.dot(sample.to_eye);
        others.iter().all(|it| *it == one).then(|| {
            let name = &light.name;
            format!(
                "Sharp edges: the whole face has one normal, and mirrors light {name} past the eye (o.r is {toward:.2} here). \
                 So it has no highlight."
            )
        })
    }

    /// The cause if the picture is flat or by the reference, and its evidence.
    fn cause_of_shortcut(&self, sample: &Sample, channel: usize) -> Option<[String; 2]> {
        let [drawn, exact] = [self.drawn[channel], sample.phong[channel]].map(level);
        let instead = format!("{drawn} instead of {exact} in {}.", CHANNELS[channel]);
        let (cause, evidence) = match self.mode {
            ShadingMode::Gouraud | ShadingMode::Phong => return None,
            ShadingMode::Flat => (
                "Flat shading has one colour for the whole face:",
                "The model is evaluated at its middle.".to_owned(),
            ),
            ShadingMode::BlinnPhong => (
                "Blinn-Phong shows",
                "Its highlight goes with n.h in place of o.r.".to_owned(),
            ),
            ShadingMode::UnitVectors => {
                // Face normals keep their length; l and o do not.
                let shorter = match sample.normal_length {
                    length @ ..0.995 => format!("n has length {length:.2} here"),
                    _ => "l and o are shorter than 1 here".to_owned(),
                };
                (
                    "Interpolated unit vectors are too short:",
                    format!("{shorter}, so n.l and o.r are no cosines."),
                )
            }
        };
        Some([format!("{cause} {instead}"), evidence])
    }

    /// The cause of that difference, and its evidence.
    pub fn cause(&self) -> Option<[String; 2]> {
        let sample = self.sample.as_ref()?;
        let (channel, error) = self.error()?;
        let color = CHANNELS[channel];
        if let Some(cause) = self.cause_of_shortcut(sample, channel) {
            return Some(cause);
        }
        let Some(light) = self.missed(channel) else {
            let cause = "No diffuse or specular light is on: Gouraud and Phong agree.";
            return Some([cause.to_owned(), String::new()]);
        };
        let (name, here) = (format!("light {}", light.name), light.factor);
        let factor = match light.kind {
            LightKind::Specular => format!("(o.r)^{}", self.material.shininess),
            _ => "n.l".to_owned(),
        };
        let [a, b, c] = light.vertex_factors;
        let evidence = format!(
            "{factor} of {name} is {a:.2}, {b:.2} and {c:.2} at the vertices, and {here:.2} here."
        );
        if error < AGREE {
            let cause = if (sample.gouraud - sample.phong).abs().max_element() < AGREE {
                "Light changes nearly linearly here"
            } else {
                "Both are beyond the levels of the display"
            };
            let agreement = format!("{cause}: Gouraud and Phong agree within {}.", level(error));
            let dull = self.dull().map(|it| it + " ").unwrap_or_default();
            return Some([agreement, dull + &evidence]);
        }
        let is_less = light.gouraud[channel] < light.phong[channel];
        let is_specular = light.kind == LightKind::Specular;
        let most = a.max(b).max(c);
        let cause = if is_specular && is_less && most < OUTSIDE * here {
            format!("No vertex lies in the highlight of {name}, so interpolation cannot find it")
        } else if !is_specular && is_less && here > most {
            format!("The surface faces {name} more here than at any vertex")
        } else if !is_specular && light.vertex_factors.contains(&0.0) {
            format!("A vertex faces away from {name}: n.l is negative there and counts as 0")
        } else {
            let course = if is_less { "above" } else { "below" };
            format!("{factor} of {name} lies {course} a straight line between the vertices")
        };
        let [gouraud, phong] = [light.gouraud, light.phong].map(|term| level(term[channel]));
        let cause =
            format!("{cause}. The light adds {gouraud} levels of {color} instead of {phong}.");
        Some([cause, evidence])
    }

    /// The evaluations of the model in the square of the pixel.
    pub fn cost(&self) -> String {
        let (kind, within) = (self.kind.name(), self.tolerance);
        match (self.mode, self.kind) {
            (ShadingMode::Flat, _) => "The model is evaluated once a face.".to_owned(),
            (ShadingMode::Gouraud, SquareKind::PerPixel | SquareKind::InF64) => {
                "The model is not evaluated here: the levels of three vertices are interpolated at every pixel."
                    .to_owned()
            }
            (ShadingMode::Gouraud, _) => format!(
                "The model is not evaluated here: Gouraud interpolates the levels of three vertices. In the square around \
                 this pixel a polynomial ({kind}) stands for that, proven within {within}."
            ),
            (_, SquareKind::PerPixel) => {
                "The model is evaluated here, as at every pixel of the square.".to_owned()
            }
            (_, SquareKind::InF64) => {
                "The model is evaluated here in f64, as at every pixel of the square.".to_owned()
            }
            _ => format!(
                "The model is evaluated at nine places of the square around this pixel. A polynomial through them ({kind}) \
                 is proven within {within}."
            ),
        }
    }
}

/// A level, or a difference of levels, with few digits.
fn level(value: f64) -> String {
    match value {
        10.0.. => format!("{value:.0}"),
        _ => short(value),
    }
}
