//! Nine samples in, the cheapest rows that keep the tolerance out.
//!
//! ```text
//!   f at x, y in {-r, 0, r}, r = sqrt(3) / 2  -->  sum c[j][i] x^i y^j, i, j <= 2  -->  constant, linear or quadratic rows
//! ```
//! x and y run from -1 to 1 over the square. Terms are left out where the rest of the tolerance allows it. x^2 is then replaced
//! by 1/2, the middle of its range, which errs by at most 1/2 (economization; Lanczos 1938).
//!
//! Rule: f32 rounds a value at most fourteen times at the size of the sum of its terms. Where the tolerance has `FIXED` to spare
//! and no channel leaves the display's range, values are formed in multiples of 1/256 level, so that nothing is left
//! to clamp and bytes only have to be cut out.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, mask64x4};

use super::display::display_pixel;
use super::field::Lanes;
use super::rows::{Curve, FixedCurve, Flat, Ramp, Terminator};
use super::square::Square;
use super::{Sink, TileKind, U};
use crate::simd::{four, three};

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
    let rows = three!(|j| quadratic(samples[j]));
    let columns = three!(|i| quadratic([rows[0][i], rows[1][i], rows[2][i]]));
    transposed(&columns)
}

/// The rounding error of a value in a row, relative to the sum of the sizes of its terms:
///
/// ```text
///   x^2 y^2: its coefficient, and two for each power of x and of y      9 U
///   the term that crosses zero: a product and two sums more             3 U
///   the display step may be that of the next float                      2 U
/// ```
/// and, as each rounding enlarges the errors before it, a thousandth: `proofs/rows.v`.
pub(super) const ROUNDING: f64 = 14.001 * U;

/// What multiples of 1/256 level cost: three roundings, `proofs/fixed.g`.
pub(super) const FIXED: f64 = 1.5 / 256.0;

/// The levels that multiples of 1/256 can hold without a clamp: with a half added they stay within 0..256.
const FIXED_RANGE: [f64; 2] = [0.0, 255.49];

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
    /// How each is drawn; none where the budget does not suffice.
    pub forms: [Option<Form>; 4],
}

/// The colour of one square, and n.l of the light that is cut off: `c[j][i]` for x^i y^j.
pub type Color = [[[f64; 3]; 3]; 4];

impl<S: Simd> Interpolant<S> {
    /// The cheapest rows that stay within the budget.
    #[inline(always)]
    pub fn new(colors: Colors<S>) -> Self {
        let budget = colors.budget;
        let zero = Lanes::splat(budget.token(), 0.0);
        let [mut size, mut error, mut flat_error] = [zero; 3];
        let mut inside = budget.simd_gt(0.0);
        // A maximum may lose what is not a number, so finiteness is tested on its own.
        let mut finite = inside;
        let mut cosine = zero;
        for terms in colors.terms[3] {
            cosine = cosine + terms[0].abs() + terms[1].abs() + terms[2].abs();
        }
        for channel in 0..3 {
            let c = &colors.terms[channel];
            // Of the terms beyond linear ones: all, and what stays when x^2 and y^2 are replaced by 1/2.
            let [cubic, square] = [c[1][2].abs() + c[2][1].abs(), c[0][2].abs() + c[2][0].abs()];
            let quartic = c[2][2].abs();
            let beyond = square + c[1][1].abs() + cubic + quartic;
            let linear_error = (square + cubic) * 0.5 + c[1][1].abs() + quartic * 0.75;
            let linear = c[0][1].abs() + c[1][0].abs();
            let radius = linear + beyond;
            inside = inside
                & (c[0][0] - radius).simd_ge(FIXED_RANGE[0])
                & (c[0][0] + radius).simd_le(FIXED_RANGE[1]);
            let all = c[0][0].abs() + radius + cosine * colors.crossing[channel];
            finite &= all.simd_lt(f64::INFINITY);
            size = size.max(all);
            error = error.max(linear_error);
            flat_error = flat_error.max(linear + cubic * 0.5 + linear_error);
        }
        let left = budget - size * ROUNDING;
        let fixed = inside & left.simd_gt(FIXED);
        let allowed = fixed.select(left - FIXED, left);
        let possible = (finite & left.simd_gt(0.0)).to_bitmask();
        let steps = fixed.to_bitmask();
        let crosses = colors.crosses.to_bitmask();
        let curved = error.simd_gt(allowed).to_bitmask();
        let sloped = flat_error.simd_gt(allowed).to_bitmask();
        let forms = four!(|index| {
            let is = |set: u64| set >> index & 1 == 1;
            let kind = if is(crosses) {
                TileKind::Terminator
            } else if is(curved) {
                TileKind::Quadratic
            } else if is(sloped) {
                TileKind::Linear
            } else {
                TileKind::Constant
            };
            let fixed = is(steps);
            is(possible).then_some(Form { kind, fixed })
        });
        Interpolant {
            linear: three!(|channel| economized(&colors.terms[channel])),
            forms,
            colors,
        }
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

#[inline(always)]
fn transposed<S: Simd>(nine: &Nine<S>) -> Nine<S> {
    three!(|j| three!(|i| nine[i][j]))
}

/// How one square is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Form {
    /// Constant, linear, quadratic or terminator.
    pub kind: TileKind,
    /// Whether in multiples of 1/256 level.
    fixed: bool,
}

/// The best linear colour: the middles of the squares' ranges take the place of what is left out.
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
    let linear = three!(|channel| {
        let [middle, right, down] =
            three!(|term| interpolant.linear[channel][term].as_array()[index]);
        [middle, right * x, down * y]
    });
    if form.kind == TileKind::Constant {
        let levels = linear.map(|[middle, ..]| middle);
        let mut rows = Flat {
            simd,
            pixel: display_pixel(levels),
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
            crossing: three!(
                |channel| interpolant.colors.crossing[channel].as_array()[index] as f32
            ),
        });
    } else if form.fixed {
        sink.draw(&mut FixedCurve::new(simd, &color, first));
    } else {
        sink.draw(&mut Curve::new(simd, &color, first, 0.0));
    }
}

#[cfg(test)]
mod tests;
