//! The lights of a face on four squares: their classification, bounds on the errors of the interpolated and of the evaluated
//! levels, and the evaluation of the model in lanes of f32.
//!
//! ```text
//!   on a square a light is       dark, n.l <= 0 all over      lit, n.l > 0 all over      crossing      unsure
//!   its highlight is             drawn, or so faint that it is left out
//!   levels                       ambient + sum of diffuse n.l + specular s^rho, where 1 - s = |r - o|^2 / 2
//! ```
//! The lights are classified once. If all errors together leave something of the tolerance, the square is interpolated through
//! nine samples. Otherwise the same lights are evaluated at its pixels. Samples and pixels share one function, whose rounding
//! errors [`super::rounding`] counts. For unit vectors 1 - s equals |r - o|^2 / 2, which loses no digits (Lyon 1993).
//!
//! f32 does not suffice where the sign of n.l is in doubt, because a highlight jumps there, and where |s| < 1/256 and
//! 0 < rho < 1, because the slope of s^rho is too steep. Such a pixel is marked by a level that is not a number, and evaluated
//! again in f64. Without these marks the whole square would be evaluated in f64.
//!
//! All decisions depend on the four squares and their face alone, so neither threads nor parts of a picture change them.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, f64x4, mask64x4};

use super::field::{Extents, Field};
use super::interpolation::{Interpolant, LEBESGUE, sampled};
use super::lanes::{LaneLayout, Squares, dot, has};
use super::phong::Phong;
use super::rounding::Rounding;
use super::specular::{self, POWER_ERROR};
use super::{U, bound, limit};
use crate::simd::{four, inlined, three};

/// The quarters of a square are tried if at most this many lights have no bound on it. With more of them, a quarter hardly ever
/// has bounds on all. Compared with 9, a frame of many lights on small faces takes 5 % fewer instructions (18 lights, 480x360).
const UNSURE: f64 = 1.0;

/// A light that may light at least one of four squares.
#[derive(Clone, Copy, Debug)]
pub struct TileLight {
    /// Its index among the face's lights.
    pub light: usize,
    /// Where n.l may be above 0.
    pub reaches: Squares,
    /// Where its highlight is drawn.
    pub shines: Squares,
    /// Where n.l may change its sign and its highlight is not drawn. An interpolated square may have one such light.
    pub crosses: Squares,
    /// w (L - P), scaled to length one at the middle of each square.
    pub vector: [[[f32; 4]; 3]; 3],
    /// If |n.l| is smaller than this, f32 may have the wrong sign of n.l, on which the highlight depends.
    pub doubt: [f32; 4],
}

/// The lights of a face on four squares.
#[derive(Clone, Debug, Default)]
pub struct TileLights {
    pub lights: Vec<TileLight>,
    /// w n and w (O - P), scaled likewise.
    pub normal: [[[f32; 4]; 3]; 3],
    pub eye: [[[f32; 4]; 3]; 3],
    /// Where any highlight is drawn.
    pub shines: Squares,
    /// Where levels in f32 keep the tolerance.
    pub in_f32: Squares,
}

impl TileLights {
    /// The lights whose highlights are evaluated at a pixel of a square in f32.
    pub fn highlights(&self, index: usize) -> impl Iterator<Item = &TileLight> {
        let lights = self.lights.iter();
        lights.filter(move |on| has(on.shines, index))
    }
}

impl Phong<'_> {
    /// See [`super::Shader::prepare`].
    #[inline(always)]
    pub fn prepare<S: Simd>(
        &self,
        simd: S,
        extents: &Extents<S>,
        interpolate: bool,
        tile: &mut TileLights,
    ) -> (Option<Interpolant<S>>, Squares) {
        let (budget, promising) = self.classify(extents, interpolate, tile);
        if !budget.simd_gt(0.0).any_true() {
            return (None, promising);
        }
        let zero = f64x4::splat(simd, 0.0);
        let sample = inlined!(|xy| self.levels(simd, tile, LaneLayout::Nodes, xy));
        let terms = sampled(simd, sample);
        let mut crossing = [zero; 3];
        let mut crosses = mask64x4::splat(simd, false);
        for on in tile.lights.iter().filter(|on| on.crosses != 0) {
            let own = mask64x4::from_bitmask(simd, on.crosses);
            let diffuse = self.lights[on.light].diffuse;
            crossing = three!(|channel| {
                let levels = f64x4::splat(simd, f64::from(diffuse[channel]));
                own.select(levels, crossing[channel])
            });
            crosses |= own;
        }
        let interpolant = Interpolant::new(terms, crossing, crosses, budget);
        (Some(interpolant), promising)
    }

    /// Whether f32 has the signs of n.l and s at all pixels of a square, wherever a highlight depends on them.
    pub fn has_signs(&self, tile: &TileLights, index: usize) -> bool {
        let mut highlights = tile.highlights(index);
        highlights.all(|on| on.doubt[index] == 0.0 && self.gloss.doubt == 0.0)
    }

    /// Classifies the lights on four squares. Returns the budget of each square, which is the tolerance minus all error bounds,
    /// and at most 0 where an error has no bound. Also returns the set of squares whose quarters are worth trying.
    #[inline(always)]
    fn classify<S: Simd>(
        &self,
        extents: &Extents<S>,
        interpolate: bool,
        tile: &mut TileLights,
    ) -> (f64x4<S>, Squares) {
        let [middle, right, down] = extents.affine(&self.face.w);
        let least = middle - right.abs() - down.abs();
        let simd = least.token();
        let splat = inlined!(|number: f64| f64x4::splat(simd, number));
        let [zero, one] = [splat(0.0), splat(1.0)];
        let none = mask64x4::splat(simd, false);
        let normal = Field::new(&self.normal, extents);
        let eye = Field::new(&self.face.rays.to_eye, extents);
        // Pixels of a sliver are clamped to the face, one by one.
        let steady = least.simd_gt(self.face.least_steady().max(0.0));
        let mut bounded = steady & normal.is_direction_bounded() & eye.is_direction_bounded();
        let mut budget = splat(if interpolate { self.tolerance } else { -1.0 });
        let ambient = self.surface.ambient().max_element();
        let mut rounding = Rounding::new(&normal, &eye, ambient);
        let (mut left_out, mut crossed, mut unsure) = (zero, none, zero);
        (tile.normal, tile.eye) = (normal.squares(), eye.squares());
        tile.shines = 0;
        tile.lights.clear();
        for (index, light) in self.lights.iter().enumerate() {
            let to_light = Field::new(&light.towards, extents);
            let roundings = rounding.cosine(&to_light);
            let (cosine, lit, dark) = bound::side(&normal, &to_light, roundings * U);
            if dark.all_true() {
                continue;
            }
            let [diffuse, specular] = [splat(light.most[0]), splat(light.most[1])];
            let is_bounded = (bounded & budget.simd_gt(0.0)).any_true();
            let (mut shines, mut error, mut doubt) = (none, zero, zero);
            if light.most[0] > 0.0 {
                rounding.add(dark.select(zero, diffuse), roundings);
            }
            if light.most[1] > 0.0 {
                let reflection = bound::reflection(&normal, &to_light, &eye, cosine);
                shines = reflection[0].simd_gt(self.gloss.least) & !dark;
                left_out += (shines | dark).select(zero, splat(self.gloss.faint));
                let any_shines = shines.any_true();
                if any_shines {
                    let chord = self.gloss.propagated(rounding.chord(&to_light));
                    rounding.add(shines.select(specular, zero), chord + POWER_ERROR);
                    doubt = (lit | !shines).select(zero, roundings * U);
                }
                if is_bounded {
                    let power = bound::power(self.gloss.shininess, reflection[0]);
                    error = power * specular;
                    if any_shines {
                        let bound = &self.gloss.bound;
                        let bound = bound.error(&normal, &to_light, &eye, reflection, power);
                        error = shines.select(bound * specular, error);
                    }
                }
            }
            let mut crosses = none;
            if interpolate {
                // One light of a square may cross n.l = 0 there, if its highlight is not drawn.
                let idle = mask64x4::splat(simd, light.most[0] == 0.0) & !shines;
                crosses = !(lit | dark | idle | shines | crossed);
                crossed |= crosses;
                let sure = to_light.is_direction_bounded() & (lit | dark | idle | crosses);
                unsure += sure.select(zero, one);
                bounded &= sure;
                if is_bounded {
                    error += bound::cosine_error(&normal, &to_light) * diffuse;
                    budget -= dark.select(zero, error);
                }
            }
            tile.shines |= shines.to_bitmask();
            tile.lights.push(TileLight {
                light: index,
                reaches: (!dark).to_bitmask(),
                shines: shines.to_bitmask(),
                crosses: crosses.to_bitmask(),
                vector: to_light.squares(),
                doubt: four!(|square| doubt.as_array()[square] as f32),
            });
        }
        let rounding = rounding.levels();
        tile.in_f32 = (steady & (rounding + left_out).simd_le(limit(self.tolerance))).to_bitmask();
        let budget = bounded.select(budget - rounding * LEBESGUE, -one);
        let promising = (steady & unsure.simd_le(UNSURE)).to_bitmask();
        (budget, if interpolate { promising } else { 0 })
    }

    /// The levels at points of squares, x and y from -1 to 1, and n.l of the light that crosses at nodes.
    #[inline(always)]
    pub fn levels<S: Simd>(
        &self,
        simd: S,
        tile: &TileLights,
        at: LaneLayout,
        xy: [f32x16<S>; 2],
    ) -> [f32x16<S>; 4] {
        let zero = f32x16::splat(simd, 0.0);
        let vector =
            inlined!(|of: &[[[f32; 4]; 3]; 3]| { three!(|axis| at.affine(&of[axis], xy)) });
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
        for on in tile.lights.iter().filter(|on| at.any(on.reaches)) {
            let light = &self.lights[on.light];
            let l = vector(&on.vector);
            let inverse = 1.0 / (n2 * dot(&l, &l)).sqrt();
            let cosine = dot(&n, &l) * inverse;
            if light.most[0] > 0.0 {
                let lit = cosine.max(zero);
                let (diffuse, mut set) = (light.diffuse, on.reaches);
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
