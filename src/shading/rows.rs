//! Colours of a square row by row, as levels or as bytes: a linear or biquadratic polynomial, or the model at every pixel.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, u32x16};

use super::SquareKind;
use super::display::display;
use super::interpolation::{FOURTH, SquareColor};
use super::specular::exp2;
use super::square::{MAX_SIDE, Square};
use crate::shading::simd::{four, three, two};

/// The colours of a square, evaluated in sixteen columns at a time.
pub trait Rows<S: Simd> {
    /// Selects the sixteen columns that start at column `16 * part` of the square.
    fn go_to(&mut self, part: usize);

    /// Their levels in a row of the square, unclamped.
    fn levels(&self, row: usize) -> [f32x16<S>; 3];

    /// Their bytes in a row of the square, 0x00RRGGBB.
    #[inline(always)]
    fn pixels(&self, row: usize) -> u32x16<S> {
        display(self.levels(row))
    }
}

/// `from`, `from` + 1, ...
#[inline(always)]
pub fn counted<S: Simd>(simd: S, from: usize) -> f32x16<S> {
    f32x16::from_fn(simd, |lane| lane as f32) + from as i32 as f32
}

/// 1.5 * 2^15: adding it to a float of size below 2^14 rounds the float to a multiple of 1/256, and the low bits of the sum are
/// 256 times that.
const FIXED_OFFSET: f32 = 49_152.0;
/// The same plus a half: then the whole part is the byte.
const BIAS: f64 = 49_152.5;
/// The largest of them whose byte does not overflow.
const FIXED_MOST: f32 = FIXED_OFFSET + 256.0 - 1.0 / 256.0;

/// A linear colour in multiples of 1/256 level, with a half added so that truncation rounds. Two integers hold three channels:
/// `red << 16 | blue`, and green, so one addition adds two channels. A negative change of blue borrows 1 from red. Its addition to
/// the start of the row carries 1 back, because the sum of blue is within 0..65536 (`FIXED_RANGE`).
pub struct LinearRows<S: Simd> {
    /// The levels at the start of each row, and the changes from there to each column of the part.
    starts: [[u32; MAX_SIDE]; 2],
    columns: [u32x16<S>; 2],
    /// The change from column to column, in levels.
    right: [f32; 3],
    /// The square's first column from the middle, in pixels.
    left: f32,
}

impl<S: Simd> LinearRows<S> {
    /// `color` is in pixels from the square's middle.
    #[inline(always)]
    pub fn new(simd: S, color: &SquareColor<f64>, square: &Square) -> Self {
        let [left, top] = square.first();
        let mut starts = [[0; MAX_SIDE]; 2];
        for first in (0..square.side).step_by(16) {
            let y = counted(simd, first) + top as f32;
            // With a half added, the byte is the whole part.
            let pairs = paired(three!(|channel| {
                let [[middle, ..], [down, ..], _] = color[channel];
                y * down as f32 + (middle + 0.5) as f32
            }));
            for pair in 0..2 {
                starts[pair][first..first + 16].copy_from_slice(pairs[pair].as_slice());
            }
        }
        LinearRows {
            starts,
            columns: [u32x16::splat(simd, 0); 2],
            right: three!(|channel| color[channel][0][1] as f32),
            left: left as f32,
        }
    }

    /// Red and blue, and green.
    #[inline(always)]
    fn at(&self, row: usize) -> [u32x16<S>; 2] {
        two!(|pair| self.columns[pair] + self.starts[pair][row % MAX_SIDE])
    }
}

/// Three channels in multiples of 1/256 level, as a [`LinearRows`] has them.
#[inline(always)]
fn paired<S: Simd>(levels: [f32x16<S>; 3]) -> [u32x16<S>; 2] {
    let [red, green, blue] =
        three!(|channel| (levels[channel] + FIXED_OFFSET).to_bits() - FIXED_OFFSET.to_bits());
    [(red << 16) + blue, green]
}

impl<S: Simd> Rows<S> for LinearRows<S> {
    #[inline(always)]
    fn go_to(&mut self, part: usize) {
        let x = counted(self.columns[0].token(), 16 * part) + self.left;
        self.columns = paired(three!(|channel| x * self.right[channel]));
    }

    #[inline(always)]
    fn levels(&self, row: usize) -> [f32x16<S>; 3] {
        let [red_blue, green] = self.at(row);
        let parts = [red_blue >> 16, green & 0xffff, red_blue & 0xffff];
        three!(|channel| parts[channel].to_float::<f32x16<S>>() * (1.0 / 256.0) - 0.5)
    }

    #[inline(always)]
    fn pixels(&self, row: usize) -> u32x16<S> {
        let [red_blue, green] = self.at(row);
        ((red_blue >> 8) & 0x00ff_00ff) | (green & 0xff00)
    }
}

/// A biquadratic colour, and max(0, n.l) or s^rho of one light.
pub struct QuadraticRows<S: Simd> {
    color: SquareColor<f32>,
    /// In sixteen columns: by power of y.
    terms: [[f32x16<S>; 3]; 4],
    /// The square's first pixel from the middle, in pixels.
    first: [f32; 2],
    /// Whether the three channels are linear.
    linear: bool,
    /// Whether [`FIXED_OFFSET`] and a half are part of the levels, so that these come in multiples of 1/256.
    fixed: bool,
    kind: SquareKind,
    /// The factors of max(0, n.l) or s^rho, in levels.
    factors: [f32; 3],
}

impl<S: Simd> QuadraticRows<S> {
    /// `color` is in pixels from the square's middle.
    #[inline(always)]
    pub fn new(
        simd: S,
        mut color: SquareColor<f64>,
        square: &Square,
        [linear, fixed]: [bool; 2],
        kind: SquareKind,
        factors: [f32; 3],
    ) -> Self {
        for channel in &mut color[..FOURTH] {
            channel[0][0] += if fixed { BIAS } else { 0.0 };
        }
        QuadraticRows {
            color: four!(|channel| three!(|j| three!(|i| color[channel][j][i] as f32))),
            terms: [[f32x16::splat(simd, 0.0); 3]; 4],
            first: square.first().map(|first| first as f32),
            linear,
            fixed,
            kind,
            factors,
        }
    }

    /// A channel in a row.
    #[inline(always)]
    fn at(&self, row: usize, channel: usize) -> f32x16<S> {
        let y = self.first[1] + row as i32 as f32;
        let [middle, slope, bend] = self.terms[channel];
        (bend * y + slope) * y + middle
    }

    /// The three channels in a row, with [`BIAS`] where they are fixed. A sum with a term of one light is at most `most`.
    #[inline(always)]
    fn sums(&self, row: usize, most: f32) -> [f32x16<S>; 3] {
        let levels = if self.linear {
            let y = self.first[1] + row as i32 as f32;
            three!(|channel| self.terms[channel][1] * y + self.terms[channel][0])
        } else {
            three!(|channel| self.at(row, channel))
        };
        let term = match self.kind {
            SquareKind::Terminator => {
                let cosine = self.at(row, FOURTH);
                cosine.max(f32x16::splat(cosine.token(), 0.0))
            }
            SquareKind::Highlight => exp2(self.at(row, FOURTH)),
            _ => return levels,
        };
        let most = f32x16::splat(term.token(), most);
        three!(|channel| (levels[channel] + term * self.factors[channel]).min(most))
    }
}

impl<S: Simd> Rows<S> for QuadraticRows<S> {
    #[inline(always)]
    fn go_to(&mut self, part: usize) {
        let x = counted(self.terms[0][0].token(), 16 * part) + self.first[0];
        for channel in 0..4 {
            for j in 0..3 {
                let [middle, slope, bend] = self.color[channel][j];
                self.terms[channel][j] = (x * bend + slope) * x + middle;
            }
        }
    }

    #[inline(always)]
    fn levels(&self, row: usize) -> [f32x16<S>; 3] {
        let sums = self.sums(row, f32::INFINITY);
        if self.fixed {
            three!(|channel| sums[channel] - FIXED_OFFSET - 0.5)
        } else {
            sums
        }
    }

    #[inline(always)]
    fn pixels(&self, row: usize) -> u32x16<S> {
        if self.fixed {
            let sums = self.sums(row, FIXED_MOST);
            let [red, green, blue] = three!(|channel| sums[channel].to_bits());
            ((red << 8) & 0x00ff_0000) | (green & 0xff00) | ((blue >> 8) & 0xff)
        } else {
            display(self.sums(row, f32::INFINITY))
        }
    }
}

/// Levels that are evaluated at every pixel, from its position on the square: x and y from -1 to 1.
pub struct EvaluatedRows<S: Simd, F> {
    evaluate: F,
    /// The square's first pixel from the middle of what is covered, in pixels, and the inverse half extents.
    first: [f32; 2],
    scale: [f32; 2],
    x: f32x16<S>,
}

impl<S: Simd, F> EvaluatedRows<S, F> {
    #[inline(always)]
    pub fn new(simd: S, square: &Square, evaluate: F) -> Self {
        EvaluatedRows {
            evaluate,
            first: square.first().map(|first| first as f32),
            scale: square.half().map(|half| (1.0 / half) as f32),
            x: f32x16::splat(simd, 0.0),
        }
    }
}

impl<S: Simd, F: Fn([f32x16<S>; 2]) -> [f32x16<S>; 3]> Rows<S> for EvaluatedRows<S, F> {
    #[inline(always)]
    fn go_to(&mut self, part: usize) {
        self.x = (counted(self.x.token(), 16 * part) + self.first[0]) * self.scale[0];
    }

    #[inline(always)]
    fn levels(&self, row: usize) -> [f32x16<S>; 3] {
        let y = (self.first[1] + row as i32 as f32) * self.scale[1];
        (self.evaluate)([self.x, f32x16::splat(self.x.token(), y)])
    }
}
