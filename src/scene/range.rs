//! The ranges of the numbers in a scene file. NaN and infinities are in no range.

use std::ops::RangeInclusive;

/// Levels of the display.
pub const LEVEL: RangeInclusive<f64> = 0.0..=255.0;
/// World units.
pub const LENGTH: RangeInclusive<f64> = 1e-100..=1e100;
/// World units.
pub const COORDINATE: RangeInclusive<f64> = -1e100..=1e100;
/// Degrees, of any number of turns.
pub const ANGLE: RangeInclusive<f64> = f64::MIN..=f64::MAX;
/// Coefficients, colours, intensities and gains.
pub const STRENGTH: RangeInclusive<f64> = 0.0..=1e30;
/// The exponent rho.
pub const SHININESS: RangeInclusive<f64> = 0.0..=1e6;
/// Degrees; the lower bound is the smallest number above 0.
pub const FIELD_OF_VIEW: RangeInclusive<f64> = 5e-324..=179.0;
/// Degrees of an orbit.
pub const ORBIT: RangeInclusive<f64> = -180.0..=180.0;
/// The factor of a camera's distance and height.
pub const ZOOM: RangeInclusive<f64> = 1e-200..=1e200;
/// A share of a whole.
pub const SHARE: RangeInclusive<f64> = 0.0..=1.0;

/// A range in words, for use after "expected".
pub(super) fn words(range: &RangeInclusive<f64>) -> String {
    if *range == ANGLE {
        return "a number that is finite (degrees)".to_owned();
    }
    if *range == FIELD_OF_VIEW {
        return "a number above 0 and at most 179 (degrees)".to_owned();
    }
    let end = |end: f64| match end.abs() {
        1e-3..1e5 | 0.0 => end.to_string(),
        _ => format!("{end:e}"),
    };
    format!(
        "a number from {} to {}",
        end(*range.start()),
        end(*range.end())
    )
}
