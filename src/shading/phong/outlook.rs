//! A tile and its lights in; what light can do there, bounded before any pixel is looked at, out.
//!
//! ```text
//!   N, L, O affine  -->  N.N  L.L  N.L  quadratic, without loss  -->  sign and polynomial of n.l, least 1 - o.r
//! ```
//! Rule: whatever cannot be bounded is a [`Side::Terminator`] and shines.

use fearless_simd::Simd;
use glam::DVec3;

use super::{Phong, Pixels, SMOOTHED};
use crate::components::PointLight;
use crate::shading::affine::Affine;
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

/// What all lights share on a tile. The products are those of vectors of length one at its middle.
pub struct Vectors {
    /// Up to one positive factor a pixel.
    pub normal: Affine,
    /// Up to one positive factor a pixel.
    pub to_eye: Affine,
    /// One over their lengths at the middle.
    pub inverse_normal: f64,
    pub inverse_eye: f64,
    pub swing_normal: f64,
    pub swing_eye: f64,
    pub normal_square: Quadratic,
}

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
pub struct Outlook {
    /// Up to one positive factor a pixel.
    pub to_light: Affine,
    /// One over its length at the middle.
    pub inverse_light: f64,
    /// N.L, without loss: the sign of n.l.
    pub facing: Quadratic,
    pub light_square: Quadratic,
    pub side: Side,
    /// 1 - o.r is nowhere below this.
    pub lambda: f64,
    /// Whether the highlight may reach the tile.
    pub shines: bool,
    pub swing: f64,
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

/// One over a vector's length at the middle of its tile, and its swing there.
#[inline(always)]
fn measure(vector: &Affine, half: [f64; 2]) -> (f64, f64) {
    let inverse = 1.0 / vector.centre.length();
    (inverse, vector.reach(half) * inverse)
}

impl Vectors {
    #[inline(always)]
    pub fn new(triangle: &Triangle, patch: &Patch) -> Self {
        let normal = patch.normal(triangle);
        let to_eye = patch.to_eye(triangle);
        let (inverse_normal, swing_normal) = measure(&normal, patch.half);
        let (inverse_eye, swing_eye) = measure(&to_eye, patch.half);
        Vectors {
            normal_square: Quadratic::dot(&normal, &normal).scaled(inverse_normal * inverse_normal),
            normal,
            to_eye,
            inverse_normal,
            inverse_eye,
            swing_normal,
            swing_eye,
        }
    }

    /// N.O
    #[inline(always)]
    pub fn normal_eye(&self) -> Quadratic {
        Quadratic::dot(&self.normal, &self.to_eye).scaled(self.inverse_normal * self.inverse_eye)
    }

    /// O.O
    #[inline(always)]
    pub fn eye_square(&self) -> Quadratic {
        Quadratic::dot(&self.to_eye, &self.to_eye).scaled(self.inverse_eye * self.inverse_eye)
    }
}

impl Outlook {
    /// n.l as a quadratic, and what that errs by. Taylor's serves where that is at most `enough`; elsewhere its cubic terms
    /// are taken into account.
    #[inline(always)]
    pub fn cosine(&self, vectors: &Vectors, half: [f64; 2], enough: f64) -> (Quadratic, f64) {
        let (normal, light) = (&vectors.normal_square, &self.light_square);
        let error = cosine_remainder(rate(vectors.swing_normal), rate(self.swing));
        if error <= enough || vectors.swing_normal.max(self.swing) >= MOST_SWING {
            let roots = normal.inverse_root().times(&light.inverse_root());
            return (self.facing.times(&roots), error);
        }
        let roots = Cubic::from(*normal)
            .inverse_root()
            .times(&Cubic::from(*light).inverse_root());
        let (quadratic, left) = Cubic::from(self.facing).times(&roots).economized(half);
        let directions =
            Majorant::of_swing(vectors.swing_normal).times(&Majorant::of_swing(self.swing));
        (quadratic, left + directions.tail())
    }

    /// L.O
    #[inline(always)]
    pub fn light_eye(&self, vectors: &Vectors) -> Quadratic {
        Quadratic::dot(&self.to_light, &vectors.to_eye)
            .scaled(self.inverse_light * vectors.inverse_eye)
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
        for light in &self.surface.illumination.points {
            let outlook = self.outlook(light, vectors, triangle, patch);
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
                        || self.add_specular(light, vectors, &outlook, patch, pixels),
                    );
                    // Product and sums in f32 are three more roundings.
                    survey.budget -= cost + 3.0 * U * bright;
                }
            } else if specular != DVec3::ZERO {
                survey.budget -= self.faint;
            }
        }
        Some(survey)
    }

    /// Bounds what a light does to a tile.
    #[inline(always)]
    pub(super) fn outlook(
        &self,
        light: &PointLight,
        vectors: &Vectors,
        triangle: &Triangle,
        patch: &Patch,
    ) -> Outlook {
        let to_light = patch.to_light(triangle, light.position - self.surface.centre);
        let (inverse_light, swing) = measure(&to_light, patch.half);
        let facing = Quadratic::dot(&vectors.normal, &to_light)
            .scaled(vectors.inverse_normal * inverse_light);
        let side = side(&facing, patch.half);
        let mut outlook = Outlook {
            light_square: Quadratic::dot(&to_light, &to_light)
                .scaled(inverse_light * inverse_light),
            to_light,
            inverse_light,
            facing,
            side,
            lambda: f64::INFINITY,
            shines: false,
            swing,
        };
        if side != Side::Dark && light.specular != DVec3::ZERO {
            let turns = 2.0 * angle(vectors.swing_normal) + angle(swing) + angle(vectors.swing_eye);
            outlook.lambda = least_lambda(chord(vectors, &outlook), turns);
            outlook.shines = self.reaches(light, outlook.lambda);
        }
        outlook
    }
}

/// |r - o| at the middle of the tile.
#[inline(always)]
fn chord(vectors: &Vectors, outlook: &Outlook) -> f64 {
    let n = vectors.normal.centre * vectors.inverse_normal;
    let l = outlook.to_light.centre * outlook.inverse_light;
    let o = vectors.to_eye.centre * vectors.inverse_eye;
    (2.0 * outlook.facing.0[0] * n - l - o).length()
}

/// The sign of n.l over a tile.
#[inline(always)]
fn side(facing: &Quadratic, half: [f64; 2]) -> Side {
    let middle = facing.0[0];
    let reach = facing.linear_reach(half) + facing.quadratic_reach(half);
    // f64 rounding of the sums is a millionth of a millionth of the largest term.
    let doubt = 1e-12 * (middle.abs() + reach);
    if middle - reach > doubt {
        Side::Lit
    } else if middle + reach < -doubt {
        Side::Dark
    } else {
        Side::Terminator
    }
}
