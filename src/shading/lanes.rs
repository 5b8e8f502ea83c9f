//! Lanes: four of f64 hold a bound of four squares, sixteen of f32 hold nodes or pixels of one square.
//!
//! Squares are prepared in fours, because a bound in f64 fills four lanes: four neighbours in a row of the grid, and the four
//! quarters of a square. No bound and no sample of a square depends on the other three.

use std::ops::{Add, Mul, Sub};

use fearless_simd::{Simd, f32x16};

use super::affine::Affine;
use crate::shading::simd::three;

/// The scalar product.
#[inline(always)]
pub fn dot<V: Copy + Add<Output = V> + Mul<Output = V>>(a: &[V; 3], b: &[V; 3]) -> V {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The vector product.
#[inline(always)]
pub fn cross<V: Copy + Sub<Output = V> + Mul<Output = V>>(a: &[V; 3], b: &[V; 3]) -> [V; 3] {
    three!(|axis| {
        let [next, last] = [(axis + 1) % 3, (axis + 2) % 3];
        a[next] * b[last] - a[last] * b[next]
    })
}

/// A set of the four squares that are prepared together: bit i stands for square i.
pub type SquareSet = u64;

/// Whether a square is in a set.
pub fn has(set: SquareSet, square: usize) -> bool {
    set >> square & 1 == 1
}

/// A number that is affine on squares, at points of one of them, x and y from -1 to 1.
#[inline(always)]
pub fn affine_at<S: Simd>(
    of: &Affine<[f32; 4]>,
    square: usize,
    [x, y]: [f32x16<S>; 2],
) -> f32x16<S> {
    x * of.dx[square] + (y * of.dy[square] + of.centre[square])
}
