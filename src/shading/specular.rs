//! The specular power: s^rho from 1 - s.
//!
//! Rule: every function here takes one_minus_cos = 1 - s, formed without cancellation as |r - o|^2 / 2 (Lyon 1993: for unit
//! vectors o.r = 1 - |r - o|^2 / 2), because near the highlight s itself has too few digits for a large rho.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, i32x16};

use super::U;

/// s^rho for s = 1 - one_minus_cos, in f64: `max(0, s)^rho`, and 0^0 = 1.
pub fn power_exact(shininess: f64, one_minus_cos: f64) -> f64 {
    if shininess == 0.0 {
        1.0
    } else if one_minus_cos >= 1.0 {
        0.0
    } else {
        (shininess * (-one_minus_cos).ln_1p()).exp()
    }
}

/// Bits of the square root of a half, in f32.
const HALF_ROOT_BITS: i32 = 0x3f35_04f3;
/// 1.5 * 2^23: adding it to a float of size below 2^22 leaves the nearest integer in the low bits.
const ROUND: f32 = 12_582_912.0;

/// s^rho for s = 1 - one_minus_cos, one_minus_cos in 0..=2, shininess > 0, in f32 and without branches.
///
/// Twice the inverse hyperbolic tangent of f / (2 + f) is ln(1 + f) (Abramowitz and Stegun 4.6.22); four terms leave a
/// relative error of 9.8e-8 on [sqrt(1/2), sqrt(2)], and where s is at least sqrt(1/2) f is -one_minus_cos itself, so the
/// logarithm is relatively exact as s goes to 1. The power of two is rounded off and the rest, within +-1/2, goes
/// through the exponential series to the sixth power (relative error 1.6e-7).
#[inline(always)]
pub fn power<S: Simd>(shininess: f32, one_minus_cos: f32x16<S>) -> f32x16<S> {
    let simd = one_minus_cos.token();
    let zero = f32x16::splat(simd, 0.0);
    let s = 1.0 - one_minus_cos;
    let bits: i32x16<S> = s.bitcast();
    let exponent = (bits - HALF_ROOT_BITS) >> 23;
    let mantissa: f32x16<S> = (bits - (exponent << 23)).bitcast();
    let f = exponent.simd_eq(0).select(-one_minus_cos, mantissa - 1.0);
    let z = f / (f + 2.0);
    let z2 = z * z;
    // 2 / ln 2 over 1, 3, 5, 7.
    let series = z * (((z2 * 0.412_198_58 + 0.577_078_04) * z2 + 0.961_796_7) * z2 + 2.885_39);
    let log2 = exponent.to_float::<f32x16<S>>() + series;

    let y = (log2 * shininess).max(f32x16::splat(simd, -126.0));
    let rounded = y + ROUND;
    let g = y - (rounded - ROUND);
    // ln 2 ^ k / k! for k = 0..=6.
    let mut mantissa = g * 0.000_154_035_3 + 0.001_333_355_8;
    for coefficient in [
        0.009_618_129,
        0.055_504_11,
        0.240_226_5,
        std::f32::consts::LN_2,
        1.0,
    ] {
        mantissa = mantissa * g + coefficient;
    }
    let scale: f32x16<S> = ((rounded.to_bits() << 23) + 0x3f80_0000).bitcast();
    s.simd_gt(zero).select(mantissa * scale, zero)
}

/// s^rho in few steps, for one rho: a quadratic in 1 - s stands for s^(rho / 2^j) with 1 <= rho / 2^j < 2, and is squared
/// j times ("polynomial, then square"). Where s is below a bound the result is 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Squarings {
    coefficients: [f32; 3],
    times: u32,
    /// 1 - s up to which the quadratic stands.
    end: f32,
    /// A bound on the error of s^rho where s is at least the bound it was made for, f32 included.
    pub error: f64,
}

impl Squarings {
    /// For s in `least`..=1; none where rho is below 1 or from 1e4 on, or the error above `most`.
    ///
    /// The quadratic interpolates g = (1 - x)^e on 0..=h at Chebyshev's nodes, so it errs by |g^(3)| / 3 (h / 4)^3 at
    /// most; m = 2^j such factors make m times that (times what m errors in a row can add, which the exponential bounds).
    /// Rounding adds [`QUADRATIC`] units to each of them, and one for all squarings together.
    /// The end is rounded up, so that no s from `least` on is lost.
    pub fn new(shininess: f64, least: f64, most: f64) -> Option<Self> {
        if !((1.0..1e4).contains(&shininess) && least > 0.0 && least < 1.0) {
            return None;
        }
        let doublings = shininess.log2().floor();
        let factors = doublings.exp2();
        let exponent = shininess / factors;
        let end = 1.0 - least;
        let third = (exponent * (exponent - 1.0) * (exponent - 2.0)).abs()
            * least.powf((exponent - 3.0).min(0.0));
        let factor_error = third / 3.0 * (end / 4.0).powi(3) + (QUADRATIC + 1.0) * U;
        let error = factors * factor_error * (factors * factor_error).exp();
        if error.is_nan() || most.is_nan() || error > most {
            return None;
        }
        // Newton's interpolation at the nodes h / 2 (1 + cos((2 i + 1) pi / 6)).
        let reach = 3.0_f64.sqrt() / 2.0;
        let [a, b, c] = [1.0 - reach, 1.0, 1.0 + reach].map(|node| node * end / 2.0);
        let [first, second, third] = [a, b, c].map(|node| (1.0 - node).powf(exponent));
        let rise = (second - first) / (b - a);
        let bend = ((third - second) / (c - b) - rise) / (c - a);
        let coefficients = [first - rise * a + bend * a * b, rise - bend * (a + b), bend];
        Some(Squarings {
            coefficients: coefficients.map(|coefficient| coefficient as f32),
            times: doublings as u32,
            end: (end as f32).next_up(),
            error,
        })
    }

    /// s^rho for s = 1 - `one_minus_cos`.
    #[inline(always)]
    pub fn power<S: Simd>(&self, one_minus_cos: f32x16<S>) -> f32x16<S> {
        let zero = f32x16::splat(one_minus_cos.token(), 0.0);
        let [constant, slope, curve] = self.coefficients;
        // Beyond the end lanes may pass through denormal numbers, which are slow on some machines and are not shown.
        let mut power = (one_minus_cos * curve + slope) * one_minus_cos + constant;
        for _ in 0..self.times {
            power = power * power;
        }
        one_minus_cos.simd_lt(self.end).select(power, zero)
    }
}

/// The power of one shininess, s^rho from 1 - s.
#[derive(Clone, Copy, Debug)]
pub struct Power {
    pub shininess: f32,
    pub exact: f64,
    /// The steepest slope of (1 - d^2/2)^rho in d = |r - o|, at d^2 = 2 / (2 rho - 1): for a shininess of at least 1.
    steepest: f64,
    pub squarings: Option<Squarings>,
    /// What it errs by, f32 included.
    pub error: f64,
}

/// The largest error of [`power`], with rho rounded to f32: `proofs/power.v`. In units u it is the largest value of
/// (10.2 z + 4.3) e^-z, 5.8, where z = |ln s^rho| errs by 10.2 u z and the power of two by 4.3 u.
pub const POWER_ERROR: f64 = 6.0 * U;
/// The error of the quadratic of [`Squarings`], in roundings: `proofs/squarings.g`.
pub const QUADRATIC: f64 = 6.0;

impl Power {
    /// One that errs by at most `most` where s is at least `least` and nothing is asked elsewhere, if there is a cheap
    /// one; otherwise one for every s.
    pub fn new(shininess: f64, least: f64, most: f64) -> Self {
        let squarings = Squarings::new(shininess, least, most);
        let chord = (2.0 / (2.0 * shininess - 1.0)).sqrt();
        Power {
            shininess: shininess as f32,
            exact: shininess,
            steepest: shininess * chord * (1.0 - chord * chord / 2.0).powf(shininess - 1.0),
            squarings,
            error: squarings.map_or(POWER_ERROR, |squarings| squarings.error),
        }
    }

    /// The error of s^rho caused by an error of |r - o| and four roundings of 1 - s. Below a shininess of 1 the slope has no
    /// bound as s goes to 0, but powers of two numbers then differ by no more than the power of their difference. From 1 on
    /// relative errors of 1 - s become no larger: rho (1 - s) s^(rho - 1) <= 1.
    pub fn propagated(&self, distance: f64, unit: f64) -> f64 {
        let rounded = 4.0 * unit;
        match self.exact {
            0.0 => 0.0,
            shininess if shininess < 1.0 => (2.0 * distance + rounded).powf(shininess),
            _ => self.steepest * distance + rounded,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::{Baseline, token};

    fn lanes(one_minus_cos: f32) -> f32x16<Baseline> {
        f32x16::splat(token(), one_minus_cos)
    }

    fn power(shininess: f32, one_minus_cos: f32) -> f32 {
        super::power(shininess, lanes(one_minus_cos)).as_array()[0]
    }

    const SHININESSES: [f64; 12] = [
        1e-3, 0.5, 1.0, 1.5, 2.0, 5.0, 10.0, 76.8, 200.0, 1e3, 1e4, 1e6,
    ];

    #[test]
    fn the_power_is_within_a_thousandth_of_a_level_of_f64() {
        let mut worst = 0.0_f64;
        for shininess in SHININESSES {
            for step in 0..=200_000 {
                // Denser towards one_minus_cos = 0, where a large rho has its highlight.
                let one_minus_cos = 2.0 * (f64::from(step) / 200_000.0).powi(4);
                let one_minus_cos = one_minus_cos as f32;
                let expected = power_exact(f64::from(shininess as f32), f64::from(one_minus_cos));
                worst =
                    worst.max((f64::from(power(shininess as f32, one_minus_cos)) - expected).abs());
            }
        }
        assert!(worst * 255.0 < 1e-3, "{} levels", worst * 255.0);
    }

    #[test]
    fn a_power_errs_by_less_than_its_bound_and_by_more_than_half_of_it() {
        let mut worst = 0.0_f64;
        for shininess in SHININESSES.into_iter().filter(|rho| *rho >= 1.0) {
            let shininess = f64::from(shininess as f32);
            for step in 0..=100_000 {
                let one_minus_cos = (f64::from(step) / 100_000.0).powi(4);
                let found = f64::from(power(shininess as f32, one_minus_cos as f32));
                worst = worst.max((found - power_exact(shininess, one_minus_cos)).abs());
            }
        }
        println!("{:.3} of what is said", worst / POWER_ERROR);
        assert!(worst <= POWER_ERROR, "{worst}");
        assert!(worst > POWER_ERROR / 2.0, "{worst}");
    }

    #[test]
    fn no_error_in_the_chord_or_in_one_minus_s_makes_more_of_the_power_than_is_said() {
        for shininess in SHININESSES {
            let given = Power::new(shininess, 0.0, 0.0);
            let (mut moved, mut rounded) = (0.0_f64, 0.0_f64);
            let (distance, unit) = (1e-5, 1e-5);
            for step in 0..=20_000 {
                let chord = std::f64::consts::SQRT_2 * (f64::from(step) / 20_000.0).powi(3);
                let at =
                    |chord: f64, factor: f64| power_exact(shininess, chord * chord / 2.0 * factor);
                let here = at(chord, 1.0);
                moved = moved.max(
                    (at(chord + distance, 1.0) - here).abs() / given.propagated(distance, 0.0),
                );
                let change = (at(chord, 1.0 + 4.0 * unit) - here).abs();
                rounded = rounded.max(change / given.propagated(0.0, unit));
            }
            if shininess > 0.0 {
                println!("rho {shininess}: {moved:.3} and {rounded:.3} of what is said");
                assert!(moved <= 1.001 && rounded <= 1.001, "rho {shininess}");
            }
            if shininess > 1.0 && shininess < 1e4 {
                assert!(moved > 0.95, "rho {shininess}: {moved} is loose");
                assert!(rounded > 0.3, "rho {shininess}: {rounded} is loose");
            }
        }
    }

    #[test]
    fn the_ends_are_exact() {
        for shininess in SHININESSES {
            assert_eq!(
                power(shininess as f32, 0.0),
                1.0,
                "s = 1, rho = {shininess}"
            );
            assert_eq!(
                power(shininess as f32, 1.0),
                0.0,
                "s = 0, rho = {shininess}"
            );
            assert_eq!(
                power(shininess as f32, 2.0),
                0.0,
                "s = -1, rho = {shininess}"
            );
            assert_eq!(power_exact(shininess, 0.0), 1.0);
            assert_eq!(power_exact(shininess, 1.0), 0.0);
        }
        assert_eq!(power_exact(0.0, 1.5), 1.0, "max(0, x)^0 is 1");
    }

    #[test]
    fn squarings_err_no_more_than_they_say() {
        let mut made = 0;
        for shininess in SHININESSES
            .into_iter()
            .chain([3.0, 7.9, 32.0, 47.3, 130.0, 999.0])
        {
            for faint in [0.2_f64, 1e-2, 1e-3, 1e-4] {
                let least = faint.powf(1.0 / shininess);
                let Some(squarings) = Squarings::new(shininess, least, 1e-3) else {
                    continue;
                };
                made += 1;
                let mut worst = 0.0_f64;
                for step in 0..=20_000 {
                    let one_minus_cos = (2.0 * (f64::from(step) / 20_000.0).powi(3)) as f32;
                    let found = f64::from(squarings.power(lanes(one_minus_cos)).as_array()[0]);
                    let expected = power_exact(shininess, f64::from(one_minus_cos));
                    let error = (found - expected).abs();
                    if f64::from(one_minus_cos) < 1.0 - least {
                        worst = worst.max(error);
                    } else {
                        assert!(
                            error <= faint * (1.0 + 1e-12),
                            "rho {shininess}, 1 - s {one_minus_cos}"
                        );
                    }
                }
                assert!(
                    worst <= squarings.error,
                    "rho {shininess}, {faint}: {worst} above {}",
                    squarings.error
                );
            }
        }
        assert!(made > 10, "{made} powers could be squared");
    }

    #[test]
    fn squarings_are_refused_where_they_would_err_or_have_no_meaning() {
        let made = |shininess: f64, least: f64, most: f64| Squarings::new(shininess, least, most);
        assert!(made(76.8, 0.9, 1e-3).is_some());
        assert_eq!(made(76.8, 0.9, 1e-9), None, "f32 alone errs more");
        assert_eq!(made(0.5, 0.9, 1.0), None, "no bound below rho = 1");
        assert_eq!(made(5.0, 0.1, 1e-3), None, "too wide for a quadratic");
        for least in [0.0, 1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(made(76.8, least, 1.0), None, "s from {least}");
        }
        assert_eq!(made(76.8, 0.9, f64::NAN), None);
    }

    #[test]
    fn known_powers() {
        for (shininess, s, expected) in [
            (2.0, 0.5, 0.25),
            (3.0, 0.5, 0.125),
            (1.0, 0.3, 0.3),
            (0.5, 0.25, 0.5),
            (10.0, 0.9, 0.348_678_440_1),
        ] {
            assert!(
                (f64::from(power(shininess as f32, 1.0 - s as f32)) - expected).abs() < 5e-7,
                "{s}^{shininess}"
            );
            assert!(
                (power_exact(shininess, 1.0 - s) - expected).abs() < 1e-15,
                "{s}^{shininess}"
            );
        }
    }
}
