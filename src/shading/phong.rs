//! Position and normal interpolated, the model at every pixel (Phong 1975).
//!
//! Per tile and light, what n.l and the highlight can do is bounded first (see [`super::certificate`]): a light behind
//! the whole tile is left out, a diffuse term becomes a certified polynomial, a specular term is dropped where it cannot
//! reach its share of the tolerance. Only what remains is evaluated pixel by pixel.
//!
//! Rule: the shares add up to the tolerance, rounding included; at tolerance 0 there are no shares and every pixel is
//! evaluated exactly.

mod exact;

use glam::DVec3;

use super::certificate::{Color, Quadratic, angle, cosine_remainder, least_lambda, rate};
use super::patch::{Affine, Patch, Triangle};
use super::polynomial::Polynomial;
use super::{
    Coverage, Evaluations, Scratch, Shader, Sink, Surface, TILE, TileKind, U, limit, polynomial,
};
use crate::components::PointLight;
use exact::Reflection;

/// The part of the tolerance that dropped specular terms may use up together.
const DROPPED: f64 = 0.25;
/// The part of the tolerance that the rounding of highlights should keep to.
const ROUNDED: f64 = 0.5;

/// What a shaded object brings to all of its tiles.
pub struct Phong<'a> {
    surface: Surface<'a>,
    /// As asked for, in levels.
    tolerance: f64,
    /// What a level of specular coefficient may lose by a radian of error in |r - o|, in levels.
    slope: f64,
    /// The logarithm of the largest specular coefficient over what one light's highlight may lose, both in levels.
    drop: f64,
}

/// The interpolated vectors of a tile, each true up to one positive factor a pixel and of length one at the tile's
/// middle, how far they swing, and their products.
struct Vectors {
    normal: Affine,
    to_eye: Affine,
    /// P, weighted, from the cuboid's centre in world units.
    position: Affine,
    swing_normal: f64,
    swing_eye: f64,
    normal_square: Quadratic,
    normal_eye: Quadratic,
    eye_square: Quadratic,
}

/// How a light stands to a tile.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Side {
    /// n.l <= 0 all over.
    Dark,
    /// n.l > 0 all over.
    Lit,
    /// Neither is certain.
    Terminator,
}

/// What is known of all lights on a tile before any pixel is looked at.
struct Survey {
    color: Color,
    budget: f64,
    terminators: u64,
    highlights: u64,
    /// Whether any of the highlights needs unit vectors.
    by_vectors: bool,
}

/// What is known of one light on a tile before any pixel is looked at.
struct Outlook {
    to_light: Affine,
    /// N.L, without loss: the sign of n.l.
    facing: Quadratic,
    light_square: Quadratic,
    side: Side,
    /// Whether the highlight may reach the tile.
    shines: bool,
    swing: f64,
}

impl<'a> Phong<'a> {
    /// Prepares an object; `tolerance` in levels.
    pub fn new(surface: Surface<'a>, tolerance: f64) -> Self {
        let mut phong = Phong {
            surface,
            tolerance,
            slope: exact::steepest(surface.material.shininess),
            drop: 0.0,
        };
        let share = phong.dropped() / surface.powers().max(1) as f64;
        phong.drop = (surface.material.specular.max_element() / share).ln();
        phong
    }

    /// What dropped specular terms may cost together, in levels.
    #[inline(always)]
    fn dropped(&self) -> f64 {
        DROPPED * limit(self.tolerance)
    }

    /// What the rounding of one highlight should cost at most, in levels.
    #[inline(always)]
    fn share(&self) -> f64 {
        ROUNDED * limit(self.tolerance) / self.surface.powers().max(1) as f64
    }

    /// What holds for the whole of a patch: the diffuse terms of the lights that are lit all over as polynomials, what is
    /// left of the tolerance after their remainders and all rounding, and how many lights need a look at every pixel.
    #[inline(always)]
    fn survey(&self, vectors: &Vectors, patch: &Patch) -> Survey {
        let mut survey = Survey {
            color: Color::constant(self.surface.ambient()),
            budget: self.tolerance - self.dropped(),
            terminators: 0,
            highlights: 0,
            by_vectors: false,
        };
        for light in &self.surface.illumination.points {
            let outlook = self.outlook(light, vectors, patch);
            if outlook.side == Side::Dark {
                continue;
            }
            let [diffuse, specular] = self.surface.coefficients(light);
            if diffuse != DVec3::ZERO {
                let remainder = cosine_remainder(rate(vectors.swing_normal), rate(outlook.swing));
                survey.budget -= diffuse.max_element() * (remainder + 6.0 * U);
                if outlook.side == Side::Lit {
                    survey.color.add(&outlook.cosine(vectors), diffuse);
                } else {
                    survey.terminators += 1;
                }
            }
            if outlook.shines {
                survey.highlights += 1;
                let (reflection, cost) = self.reflection(
                    specular.max_element(),
                    self.share(),
                    vectors,
                    &outlook,
                    patch,
                );
                survey.by_vectors |= reflection == Reflection::Vectors;
                survey.budget -= cost;
            }
        }
        survey
    }

    /// Draws polynomials, and pixel by pixel only the terminators and highlights; `None`, and nothing drawn, where the
    /// tolerance cannot be certified.
    #[inline(always)]
    fn shade_certified(
        &self,
        vectors: &Vectors,
        patch: &Patch,
        coverage: &Coverage,
        scratch: &mut Scratch,
        sink: &mut impl Sink,
    ) -> Option<Evaluations> {
        let survey = self.survey(vectors, patch);
        if survey.terminators == 0 && survey.highlights == 0 {
            let polynomial = polynomial::cheapest(survey.color, patch.half, survey.budget)?;
            polynomial.shade(patch.first(), coverage, sink);
            return Some(Evaluations::of(polynomial.kind));
        }
        let budget = survey.budget - polynomial::rounding(&survey.color, patch.half);
        if budget.is_nan() || budget < 0.0 {
            return None;
        }
        let lanes = patch.lanes();
        for (row, &(from, to)) in coverage.spans.iter().enumerate() {
            if from < to {
                polynomial::row_of(
                    &survey.color,
                    row as f64 - patch.row,
                    &lanes,
                    &mut scratch.levels[row],
                );
            }
        }
        if survey.by_vectors {
            vectors.normalise(patch, coverage, scratch);
        }
        for light in &self.surface.illumination.points {
            let outlook = self.outlook(light, vectors, patch);
            if outlook.side == Side::Terminator {
                self.add_terminator(light, &outlook.cosine(vectors), patch, coverage, scratch);
            }
            if outlook.shines {
                self.add_specular(light, vectors, &outlook, patch, coverage, scratch);
            }
        }
        exact::flush(coverage, scratch, sink);
        let kind = if survey.highlights > 0 {
            TileKind::Highlight
        } else {
            TileKind::Terminator
        };
        Some(Evaluations {
            specular: u64::from(coverage.pixels) * survey.highlights,
            ..Evaluations::of(kind)
        })
    }

    /// Bounds what a light does to a tile.
    #[inline(always)]
    fn outlook(&self, light: &PointLight, vectors: &Vectors, patch: &Patch) -> Outlook {
        let to_light = exact::scaled(
            &patch
                .constant(light.position - self.surface.centre)
                .minus(&vectors.position),
        );
        let facing = Quadratic::dot(&vectors.normal, &to_light);
        let side = side(&facing, patch.half);
        let swing = to_light.swing(patch.half);
        let mut shines = false;
        if side != Side::Dark && light.specular != DVec3::ZERO {
            let turns = 2.0 * angle(vectors.swing_normal) + angle(swing) + angle(vectors.swing_eye);
            let lambda = least_lambda(chord(vectors, &to_light), turns);
            let most = self.drop + light.specular.max_element().ln()
                - self.surface.material.shininess * lambda;
            shines = most.is_nan() || most > 0.0;
        }
        Outlook {
            facing,
            light_square: Quadratic::dot(&to_light, &to_light),
            to_light,
            side,
            shines,
            swing,
        }
    }

    /// Adds max(0, n.l) where its polynomial changes sign, or stays so near to zero that it may.
    #[inline(always)]
    fn add_terminator(
        &self,
        light: &PointLight,
        cosine: &Quadratic,
        patch: &Patch,
        coverage: &Coverage,
        scratch: &mut Scratch,
    ) {
        let polynomial = cosine;
        let lanes = patch.lanes();
        let diffuse = self.surface.coefficients(light)[0].as_vec3().to_array();
        for (row, &(from, to)) in coverage.spans.iter().enumerate() {
            if from < to {
                let [middle, slope, curve] = polynomial.ramp(row as f64 - patch.row);
                let mut cosine = [0.0; TILE];
                for lane in 0..TILE {
                    let value = middle + lanes[lane] * (slope + lanes[lane] * curve);
                    cosine[lane] = if value > 0.0 { value } else { 0.0 };
                }
                for channel in 0..3 {
                    for lane in 0..TILE {
                        scratch.levels[row][channel][lane] += diffuse[channel] * cosine[lane];
                    }
                }
            }
        }
    }
}

impl Outlook {
    /// n.l, to second order.
    #[inline(always)]
    fn cosine(&self, vectors: &Vectors) -> Quadratic {
        self.facing.times(
            &vectors
                .normal_square
                .inverse_root()
                .times(&self.light_square.inverse_root()),
        )
    }
}

impl Shader for Phong<'_> {
    #[inline(always)]
    fn polynomial(&self, triangle: &Triangle, patch: &Patch) -> Option<Polynomial> {
        if self.tolerance == 0.0 || !patch.steady {
            return None;
        }
        let survey = self.survey(&Vectors::new(triangle, patch), patch);
        if survey.terminators > 0 || survey.highlights > 0 {
            return None;
        }
        polynomial::cheapest(survey.color, patch.half, survey.budget)
    }

    #[inline(always)]
    fn shade(
        &self,
        triangle: &Triangle,
        patch: &Patch,
        coverage: &Coverage,
        scratch: &mut Scratch,
        sink: &mut impl Sink,
    ) -> Evaluations {
        let vectors = Vectors::new(triangle, patch);
        if patch.steady
            && self.tolerance > 0.0
            && let Some(evaluations) =
                self.shade_certified(&vectors, patch, coverage, scratch, sink)
        {
            return evaluations;
        }
        let in_lanes = if patch.steady {
            self.shade_lanes(&vectors, patch, coverage, scratch, sink)
        } else {
            None
        };
        in_lanes.unwrap_or_else(|| self.shade_doubles(triangle, patch, coverage, sink))
    }
}

impl Vectors {
    #[inline(always)]
    fn new(triangle: &Triangle, patch: &Patch) -> Self {
        let normal = exact::scaled(&patch.normal(triangle));
        let to_eye = exact::scaled(&patch.to_eye(triangle));
        let position = patch.position(triangle);
        Vectors {
            swing_normal: normal.swing(patch.half),
            swing_eye: to_eye.swing(patch.half),
            normal_square: Quadratic::dot(&normal, &normal),
            normal_eye: Quadratic::dot(&normal, &to_eye),
            eye_square: Quadratic::dot(&to_eye, &to_eye),
            normal,
            to_eye,
            position,
        }
    }
}

/// |r - o| at the middle of the tile.
#[inline(always)]
fn chord(vectors: &Vectors, to_light: &Affine) -> f64 {
    let [n, l, o] = [
        vectors.normal.centre,
        to_light.centre,
        vectors.to_eye.centre,
    ];
    (2.0 * n.dot(l) * n - l - o).length()
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
