//! A tile and its lights in; what light can do there, bounded before any pixel is looked at, out.
//!
//! ```text
//!   N.N  L.L  O.O  N.L  N.O  L.O  -->  sign and polynomial of n.l, least 1 - o.r
//! ```
//! Rule: whatever cannot be bounded is a [`Side::Terminator`] and shines.

use fearless_simd::Simd;
use glam::DVec3;

use super::products::{Own, Shared, ToLight, Vectors};
use super::{Phong, Pixels, SMOOTHED};
use crate::shading::certificate::{
    Color, MOST_SWING, Majorant, angle, cosine_remainder, least_lambda, rate,
};
use crate::shading::patch::Patch;
use crate::shading::series::{Cubic, Quadratic};
use crate::shading::triangle::Triangle;
use crate::shading::{TileKind, U};
use crate::simd::apart;

/// A diffuse term that errs by no more than this part of the tolerance need not be looked at more closely.
const ENOUGH: f64 = 0.125;

/// How a light stands to a tile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// n.l <= 0 all over.
    Dark,
    /// n.l > 0 all over.
    Lit,
    /// Neither is certain.
    Terminator,
}

/// What is known of one light on a tile before any pixel is looked at.
pub struct Outlook<'a> {
    pub to_light: ToLight<'a>,
    pub side: Side,
    /// 1 - o.r is nowhere below this.
    pub lambda: f64,
    /// Whether the highlight may reach the tile.
    pub shines: bool,
}

/// What is known of all lights on a tile before any pixel is looked at.
pub struct Survey {
    /// All terms that are polynomials of the whole tile: ambient light, the diffuse terms of the lights that are lit all
    /// over, the highlights that vary slowly.
    pub color: Color,
    /// What is left of the tolerance, in levels.
    pub budget: f64,
    pub terminators: u64,
    pub highlights: u64,
}

impl Survey {
    /// Whether no pixel was looked at.
    #[inline(always)]
    pub fn is_polynomial(&self) -> bool {
        self.terminators == 0 && self.highlights == 0
    }

    /// The pixels, where there are any, with nothing added to them yet if no light has been.
    #[inline(always)]
    fn look_at<'p, 's>(
        &self,
        pixels: &'p mut Option<&mut Pixels<'s>>,
    ) -> Option<&'p mut Pixels<'s>> {
        let pixels = pixels.as_deref_mut()?;
        if self.is_polynomial() {
            pixels.fill(DVec3::ZERO);
        }
        Some(pixels)
    }

    /// How a tile that is not all polynomial is drawn.
    pub fn kind(&self) -> TileKind {
        if self.highlights > 0 {
            TileKind::Highlight
        } else {
            TileKind::Terminator
        }
    }
}

impl Outlook<'_> {
    /// n.l as a quadratic, and what that errs by. Taylor's serves where that is at most `enough`; elsewhere its cubic terms
    /// are taken into account.
    #[inline(always)]
    pub fn cosine(&self, vectors: &Vectors, half: [f64; 2], enough: f64) -> (Quadratic, f64) {
        let ToLight {
            facing,
            light_square,
            doubt,
            ..
        } = &self.to_light;
        let normal_square = &vectors.normal_square;
        let (turn, swing) = (vectors.swing_normal(), self.to_light.swing());
        // Each root of a square errs by half of what that does.
        let rounding = 4.0 * doubt;
        let error = cosine_remainder(rate(turn), rate(swing));
        if error <= enough || turn.max(swing) >= MOST_SWING {
            let roots = normal_square
                .inverse_root()
                .times(&light_square.inverse_root());
            return (facing.times(&roots), error + rounding);
        }
        let roots = Cubic::from(*normal_square)
            .inverse_root()
            .times(&Cubic::from(*light_square).inverse_root());
        let (quadratic, left) = Cubic::from(*facing).times(&roots).economized(half);
        let directions = Majorant::direction(turn).times(&Majorant::direction(swing));
        (quadratic, left + directions.tail() + rounding)
    }
}

impl<S: Simd> Phong<'_, S> {
    /// What lights do to the whole of a patch as polynomials, and what is left of the tolerance after their remainders
    /// and all rounding. What has to be evaluated pixel by pixel is added to `pixels`; `None` where that is needed and
    /// there are none.
    #[inline(always)]
    pub(super) fn survey(
        &self,
        vectors: &Vectors,
        triangle: &Triangle,
        patch: &Patch,
        mut pixels: Option<&mut Pixels>,
    ) -> Option<Survey> {
        let mut survey = Survey {
            color: Color::constant(self.ambient),
            budget: self.tolerance,
            terminators: 0,
            highlights: 0,
        };
        for (index, light) in self.surface.illumination.points.iter().enumerate() {
            let mut own = None;
            let outlook = self.outlook(index, vectors, triangle, patch, &mut own);
            if outlook.side == Side::Dark {
                continue;
            }
            let [diffuse, specular] = self.surface.coefficients(light);
            if diffuse != DVec3::ZERO {
                let bright = diffuse.max_element();
                let enough = ENOUGH * self.tolerance / bright;
                let (cosine, error) = outlook.cosine(vectors, patch.half, enough);
                survey.budget -= bright * (error + 6.0 * U);
                if outlook.side == Side::Lit {
                    survey.color.add(&cosine, diffuse);
                } else {
                    let pixels = survey.look_at(&mut pixels)?;
                    survey.terminators += 1;
                    apart(
                        self.simd,
                        #[inline(always)]
                        || self.add_terminator(light, &cosine, patch, pixels),
                    );
                }
            }
            if outlook.shines {
                let bright = specular.max_element();
                let most = SMOOTHED * self.share_of_tolerance() / bright;
                if outlook.side == Side::Lit
                    && let Some((strength, error)) = apart(
                        self.simd,
                        #[inline(always)]
                        || self.highlight(vectors, &outlook, patch, most),
                    )
                {
                    survey.color.add(&strength, specular);
                    survey.budget -= bright * error;
                } else {
                    let pixels = survey.look_at(&mut pixels)?;
                    survey.highlights += 1;
                    let cost = apart(
                        self.simd,
                        #[inline(always)]
                        || {
                            if outlook.side == Side::Lit
                                && let Some(cost) =
                                    self.add_raised(light, vectors, &outlook, patch, pixels)
                            {
                                return cost;
                            }
                            self.add_specular(light, vectors, &outlook, triangle, patch, pixels)
                        },
                    );
                    // A power in few steps is nothing where it is fainter than that; product and sums in f32 are three
                    // more roundings.
                    let cut = self.squarings.map_or(0.0, |_| self.faint);
                    survey.budget -= cost + cut + 3.0 * U * bright;
                }
            } else if specular != DVec3::ZERO {
                survey.budget -= self.faint;
            }
        }
        Some(survey)
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
    fn to_light<'a>(
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

    /// Bounds what the light of a number does to a tile; `own` is room for products that are the tile's.
    #[inline(always)]
    pub(super) fn outlook<'a>(
        &'a self,
        light: usize,
        vectors: &Vectors,
        triangle: &Triangle,
        patch: &Patch,
        own: &'a mut Option<Own>,
    ) -> Outlook<'a> {
        let to_light = self.to_light(light, vectors, triangle, patch, own);
        let light = &self.surface.illumination.points[light];
        let mut outlook = Outlook {
            side: side(&to_light.facing, to_light.doubt, patch.half),
            to_light,
            lambda: f64::INFINITY,
            shines: false,
        };
        if outlook.side != Side::Dark && light.specular != DVec3::ZERO {
            let turns = 2.0 * angle(vectors.swing_normal())
                + angle(to_light.swing())
                + angle(vectors.swing_eye());
            // |r - o| at the middle of the tile.
            let lambda = to_light.lambda(vectors) - 8.0 * to_light.doubt;
            let chord = (2.0 * lambda.max(0.0)).sqrt();
            outlook.lambda = least_lambda(chord, turns);
            outlook.shines = self.reaches(light, outlook.lambda);
        }
        outlook
    }
}

/// The sign of n.l over a tile, where N.L errs by `doubt` at most.
#[inline(always)]
fn side(facing: &Quadratic, doubt: f64, half: [f64; 2]) -> Side {
    let middle = facing.0[0];
    let reach = facing.linear_reach(half) + facing.quadratic_reach(half);
    if middle - reach > doubt {
        Side::Lit
    } else if middle + reach < -doubt {
        Side::Dark
    } else {
        Side::Terminator
    }
}
