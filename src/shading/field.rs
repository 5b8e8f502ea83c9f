//! Vectors that are affine in the pixel in, where they are on four squares side by side out.
//!
//! Rule: whatever is not a number makes lengths and rates that are none, which bound nothing.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x4, mask64x4};

use super::affine::Affine;
use super::interpolation::NODE;
use super::kernel::dot;
use super::rounding::Extent;
use super::square::Square;
use crate::components::length;
use crate::simd::{four, inlined, three, two};

/// A number for each of four squares.
pub type Lanes<S> = f64x4<S>;

/// The largest relative radius of a vector whose direction is bounded.
pub const MAX_RADIUS: f64 = 0.5;

/// The rounding of f64 may take this much off a vector product's length, relative to the factors: that is the square root of a
/// difference of squares, which errs by at most 34 roundings, and sqrt(34 2^-53) = 6.2e-8: `proofs/cross.g`.
pub(super) const CROSS_ERROR: f64 = 1e-7;

/// Four vectors.
pub type Vectors<S> = [Lanes<S>; 3];

/// Where four squares are: their middles in pixels from the picture's middle, and half their extents in pixels.
#[derive(Clone, Copy)]
pub struct Places<S: Simd> {
    pub middle: [Lanes<S>; 2],
    pub half: [Lanes<S>; 2],
}

impl<S: Simd> Places<S> {
    /// Those of four squares; their middles from `origin`, in pixels from the picture's corner.
    #[inline(always)]
    pub fn new(simd: S, [a, b, c, d]: &[Square; 4], origin: [f64; 2]) -> Self {
        let lanes = inlined!(|[a, b, c, d]: [[f64; 2]; 4], axis: usize| {
            Lanes::simd_from(simd, [a[axis], b[axis], c[axis], d[axis]])
        });
        let middles = [a.middle(), b.middle(), c.middle(), d.middle()];
        let halves = [a.half(), b.half(), c.half(), d.half()];
        Places {
            middle: two!(|axis| lanes(middles, axis) - origin[axis]),
            half: two!(|axis| lanes(halves, axis)),
        }
    }

    /// How many rows of sixteen pixels the squares have together, about, that have a positive budget.
    #[inline(always)]
    pub fn rows(&self, budget: Lanes<S>) -> f64 {
        let [width, height] = two!(|axis| self.half[axis] * 2.0 + 1.0);
        let rows = height * (width * (1.0 / 16.0)).max(Lanes::splat(width.token(), 1.0));
        let zero = Lanes::splat(width.token(), 0.0);
        budget
            .simd_gt(0.0)
            .select(rows, zero)
            .as_array()
            .iter()
            .sum()
    }

    /// One square, four times.
    #[inline(always)]
    pub fn single(simd: S, middle: [f64; 2], half: [f64; 2]) -> Self {
        Places {
            middle: two!(|axis| Lanes::splat(simd, middle[axis])),
            half: two!(|axis| Lanes::splat(simd, half[axis])),
        }
    }
}

/// A vector on four squares: `middle + right x + down y` for x and y from -1 to 1, the middle of length one.
#[derive(Clone, Copy)]
pub struct Field<S: Simd> {
    pub middle: Vectors<S>,
    pub right: Vectors<S>,
    pub down: Vectors<S>,
    /// Relative radius: how far the vector gets from its middle at most.
    pub radius: Lanes<S>,
    /// Its length is nowhere below this.
    pub shortest: Lanes<S>,
    /// p and q along x and along y: see [`super::bound`].
    pub rates: [[Lanes<S>; 2]; 2],
}

/// An affine vector, anchored at the picture's middle, and the lengths that a [`Field`] is bounded with.
#[derive(Clone, Copy, Debug, Default)]
pub struct Moving {
    pub vector: Affine,
    /// |V_x| and |V_y|, by pixel.
    lengths: [f64; 2],
    /// |V_x x V_y|.
    area: f64,
}

impl From<Affine> for Moving {
    /// No coordinate exceeds 1e100, so neither products nor lengths leave the range of f64.
    fn from(vector: Affine) -> Self {
        Moving {
            lengths: [vector.dx, vector.dy].map(length),
            area: length(vector.dx.cross(vector.dy)),
            vector,
        }
    }
}

impl<S: Simd> Field<S> {
    /// A vector on four squares.
    #[inline(always)]
    pub fn new(moving: &Moving, places: &Places<S>) -> Self {
        let Moving {
            vector,
            lengths,
            area,
        } = moving;
        let [x, y] = places.middle;
        let middle = three!(|axis| x * vector.dx[axis] + y * vector.dy[axis] + vector.centre[axis]);
        let inverse = 1.0 / dot(&middle, &middle).sqrt();
        let steps = two!(|axis| places.half[axis] * inverse);
        let [right, down] = [vector.dx, vector.dy];
        let [right_length, down_length] = two!(|axis| steps[axis] * lengths[axis]);
        let radius = right_length + down_length;
        // One over the least length of the vector.
        let most = 1.0 / (1.0 - radius);
        let parallelogram = steps[0] * steps[1] * *area;
        let middle = three!(|axis| middle[axis] * inverse);
        let [right, down] = [
            three!(|axis| steps[0] * right[axis]),
            three!(|axis| steps[1] * down[axis]),
        ];
        let along = [dot(&middle, &right), dot(&middle, &down)];
        // |a x b|^2 = |a|^2 |b|^2 - (a.b)^2 (Lagrange).
        let rates = inlined!(|along: Lanes<S>, length: Lanes<S>| {
            let cross = positive(length * length - along * along).sqrt() + parallelogram;
            let q = length * most;
            let p = (cross + length * CROSS_ERROR) * most * most;
            [p.min(q), q]
        });
        Field {
            middle,
            right,
            down,
            radius,
            // What it moves along its middle is all that can shorten it.
            shortest: 1.0 - along[0].abs() - along[1].abs(),
            rates: [rates(along[0], right_length), rates(along[1], down_length)],
        }
    }
}

impl<S: Simd> Field<S> {
    /// Whether its direction is bounded: the relative radius is below [`MAX_RADIUS`].
    #[inline(always)]
    pub fn is_direction_bounded(&self) -> mask64x4<S> {
        self.radius.simd_lt(MAX_RADIUS)
    }

    /// What rounding depends on, by square.
    #[inline(always)]
    pub fn extents(&self) -> [Extent; 4] {
        let (radius, shortest) = (self.radius.as_array(), self.shortest.as_array());
        four!(|square| Extent {
            radius: radius[square],
            shortest: shortest[square],
        })
    }

    /// At one of the nine nodes, by row and column.
    #[inline(always)]
    pub fn node(&self, row: usize, column: usize) -> Vectors<S> {
        let [x, y] = two!(|axis| NODE * ([column, row][axis] as f64 - 1.0));
        three!(|axis| self.middle[axis] + self.right[axis] * x + self.down[axis] * y)
    }
}

/// The least value of a scalar on four squares.
#[inline(always)]
pub fn least<S: Simd>(scalar: &Affine<f64>, places: &Places<S>) -> Lanes<S> {
    let ([x, y], [width, height]) = (places.middle, places.half);
    let middle = x * scalar.dx + y * scalar.dy + scalar.centre;
    middle - width * scalar.dx.abs() - height * scalar.dy.abs()
}

/// w on four squares over its value at the middle: what x and y add.
#[inline(always)]
pub fn relative<S: Simd>(w: &Affine<f64>, places: &Places<S>) -> [Lanes<S>; 3] {
    let [x, y] = places.middle;
    let middle = x * w.dx + y * w.dy + w.centre;
    [
        middle,
        places.half[0] * w.dx / middle,
        places.half[1] * w.dy / middle,
    ]
}

/// The number, or zero where it is negative.
#[inline(always)]
pub fn positive<S: Simd>(number: Lanes<S>) -> Lanes<S> {
    number.max(Lanes::splat(number.token(), 0.0))
}
