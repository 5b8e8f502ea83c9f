//! The biquadratic through nine samples, and the cheapest rows for it that keep the tolerance.
//!
//! ```text
//!   f at x, y in {-r, 0, r}, r = sqrt(3) / 2  -->  sum c[j][i] x^i y^j, i, j <= 2  -->  constant, linear or quadratic rows
//! ```
//! x and y run from -1 to 1 over the square. Quadratic terms are dropped if the rest of the tolerance allows it: x^2 is
//! replaced by 1/2, the middle of its range, with an error of at most 1/2 (economization; Lanczos 1938).
//!
//! Values are multiples of 1/256 level if at least `FIXED` of the tolerance is left, no channel leaves 0 to 255 and no
//! terminator crosses. Then no clamp is needed, and a mask extracts the byte. Without these rows a frame of bench-close takes 63 % more
//! time, and without linear rows 70 % more (Phong, tolerance 0.5, one thread).

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, mask64x4};

use super::display::Sink;
use super::field::Lanes;
use super::rows::{Color, Curve, Ramp};
use super::square::Square;
use super::{TileKind, U};
use crate::simd::{four, three};

/// The outer node of three.
pub const NODE: f64 = 0.866_025_403_784_438_6;

/// The factor by which interpolation may enlarge errors of the samples: the square of the Lebesgue constant 5/3 of three nodes.
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
    three!(|j| three!(|i| columns[i][j]))
}

/// The biquadratics of four channels through samples at the nodes; the lanes of a sample belong to each square in turn.
#[inline(always)]
pub fn sampled<S: Simd>(
    simd: S,
    sample: impl Fn([f32x16<S>; 2]) -> [f32x16<S>; 4],
) -> [Nine<S>; 4] {
    let node = NODE as f32;
    // Lanes by node and square; the last four are not used.
    let mut x = [0.0; 16];
    x[..4].fill(-node);
    x[8..12].fill(node);
    let x = f32x16::simd_from(simd, x);
    let rows = three!(|row| sample([x, f32x16::splat(simd, [-node, 0.0, node][row])]));
    four!(|channel| {
        let samples = three!(|row| three!(|column| {
            let lanes = rows[row][channel].as_array();
            let samples = four!(|square| f64::from(lanes[4 * column + square]));
            Lanes::simd_from(simd, samples)
        }));
        biquadratic(&samples)
    })
}

/// The rounding error of a value in a row, relative to the sum of the sizes of its terms:
///
/// ```text
///   operation            count   why
///   x^2 y^2                9     its coefficient, and two for each power of x and of y
///   term that crosses      3     its coefficient, a product and a sum
///   display                2     the byte may be that of the next float
/// ```
/// and, as each rounding enlarges the errors before it, a thousandth: `proofs/rows.v`.
pub(super) const ROUNDING: f64 = 14.001 * U;

/// The error of multiples of 1/256 level: three roundings to the nearest multiple, `proofs/fixed.g`.
pub(super) const FIXED: f64 = 1.5 / 256.0;

/// The levels that multiples of 1/256 can hold without a clamp: with a half added they stay within 0..256.
const FIXED_RANGE: [f64; 2] = [0.0, 255.49];

/// Colours of four squares, x and y from -1 to 1 over each, and how each square is drawn.
pub struct Interpolant<S: Simd> {
    /// Three channels, then n.l of the light whose terminator crosses the square. Each pixel takes max(0, n.l), which does not
    /// enlarge an error: |max(0, a) - max(0, b)| <= |a - b|.
    terms: [Nine<S>; 4],
    /// The factors of that, in levels.
    crossing: [Lanes<S>; 3],
    /// None where the budget does not suffice or a sample is not a number.
    pub forms: [Option<Form>; 4],
}

/// How one square is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Form {
    /// Constant, linear, quadratic or terminator.
    pub kind: TileKind,
    /// Whether in multiples of 1/256 level.
    fixed: bool,
}

impl<S: Simd> Interpolant<S> {
    /// The cheapest rows that stay within the budget: the rest of the tolerance. A square with nothing left has no form.
    #[inline(always)]
    pub fn new(
        terms: [Nine<S>; 4],
        crossing: [Lanes<S>; 3],
        crosses: mask64x4<S>,
        budget: Lanes<S>,
    ) -> Self {
        let zero = Lanes::splat(budget.token(), 0.0);
        let [mut size, mut error, mut flat_error] = [zero; 3];
        let mut inside = budget.simd_gt(0.0);
        // A maximum may lose a NaN, so finiteness is tested on its own.
        let mut finite = inside;
        let mut cosine = zero;
        for [a, b, c] in terms[3] {
            cosine = cosine + a.abs() + b.abs() + c.abs();
        }
        for channel in 0..3 {
            let c = &terms[channel];
            // `beyond` is the sum of all nonlinear terms; `linear_error` is the error if x^2 and y^2 are replaced by 1/2.
            let [cubic, square] = [c[1][2].abs() + c[2][1].abs(), c[0][2].abs() + c[2][0].abs()];
            let quartic = c[2][2].abs();
            let beyond = square + c[1][1].abs() + cubic + quartic;
            let linear_error = (square + cubic) * 0.5 + c[1][1].abs() + quartic * 0.75;
            let linear = c[0][1].abs() + c[1][0].abs();
            let radius = linear + beyond;
            inside = inside
                & (c[0][0] - radius).simd_ge(FIXED_RANGE[0])
                & (c[0][0] + radius).simd_le(FIXED_RANGE[1]);
            let all = c[0][0].abs() + radius + cosine * crossing[channel];
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
        let crosses = crosses.to_bitmask();
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
            let fixed = is(steps) && !is(crosses);
            is(possible).then_some(Form { kind, fixed })
        });
        Interpolant {
            terms,
            crossing,
            forms,
        }
    }

    /// The colour of one of the squares in a form, where a unit is `x` and `y` half extents.
    #[inline(always)]
    fn color(&self, index: usize, form: Form, [x, y]: [f64; 2]) -> Color {
        let mut color = [[[0.0; 3]; 3]; 4];
        for channel in 0..4 {
            let c = three!(|j| three!(|i| self.terms[channel][j][i].as_array()[index]));
            // The middles of the ranges of x^2 and y^2 take their place.
            let middle = c[0][0] + (c[0][2] + c[2][0]) * 0.5 + c[2][2] * 0.25;
            let [right, down] = [c[0][1] + c[2][1] * 0.5, c[1][0] + c[1][2] * 0.5];
            let c = match form.kind {
                TileKind::Constant => [[middle, 0.0, 0.0], [0.0; 3], [0.0; 3]],
                TileKind::Linear => [[middle, right, 0.0], [down, 0.0, 0.0], [0.0; 3]],
                _ => c,
            };
            let scales = [[1.0, x, x * x], [1.0, y, y * y]];
            color[channel] = three!(|j| three!(|i| c[j][i] * (scales[0][i] * scales[1][j])));
        }
        color
    }
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
    let color = interpolant.color(index, form, square.half().map(|half| 1.0 / half));
    if form.fixed && matches!(form.kind, TileKind::Constant | TileKind::Linear) {
        sink.draw(&mut Ramp::new(simd, &color, square.first(), square.side));
    } else {
        let crossing = (form.kind == TileKind::Terminator)
            .then(|| three!(|channel| interpolant.crossing[channel].as_array()[index] as f32));
        sink.draw(&mut Curve::new(
            simd,
            &color,
            square.first(),
            form.fixed,
            crossing,
        ));
    }
}

#[cfg(test)]
mod tests;
