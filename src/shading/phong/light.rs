//! A light on four squares: whether it reaches them, how its terms are drawn, and their errors.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x4, mask64x4};

use crate::shading::U;
use crate::shading::affine::Affine;
use crate::shading::bound::{self, Reflection};
use crate::shading::gloss::Gloss;
use crate::shading::lanes::SquareSet;
use crate::shading::moving::{Extents, MovingVector};
use crate::shading::rounding::Rounding;
use crate::shading::simd::{four, inlined};
use crate::shading::specular::POWER_ERROR;

/// A point light on a face, and on the squares prepared last.
#[derive(Clone, Copy, Debug, Default)]
pub struct FaceLight {
    /// w (L - P).
    pub by_pixel: Affine,
    /// The factors of n.l and s^rho, in levels.
    pub diffuse: [f32; 3],
    pub specular: [f32; 3],
    /// The largest channel of each.
    pub most: [f64; 2],
    /// Where n.l may be above 0.
    pub reaches: SquareSet,
    /// Where its highlight is drawn.
    pub shines: SquareSet,
    /// Where the fourth channel is its n.l: max(0, n.l) has a kink there.
    pub kink: SquareSet,
    /// Where the fourth channel is the logarithm of its highlight.
    pub logarithm: SquareSet,
    /// `by_pixel`, scaled to length one at the middle of each square.
    pub by_square: [Affine<[f32; 4]>; 3],
    /// If |n.l| is smaller than this, f32 may have the wrong sign of n.l, on which the highlight depends.
    pub doubt: [f32; 4],
}

/// What four squares may still err by.
pub struct Budget<S: Simd> {
    /// The rest of the tolerance after the errors of interpolation and of missing highlights.
    pub rest: f64x4<S>,
    /// The rounding errors of samples and of pixels.
    pub rounding: Rounding<S>,
    /// The errors of the highlights that are left out.
    pub left_out: f64x4<S>,
    /// Where each error of interpolation has a bound.
    pub is_bounded: mask64x4<S>,
    /// Where a light has the fourth channel; everywhere if nothing is interpolated.
    pub is_fourth_taken: mask64x4<S>,
}

impl FaceLight {
    /// Classifies the light on squares, and takes its errors from their budget. `all_lit`: n.l > 0 all over the face.
    #[inline(always)]
    pub fn classify<S: Simd>(
        &mut self,
        gloss: &Gloss,
        [normal, eye]: [&MovingVector<S>; 2],
        extents: &Extents<S>,
        all_lit: mask64x4<S>,
        budget: &mut Budget<S>,
    ) {
        let simd = all_lit.token();
        let splat = inlined!(|number: f64| f64x4::splat(simd, number));
        let (zero, none) = (splat(0.0), mask64x4::splat(simd, false));
        let light = &MovingVector::new(&self.by_pixel, extents);
        let vectors = [normal, light, eye];
        let cosine_rounding = budget.rounding.cosine(light);
        let (cosine, lit, dark) = bound::facing(normal, light, cosine_rounding * U);
        let [lit, dark] = [lit | all_lit, dark & !all_lit];
        let diffuse = dark.select(zero, splat(self.most[0]));
        budget.rounding.add(diffuse, cosine_rounding);
        let error = bound::cosine_error(normal, light) * self.most[0];
        budget.rest -= dark.select(zero, error);
        let [mut shines, mut logarithm] = [none; 2];
        if self.most[1] > 0.0 {
            let reflection = bound::reflection(vectors, cosine);
            shines = reflection.most.simd_gt(gloss.drawn_above) & !dark;
            budget.left_out += (shines | dark).select(zero, splat(gloss.faint));
            let chord = budget.rounding.chord(light);
            let specular = shines.select(splat(self.most[1]), zero);
            let rounding = gloss.propagated(chord) + POWER_ERROR;
            budget.rounding.add(specular, rounding);
            let sets = [shines, lit & !budget.is_fourth_taken];
            let error;
            (error, logarithm) =
                self.highlight_error(gloss, vectors, reflection, chord, sets, budget.rest);
            budget.rest -= dark.select(zero, error);
        }
        // A polynomial may carry the kink max(0, n.l) of one light. The highlight of that light must be left out: it jumps at
        // n.l = 0, and no polynomial follows a jump.
        let adds_nothing = mask64x4::splat(simd, self.most[0] == 0.0) & !shines;
        let has_no_kink = lit | dark | adds_nothing;
        let kink = !(has_no_kink | shines | budget.is_fourth_taken);
        budget.is_fourth_taken |= kink | logarithm;
        budget.is_bounded &= light.is_direction_bounded() & (has_no_kink | kink);
        self.reaches = (!dark).to_bitmask();
        self.shines = shines.to_bitmask();
        self.kink = kink.to_bitmask();
        self.logarithm = logarithm.to_bitmask();
        self.by_square = light.single();
        let doubt = (lit | !shines).select(zero, cosine_rounding * U);
        self.doubt = four!(|square| doubt.as_array()[square] as f32);
    }

    /// The interpolation error of its highlight, in levels, and the squares on which its logarithm is interpolated: those where
    /// it may have the fourth channel, and the rest of the tolerance suffices for the logarithm but not for s^rho itself.
    /// `chord` is the rounding error of |r - o|, and the vectors are n, l and o.
    #[inline(always)]
    fn highlight_error<S: Simd>(
        &self,
        gloss: &Gloss,
        vectors: [&MovingVector<S>; 3],
        reflection: Reflection<S>,
        chord: f64x4<S>,
        [shines, may_have_fourth]: [mask64x4<S>; 2],
        rest: f64x4<S>,
    ) -> (f64x4<S>, mask64x4<S>) {
        let power = bound::power(gloss.shininess, reflection.most);
        // A highlight that is left out errs by its largest value.
        let (mut error, mut logarithm) = (power, shines & may_have_fourth);
        if shines.any_true() {
            let drawn = bound::highlight_error(gloss, vectors, reflection, power);
            error = shines.select(drawn, power);
            logarithm &= (error * self.most[1]).simd_gt(rest);
        }
        if logarithm.any_true() {
            let drawn = bound::logarithm_error(gloss, vectors, reflection, power, chord);
            logarithm &= (drawn * self.most[1]).simd_lt(rest);
            error = logarithm.select(drawn, error);
        }
        (error * self.most[1], logarithm)
    }
}
