//! Sixteen lanes of f32, which hold either nodes of four squares or pixels of one square.
//!
//! Squares are prepared in fours, because a bound in f64 fills four lanes. Three nodes of each of the four squares fill twelve lanes.
//! Four neighbours in a row of the grid are prepared together, and the four quarters of a square.

use std::ops::{Add, Mul, Sub};

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x4, f32x16, mask32x16};

use super::affine::Affine;
use crate::shading::simd::{inlined, three};

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

/// Which squares the sixteen lanes belong to.
#[derive(Clone, Copy)]
pub enum LaneLayout {
    /// Lane i belongs to square i % 4.
    Nodes,
    /// All lanes belong to this square.
    Pixels(usize),
}

impl LaneLayout {
    /// Whether any lane is in a set of squares.
    #[inline(always)]
    pub fn any(self, set: SquareSet) -> bool {
        match self {
            LaneLayout::Nodes => set != 0,
            LaneLayout::Pixels(square) => has(set, square),
        }
    }

    /// A number of each square, in its lanes.
    #[inline(always)]
    pub fn lanes<S: Simd>(self, simd: S, squares: &[f32; 4]) -> f32x16<S> {
        match self {
            LaneLayout::Nodes => f32x16::block_splat(f32x4::simd_from(simd, *squares)),
            LaneLayout::Pixels(square) => f32x16::splat(simd, squares[square]),
        }
    }

    /// An affine number at points of the squares, x and y from -1 to 1.
    #[inline(always)]
    pub fn affine<S: Simd>(self, of: &Affine<[f32; 4]>, [x, y]: [f32x16<S>; 2]) -> f32x16<S> {
        let lanes = inlined!(|term: &[f32; 4]| self.lanes(x.token(), term));
        x * lanes(&of.dx) + (y * lanes(&of.dy) + lanes(&of.centre))
    }

    /// `number` in the lanes of the squares of `set`, 0 in the others. The square of [`LaneLayout::Pixels`] must be in `set`:
    /// callers have asked [`LaneLayout::any`].
    #[inline(always)]
    pub fn within<S: Simd>(self, simd: S, set: SquareSet, number: f32) -> f32x16<S> {
        let number = f32x16::splat(simd, number);
        match self {
            LaneLayout::Nodes => {
                mask32x16::from_bitmask(simd, set * 0x1111).select(number, f32x16::splat(simd, 0.0))
            }
            LaneLayout::Pixels(square) => {
                debug_assert!(has(set, square));
                number
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shading::simd::baseline;

    #[test]
    fn each_square_has_its_own_lanes() {
        assert!(!LaneLayout::Nodes.any(0));
        for square in 0..4 {
            let set = 1 << square;
            assert!(LaneLayout::Nodes.any(set));
            let within = LaneLayout::Nodes.within(baseline(), set, 7.0);
            for lane in 0..16 {
                assert_eq!(within[lane] == 7.0, lane % 4 == square);
            }
            for other in 0..4 {
                assert_eq!(LaneLayout::Pixels(other).any(set), other == square);
            }
        }
    }
}
