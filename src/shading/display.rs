//! Levels in, pixels out: the display step, done once and last.
//!
//! Rule: `byte = floor(clamp(level, 0, 255) + 0.5)`, NaN gives 0; no gamma, levels are display-referred.

use std::ops::Range;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, u32x16};
use glam::DVec3;

use super::square::{MAX_SIDE, MIN_SIDE, Region};
use crate::simd::{three, two};

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
        pack(three!(|channel| display_bits(levels[channel])))
    }
}

/// The most pixels that are listed: those of one of the smallest squares.
const MAX_LISTED: usize = MIN_SIDE * MIN_SIDE;

/// Pixels of a square one by one, so that a few of them fill the lanes.
#[derive(Clone, Copy, Debug)]
pub struct Listed {
    len: usize,
    /// Right and down from the square's middle, in pixels.
    places: [[f32; MAX_LISTED]; 2],
    /// Where each stands in the band.
    indices: [usize; MAX_LISTED],
    levels: [[f32; MAX_LISTED]; 3],
}

impl Default for Listed {
    fn default() -> Self {
        Listed {
            len: 0,
            places: [[0.0; MAX_LISTED]; 2],
            indices: [0; MAX_LISTED],
            levels: [[0.0; MAX_LISTED]; 3],
        }
    }
}

impl Listed {
    /// None.
    pub fn clear(&mut self) {
        self.len = 0;
    }

    /// Those of a row that are `seen`, which is told how far each is from the first; the first stands at `x`, `y`.
    pub fn extend(
        &mut self,
        [mut x, y]: [f32; 2],
        indices: Range<usize>,
        seen: impl Fn(usize) -> bool,
    ) {
        for (pixel, index) in indices.enumerate() {
            if seen(pixel) {
                let len = self.len;
                (self.places[0][len], self.places[1][len]) = (x, y);
                self.indices[len] = index;
                self.len += 1;
            }
            x += 1.0;
        }
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.len
    }

    /// Evaluates all; `evaluate` is told places from the square's middle.
    #[inline(always)]
    fn fill<S: Simd>(&mut self, simd: S, evaluate: impl Fn([f32x16<S>; 2]) -> [f32x16<S>; 3]) {
        for first in (0..self.len).step_by(16) {
            let [x, y] =
                two!(|axis| f32x16::from_slice(simd, &self.places[axis][first..first + 16]));
            let levels = evaluate([x, y]);
            for channel in 0..3 {
                self.levels[channel][first..first + 16].copy_from_slice(levels[channel].as_slice());
            }
        }
    }

    /// Where they stand in the band, and their levels.
    pub fn levels(&self) -> impl Iterator<Item = (usize, [f32; 3])> {
        let levels = |pixel: usize| three!(|channel| self.levels[channel][pixel]);
        (0..self.len).map(move |pixel| (self.indices[pixel], levels(pixel)))
    }

    /// The same, and their display step.
    #[inline(always)]
    pub fn draw<S: Simd>(&self, simd: S, mut draw: impl FnMut(usize, u32)) {
        for first in (0..self.len).step_by(16) {
            let pixels = pack(three!(|channel| {
                let levels = &self.levels[channel][first..first + 16];
                display_bits(f32x16::from_slice(simd, levels))
            }));
            let indices = &self.indices[first..self.len.min(first + 16)];
            for (index, pixel) in indices.iter().zip(pixels.as_array()) {
                draw(*index, *pixel);
            }
        }
    }
}

/// The levels of a square's pixels.
#[derive(Clone, Copy, Debug)]
pub struct Levels {
    /// By row and channel.
    rows: [[[f32; MAX_SIDE]; 3]; MAX_SIDE],
    /// Where the square holds but a few.
    pub listed: Listed,
}

impl Default for Levels {
    fn default() -> Self {
        Levels {
            rows: [[[0.0; MAX_SIDE]; 3]; MAX_SIDE],
            listed: Listed::default(),
        }
    }
}

impl Levels {
    /// Those of a pixel, counted from the square's first.
    pub fn at(&self, column: usize, row: usize) -> [f32; 3] {
        self.rows[row].map(|channel| channel[column])
    }

    /// Evaluates what is covered of a region, sixteen pixels at a time; `evaluate` is told places from the square's middle, in
    /// pixels.
    #[inline(always)]
    pub fn fill<S: Simd>(
        &mut self,
        simd: S,
        region: &Region,
        evaluate: impl Fn([f32x16<S>; 2]) -> [f32x16<S>; 3],
    ) {
        if region.listed {
            return self.listed.fill(simd, evaluate);
        }
        let [left, top] = region.square.first().map(|first| first as f32);
        for part in region.square.parts() {
            let first = 16 * part;
            let x = counted(simd, first) + left;
            for (row, span) in region.covered() {
                if span.end <= first || first + 16 <= span.start {
                    continue;
                }
                let y = f32x16::splat(simd, row as i32 as f32 + top);
                let levels = evaluate([x, y]);
                for channel in 0..3 {
                    self.rows[row][channel][first..first + 16]
                        .copy_from_slice(levels[channel].as_slice());
                }
            }
        }
    }

    /// Takes what is covered of a region, one pixel at a time; `evaluate` is told its centre from the picture's middle.
    pub fn fill_each(&mut self, region: &Region, evaluate: impl Fn([f64; 2]) -> DVec3) {
        if region.listed {
            let [right, down] = region.middle();
            let Listed {
                len,
                places: [x, y],
                levels: kept,
                ..
            } = &mut self.listed;
            for pixel in 0..*len {
                let place = [f64::from(x[pixel]) + right, f64::from(y[pixel]) + down];
                let levels = evaluate(place).as_vec3();
                for channel in 0..3 {
                    kept[channel][pixel] = levels[channel];
                }
            }
            return;
        }
        for (row, span) in region.covered() {
            for column in span {
                let levels = evaluate(region.centre(column, row)).as_vec3();
                for channel in 0..3 {
                    self.rows[row][channel][column] = levels[channel];
                }
            }
        }
    }
}

/// `from`, `from` + 1, ...
#[inline(always)]
pub fn counted<S: Simd>(simd: S, from: usize) -> f32x16<S> {
    const LANES: [f32; 16] = [
        0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 12.0, 13.0, 14.0, 15.0,
    ];
    f32x16::simd_from(simd, LANES) + from as i32 as f32
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
        three!(|channel| f32x16::from_slice(
            self.simd,
            &self.levels.rows[row][channel][first..][..16]
        ))
    }
}

/// The contract's display step: `floor(clamp(level, 0, 255) + 0.5)`, NaN gives 0.
pub fn display_step(level: f64) -> u8 {
    let positive = if level > 0.0 { level } else { 0.0 };
    (positive.min(255.0) + 0.5).floor() as u8
}

/// Three levels after the display step, 0x00RRGGBB.
pub fn display_pixel(levels: [f64; 3]) -> u32 {
    let [red, green, blue] = levels.map(display_step);
    u32::from_be_bytes([0, red, green, blue])
}

/// 2^23: adding it to a float of 0..=255 leaves the nearest integer, halves to even, in the low bits.
const INTEGERS: f32 = 8_388_608.0;

/// The display step of levels in f32, the byte in the low bits and the rest as in [`INTEGERS`], without the saturating casts
/// that keep loops from vectorising: halves go up, and so does the one float below an odd half.
#[inline(always)]
pub(super) fn display_bits<S: Simd>(level: f32x16<S>) -> u32x16<S> {
    let simd = level.token();
    // A maximum may return either operand where one of them is not a number; a comparison is false there.
    let zero = f32x16::splat(simd, 0.0);
    let positive = level.simd_gt(zero).select(level, zero);
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
    fn what_is_not_a_number_is_black_at_every_simd_level() {
        for level in crate::simd::NAMES
            .into_iter()
            .filter_map(crate::simd::named)
        {
            let pixel = crate::simd::dispatch!(level, simd => {
                pack([display_bits(f32x16::splat(simd, f32::NAN)); 3]).as_array()[0]
            });
            assert_eq!(pixel, 0, "{}", crate::simd::name(level));
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
