//! The illumination model in lanes of f32, at nodes of four squares or at pixels of one.
//!
//! ```text
//!   N, L, O --> n.l = N.L / |N| |L|        |r - o|^2 / 2 = 1 - s --> s^rho        levels += diffuse n.l + specular s^rho
//! ```
//! 1 - s is formed as |r - o|^2 / 2, which holds for unit vectors and cancels nothing (Lyon 1993). Nodes and pixels are
//! evaluated by the same lines; their rounding errors are counted in [`super::rounding`].
//!
//! Where n.l or s is so near 0 that its sign is in doubt, a highlight may jump; the result is then not a number, and the
//! pixel is evaluated in f64. Without these marks such squares were evaluated in f64 throughout.

use std::ops::{Add, Mul};

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x4, f32x16, mask32x16};

use super::phong::{Phong, TileLights};
use super::specular;
use crate::simd::{inlined, three};

/// The scalar product.
#[inline(always)]
pub fn dot<V: Copy + Add<Output = V> + Mul<Output = V>>(a: &[V; 3], b: &[V; 3]) -> V {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// An affine number on four squares: its value at the middle, and its changes from there to the right and to the lower edge;
/// by square. A vector is three of them; its length at the middle is one.
pub type Squares = [[f32; 4]; 3];

/// The squares that the sixteen lanes belong to.
#[derive(Clone, Copy)]
pub enum At {
    /// Each of the four in turn.
    Nodes,
    /// One of them.
    Pixels(usize),
}

impl At {
    /// Whether any lane is in a set of squares, a bit each.
    #[inline(always)]
    pub fn any(self, set: u64) -> bool {
        match self {
            At::Nodes => set != 0,
            At::Pixels(square) => set >> square & 1 == 1,
        }
    }

    /// A number of each square, in its lanes.
    #[inline(always)]
    fn lanes<S: Simd>(self, simd: S, squares: &[f32; 4]) -> f32x16<S> {
        match self {
            At::Nodes => {
                let four = f32x4::simd_from(simd, *squares);
                let eight = four.combine(four);
                eight.combine(eight)
            }
            At::Pixels(square) => f32x16::splat(simd, squares[square]),
        }
    }

    /// An affine number at places on the squares, x and y from -1 to 1.
    #[inline(always)]
    pub fn number<S: Simd>(self, of: &Squares, [x, y]: [f32x16<S>; 2]) -> f32x16<S> {
        let [middle, right, down] = three!(|term| self.lanes(x.token(), &of[term]));
        x * right + (y * down + middle)
    }

    /// A number in the lanes of a set of squares, zero elsewhere; one lane at least is in the set.
    #[inline(always)]
    fn within<S: Simd>(self, simd: S, set: u64, number: f32) -> f32x16<S> {
        let number = f32x16::splat(simd, number);
        match self {
            At::Nodes => {
                mask32x16::from_bitmask(simd, set * 0x1111).select(number, f32x16::splat(simd, 0.0))
            }
            At::Pixels(_) => number,
        }
    }
}

impl Phong<'_> {
    /// The levels at places on squares, x and y from -1 to 1, and n.l of the light that crosses at nodes.
    #[inline(always)]
    pub fn levels<S: Simd>(
        &self,
        simd: S,
        tile: &TileLights,
        at: At,
        place: [f32x16<S>; 2],
    ) -> [f32x16<S>; 4] {
        let zero = f32x16::splat(simd, 0.0);
        let vector = inlined!(|of: &[Squares; 3]| { three!(|axis| at.number(&of[axis], place)) });
        let unit = inlined!(|vector: [f32x16<S>; 3]| {
            let inverse = 1.0 / dot(&vector, &vector).sqrt();
            three!(|axis| vector[axis] * inverse)
        });
        let normal = vector(&tile.normal);
        // Unit vectors are for highlights: without one n.l takes a single root, and exact frames 5 % less time.
        let (n, o, n2) = if at.any(tile.shines) {
            (unit(normal), unit(vector(&tile.eye)), zero + 1.0)
        } else {
            (normal, normal, dot(&normal, &normal))
        };
        let [red, green, blue] = three!(|channel| f32x16::splat(simd, self.ambient[channel]));
        let mut levels = [red, green, blue, zero];
        for on in tile.lights.iter().filter(|on| at.any(!on.dark & 0b1111)) {
            let light = &self.lights[on.light];
            let l = vector(&on.vector);
            let inverse = 1.0 / (n2 * dot(&l, &l)).sqrt();
            let cosine = dot(&n, &l) * inverse;
            if light.most[0] > 0.0 {
                let lit = cosine.max(zero);
                let (diffuse, mut set) = (light.diffuse, !on.dark & 0b1111);
                if let At::Nodes = at {
                    set &= !on.crosses;
                    levels[3] += cosine * at.within(simd, on.crosses, 1.0);
                }
                for channel in 0..3 {
                    levels[channel] += lit * at.within(simd, set, diffuse[channel]);
                }
            }
            if at.any(on.shines) {
                let twice = cosine + cosine;
                let e = three!(|axis| n[axis] * twice - l[axis] * inverse - o[axis]);
                let one_minus_cos = dot(&e, &e) * 0.5;
                let power = specular::power(self.gloss.shininess, one_minus_cos);
                let power = cosine.simd_gt(zero).select(power, zero);
                for channel in 0..3 {
                    levels[channel] += power * at.within(simd, on.shines, light.specular[channel]);
                }
                let doubt = cosine.abs().simd_lt(at.lanes(simd, &on.doubt))
                    | (1.0 - one_minus_cos).abs().simd_lt(self.gloss.doubt);
                levels[0] = doubt.select(f32x16::splat(simd, f32::NAN), levels[0]);
            }
        }
        levels
    }
}
