//! Levels in, pixels out: the display step, done once and last.
//!
//! Rule: `byte = floor(clamp(level, 0, 255) + 0.5)`, NaN gives 0; no gamma, levels are display-referred.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, u32x16};
use glam::DVec3;

use super::square::{MAX_SIDE, Region};
use crate::simd::three;

/// The colours of a square, sixteen columns at a time.
pub trait Rows<S: Simd> {
    /// Goes to the columns from 16 `part` on, counted from the square's first.
    fn go_to(&mut self, part: usize);

    /// Their levels in a row, counted from the square's first; unclamped.
    fn levels(&self, row: usize) -> [f32x16<S>; 3];

    /// Their display step, 0x00RRGGBB.
    #[inline(always)]
    fn pixels(&self, row: usize) -> u32x16<S> {
        let levels = self.levels(row);
        pack(three(
            #[inline(always)]
            |channel| display_bits(levels[channel]),
        ))
    }
}

/// The levels of a square's pixels, by row and channel.
#[derive(Clone, Copy, Debug)]
pub struct Levels([[[f32; MAX_SIDE]; 3]; MAX_SIDE]);

impl Default for Levels {
    fn default() -> Self {
        Levels([[[0.0; MAX_SIDE]; 3]; MAX_SIDE])
    }
}

impl Levels {
    /// Those of a pixel, counted from the square's first.
    pub fn at(&self, column: usize, row: usize) -> [f32; 3] {
        self.0[row].map(|channel| channel[column])
    }

    /// Takes what is covered of a region.
    #[inline(always)]
    pub fn fill<S: Simd>(&mut self, region: &Region, rows: &mut impl Rows<S>) {
        for_parts(
            region,
            rows,
            #[inline(always)]
            |row, part, levels| {
                for channel in 0..3 {
                    self.0[row][channel][16 * part..16 * part + 16]
                        .copy_from_slice(levels[channel].as_slice());
                }
            },
        );
    }

    /// The same where `wanted`, which is told a pixel's centre from the picture's middle.
    #[inline(always)]
    pub fn fill_where<S: Simd>(
        &mut self,
        region: &Region,
        rows: &mut impl Rows<S>,
        wanted: impl Fn([f64; 2]) -> bool,
    ) {
        for_parts(
            region,
            rows,
            #[inline(always)]
            |row, part, levels| {
                for lane in 0..16 {
                    let column = 16 * part + lane;
                    if wanted(region.centre(column, row)) {
                        for channel in 0..3 {
                            self.0[row][channel][column] = levels[channel][lane];
                        }
                    }
                }
            },
        );
    }

    /// Takes what is covered of a region, one pixel at a time; `evaluate` is told its centre from the picture's middle.
    pub fn fill_each(&mut self, region: &Region, evaluate: impl Fn([f64; 2]) -> DVec3) {
        for (row, span) in region.covered() {
            for column in span {
                let levels = evaluate(region.centre(column, row)).as_vec3();
                for channel in 0..3 {
                    self.0[row][channel][column] = levels[channel];
                }
            }
        }
    }
}

/// Evaluates the parts of rows in which anything is covered.
#[inline(always)]
fn for_parts<S: Simd, R: Rows<S>>(
    region: &Region,
    rows: &mut R,
    mut take: impl FnMut(usize, usize, [f32x16<S>; 3]),
) {
    for part in region.square.parts() {
        rows.go_to(part);
        for (row, span) in region.covered() {
            if span.start < 16 * part + 16 && 16 * part < span.end {
                take(row, part, rows.levels(row));
            }
        }
    }
}

/// Levels that were evaluated before.
pub struct Evaluated<'a, S: Simd> {
    simd: S,
    levels: &'a Levels,
    part: usize,
}

impl<'a, S: Simd> Evaluated<'a, S> {
    /// Those of a square.
    pub fn new(simd: S, levels: &'a Levels) -> Self {
        let part = 0;
        Evaluated { simd, levels, part }
    }
}

impl<S: Simd> Rows<S> for Evaluated<'_, S> {
    #[inline(always)]
    fn go_to(&mut self, part: usize) {
        self.part = part;
    }

    #[inline(always)]
    fn levels(&self, row: usize) -> [f32x16<S>; 3] {
        let first = 16 * self.part;
        three(
            #[inline(always)]
            |channel| f32x16::from_slice(self.simd, &self.levels.0[row][channel][first..][..16]),
        )
    }
}

/// The contract's display step: `floor(clamp(level, 0, 255) + 0.5)`, NaN gives 0.
pub fn display_step(level: f64) -> u8 {
    let positive = if level > 0.0 { level } else { 0.0 };
    (positive.min(255.0) + 0.5).floor() as u8
}

/// 2^23: adding it to a float of 0..=255 leaves the nearest integer, halves to even, in the low bits.
const INTEGERS: f32 = 8_388_608.0;

/// The display step of levels in f32, the byte in the low bits and the rest as in [`INTEGERS`], without the saturating casts
/// that keep loops from vectorising: halves go up, and so does the one float below an odd half.
#[inline(always)]
pub(super) fn display_bits<S: Simd>(level: f32x16<S>) -> u32x16<S> {
    let simd = level.token();
    // The other way round what is not a number would stay.
    let positive = level.max(f32x16::splat(simd, 0.0));
    let clamped = positive.min(f32x16::splat(simd, 255.0));
    (f32x16::from_bits(clamped.to_bits() + 1) + INTEGERS).to_bits()
}

/// Three display bits as 0x00RRGGBB; what is shifted out is not the byte.
#[inline(always)]
pub(super) fn pack<S: Simd>([red, green, blue]: [u32x16<S>; 3]) -> u32x16<S> {
    (red << 16) | (green << 8) | (blue & 0xff)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::token;

    /// The byte of one level by the fast step, in all three places.
    fn shown(level: f32) -> u32 {
        let bits = display_bits(f32x16::splat(token(), level));
        pack([bits; 3]).as_array()[0]
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
    fn the_fast_display_step_is_the_plain_one_on_every_kind_of_float() {
        // Every 257th of all floats, and all those next to a half.
        let everywhere = (0..=u32::MAX / 257).map(|step| f32::from_bits(step * 257));
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
