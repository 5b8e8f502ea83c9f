//! The specular power: s^rho from 1 - s.
//!
//! All functions take one_minus_cos = 1 - s, which is computed without cancellation as |r - o|^2 / 2 (Lyon 1993). Near the
//! highlight s itself has too few digits for a large rho.

use std::f64::consts::{LN_2, LOG2_E};

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, f64x8, i32x16, i64x8};

use crate::shading::simd::inlined;

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

/// [`power_exact`] in lanes, one_minus_cos in 0..=2. It errs by less than 2e-12, and relatively by less than 2e-12 (1 + |ln s^rho|);
/// no power is less than 2^-1022, but for 0.
///
/// The method is that of [`power`]: seven terms of the logarithm leave a relative error of 0.02944^7 / 15 = 1.3e-12 where z^2
/// is 0.02944, its largest, and ten of the exponential series leave 0.3466^11 / 11! = 2.2e-13. The rest is rounding.
#[inline(always)]
pub fn power_in_lanes<S: Simd>(shininess: f64, one_minus_cos: f64x8<S>) -> f64x8<S> {
    /// Bits of the square root of a half.
    const HALF_ROOT_BITS: i64 = 0x3fe6_a09e_667f_3bcd;
    /// 1.5 * 2^52, as [`ROUND`].
    const ROUND: f64 = 6_755_399_441_055_744.0;
    let splat = inlined!(|number: f64| f64x8::splat(one_minus_cos.token(), number));
    if shininess == 0.0 {
        return splat(1.0);
    }
    let s = 1.0 - one_minus_cos;
    let bits: i64x8<S> = s.bitcast();
    let exponent = (bits - HALF_ROOT_BITS) >> 52;
    let mantissa: f64x8<S> = (bits - (exponent << 52)).bitcast();
    let f = exponent.simd_eq(0).select(-one_minus_cos, mantissa - 1.0);
    let z = f / (f + 2.0);
    let (z2, mut series) = (z * z, splat(0.0));
    for odd in [13.0, 11.0, 9.0, 7.0, 5.0, 3.0, 1.0] {
        series = series * z2 + 2.0 * LOG2_E / odd;
    }
    let y = (exponent.to_float::<f64x8<S>>() + z * series) * shininess;
    let y = y.max(splat(-1022.0));
    let rounded = y + ROUND;
    let g = (y - (rounded - ROUND)) * LN_2;
    let mut power = splat(1.0);
    for order in [10.0, 9.0, 8.0, 7.0, 6.0, 5.0, 4.0, 3.0, 2.0, 1.0] {
        power = power * (g * (1.0 / order)) + 1.0;
    }
    let scale: f64x8<S> = ((rounded.to_bits() << 52) + (1023 << 52)).bitcast();
    s.simd_gt(0.0).select(power * scale, splat(0.0))
}

/// Bits of the square root of a half, in f32.
const HALF_ROOT_BITS: i32 = 0x3f35_04f3;
/// 1.5 * 2^23: adding it to a float of size below 2^22 leaves the nearest integer in the low bits.
const ROUND: f32 = 12_582_912.0;

/// s^rho for s = 1 - one_minus_cos, one_minus_cos in 0..=2, in f32; 0^0 = 1.
///
/// Twice the inverse hyperbolic tangent of f / (2 + f) is ln(1 + f) (Abramowitz and Stegun 4.6.22); four terms leave a
/// relative error of 9.8e-8 on [sqrt(1/2), sqrt(2)]. Where s is at least sqrt(1/2), f is -one_minus_cos itself, so the
/// logarithm stays relatively exact as s goes to 1. The exponent of the power is split into the nearest integer
/// and a rest within +-1/2, for which the exponential series is evaluated to the sixth power (relative error 1.6e-7).
#[inline(always)]
pub fn power<S: Simd>(shininess: f32, one_minus_cos: f32x16<S>) -> f32x16<S> {
    let simd = one_minus_cos.token();
    if shininess == 0.0 {
        return f32x16::splat(simd, 1.0);
    }
    let power = exp2(exponent(shininess, one_minus_cos));
    let zero = f32x16::splat(simd, 0.0);
    (1.0 - one_minus_cos).simd_gt(zero).select(power, zero)
}

/// log2(s^rho) for s > 0 and rho > 0.
#[inline(always)]
pub fn exponent<S: Simd>(shininess: f32, one_minus_cos: f32x16<S>) -> f32x16<S> {
    let s = 1.0 - one_minus_cos;
    let bits: i32x16<S> = s.bitcast();
    let exponent = (bits - HALF_ROOT_BITS) >> 23;
    let mantissa: f32x16<S> = (bits - (exponent << 23)).bitcast();
    let f = exponent.simd_eq(0).select(-one_minus_cos, mantissa - 1.0);
    let z = f / (f + 2.0);
    let z2 = z * z;
    // 2 / ln 2 over 1, 3, 5, 7.
    let series = z * (((z2 * 0.412_198_58 + 0.577_078_04) * z2 + 0.961_796_7) * z2 + 2.885_39);
    (exponent.to_float::<f32x16<S>>() + series) * shininess
}

/// 2^y for y below 127, and at least 2^-126.
#[inline(always)]
pub fn exp2<S: Simd>(y: f32x16<S>) -> f32x16<S> {
    let y = y.max(f32x16::splat(y.token(), -126.0));
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
    mantissa * scale
}

/// The largest error of [`exponent`], in roundings, relative: `proofs/power.v`.
pub const EXPONENT_ERROR: f64 = 10.2;

/// The largest error of [`power`], in roundings, with rho rounded to f32: `proofs/power.v`. It covers 5.8, the largest
/// (10.2 z + 4.3) e^-z, where z = |ln s^rho| errs by 10.2 u z and the power of two by 4.3 u.
pub const POWER_ERROR: f64 = 6.0;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shading::U;
    use crate::shading::simd::baseline;

    fn power(shininess: f32, one_minus_cos: f32) -> f32 {
        super::power(shininess, f32x16::splat(baseline(), one_minus_cos)).as_array()[0]
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
        println!("{:.3} of what is said", worst / POWER_ERROR / U);
        assert!(worst <= POWER_ERROR * U, "{worst}");
        assert!(worst > POWER_ERROR / 2.0 * U, "{worst}");
    }

    #[test]
    fn a_power_in_lanes_errs_by_less_than_it_says() {
        for shininess in SHININESSES {
            for step in 0..=100_000 {
                let one_minus_cos = (f64::from(step) / 100_000.0).powi(4);
                let found = power_in_lanes(shininess, f64x8::splat(baseline(), one_minus_cos))[0];
                let expected = power_exact(shininess, one_minus_cos);
                let error = (found - expected).abs();
                let exponent = shininess * (-one_minus_cos).ln_1p();
                let relative = 2e-12 * (1.0 + exponent.abs());
                assert!(
                    error <= 2e-12_f64.min(relative * expected).max(f64::MIN_POSITIVE),
                    "{one_minus_cos}^{shininess}"
                );
            }
            let at = |it| power_in_lanes(shininess, f64x8::splat(baseline(), it))[0];
            assert_eq!([at(0.0), at(1.0), at(2.0)], [1.0, 0.0, 0.0], "{shininess}");
        }
        assert_eq!(power_in_lanes(0.0, f64x8::splat(baseline(), 1.5))[0], 1.0);
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
        assert_eq!(power(0.0, 1.5), 1.0);
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
