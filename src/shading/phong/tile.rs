//! The lights of a face on four squares: their classification, and colours of squares that keep the tolerance.
//!
//! ```text
//!  light, square:   dark, n.l <= 0 all over      lit, n.l > 0 all over      crossing      unsure
//!                   highlight drawn, or so faint that it is left out
//! ```
//! The classification is done once. Where bounds leave something of the tolerance the square is interpolated through nine
//! samples; elsewhere the same lights are evaluated at its pixels.
//!
//! All decisions depend on the four squares and their face alone, so neither threads nor parts of a picture change them.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, mask64x4};

use super::Phong;
use crate::shading::field::{Field, Lanes, Places};
use crate::shading::interpolation::{Interpolant, LEBESGUE, sampled};
use crate::shading::lanes::{LaneLayout, Squares};
use crate::shading::rounding::Rounding;
use crate::shading::{U, bound, limit};
use crate::simd::{four, inlined, three};

/// The largest number of lights without a bound on a square at which its quarters are tried: with more of them, a quarter
/// hardly ever has bounds on all. Against 9, a frame of many lights on small faces takes 5 % fewer instructions (18 lights,
/// 480x360).
const UNSURE: f64 = 1.0;

/// A light on four squares, which it does not leave dark altogether. The sets are of these squares, a bit each.
#[derive(Clone, Copy, Debug)]
pub struct TileLight {
    /// Its index among the face's lights.
    pub light: usize,
    /// Where n.l <= 0 all over.
    pub dark: u64,
    /// Where its highlight is drawn.
    pub shines: u64,
    /// Where its terminator crosses and it has no highlight: an interpolated square may have one such light.
    pub crosses: u64,
    /// w (L - P).
    pub vector: [Squares; 3],
    /// Where |n.l| is smaller than this, the sign of n.l is in doubt and the highlight may jump.
    pub doubt: [f32; 4],
}

/// The lights of a face on four squares.
#[derive(Clone, Debug, Default)]
pub struct TileLights {
    pub lights: Vec<TileLight>,
    pub normal: [Squares; 3],
    pub eye: [Squares; 3],
    /// Where any highlight is drawn.
    pub shines: u64,
    /// Bounds on the errors of levels that are evaluated in f32, in levels: of rounding and of highlights that are left out.
    pub errors: [f64; 4],
}

impl Phong<'_> {
    /// See [`super::super::Shader::prepare`].
    #[inline(always)]
    pub fn prepare<S: Simd>(
        &self,
        simd: S,
        places: &Places<S>,
        interpolate: bool,
        tile: &mut TileLights,
    ) -> (Option<Interpolant<S>>, u64) {
        let (budget, promising) = self.classify(places, interpolate, tile);
        let interpolant = if budget.simd_gt(0.0).any_true() {
            Some(self.sample(simd, tile, budget))
        } else {
            None
        };
        (interpolant, promising)
    }

    /// The number of highlights evaluated at a pixel of one of four squares in f32, if f32 keeps the tolerance.
    pub fn single(&self, tile: &TileLights, index: usize) -> Option<usize> {
        let lights = tile.lights.iter();
        let highlights = lights.filter(|on| on.shines >> index & 1 == 1).count();
        // False for an error that is not a number.
        (tile.errors[index] <= limit(self.tolerance)).then_some(highlights)
    }

    /// Whether f32 has the signs of n.l and s at all pixels of one of four squares, wherever a highlight depends on them.
    pub fn has_signs(&self, tile: &TileLights, index: usize) -> bool {
        let mut shining = tile.lights.iter().filter(|on| on.shines >> index & 1 == 1);
        shining.all(|on| on.doubt[index] == 0.0 && self.gloss.doubt == 0.0)
    }

    /// The levels at a place on one of four squares, x and y from -1 to 1.
    #[inline(always)]
    pub fn pixel_levels<S: Simd>(
        &self,
        simd: S,
        tile: &TileLights,
        index: usize,
        place: [f32x16<S>; 2],
    ) -> [f32x16<S>; 3] {
        let [red, green, blue, _] = self.levels(simd, tile, LaneLayout::Pixels(index), place);
        [red, green, blue]
    }

    /// Classifies the lights on four squares. Returns the budget of each square: the tolerance less all bounded errors, at
    /// most 0 where an error has no bound; and the set of squares whose quarters are worth trying.
    #[inline(always)]
    fn classify<S: Simd>(
        &self,
        places: &Places<S>,
        interpolate: bool,
        tile: &mut TileLights,
    ) -> (Lanes<S>, u64) {
        let [middle, right, down] = places.number(self.face.plane.w.terms());
        let least = middle - right.abs() - down.abs();
        let simd = least.token();
        let number = inlined!(|number: f64| Lanes::splat(simd, number));
        let [zero, one, infinite] = [number(0.0), number(1.0), number(f64::INFINITY)];
        let none = mask64x4::splat(simd, false);
        let normal = Field::new(&self.normal, places);
        let eye = Field::new(&self.face.rays.to_eye, places);
        // Pixels of a sliver are clamped to the face, one by one.
        let steady = least.simd_gt(self.face.least_steady().max(0.0));
        let mut bounded = steady & normal.is_direction_bounded() & eye.is_direction_bounded();
        let mut budget = number(if interpolate { self.tolerance } else { -1.0 });
        let mut rounding = Rounding::new(&normal, &eye, self.brightest_ambient());
        let (mut lost, mut crossed, mut unsure) = (zero, none, zero);
        (tile.normal, tile.eye) = (normal.squares(), eye.squares());
        tile.shines = 0;
        tile.lights.clear();
        for (index, light) in self.lights.iter().enumerate() {
            let to_light = Field::new(&light.towards, places);
            let side = bound::side(&normal, &to_light);
            if side.dark.all_true() {
                continue;
            }
            let [diffuse, specular] = [number(light.most[0]), number(light.most[1])];
            let is_bounded = (bounded & budget.simd_gt(0.0)).any_true();
            let (mut shines, mut error, mut doubt) = (none, zero, zero);
            if light.most[0] > 0.0 {
                rounding.diffuse(&to_light, side.dark.select(zero, diffuse));
            }
            if light.most[1] > 0.0 {
                let reflection = bound::reflection(&normal, &to_light, &eye, side.cosine);
                shines = reflection.most.simd_gt(self.gloss.least) & !side.dark;
                lost += (shines | side.dark).select(zero, number(self.gloss.faint));
                let any_shines = shines.any_true();
                if any_shines {
                    rounding.specular(&to_light, shines.select(specular, zero), self.gloss);
                    let certain = side.lit | !shines;
                    doubt = certain.select(zero, rounding.cosine(&to_light) * U);
                }
                if is_bounded {
                    let power = bound::power(self.gloss.shininess, reflection.most);
                    error = power * specular;
                    if any_shines {
                        let bound = &self.gloss.bound;
                        let bound = bound.error(&normal, &to_light, &eye, &reflection, power);
                        error = shines.select(bound * specular, error);
                    }
                }
            }
            let mut cut = none;
            if interpolate {
                // One light of a square may cross n.l = 0 there, if its highlight is not drawn.
                let idle = mask64x4::splat(simd, light.most[0] == 0.0) & !shines;
                cut = !(side.lit | side.dark | idle | shines | crossed);
                crossed |= cut;
                let sure = to_light.is_direction_bounded() & (side.lit | side.dark | idle | cut);
                unsure += sure.select(zero, one);
                bounded &= sure;
                if is_bounded {
                    error += bound::cosine_error(&normal, &to_light) * diffuse;
                    budget -= side.dark.select(zero, error);
                }
            }
            tile.shines |= shines.to_bitmask();
            tile.lights.push(TileLight {
                light: index,
                dark: side.dark.to_bitmask(),
                shines: shines.to_bitmask(),
                crosses: cut.to_bitmask(),
                vector: to_light.squares(),
                doubt: four!(|square| doubt.as_array()[square] as f32),
            });
        }
        let rounding = rounding.levels();
        tile.errors = *steady.select(rounding + lost, infinite).as_array();
        let budget = bounded.select(budget - rounding * LEBESGUE, -one);
        let promising = steady & unsure.simd_le(UNSURE);
        (
            budget,
            if interpolate {
                promising.to_bitmask()
            } else {
                0
            },
        )
    }

    /// Colours of four squares through samples at nine nodes.
    #[inline(always)]
    fn sample<S: Simd>(&self, simd: S, tile: &TileLights, budget: Lanes<S>) -> Interpolant<S> {
        let zero = Lanes::splat(simd, 0.0);
        let sample = inlined!(|place| self.levels(simd, tile, LaneLayout::Nodes, place));
        let terms = sampled(simd, sample);
        let mut crossing = [zero; 3];
        let mut crosses = mask64x4::splat(simd, false);
        for on in tile.lights.iter().filter(|on| on.crosses != 0) {
            let own = mask64x4::from_bitmask(simd, on.crosses);
            let diffuse = self.lights[on.light].diffuse;
            crossing = three!(|channel| {
                let levels = Lanes::splat(simd, f64::from(diffuse[channel]));
                own.select(levels, crossing[channel])
            });
            crosses |= own;
        }
        Interpolant::new(terms, crossing, crosses, budget)
    }
}
