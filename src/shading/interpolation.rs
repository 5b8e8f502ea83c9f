//! Nine samples in, the cheapest rows that keep the tolerance out.
//!
//! ```text
//!   f at x, y in {-r, 0, r}, r = sqrt(3) / 2  -->  sum c[j][i] x^i y^j, i, j <= 2  -->  constant, linear or quadratic rows
//! ```
//! x and y run from -1 to 1 over the square. Terms that the rest of the tolerance allows to be left out are: x^2 is then
//! replaced by its mean 1/2, which leaves 1/2 (economization; Lanczos 1938).
//!
//! Rule: f32 rounds a value at most fourteen times at the size of the sum of its terms. Where the tolerance has `FIXED` to spare
//! and no channel leaves the display's range, values are formed in multiples of 1/256 level, so that nothing is left
//! to clamp and bytes only have to be cut out.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, mask64x4, u32x16};

use super::bound::{Lanes, Places};
use super::display::{Rows, display_step};
use super::kernel::Reals;
use super::square::{MAX_SIDE, Square};
use super::{Sink, TileKind, U};
use crate::simd::{four, inlined, three, two};

/// The outer node of three.
pub const NODE: f64 = 0.866_025_403_784_438_6;

/// How much interpolation may enlarge errors of the samples: the square of the Lebesgue constant 5/3 of three nodes.
pub const LEBESGUE: f64 = 25.0 / 9.0;

/// A channel's samples by row and column, or its coefficients by power of y and of x, on four squares.
pub type Nine<S> = [[Lanes<S>; 3]; 3];

/// The coefficients of the quadratic through samples at the nodes.
#[inline(always)]
fn quadratic<S: Simd>([left, middle, right]: [Lanes<S>; 3]) -> [Lanes<S>; 3] {
    [
        middle,
        (right - left) * (0.5 / NODE),
        (right + left - middle * 2.0) * (0.5 / (NODE * NODE)),
    ]
}

/// The coefficients of the biquadratic through nine samples.
#[inline(always)]
pub fn biquadratic<S: Simd>(samples: &Nine<S>) -> Nine<S> {
    let rows = three(
        #[inline(always)]
        |j| quadratic(samples[j]),
    );
    let columns = three(
        #[inline(always)]
        |i| quadratic([rows[0][i], rows[1][i], rows[2][i]]),
    );
    transposed(&columns)
}

/// What f32 makes of a value, over the size of its terms. A term x^2 y^2 is rounded once as a
/// coefficient, and at most twice for each power of x and of y: nine times. What is cut off is rounded three times more where it is multiplied and added, and the display may be that of
/// the next float, which is two.
const ROUNDING: f64 = 14.0 * U;

/// What multiples of 1/256 level cost: three roundings.
const FIXED: f64 = 1.5 / 256.0;

/// The levels that multiples of 1/256 can hold without a clamp: with a half added they stay within 0..256.
const FIXED_RANGE: [f64; 2] = [0.0, 255.49];

/// 1.5 * 2^15: a float added to it, of size below 2^14, is rounded to a multiple of 1/256 and stands, times 256, in the
/// low bits.
const PLACES: f32 = 49_152.0;

/// Colours of four squares, x and y from -1 to 1 over each.
pub struct Colors<S: Simd> {
    /// By channel, and then n.l of a light whose terminator crosses the square: cutting it off at zero at each pixel
    /// enlarges no error, for max(0, x) moves no more than x does.
    pub terms: [Nine<S>; 4],
    /// What that is multiplied with, in levels.
    pub crossing: [Lanes<S>; 3],
    /// Whether there is such a light.
    pub crosses: mask64x4<S>,
    /// What is left of the tolerance; a square with nothing left may not be drawn so.
    pub budget: Lanes<S>,
}

/// The same, and how each square is drawn.
pub struct Interpolant<S: Simd> {
    colors: Colors<S>,
    /// The best linear colours, by channel: the middle, and what x and y add.
    linear: [[Lanes<S>; 3]; 3],
    /// For each square a bit: whether it may be drawn; in multiples of 1/256 level; whether a light crosses it, more than a
    /// linear colour is needed, or more than one colour.
    possible: u64,
    fixed: u64,
    crosses: u64,
    curved: u64,
    sloped: u64,
}

/// The colour of one square, and n.l of the light that is cut off: `c[j][i]` for x^i y^j.
pub type Color = [[[f64; 3]; 3]; 4];

impl<S: Simd> Interpolant<S> {
    /// The cheapest rows that stay within the budget.
    #[inline(always)]
    pub fn new(colors: Colors<S>) -> Self {
        let budget = colors.budget;
        let zero = Lanes::splat(budget.token(), 0.0);
        let [mut size, mut curve, mut slope] = [zero; 3];
        let mut inside = budget.simd_gt(0.0);
        // What is not a number is smaller than nothing, and the larger of two may hide it.
        let mut finite = inside;
        let mut lit = zero;
        for terms in colors.terms[3] {
            lit = lit + terms[0].abs() + terms[1].abs() + terms[2].abs();
        }
        for channel in 0..3 {
            let c = &colors.terms[channel];
            // Of the terms beyond linear ones: all, and what stays when x^2 and y^2 are replaced by their means.
            let [cubic, square] = [c[1][2].abs() + c[2][1].abs(), c[0][2].abs() + c[2][0].abs()];
            let quartic = c[2][2].abs();
            let all = square + c[1][1].abs() + cubic + quartic;
            let rest = (square + cubic) * 0.5 + c[1][1].abs() + quartic * 0.75;
            let linear = c[0][1].abs() + c[1][0].abs();
            let sway = linear + all;
            inside = inside
                & (c[0][0] - sway).simd_ge(FIXED_RANGE[0])
                & (c[0][0] + sway).simd_le(FIXED_RANGE[1]);
            let all = c[0][0].abs() + sway + lit * colors.crossing[channel];
            finite &= all.simd_lt(f64::INFINITY);
            size = size.max(all);
            curve = curve.max(rest);
            slope = slope.max(linear + cubic * 0.5 + rest);
        }
        let left = budget - size * ROUNDING;
        let fixed = inside & left.simd_gt(FIXED);
        let rest = fixed.select(left - FIXED, left);
        Interpolant {
            linear: three(
                #[inline(always)]
                |channel| economized(&colors.terms[channel]),
            ),
            possible: (finite & left.simd_gt(0.0)).to_bitmask(),
            fixed: fixed.to_bitmask(),
            crosses: colors.crosses.to_bitmask(),
            curved: curve.simd_gt(rest).to_bitmask(),
            sloped: slope.simd_gt(rest).to_bitmask(),
            colors,
        }
    }

    /// How one of the squares is drawn; none where the budget does not suffice.
    #[inline(always)]
    pub fn form(&self, index: usize) -> Option<Form> {
        let is = |set: u64| set >> index & 1 == 1;
        if !is(self.possible) {
            return None;
        }
        let kind = if is(self.crosses) {
            TileKind::Terminator
        } else if is(self.curved) {
            TileKind::Quadratic
        } else if is(self.sloped) {
            TileKind::Linear
        } else {
            TileKind::Constant
        };
        Some(Form {
            kind,
            fixed: is(self.fixed),
        })
    }

    /// That of one of the squares, on its quarters.
    #[inline(always)]
    pub fn on_quarters(&self, index: usize, square: &Square, quarters: &[Square; 4]) -> Self {
        let Colors {
            terms,
            crossing,
            crosses,
            budget,
        } = &self.colors;
        let simd = budget.token();
        let splat = inlined(
            #[inline(always)]
            |lanes: Lanes<S>| Lanes::splat(simd, lanes.as_array()[index]),
        );
        let Places { middle, half } = Places::new(simd, quarters, square.middle());
        let scales = square.half().map(|half| 1.0 / half);
        let [starts, scales] = [middle, half].map(|[x, y]| [x * scales[0], y * scales[1]]);
        let terms = four(
            #[inline(always)]
            |channel| {
                let rows = three(
                    #[inline(always)]
                    |j| {
                        let terms = three(
                            #[inline(always)]
                            |i| splat(terms[channel][j][i]),
                        );
                        moved(terms, starts[0], scales[0])
                    },
                );
                let columns = three(
                    #[inline(always)]
                    |i| moved([rows[0][i], rows[1][i], rows[2][i]], starts[1], scales[1]),
                );
                transposed(&columns)
            },
        );
        Interpolant::new(Colors {
            terms,
            crossing: three(
                #[inline(always)]
                |channel| splat(crossing[channel]),
            ),
            crosses: mask64x4::splat(simd, crosses.test(index)),
            budget: splat(*budget),
        })
    }

    /// The colour of one of the squares, where a unit is `x` and `y` half extents.
    #[inline(always)]
    fn color(&self, index: usize, [x, y]: [f64; 2]) -> Color {
        let scales = [[1.0, x, x * x], [1.0, y, y * y]];
        let mut color = [[[0.0; 3]; 3]; 4];
        for channel in 0..4 {
            for j in 0..3 {
                for i in 0..3 {
                    let term = self.colors.terms[channel][j][i].as_array()[index];
                    color[channel][j][i] = term * (scales[0][i] * scales[1][j]);
                }
            }
        }
        color
    }
}

/// A quadratic in x = start + scale t, as one in t.
#[inline(always)]
fn moved<S: Simd>(c: [Lanes<S>; 3], start: Lanes<S>, scale: Lanes<S>) -> [Lanes<S>; 3] {
    let bend = c[2] * start;
    [
        c[0] + (c[1] + bend) * start,
        (c[1] + bend + bend) * scale,
        c[2] * scale * scale,
    ]
}

#[inline(always)]
fn transposed<S: Simd>(nine: &Nine<S>) -> Nine<S> {
    three(
        #[inline(always)]
        |j| {
            three(
                #[inline(always)]
                |i| nine[i][j],
            )
        },
    )
}

/// How one square is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Form {
    /// Constant, linear, quadratic or terminator.
    pub kind: TileKind,
    /// Whether in multiples of 1/256 level.
    fixed: bool,
}

/// The best linear colour: the means of the squares take the place of what is left out.
#[inline(always)]
fn economized<S: Simd>(c: &Nine<S>) -> [Lanes<S>; 3] {
    [
        c[0][0] + (c[0][2] + c[2][0]) * 0.5 + c[2][2] * 0.25,
        c[0][1] + c[2][1] * 0.5,
        c[1][0] + c[1][2] * 0.5,
    ]
}

/// Draws one of the squares of an interpolant.
#[inline(always)]
pub fn draw<S: Simd>(
    simd: S,
    interpolant: &Interpolant<S>,
    index: usize,
    form: Form,
    square: &Square,
    sink: &mut impl Sink<S>,
) {
    let first = square.first();
    let [width, height] = square.half();
    let [x, y] = [1.0 / width, 1.0 / height];
    let linear = three(
        #[inline(always)]
        |channel| {
            let [middle, right, down] = three(
                #[inline(always)]
                |term| interpolant.linear[channel][term].as_array()[index],
            );
            [middle, right * x, down * y]
        },
    );
    if form.kind == TileKind::Constant {
        let levels = linear.map(|[middle, ..]| middle);
        let [red, green, blue] = levels.map(display_step);
        let mut rows = Flat {
            simd,
            pixel: u32::from_be_bytes([0, red, green, blue]),
            levels: levels.map(|level| level as f32),
        };
        return sink.draw(&mut rows);
    }
    if form.kind == TileKind::Linear && form.fixed {
        return sink.draw(&mut Ramp::new(simd, &linear, square));
    }
    let color = if form.kind == TileKind::Linear {
        let [red, green, blue] =
            linear.map(|[middle, right, down]| [[middle, right, 0.0], [down, 0.0, 0.0], [0.0; 3]]);
        [red, green, blue, [[0.0; 3]; 3]]
    } else {
        interpolant.color(index, [x, y])
    };
    if form.kind == TileKind::Terminator {
        sink.draw(&mut Terminator {
            curve: Curve::new(simd, &color, first, 0.0),
            crossing: three(
                #[inline(always)]
                |channel| interpolant.colors.crossing[channel].as_array()[index] as f32,
            ),
        });
    } else if form.fixed {
        let bias = f64::from(PLACES) + 0.5;
        sink.draw(&mut FixedCurve(Curve::new(simd, &color, first, bias)));
    } else {
        sink.draw(&mut Curve::new(simd, &color, first, 0.0));
    }
}

/// One colour.
struct Flat<S: Simd> {
    simd: S,
    pixel: u32,
    levels: [f32; 3],
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
struct Ramp<'a, S: Simd> {
    /// For each channel the middle, and what a pixel to the right and one down add.
    colors: &'a [[f64; 3]; 3],
    starts: [[u32; MAX_SIDE]; 2],
    columns: [u32x16<S>; 2],
    /// The square's first column from the middle, in pixels.
    left: f32,
}

impl<'a, S: Simd> Ramp<'a, S> {
    #[inline(always)]
    fn new(simd: S, colors: &'a [[f64; 3]; 3], square: &Square) -> Self {
        let [left, top] = square.first();
        let mut starts = [[0; MAX_SIDE]; 2];
        for part in 0..square.side / 16 {
            let y = f32x16::count(simd, 16 * part) + top as f32;
            // A half is added here once: then the byte is the whole part.
            let pairs = paired(three(
                #[inline(always)]
                |channel| {
                    let [middle, _, down] = colors[channel];
                    y * down as f32 + (middle + 0.5) as f32
                },
            ));
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
        two(
            #[inline(always)]
            |pair| self.columns[pair] + self.starts[pair][row % MAX_SIDE],
        )
    }
}

/// Three channels in multiples of 1/256 level, as a [`Ramp`] has them.
#[inline(always)]
fn paired<S: Simd>(levels: [f32x16<S>; 3]) -> [u32x16<S>; 2] {
    let [red, green, blue] = three(
        #[inline(always)]
        |channel| (levels[channel] + PLACES).to_bits() - PLACES.to_bits(),
    );
    [(red << 16) + blue, green]
}

impl<S: Simd> Rows<S> for Ramp<'_, S> {
    #[inline(always)]
    fn go_to(&mut self, part: usize) {
        let x = f32x16::count(self.columns[0].token(), 16 * part) + self.left;
        self.columns = paired(three(
            #[inline(always)]
            |channel| x * self.colors[channel][1] as f32,
        ));
    }

    #[inline(always)]
    fn levels(&self, row: usize) -> [f32x16<S>; 3] {
        let [red_blue, green] = self.at(row);
        let places = [red_blue >> 16, green & 0xffff, red_blue & 0xffff];
        three(
            #[inline(always)]
            |channel| places[channel].to_float::<f32x16<S>>() * (1.0 / 256.0) - 0.5,
        )
    }

    #[inline(always)]
    fn pixels(&self, row: usize) -> u32x16<S> {
        let [red_blue, green] = self.at(row);
        ((red_blue >> 8) & 0x00ff_00ff) | (green & 0xff00)
    }
}

/// A quadratic of so many channels.
struct Curve<S: Simd, const CHANNELS: usize> {
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
    fn new(simd: S, color: &Color, first: [f64; 2], bias: f64) -> Self {
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
        let x = f32x16::count(self.terms[0][0].token(), 16 * part) + self.first[0];
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
struct Terminator<S: Simd> {
    curve: Curve<S, 4>,
    crossing: [f32; 3],
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
        three(
            #[inline(always)]
            |channel| levels[channel] + lit * self.crossing[channel],
        )
    }
}

/// A quadratic colour with [`PLACES`] and a half in its middle, so that it comes in multiples of 1/256 level.
struct FixedCurve<S: Simd>(Curve<S, 3>);

impl<S: Simd> Rows<S> for FixedCurve<S> {
    #[inline(always)]
    fn go_to(&mut self, part: usize) {
        self.0.go_to(part);
    }

    #[inline(always)]
    fn levels(&self, row: usize) -> [f32x16<S>; 3] {
        let levels = self.0.at(row);
        three(
            #[inline(always)]
            |channel| levels[channel] - PLACES - 0.5,
        )
    }

    #[inline(always)]
    fn pixels(&self, row: usize) -> u32x16<S> {
        let levels = self.0.at(row);
        let [red, green, blue] = three(
            #[inline(always)]
            |channel| levels[channel].to_bits(),
        );
        ((red << 8) & 0x00ff_0000) | (green & 0xff00) | ((blue >> 8) & 0xff)
    }
}

#[cfg(test)]
mod tests;
