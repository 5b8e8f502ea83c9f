//! The display step: levels become bytes, once and last.
//!
//! `byte = floor(clamp(level, 0, 255) + 0.5)`, NaN gives 0. There is no gamma; levels are display-referred.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, u32x16};

use crate::shading::simd::three;

/// The display step: `floor(clamp(level, 0, 255) + 0.5)`, NaN gives 0.
pub fn display_step(level: f64) -> u8 {
    let positive = if level > 0.0 { level } else { 0.0 };
    (positive.min(255.0) + 0.5) as u8
}

/// Three levels after the display step, 0x00RRGGBB.
pub fn display_pixel(levels: [f64; 3]) -> u32 {
    let [red, green, blue] = levels.map(display_step);
    u32::from_be_bytes([0, red, green, blue])
}

/// 2^23: adding it to a float of 0..=255 leaves the nearest integer, halves to even, in the low bits.
const INTEGERS: f32 = 8_388_608.0;

/// The display step of three channels in f32 as 0x00RRGGBB. Saturating casts would keep loops from being vectorised. The next
/// larger float is rounded, so that halves are rounded up. The float just below a half becomes that half, so after an odd integer
/// it is rounded up, too (1.49999988 gives 2).
#[inline(always)]
pub(super) fn display<S: Simd>(levels: [f32x16<S>; 3]) -> u32x16<S> {
    let simd = levels[0].token();
    let zero = f32x16::splat(simd, 0.0);
    let [red, green, blue] = three!(|channel| {
        // Zero where a level is not a number, unlike `max`.
        let positive = levels[channel].max_precise(zero);
        let clamped = positive.min(f32x16::splat(simd, 255.0));
        (f32x16::from_bits(clamped.to_bits() + 1) + INTEGERS).to_bits()
    });
    // The bits of `INTEGERS` above each byte are shifted or masked out.
    (red << 16) | (green << 8) | (blue & 0xff)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shading::simd::baseline;

    /// The byte of one level by the fast step, in all three places.
    fn shown(level: f32) -> u32 {
        display([f32x16::splat(baseline(), level); 3]).as_array()[0]
    }

    #[test]
    fn the_display_step_rounds_halves_up_and_survives_anything() {
        for (level, byte) in [
            (f64::NAN, 0),
            (f64::NEG_INFINITY, 0),
            (f64::INFINITY, 255),
            (-0.0, 0),
            (-3.0, 0),
            (0.499_999_99, 0),
            (0.5, 1),
            (1.5, 2),
            (2.5, 3),
            (254.499, 254),
            (254.5, 255),
            (255.0, 255),
            (1e30, 255),
        ] {
            assert_eq!(display_step(level), byte, "{level}");
            let byte = u32::from(display_step(f64::from(level as f32)));
            let level = level as f32;
            assert_eq!(shown(level), byte * 0x0001_0101, "{level} in f32");
        }
    }

    #[test]
    fn what_is_not_a_number_is_black_at_every_simd_level() {
        for level in crate::shading::simd::NAMES
            .into_iter()
            .filter_map(crate::shading::simd::named)
        {
            let pixel = crate::shading::simd::dispatch!(level, simd => {
                display([f32x16::splat(simd, f32::NAN); 3]).as_array()[0]
            });
            assert_eq!(pixel, 0, "{}", crate::shading::simd::name(level));
        }
    }

    #[test]
    fn the_fast_display_step_is_the_plain_one_on_every_kind_of_float() {
        // Every 1009th of all floats, and all those next to a half. Operations make quiet NaN only, and some processors treat
        // signalling ones otherwise.
        let everywhere = (0..=u32::MAX / 1009).map(|step| f32::from_bits(step * 1009));
        let everywhere = everywhere.map(|level| if level.is_nan() { f32::NAN } else { level });
        let halves = (0..=255).flat_map(|level| {
            let half = (level as f32 + 0.5).to_bits();
            (half - 3..=half + 3).map(f32::from_bits)
        });
        for level in everywhere.chain(halves) {
            let byte = u32::from(display_step(f64::from(level)));
            let early = u32::from(display_step(f64::from(f32::from_bits(
                level.to_bits().wrapping_add(1),
            ))));
            let within = shown(level) & 0xff;
            assert!(
                within == byte || within == early,
                "{level}: {within}, not {byte}"
            );
        }
    }
}
