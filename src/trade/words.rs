//! What was measured in; numbers, names and clauses for people out.
//!
//! Rule: pure, no more digits than say something, and "-" for what does not exist.

use crate::components::ShadingMode;
use crate::shading::Method;

/// Three digits that matter, or fewer; "-" for what does not exist.
pub(crate) fn short(value: Option<f64>) -> String {
    match value {
        None => "-".to_owned(),
        Some(0.0) => "0".to_owned(),
        Some(value) if value < 0.001 => "<0.001".to_owned(),
        Some(value) if value < 1.0 => format!("{value:.3}"),
        Some(value) if value < 10.0 => format!("{value:.2}"),
        Some(value) if value < 100.0 => format!("{value:.1}"),
        Some(value) => format!("{value:.0}"),
    }
}

/// How many times `base` goes into `value`, in two digits that matter; `None` where it has no end.
pub(super) fn times(value: f64, base: f64) -> Option<String> {
    let ratio = value / base;
    let digits = if ratio < 1.1 { 2 } else { 1 };
    let rounded: f64 = format!("{ratio:.digits$e}").parse().ok()?;
    ratio.is_finite().then(|| rounded.to_string())
}

/// A method in words: "Phong within half a level".
pub fn method_name(method: Method) -> String {
    match (method.mode, method.tolerance) {
        (ShadingMode::UnitVectors, _) => "interpolated unit vectors".to_owned(),
        (ShadingMode::Gouraud, 0.0) => "exact Gouraud".to_owned(),
        // Its tolerance is against itself, and says nothing about its error against Phong.
        (ShadingMode::Gouraud, 0.5) => "Gouraud".to_owned(),
        (ShadingMode::Gouraud, levels) => format!("Gouraud ({levels} of its own)"),
        (ShadingMode::Phong, 0.0) => "exact Phong".to_owned(),
        (ShadingMode::Phong, 0.5) => "Phong within half a level".to_owned(),
        (ShadingMode::Phong, 1.0) => "Phong within 1 level".to_owned(),
        (ShadingMode::Phong, levels) => format!("Phong within {levels} levels"),
    }
}

/// The same text with a capital letter first.
pub(crate) fn capital(text: &str) -> String {
    let (first, rest) = text.split_at(text.chars().next().map_or(0, char::len_utf8));
    first.to_uppercase() + rest
}

/// A number with its noun, which an s makes a plural.
pub(crate) fn counted(number: usize, noun: &str) -> String {
    format!("{number} {noun}{}", if number == 1 { "" } else { "s" })
}
