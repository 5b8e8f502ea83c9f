//! The constants of a material's highlights, which are the same in every square: how faint a highlight must be to be left
//! out, and how much s^rho enlarges a rounding error.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x4};

use super::limit;
use super::surface::Surface;

/// The part of the tolerance that all highlights too faint to be drawn may use together. With a larger part more highlights
/// are left out, but other errors must be smaller. A tenth or a half changes the instructions of a frame by 1 to 2 % (default
/// scene and bench-far, tolerance 0.5).
const FAINT_SHARE: f64 = 0.25;

/// If 0 < rho < 1, a pixel with |s| below this is evaluated in f64, because the slope of s^rho is unbounded at s = 0.
const DOUBT: f64 = 1.0 / 256.0;

/// The constants of the highlights of one material.
#[derive(Clone, Copy, Debug)]
pub struct Gloss {
    /// Never rounded to 0: for rho = 0 the power of an s <= 0 is 1, else it is 0.
    pub shininess: f32,
    /// rho, rho (rho - 1) and rho (rho - 1) (rho - 2), absolute.
    pub(super) factors: [f64; 3],
    /// A highlight is too faint to be drawn unless its s exceeds this.
    pub drawn_above: f64,
    /// The error of one highlight that is not drawn, in levels.
    pub faint: f64,
    /// Where |s| is smaller than this, its power is evaluated in f64.
    pub doubt: f32,
    /// The steepest slope of s^rho in |r - o|, where |s| is at least `doubt`.
    steepest: f64,
}

impl Gloss {
    /// For an object under its light.
    pub fn new(surface: &Surface, tolerance: f64) -> Self {
        let shininess = surface.material.shininess;
        let points = surface.illumination.points.iter();
        let brightest = points
            .map(|light| surface.coefficients(light)[1].max_element())
            .fold(0.0, f64::max);
        let faint = FAINT_SHARE * limit(tolerance) / surface.powers().max(1) as f64;
        let drawn_above = if brightest <= faint {
            f64::INFINITY
        } else if shininess == 0.0 {
            f64::NEG_INFINITY
        } else {
            // Another libm may differ in the last bit, so pictures may differ from machine to machine.
            (faint / brightest).powf(1.0 / shininess)
        };
        let second = (shininess * (shininess - 1.0)).abs();
        let is_steep = shininess > 0.0 && shininess < 1.0;
        Gloss {
            shininess: if shininess > 0.0 {
                (shininess as f32).max(f32::MIN_POSITIVE)
            } else {
                0.0
            },
            factors: [shininess, second, second * (shininess - 2.0).abs()],
            drawn_above,
            faint,
            doubt: if is_steep { DOUBT as f32 } else { 0.0 },
            steepest: steepest(shininess),
        }
    }

    /// The error of s^rho, in roundings, caused by an error of |r - o| in roundings and by four roundings of 1 - s.
    ///
    /// If rho >= 1, a relative error e of 1 - s changes s^rho by at most e, because rho (1 - s) s^(rho - 1) <= 1. For a
    /// shininess below 1, pixels with |s| < `DOUBT` are evaluated in f64. In f32 s errs by less than `DOUBT` / 2, so the
    /// slope is at most that at s = `DOUBT` / 2.
    #[inline(always)]
    pub fn propagated<S: Simd>(&self, chord: f64x4<S>) -> f64x4<S> {
        /// sqrt(2) times this many roundings are less than half of [`DOUBT`].
        const MOST: f64 = 2e4;
        let infinite = f64x4::splat(chord.token(), f64::INFINITY);
        let error = (chord + 4.0) * self.steepest + 4.0;
        chord.simd_lt(MOST).select(error, infinite)
    }
}

/// The steepest slope of s^rho = (1 - d^2 / 2)^rho in d = |r - o|: at d^2 = 2 / (2 rho - 1) for a shininess of at least 1.
/// Below, s changes by at most sqrt(2) times d, and is at least half of [`DOUBT`].
fn steepest(shininess: f64) -> f64 {
    if shininess == 0.0 {
        0.0
    } else if shininess < 1.0 {
        std::f64::consts::SQRT_2 * shininess * (DOUBT / 2.0).powf(shininess - 1.0)
    } else {
        let chord = (2.0 / (2.0 * shininess - 1.0)).sqrt();
        shininess * chord * (1.0 - chord * chord / 2.0).powf(shininess - 1.0)
    }
}

#[cfg(test)]
pub(super) mod tests {
    use fearless_simd::f32x16;
    use glam::DVec3;

    use super::*;
    use crate::components::{Illumination, Material, PointLight};
    use crate::shading::U;
    use crate::shading::simd::baseline;
    use crate::shading::specular::{self, power_exact};

    /// A material under one light of 100 levels.
    pub fn gloss(shininess: f64, tolerance: f64) -> Gloss {
        lit(shininess, tolerance, 1)
    }

    /// The same under several lights.
    fn lit(shininess: f64, tolerance: f64, lights: usize) -> Gloss {
        let material = Material {
            ambient: DVec3::ZERO,
            diffuse: DVec3::ZERO,
            specular: DVec3::ONE,
            shininess,
        };
        let light = PointLight {
            position: DVec3::ONE,
            diffuse: DVec3::ZERO,
            specular: DVec3::new(10.0, 100.0, 20.0),
        };
        let illumination = Illumination {
            ambient: DVec3::ZERO,
            points: vec![light; lights],
        };
        let surface = Surface {
            material: &material,
            illumination: &illumination,
            centre: DVec3::ZERO,
            plane: None,
        };
        Gloss::new(&surface, tolerance)
    }

    fn propagated(gloss: &Gloss, chord: f64) -> f64 {
        gloss.propagated(f64x4::splat(baseline(), chord)).as_array()[0]
    }

    #[test]
    fn a_positive_shininess_below_the_range_of_f32_ends_the_highlight_where_s_is_0() {
        for (shininess, behind) in [(5e-324, 0.0), (1e-40, 0.0), (0.0, 1.0)] {
            let shininess = gloss(shininess, 0.0).shininess;
            let power = |one_minus_cos| {
                let places = f32x16::splat(baseline(), one_minus_cos);
                specular::power(shininess, places).as_array()[0]
            };
            assert_eq!([power(0.5), power(1.5)], [1.0, behind], "{shininess:e}");
        }
    }

    #[test]
    fn no_error_in_the_chord_or_in_one_minus_s_makes_more_of_the_power_than_is_said() {
        for shininess in [
            1e-3, 0.1, 0.5, 0.9, 1.0, 1.5, 2.0, 5.0, 10.0, 76.8, 200.0, 1e3, 1e4, 1e6,
        ] {
            let given = gloss(shininess, 0.5);
            let (mut moved, mut rounded) = (0.0_f64, 0.0_f64);
            let distance = 170.0;
            for step in 0..=20_000 {
                let chord = std::f64::consts::SQRT_2 * (f64::from(step) / 20_000.0).powi(3);
                if 1.0 - chord * chord / 2.0 < f64::from(given.doubt) {
                    continue;
                }
                let at = |chord: f64, factor: f64| {
                    power_exact(shininess, (chord * chord / 2.0 * factor).min(1.0))
                };
                let here = at(chord, 1.0);
                moved = moved.max((at(chord + distance * U, 1.0) - here).abs());
                rounded = rounded.max((at(chord, 1.0 + 4.0 * U) - here).abs());
            }
            let [moved, rounded] = [(moved, distance), (rounded, 0.0)]
                .map(|(found, chord)| found / (propagated(&given, chord) * U));
            println!("rho {shininess}: {moved:.3} and {rounded:.3} of what is said");
            assert!(moved <= 1.001 && rounded <= 1.001, "rho {shininess}");
            assert!(moved > 0.3, "rho {shininess}: {moved} is loose");
        }
    }

    #[test]
    fn an_error_that_may_reach_s_of_zero_has_no_bound() {
        // Half of 1/256, over sqrt(2).
        let most = 1.0 / 512.0 / 2.0_f64.sqrt() / U;
        assert_eq!(propagated(&gloss(0.5, 0.5), most), f64::INFINITY);
        assert_eq!(propagated(&gloss(0.5, 0.5), f64::NAN), f64::INFINITY);
    }

    #[test]
    fn the_faintest_highlight_that_is_drawn_has_a_quarter_of_the_tolerance() {
        let known = gloss(2.0, 0.4);
        assert!((known.faint - 0.1).abs() < 1e-12);
        assert!((known.drawn_above - 1e-3_f64.sqrt()).abs() < 1e-12);
        assert!(
            (lit(2.0, 0.4, 5).faint - 0.02).abs() < 1e-12,
            "lights share it"
        );
        assert_eq!(gloss(2.0, 400.0).drawn_above, f64::INFINITY);
        assert_eq!(gloss(0.0, 0.4).drawn_above, f64::NEG_INFINITY);
        assert!(
            (gloss(1.0, 0.0).faint - 0.0125).abs() < 1e-12,
            "tolerance 0 is 0.05"
        );
    }
}
