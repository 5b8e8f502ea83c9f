//! The biquadratic through nine samples, and the cheapest rows for it that keep the tolerance.
//!
//! ```text
//!   f at x, y in {-r, 0, r}, r = sqrt(3) / 2  -->  sum c[j][i] x^i y^j, i, j <= 2  -->  linear or quadratic rows
//! ```
//! x and y run from -1 to 1 over the square. Quadratic terms are dropped if the rest of the tolerance allows it: x^2 is
//! replaced by 1/2, the middle of its range, with an error of at most 1/2 (economization; Lanczos 1938).
//!
//! One light may be a fourth channel, of which each pixel makes its own term: max(0, n.l) where that crosses 0, or s^rho from
//! its logarithm.
//!
//! Values are multiples of 1/256 level if more than `FIXED_ERROR` levels of the tolerance are left and no channel leaves
//! `FIXED_RANGE`. Then no clamp is needed, or with a fourth channel one minimum, and a mask extracts the byte. Without these
//! rows a frame of bench-close takes 63 % more time, and without linear rows either 70 % more (Phong, tolerance 0.5, one thread).

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, f64x4};

use super::lanes::{SquareSet, has};
use super::rows::{LinearRows, QuadraticRows};
use super::square::Square;
use super::{SquareKind, U};
use crate::shading::simd::{four, inlined, three};

/// The outer node of three.
pub const NODE: f64 = 0.866_025_403_784_438_6;

/// The factor by which interpolation may amplify errors of the samples: the square of the Lebesgue constant 5/3 of three
/// nodes.
pub const AMPLIFICATION: f64 = 25.0 / 9.0;

/// The coefficients of a biquadratic polynomial, by power of y and of x.
pub type Biquadratic<T> = [[T; 3]; 3];

/// The polynomials of the three colour channels, and of the fourth channel.
pub type SquareColor<T> = [Biquadratic<T>; 4];

/// The index of the channel that one light may have to itself.
pub const FOURTH: usize = 3;

/// The coefficients of the quadratic through samples at the nodes.
#[inline(always)]
fn quadratic<S: Simd>([left, middle, right]: [f64x4<S>; 3]) -> [f64x4<S>; 3] {
    [
        middle,
        (right - left) * (0.5 / NODE),
        (right + left - middle * 2.0) * (0.5 / (NODE * NODE)),
    ]
}

/// The biquadratic through nine samples by row and column.
#[inline(always)]
pub fn biquadratic<S: Simd>(samples: &[[f64x4<S>; 3]; 3]) -> Biquadratic<f64x4<S>> {
    let rows = three!(|j| quadratic(samples[j]));
    let columns = three!(|i| quadratic([rows[0][i], rows[1][i], rows[2][i]]));
    three!(|j| three!(|i| columns[i][j]))
}

/// The biquadratics through samples at the nodes of some of the squares; 0 on the others.
#[inline(always)]
pub fn sampled<S: Simd>(
    simd: S,
    squares: SquareSet,
    sample: impl Fn(usize, [f32x16<S>; 2]) -> [f32x16<S>; 4],
) -> SquareColor<f64x4<S>> {
    // Row by row, in nine of the lanes.
    let node = inlined!(|index: usize| [-NODE as f32, 0.0, NODE as f32][index % 3]);
    let x = f32x16::from_fn(simd, node);
    let y = f32x16::from_fn(simd, inlined!(|lane: usize| node(lane / 3)));
    // By channel, node and square.
    let mut samples = [[[0.0_f32; 4]; 9]; 4];
    for square in (0..4).filter(|square| has(squares, *square)) {
        let channels = sample(square, [x, y]);
        for channel in 0..4 {
            let lanes = channels[channel].as_array();
            for node in 0..9 {
                samples[channel][node][square] = lanes[node];
            }
        }
    }
    let at = inlined!(|channel: usize, node: usize| {
        f64x4::from_fn(simd, |square| f64::from(samples[channel][node][square]))
    });
    four!(|channel| biquadratic(&three!(|row| three!(|column| at(
        channel,
        3 * row + column
    )))))
}

/// The rounding error of a value in a row, relative to the sum of the sizes of its terms:
///
/// ```text
///   operation            count   why
///   x^2 y^2                9     its coefficient, and two for each power of x and of y
///   fourth channel         3     the coefficient of its term, a product and a sum
///   display                2     the display step rounds the next larger float
/// ```
/// A thousandth is added, because each rounding enlarges the errors before it (`proofs/rows.v`).
///
/// Let F be the sum of the sizes of the terms of the fourth channel's polynomial. Its term is counted as F + 1, times its factor
/// in each colour channel. For max(0, n.l), F alone would do. For a highlight the polynomial is an exponent y, its term is 2^y, and
///
/// - y errs by d <= 9 U F, which is below 1 (`MAX_FOURTH`), so 2^y changes by at most the factor 1 + d;
/// - the power of two errs by 4.3 U, and five more roundings follow: 3 and 2 in the table;
/// - 2^y is below 1.3: s^rho is at most 1, and the error of its interpolated exponent is limited (`MAX_EXPONENT_ERROR`).
///
/// Together that is at most 1.3 (9 F + 4.3 + 5) U, which is less than 14 (F + 1) U.
pub(super) const ROW_ERROR: f64 = 14.001 * U;

/// The error of multiples of 1/256 level: at most four roundings to the nearest multiple, `proofs/fixed.g`. In quadratic rows these
/// are the constant, the sums over x and over y, and the sum with the fourth channel's term; in linear rows the levels at the start
/// of a row, and their change along x.
pub(super) const FIXED_ERROR: f64 = 2.0 / 256.0;

/// The levels that multiples of 1/256 can hold without a clamp: with a half added they stay within 0..256.
const FIXED_RANGE: [f64; 2] = [0.0, 255.49];

/// The largest levels that they can hold with a fourth channel, because its sums are clamped.
const FIXED_SUM: f64 = 16_000.0;

/// The largest size of the fourth channel: 9 U times this is below one.
const MAX_FOURTH: f64 = 1e6;

/// Colours of squares, x and y from -1 to 1 over each, and how each square is drawn.
pub struct Interpolant<S: Simd> {
    /// The fourth channel is n.l of the light that crosses 0 on the square, or log2(s^rho) of one highlight. Each pixel takes
    /// max(0, n.l), which does not enlarge an error: |max(0, a) - max(0, b)| <= |a - b|; or the power of two, whose error
    /// [`super::bound`] bounds.
    terms: SquareColor<f64x4<S>>,
    /// The factors of max(0, n.l) or s^rho of each square, in levels; 0 where there is no fourth channel.
    factors: [[f32; 3]; 4],
    /// None where the rest of the tolerance does not suffice or a sample is not a number.
    pub kinds: [Option<SquareKind>; 4],
    /// The squares whose three channels are linear.
    linear: SquareSet,
    /// The squares that are drawn in multiples of 1/256 level.
    fixed: SquareSet,
}

impl<S: Simd> Interpolant<S> {
    /// Chooses the cheapest rows whose error is at most the rest of the tolerance. The kind is `None` if nothing is left. Each
    /// square of `logarithms` has the logarithm of a highlight as its fourth channel.
    #[inline(always)]
    pub fn new(
        terms: SquareColor<f64x4<S>>,
        by_square: [[f32; 3]; 4],
        logarithms: SquareSet,
        rest: f64x4<S>,
    ) -> Self {
        let simd = rest.token();
        let zero = f64x4::splat(simd, 0.0);
        let [mut size, mut error] = [zero; 2];
        let factors = three!(|channel| {
            f64x4::from_fn(simd, |square| f64::from(by_square[square][channel]))
        });
        let has_fourth = (factors[0] + factors[1] + factors[2]).simd_gt(0.0);
        let most = has_fourth.select(zero + FIXED_SUM, zero + FIXED_RANGE[1]);
        let mut inside = rest.simd_gt(0.0);
        // A maximum may lose a NaN, so finiteness is tested on its own.
        let mut finite = inside;
        // See `ROW_ERROR`.
        let mut fourth = zero + 1.0;
        for [a, b, c] in terms[FOURTH] {
            fourth = fourth + a.abs() + b.abs() + c.abs();
        }
        for channel in 0..3 {
            let c = &terms[channel];
            // `beyond` is the sum of all nonlinear terms; `linear_error` is the error if x^2 and y^2 are replaced by 1/2.
            let [cubic, squared] = [c[1][2].abs() + c[2][1].abs(), c[0][2].abs() + c[2][0].abs()];
            let quartic = c[2][2].abs();
            let beyond = squared + c[1][1].abs() + cubic + quartic;
            let linear_error = (squared + cubic) * 0.5 + c[1][1].abs() + quartic * 0.75;
            let linear = c[0][1].abs() + c[1][0].abs();
            let radius = linear + beyond;
            inside = inside
                & (c[0][0] - radius).simd_ge(FIXED_RANGE[0])
                & (c[0][0] + radius + fourth * factors[channel]).simd_le(most);
            let all = c[0][0].abs() + radius + fourth * factors[channel];
            finite &= all.simd_lt(f64::INFINITY) & fourth.simd_lt(MAX_FOURTH);
            size = size.max(all);
            error = error.max(linear_error);
        }
        let rest = rest - size * ROW_ERROR;
        let fixed = inside & rest.simd_gt(FIXED_ERROR);
        let allowed = fixed.select(rest - FIXED_ERROR, rest);
        let possible = (finite & rest.simd_gt(0.0)).to_bitmask();
        let has_fourth = has_fourth.to_bitmask();
        let linear = error.simd_le(allowed).to_bitmask();
        let kinds = four!(|index| {
            let kind = if has(logarithms, index) {
                SquareKind::Highlight
            } else if has(has_fourth, index) {
                SquareKind::Terminator
            } else if has(linear, index) {
                SquareKind::Linear
            } else {
                SquareKind::Quadratic
            };
            has(possible, index).then_some(kind)
        });
        Interpolant {
            terms,
            factors: by_square,
            kinds,
            linear,
            fixed: fixed.to_bitmask(),
        }
    }

    /// The rows of one of the squares, if it is linear and in multiples of 1/256 level.
    #[inline(always)]
    pub fn linear_rows(&self, simd: S, index: usize, square: &Square) -> Option<LinearRows<S>> {
        let is_linear = self.kinds[index] == Some(SquareKind::Linear);
        (is_linear && has(self.fixed, index))
            .then(|| LinearRows::new(simd, &self.color(index, square), square))
    }

    /// The rows of one of the squares, of any kind.
    #[inline(always)]
    pub fn quadratic_rows(&self, simd: S, index: usize, square: &Square) -> QuadraticRows<S> {
        let kind = self.kinds[index].unwrap_or(SquareKind::Quadratic);
        let form = [self.linear, self.fixed].map(|squares| has(squares, index));
        let (color, factors) = (self.color(index, square), self.factors[index]);
        QuadraticRows::new(simd, color, square, form, kind, factors)
    }

    /// The polynomials of one of the squares, in pixels from its middle.
    #[inline(always)]
    fn color(&self, index: usize, square: &Square) -> SquareColor<f64> {
        let [x, y] = square.half().map(|half| 1.0 / half);
        let mut color = [[[0.0; 3]; 3]; 4];
        for channel in 0..4 {
            let c = three!(|j| three!(|i| self.terms[channel][j][i].as_array()[index]));
            // Linear form: x^2 and y^2 become 1/2.
            let middle = c[0][0] + (c[0][2] + c[2][0]) * 0.5 + c[2][2] * 0.25;
            let [right, down] = [c[0][1] + c[2][1] * 0.5, c[1][0] + c[1][2] * 0.5];
            let c = if channel < FOURTH && has(self.linear, index) {
                [[middle, right, 0.0], [down, 0.0, 0.0], [0.0; 3]]
            } else {
                c
            };
            let scales = [[1.0, x, x * x], [1.0, y, y * y]];
            color[channel] = three!(|j| three!(|i| c[j][i] * (scales[0][i] * scales[1][j])));
        }
        color
    }
}

#[cfg(test)]
mod tests;
