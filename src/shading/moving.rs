//! Vectors that are affine in the pixel, on squares: how far they move, and how fast their directions turn.
//!
//! Where a vector is zero at the middle of a square, its lengths and rates are NaN or infinite. No comparison takes
//! them for a bound.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x4, mask64x4};

use super::affine::Affine;
use super::lanes::{cross, dot};
use super::square::Square;
use crate::components::Lens;
use crate::shading::simd::{four, inlined, three, two};

/// The largest relative radius of a vector whose direction is bounded.
pub const MAX_RADIUS: f64 = 0.5;

/// The error of a vector product's length, relative to the lengths of a and b. It is computed as sqrt(|a|^2 |b|^2 - (a.b)^2),
/// whose radicand errs by at most 34 roundings: sqrt(34 2^-53) = 6.2e-8, `proofs/cross.g`.
pub(super) const CROSS_ERROR: f64 = 1e-7;

/// Four squares: their middles from the picture's middle, and half their extents, in pixels.
#[derive(Clone, Copy)]
pub struct Extents<S: Simd> {
    pub middle: [f64x4<S>; 2],
    pub half: [f64x4<S>; 2],
}

impl<S: Simd> Extents<S> {
    /// Those of squares of the picture of a lens.
    #[inline(always)]
    pub fn new(simd: S, squares: &[Square; 4], lens: &Lens) -> Self {
        let middles = four!(|square| squares[square].middle());
        let halves = four!(|square| squares[square].half());
        Extents {
            middle: two!(|axis| f64x4::from_fn(simd, |it| middles[it][axis]) - lens.middle[axis]),
            half: two!(|axis| f64x4::from_fn(simd, |it| halves[it][axis])),
        }
    }

    /// Those of one square, four times.
    #[inline(always)]
    pub fn of_one(simd: S, square: &Square, lens: &Lens) -> Self {
        let (middle, half) = (square.middle(), square.half());
        Extents {
            middle: two!(|axis| f64x4::splat(simd, middle[axis] - lens.middle[axis])),
            half: two!(|axis| f64x4::splat(simd, half[axis])),
        }
    }

    /// Numbers that are affine in the pixel, each on its square.
    #[inline(always)]
    pub fn affine_each(&self, numbers: &[Affine<f64>; 4]) -> Affine<f64x4<S>> {
        let [x, y] = self.middle;
        let lanes = inlined!(|of: fn(&Affine<f64>) -> f64| {
            f64x4::from_fn(x.token(), |square| of(&numbers[square]))
        });
        let [dx, dy] = [lanes(|it| it.dx), lanes(|it| it.dy)];
        Affine {
            centre: x * dx + y * dy + lanes(|it| it.centre),
            dx: self.half[0] * dx,
            dy: self.half[1] * dy,
        }
    }

    /// A number that is affine in the pixel, on the squares.
    #[inline(always)]
    pub fn affine(&self, number: &Affine<f64>) -> Affine<f64x4<S>> {
        let [x, y] = self.middle;
        Affine {
            centre: x * number.dx + y * number.dy + number.centre,
            dx: self.half[0] * number.dx,
            dy: self.half[1] * number.dy,
        }
    }
}

/// A vector on squares.
#[derive(Clone, Copy)]
pub struct MovingVector<S: Simd> {
    /// Scaled to length one at the middle of each square.
    pub vector: Affine<[f64x4<S>; 3]>,
    /// How far it moves from its value at the middle, at most.
    pub radius: f64x4<S>,
    /// The angle by which its direction turns from that at the middle, at most.
    pub turn: f64x4<S>,
    /// A lower bound of its length.
    pub shortest: f64x4<S>,
    /// The bounds p and q of [`super::bound`], along x and along y.
    pub rates: [[f64x4<S>; 2]; 2],
}

impl<S: Simd> MovingVector<S> {
    /// Its direction is not bounded where the square of its length exceeds the range of f64.
    #[inline(always)]
    pub fn new(vector: &Affine, extents: &Extents<S>) -> Self {
        let [x, y] = extents.middle;
        let middle = three!(|axis| x * vector.dx[axis] + y * vector.dy[axis] + vector.centre[axis]);
        let inverse = 1.0 / dot(&middle, &middle).sqrt();
        let steps = two!(|axis| extents.half[axis] * inverse);
        let [right, down] = [vector.dx, vector.dy];
        let middle = three!(|axis| middle[axis] * inverse);
        let [right, down] = [
            three!(|axis| steps[0] * right[axis]),
            three!(|axis| steps[1] * down[axis]),
        ];
        let length = inlined!(|vector: &[f64x4<S>; 3]| dot(vector, vector).sqrt());
        let [right_length, down_length] = [length(&right), length(&down)];
        let infinite = f64x4::splat(inverse.token(), f64::INFINITY);
        let is_finite = inverse.simd_gt(0.0);
        let radius = is_finite.select(right_length + down_length, infinite);
        let parallelogram = length(&cross(&right, &down));
        let along = [dot(&middle, &right), dot(&middle, &down)];
        // A change perpendicular to the vector at the middle makes it no shorter.
        let shortest = 1.0 - along[0].abs() - along[1].abs();
        let inverse = 1.0 / shortest;
        // |V x V_x|: the part of V_x perpendicular to V; |a x b|^2 = |a|^2 |b|^2 - (a.b)^2 (Lagrange).
        let across = inlined!(|along: f64x4<S>, length: f64x4<S>| {
            positive(length * length - along * along).sqrt() + length * CROSS_ERROR
        });
        let across = [
            across(along[0], right_length),
            across(along[1], down_length),
        ];
        // For p: (V + y V_y) x V_x = V x V_x + y V_y x V_x, over the least |V|^2.
        let rates = inlined!(|across: f64x4<S>, length: f64x4<S>| {
            let q = length * inverse;
            let p = (across + parallelogram) * inverse * inverse;
            [p.min(q), q]
        });
        MovingVector {
            vector: Affine::new(middle, right, down),
            radius,
            // The tangent of the angle is the part perpendicular to V at the middle over the part along it, and the angle is at
            // most its tangent. Motion along V itself turns nothing.
            turn: (across[0] + across[1]) * inverse,
            shortest,
            rates: [
                rates(across[0], right_length),
                rates(across[1], down_length),
            ],
        }
    }

    /// Whether its direction is bounded: the relative radius is below [`MAX_RADIUS`].
    #[inline(always)]
    pub fn is_direction_bounded(&self) -> mask64x4<S> {
        self.radius.simd_lt(MAX_RADIUS)
    }

    /// The rounding error of its direction in f32, in units of U; [`super::rounding`] derives it.
    #[inline(always)]
    pub fn direction_rounding(&self) -> f64x4<S> {
        let infinite = f64x4::splat(self.radius.token(), f64::INFINITY);
        let error = (self.radius * 6.0 + 3.0) / self.shortest;
        self.shortest.simd_gt(0.0).select(error, infinite)
    }

    /// The vector in f32.
    #[inline(always)]
    pub fn single(&self) -> [Affine<[f32; 4]>; 3] {
        three!(|axis| single(
            self.vector
                .map(inlined!(|vector: [f64x4<S>; 3]| vector[axis]))
        ))
    }
}

/// An affine number in f32.
#[inline(always)]
pub fn single<S: Simd>(number: Affine<f64x4<S>>) -> Affine<[f32; 4]> {
    number.map(inlined!(|term: f64x4<S>| four!(
        |square| term.as_array()[square] as f32
    )))
}

/// The number, or zero where it is negative.
#[inline(always)]
pub fn positive<S: Simd>(number: f64x4<S>) -> f64x4<S> {
    number.max(f64x4::splat(number.token(), 0.0))
}
