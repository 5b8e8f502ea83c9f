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

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16};

use super::lanes::{LaneLayout, Squares, dot};
use super::phong::{Phong, TileLights};
use super::specular;
use crate::simd::{inlined, three};

impl Phong<'_> {
    /// The levels at places on squares, x and y from -1 to 1, and n.l of the light that crosses at nodes.
    #[inline(always)]
    pub fn levels<S: Simd>(
        &self,
        simd: S,
        tile: &TileLights,
        at: LaneLayout,
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
                if let LaneLayout::Nodes = at {
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
