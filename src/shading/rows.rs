//! An interpolated colour in, rows of levels or of display bytes out.
//!
//! Rule: levels are those of the polynomial, within what its form was chosen for; bytes are the display step of levels.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, u32x16};

use super::display::{Rows, counted};
use super::interpolation::Color;
use super::square::{MAX_SIDE, Square};
use crate::simd::{three, two};

/// 1.5 * 2^15: a float added to it, of size below 2^14, is rounded to a multiple of 1/256 and stands, times 256, in the
/// low bits.
const PLACES: f32 = 49_152.0;

/// One colour.
pub struct Flat<S: Simd> {
    pub simd: S,
    pub pixel: u32,
    pub levels: [f32; 3],
}

impl<S: Simd> Rows<S> for Flat<S> {
    #[inline(always)]
    fn go_to(&mut self, _part: usize) {}

    #[inline(always)]
    fn levels(&self, _row: usize) -> [f32x16<S>; 3] {
        self.levels.map(|level| f32x16::splat(self.simd, level))
    }

    #[inline(always)]
    fn pixels(&self, _row: usize) -> u32x16<S> {
        u32x16::splat(self.simd, self.pixel)
    }
}

/// A linear colour in multiples of 1/256 level: red and blue in the upper and the lower half of one integer, green in
/// another; a start for each row and what each column adds. Borrows between the halves cancel, since each channel's sum is
/// within 0..65536.
pub struct Ramp<'a, S: Simd> {
    /// For each channel the middle, and what a pixel to the right and one down add.
    colors: &'a [[f64; 3]; 3],
    starts: [[u32; MAX_SIDE]; 2],
    columns: [u32x16<S>; 2],
    /// The square's first column from the middle, in pixels.
    left: f32,
}

impl<'a, S: Simd> Ramp<'a, S> {
    /// On a square; `colors` in pixels from its middle.
    #[inline(always)]
    pub fn new(simd: S, colors: &'a [[f64; 3]; 3], square: &Square) -> Self {
        let [left, top] = square.first();
        let mut starts = [[0; MAX_SIDE]; 2];
        for part in 0..square.side / 16 {
            let y = counted(simd, 16 * part) + top as f32;
            // A half is added here once: then the byte is the whole part.
            let pairs = paired(three!(|channel| {
                let [middle, _, down] = colors[channel];
                y * down as f32 + (middle + 0.5) as f32
            }));
            for pair in 0..2 {
                starts[pair][16 * part..16 * part + 16].copy_from_slice(pairs[pair].as_slice());
            }
        }
        Ramp {
            colors,
            starts,
            columns: [u32x16::splat(simd, 0); 2],
            left: left as f32,
        }
    }

    /// Red and blue, and green.
    #[inline(always)]
    fn at(&self, row: usize) -> [u32x16<S>; 2] {
        two!(|pair| self.columns[pair] + self.starts[pair][row % MAX_SIDE])
    }
}

/// Three channels in multiples of 1/256 level, as a [`Ramp`] has them.
#[inline(always)]
fn paired<S: Simd>(levels: [f32x16<S>; 3]) -> [u32x16<S>; 2] {
    let [red, green, blue] =
        three!(|channel| (levels[channel] + PLACES).to_bits() - PLACES.to_bits());
    [(red << 16) + blue, green]
}

impl<S: Simd> Rows<S> for Ramp<'_, S> {
    #[inline(always)]
    fn go_to(&mut self, part: usize) {
        let x = counted(self.columns[0].token(), 16 * part) + self.left;
        self.columns = paired(three!(|channel| x * self.colors[channel][1] as f32));
    }

    #[inline(always)]
    fn levels(&self, row: usize) -> [f32x16<S>; 3] {
        let [red_blue, green] = self.at(row);
        let places = [red_blue >> 16, green & 0xffff, red_blue & 0xffff];
        three!(|channel| places[channel].to_float::<f32x16<S>>() * (1.0 / 256.0) - 0.5)
    }

    #[inline(always)]
    fn pixels(&self, row: usize) -> u32x16<S> {
        let [red_blue, green] = self.at(row);
        ((red_blue >> 8) & 0x00ff_00ff) | (green & 0xff00)
    }
}

/// A quadratic of so many channels.
pub struct Curve<S: Simd, const CHANNELS: usize> {
    /// By power of y and of x.
    color: [[[f32; 3]; 3]; CHANNELS],
    /// In sixteen columns: by power of y.
    terms: [[f32x16<S>; 3]; CHANNELS],
    /// The square's first pixel from the middle, in pixels.
    first: [f32; 2],
}

impl<S: Simd, const CHANNELS: usize> Curve<S, CHANNELS> {
    /// `color` in pixels from a middle, `first` the square's first pixel from there; `bias` is added to all levels.
    #[inline(always)]
    pub fn new(simd: S, color: &Color, first: [f64; 2], bias: f64) -> Self {
        let mut single = [[[0.0; 3]; 3]; CHANNELS];
        for channel in 0..CHANNELS {
            for j in 0..3 {
                for i in 0..3 {
                    let bias = if i + j == 0 { bias } else { 0.0 };
                    single[channel][j][i] = (color[channel][j][i] + bias) as f32;
                }
            }
        }
        Curve {
            color: single,
            terms: [[f32x16::splat(simd, 0.0); 3]; CHANNELS],
            first: first.map(|first| first as f32),
        }
    }

    #[inline(always)]
    fn go_to(&mut self, part: usize) {
        let x = counted(self.terms[0][0].token(), 16 * part) + self.first[0];
        for channel in 0..CHANNELS {
            for j in 0..3 {
                let [middle, slope, bend] = self.color[channel][j];
                self.terms[channel][j] = (x * bend + slope) * x + middle;
            }
        }
    }

    #[inline(always)]
    fn at(&self, row: usize) -> [f32x16<S>; CHANNELS] {
        let y = self.first[1] + row as i32 as f32;
        let mut levels = self.terms.each_ref().map(|terms| terms[0]);
        for channel in 0..CHANNELS {
            let [_, slope, bend] = self.terms[channel];
            levels[channel] += (bend * y + slope) * y;
        }
        levels
    }
}

impl<S: Simd> Rows<S> for Curve<S, 3> {
    #[inline(always)]
    fn go_to(&mut self, part: usize) {
        self.go_to(part);
    }

    #[inline(always)]
    fn levels(&self, row: usize) -> [f32x16<S>; 3] {
        self.at(row)
    }
}

/// A quadratic colour and one light more that is cut off where n.l is below zero.
pub struct Terminator<S: Simd> {
    pub curve: Curve<S, 4>,
    pub crossing: [f32; 3],
}

impl<S: Simd> Rows<S> for Terminator<S> {
    #[inline(always)]
    fn go_to(&mut self, part: usize) {
        self.curve.go_to(part);
    }

    #[inline(always)]
    fn levels(&self, row: usize) -> [f32x16<S>; 3] {
        let [red, green, blue, lit] = self.curve.at(row);
        let lit = lit.max(f32x16::splat(lit.token(), 0.0));
        let levels = [red, green, blue];
        three!(|channel| levels[channel] + lit * self.crossing[channel])
    }
}

/// A quadratic colour with `PLACES` and a half in its middle, so that it comes in multiples of 1/256 level.
pub struct FixedCurve<S: Simd>(Curve<S, 3>);

impl<S: Simd> FixedCurve<S> {
    /// See [`Curve::new`].
    #[inline(always)]
    pub fn new(simd: S, color: &Color, first: [f64; 2]) -> Self {
        FixedCurve(Curve::new(simd, color, first, f64::from(PLACES) + 0.5))
    }
}

impl<S: Simd> Rows<S> for FixedCurve<S> {
    #[inline(always)]
    fn go_to(&mut self, part: usize) {
        self.0.go_to(part);
    }

    #[inline(always)]
    fn levels(&self, row: usize) -> [f32x16<S>; 3] {
        let levels = self.0.at(row);
        three!(|channel| levels[channel] - PLACES - 0.5)
    }

    #[inline(always)]
    fn pixels(&self, row: usize) -> u32x16<S> {
        let levels = self.0.at(row);
        let [red, green, blue] = three!(|channel| levels[channel].to_bits());
        ((red << 8) & 0x00ff_0000) | (green & 0xff00) | ((blue >> 8) & 0xff)
    }
}
