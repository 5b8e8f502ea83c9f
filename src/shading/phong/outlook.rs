//! A tile and its lights in; what light can do there, bounded before any pixel is looked at, out.
//!
//! ```text
//!   N.N  L.L  O.O  N.L  N.O  L.O  -->  sign and polynomial of n.l, least 1 - o.r
//! ```
//! Rule: where n.l cannot be bounded there is a terminator, where a highlight cannot be bounded it shines.

use fearless_simd::Simd;
use glam::DVec3;

use super::by_pixel::ByPixel;
use super::products::{Own, Shared, ToLight, Vectors};
use super::{Phong, SMOOTHED};
use crate::components::PointLight;
use crate::shading::certificate::{
    Color, Majorant, angle, cosine_remainder, least_lambda, moderate, positive_part, rate,
};
use crate::shading::number::{Number, Truth};
use crate::shading::patch::Patch;
use crate::shading::series::{Cubic, Quadratic};
use crate::shading::triangle::Triangle;
use crate::simd::apart;

/// A diffuse term that errs by no more than this part of the tolerance need not be looked at more closely.
const ENOUGH: f64 = 0.125;

/// The part of what is left of the tolerance that a terminator as a polynomial may use up: the rest is for the lights after
/// it, and for rounding.
const CROSSED: f64 = 0.9;

/// What n.l errs by at most, over what its three products do: each root of a square errs by half of what that does.
const ROOTS: f64 = 4.0;

/// What 1 - o.r errs by in the middle of a tile, over what the products do.
const PRODUCTS: f64 = 8.0;

/// What is known of one light on a tile before any pixel is looked at. Where it is neither dark nor lit there may be a
/// terminator.
pub struct Outlook<'a, N: Number = f64> {
    pub to_light: ToLight<'a, N>,
    /// n.l <= 0 all over.
    pub dark: N::Truth,
    /// n.l > 0 all over.
    pub lit: N::Truth,
    /// 1 - o.r is nowhere below this.
    pub lambda: N,
    /// Whether the highlight may reach the tile.
    pub shines: N::Truth,
}

/// What is known of all lights on a tile before any pixel is looked at.
pub struct Survey<N> {
    /// All terms that are polynomials of the whole tile: ambient light, the diffuse terms of the lights that are lit all
    /// over, those cut off at zero where the tolerance hardly notices, the highlights that vary slowly.
    pub color: Color<N>,
    /// What is left of the tolerance, in levels.
    pub budget: N,
}

impl<'a, N: Number> Outlook<'a, N> {
    /// That of one of the tiles.
    #[inline(always)]
    pub fn one(&self, index: usize) -> Outlook<'a> {
        Outlook {
            to_light: self.to_light.one(index),
            dark: self.dark.one(index),
            lit: self.lit.one(index),
            lambda: self.lambda.one(index),
            shines: self.shines.one(index),
        }
    }

    /// n.l as a quadratic, and what that errs by. Taylor's serves where that is at most `enough`; elsewhere its cubic terms
    /// are taken into account.
    #[inline(always)]
    pub fn cosine(&self, vectors: &Vectors<N>, enough: f64) -> (Quadratic<N>, N) {
        let ToLight {
            facing,
            light_square,
            doubt,
            ..
        } = &self.to_light;
        let normal_square = &vectors.normal_square;
        let (turn, swing) = (vectors.swing_normal(), self.to_light.swing());
        let roots = normal_square
            .inverse_root()
            .times(&light_square.inverse_root());
        let mut cosine = facing.times(&roots);
        let mut error = cosine_remainder(rate(turn), rate(swing));
        let closer = !error.below(error.like(enough)) & moderate(turn) & moderate(swing);
        if closer.any() {
            let roots = Cubic::from(*normal_square)
                .inverse_root()
                .times(&Cubic::from(*light_square).inverse_root());
            let (quadratic, left) = Cubic::from(*facing)
                .times(&roots)
                .economized(vectors.half());
            let directions = Majorant::direction(turn).times(&Majorant::direction(swing));
            cosine = cosine.or(closer, &quadratic);
            error = closer.choose(left + directions.tail(), error);
        }
        (cosine, error + *doubt * ROOTS)
    }
}

impl<S: Simd> Phong<'_, S> {
    /// What lights do to the whole of squares as polynomials, and what is left of the tolerance after their remainders and
    /// all rounding: infinitely less than nothing on those that are not wanted, or whose products are not sure. What is no
    /// polynomial goes to the pixels, where they may have it, and ends the search where not.
    #[inline(always)]
    pub(super) fn survey<N: Number>(
        &self,
        triangle: &Triangle,
        vectors: &Vectors<N>,
        wanted: N::Truth,
        mut pixels: Option<&mut ByPixel<S>>,
    ) -> Survey<N> {
        let like = vectors.swing_normal();
        let [zero, everything] = [0.0, f64::INFINITY].map(|number| like.like(number));
        let wanted = wanted & vectors.are_sure();
        let mut survey = Survey {
            color: Color::constant(self.ambient, like),
            budget: wanted.choose(like.like(self.tolerance), -everything),
        };
        for (index, light) in self.surface.illumination.points.iter().enumerate() {
            let possible = zero.below(survey.budget);
            if !possible.any() {
                break;
            }
            let own;
            let products = if let Some(Some(products)) = self.lights.get(index) {
                products
            } else {
                own = Own::of(triangle, light.position - self.surface.centre);
                &own
            };
            let outlook = apart(
                self.simd,
                #[inline(always)]
                || {
                    let to_light = ToLight::new(products, vectors.place(), vectors);
                    self.outlook(light, vectors, to_light)
                },
            );
            let sure = outlook.to_light.is_sure();
            let possible = possible & sure;
            let mut cost = sure.choose(zero, everything);
            let [diffuse, specular] = self.surface.coefficients(light);
            if diffuse != DVec3::ZERO && !outlook.dark.all() {
                let bright = diffuse.max_element();
                let enough = ENOUGH * self.tolerance / bright;
                let (cosine, error) = apart(
                    self.simd,
                    #[inline(always)]
                    || outlook.cosine(vectors, enough),
                );
                let loss = (error + self.rounding) * bright;
                cost = cost + outlook.dark.choose(zero, loss);
                let mut terminator = possible & !(outlook.lit | outlook.dark);
                if terminator.any() {
                    let (part, crossing) = positive_part(&cosine, vectors.half());
                    let crossing = crossing * bright;
                    // Highlights are yet to be paid for, and one that shines here goes to the pixels anyway.
                    let spare = (survey.budget - loss - self.dropped()) * CROSSED;
                    let smooth = terminator & !outlook.shines & crossing.below(spare);
                    survey.color.add(&part.only(smooth), diffuse);
                    cost = cost + smooth.choose(crossing, zero);
                    terminator = terminator & !smooth;
                }
                if terminator.any() {
                    match &mut pixels {
                        Some(pixels) => pixels.terminator(terminator, light, &cosine),
                        None => cost = cost + terminator.choose(everything, zero),
                    }
                }
                survey.color.add(&cosine.only(outlook.lit), diffuse);
            }
            if specular != DVec3::ZERO && !outlook.dark.all() {
                let bright = specular.max_element();
                let mut rest = possible & outlook.shines;
                let dropped = !(outlook.shines | outlook.dark);
                cost = cost + dropped.choose(like.like(self.faint), zero);
                if (rest & outlook.lit).any() {
                    let most = SMOOTHED * self.share_of_tolerance() / bright;
                    let (strength, error) = apart(
                        self.simd,
                        #[inline(always)]
                        || self.highlight(vectors, &outlook, most),
                    );
                    let smooth = rest & outlook.lit & error.below(like.like(most));
                    survey.color.add(&strength.only(smooth), specular);
                    cost = cost + smooth.choose(error * bright, zero);
                    rest = rest & !smooth;
                }
                if rest.any() {
                    let taken = match &mut pixels {
                        Some(pixels) => pixels.highlight(rest, light, vectors, &outlook),
                        None => everything,
                    };
                    cost = cost + rest.choose(taken, zero);
                }
            }
            survey.budget = survey.budget - cost;
        }
        survey
    }

    /// What all lights share on a tile; `own` is room for products that are the tile's.
    #[inline(always)]
    pub(super) fn vectors<'a>(
        &'a self,
        triangle: &Triangle,
        patch: &Patch,
        own: &'a mut Option<Shared>,
    ) -> Vectors<'a> {
        let vectors = Vectors::new(&self.shared, patch.middle, patch.half);
        if vectors.are_sure() {
            return vectors;
        }
        let shared = apart(
            self.simd,
            #[inline(always)]
            || Shared::new(&patch.normal(triangle), &patch.to_eye(triangle)),
        );
        Vectors::new(own.insert(shared), [0.0; 2], patch.half)
    }

    /// What the light of a number adds to them; `own` is room for products that are the tile's.
    #[inline(always)]
    pub(super) fn to_light<'a>(
        &'a self,
        light: usize,
        vectors: &Vectors,
        triangle: &Triangle,
        patch: &Patch,
        own: &'a mut Option<Own>,
    ) -> ToLight<'a> {
        if let Some(Some(products)) = self.lights.get(light) {
            let to_light = ToLight::new(products, patch.middle, vectors);
            if to_light.is_sure() {
                return to_light;
            }
        }
        let products = apart(
            self.simd,
            #[inline(always)]
            || {
                let offset = self.surface.illumination.points[light].position - self.surface.centre;
                Own::new(
                    &patch.normal(triangle),
                    &patch.to_light(triangle, offset),
                    &patch.to_eye(triangle),
                )
            },
        );
        ToLight::new(own.insert(products), [0.0; 2], vectors)
    }

    /// Bounds what a light does to a tile.
    #[inline(always)]
    pub(super) fn outlook<'a, N: Number>(
        &self,
        light: &PointLight,
        vectors: &Vectors<N>,
        to_light: ToLight<'a, N>,
    ) -> Outlook<'a, N> {
        let ToLight { facing, doubt, .. } = to_light;
        let middle = facing.0[0];
        let reach = facing.linear_reach(vectors.half()) + facing.quadratic_reach(vectors.half());
        let dark = (middle + reach).below(-doubt);
        let mut outlook = Outlook {
            to_light,
            dark,
            lit: doubt.below(middle - reach),
            lambda: middle.like(f64::INFINITY),
            shines: dark & !dark,
        };
        if light.specular != DVec3::ZERO && !dark.all() {
            let normal = angle(vectors.swing_normal());
            let turns = normal + normal + angle(to_light.swing()) + angle(vectors.swing_eye());
            let lambda = (to_light.lambda(vectors) - doubt * PRODUCTS).or_zero();
            // |r - o| at the middle of the tile.
            let chord = (lambda + lambda).sqrt();
            outlook.lambda = least_lambda(chord, turns);
            outlook.shines = self.reaches(light, outlook.lambda) & !dark;
        }
        outlook
    }
}
