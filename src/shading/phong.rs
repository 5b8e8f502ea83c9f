//! Position and normal interpolated, the model at every pixel (Phong 1975).
//!
//! Per tile and light, what n.l and the highlight can do is bounded first (see [`super::certificate`]): a light behind
//! the whole tile is left out, a diffuse term becomes a certified polynomial, a specular term is dropped where it cannot
//! reach its share of the tolerance, and becomes a polynomial too where it varies slowly (`highlight`). Only what
//! remains is evaluated pixel by pixel.
//!
//! Rule: the shares add up to the tolerance, rounding included; at tolerance 0 there are no shares and every pixel is
//! evaluated exactly.

mod exact;
mod highlight;
mod outlook;
mod products;

use fearless_simd::Simd;
use glam::DVec3;

use super::display::Approximate;
use super::patch::Patch;
use super::polynomial::Polynomial;
use super::series::Quadratic;
use super::specular::Squarings;
use super::triangle::Triangle;
use super::{Coverage, Evaluations, Scratch, Shader, Sink, Surface, TILE, limit, polynomial};
use crate::components::PointLight;
use crate::simd::apart;
use products::{Own, Shared, Vectors};

/// The part of the tolerance that dropped specular terms may use up together.
const DROPPED: f64 = 0.25;
/// The part of the tolerance that highlights as polynomials may use up together.
const SMOOTHED: f64 = 0.5;
/// The part of the tolerance that the rounding of highlights should keep to.
const ROUNDED: f64 = 0.5;
/// The part of the tolerance that a cheaper power may use up.
const POWERED: f64 = 0.125;

/// Of so many lights the products are made once a triangle, of others once a tile.
const PREPARED: usize = 16;

/// So few pixels of a tile are evaluated faster than a certificate for them is found.
const FEW: u32 = 24;

/// What a triangle of a shaded object brings to all of its tiles.
pub struct Phong<'a, S> {
    /// The instructions there are.
    simd: S,
    surface: Surface<'a>,
    /// As asked for, in levels.
    tolerance: f64,
    /// In levels.
    ambient: DVec3,
    /// What a level of specular coefficient may lose by a radian of error in |r - o|, in levels.
    slope: f64,
    /// The largest specular term of any light where s is one, in levels.
    brightest: f64,
    /// What one light's highlight may lose by being dropped, in levels.
    faint: f64,
    /// 1 - s beyond which the brightest highlight is as faint as that.
    reach: f64,
    shared: Shared,
    /// The products of the first lights: so many that most scenes need no more, and a place for more would have to be
    /// allocated.
    lights: [Option<Own>; PREPARED],
    /// The power of a highlight in few steps, where the tolerance allows one.
    squarings: Option<Squarings>,
}

impl<'a, S: Simd> Phong<'a, S> {
    /// Prepares a triangle of an object; `tolerance` in levels.
    #[inline(always)]
    pub fn new(simd: S, surface: Surface<'a>, tolerance: f64, triangle: &Triangle) -> Self {
        let shininess = surface.material.shininess;
        let powers = surface.powers().max(1) as f64;
        let brightest = surface
            .illumination
            .points
            .iter()
            .map(|light| surface.coefficients(light)[1].max_element())
            .fold(0.0, f64::max);
        let faint = DROPPED * limit(tolerance) / powers;
        let reach = (brightest / faint).ln() / shininess;
        let squarings = Squarings::new(
            shininess,
            (brightest / faint).powf(-1.0 / shininess),
            POWERED * tolerance / powers / brightest,
        );
        let (normal, to_eye) = (&triangle.normal, &triangle.to_eye);
        let mut lights = [None; PREPARED];
        for (products, light) in lights.iter_mut().zip(&surface.illumination.points) {
            let to_light = triangle.towards(light.position - surface.centre);
            *products = Some(Own::new(normal, &to_light, to_eye));
        }
        Phong {
            simd,
            surface,
            tolerance,
            ambient: surface.ambient(),
            slope: exact::steepest(shininess),
            brightest,
            faint,
            reach,
            shared: Shared::new(normal, to_eye),
            lights,
            squarings,
        }
    }

    /// What dropped specular terms may cost together, in levels.
    #[inline(always)]
    fn dropped(&self) -> f64 {
        DROPPED * limit(self.tolerance)
    }

    /// What one highlight may cost if all cost the same, in levels.
    #[inline(always)]
    fn share_of_tolerance(&self) -> f64 {
        limit(self.tolerance) / self.surface.powers().max(1) as f64
    }

    /// Whether a highlight that is nowhere nearer to its middle than `lambda` = 1 - s is too bright to be dropped:
    /// (1 - lambda)^rho <= exp(-rho lambda).
    #[inline(always)]
    fn reaches(&self, light: &PointLight, lambda: f64) -> bool {
        if lambda > self.reach {
            return false;
        }
        let bright = self.surface.coefficients(light)[1].max_element();
        bright >= self.brightest
            || bright * (-self.surface.material.shininess * lambda).exp() > self.faint
    }

    /// Draws polynomials, and pixel by pixel only the terminators and highlights; `None`, and nothing drawn, where the
    /// tolerance cannot be certified.
    #[inline(always)]
    fn shade_certified(
        &self,
        vectors: &Vectors,
        triangle: &Triangle,
        patch: &Patch,
        coverage: &Coverage,
        scratch: &mut Scratch,
        sink: &mut impl Sink,
    ) -> Option<Evaluations> {
        let mut pixels = Pixels::new(coverage, scratch);
        let survey = self.survey(vectors, triangle, patch, Some(&mut pixels))?;
        if survey.is_polynomial() {
            let polynomial = polynomial::cheapest(survey.color, patch.half, survey.budget)?;
            apart(
                self.simd,
                #[inline(always)]
                || sink.draw(&polynomial, patch.first(), coverage),
            );
            return Some(Evaluations::of(polynomial.kind));
        }
        let budget = survey.budget - polynomial::rounding(&survey.color, patch.half);
        if budget.is_nan() || budget < 0.0 {
            return None;
        }
        let ramps = [0, 1, 2].map(|channel| survey.color.0[channel].ramps(-patch.row));
        let lanes = patch.lanes();
        for (row, &(from, to)) in coverage.spans.iter().enumerate() {
            if from < to {
                let levels = &mut scratch.levels[row];
                for channel in 0..3 {
                    let [middle, slope, curve] = ramps[channel].row(row);
                    for lane in 0..TILE {
                        levels[channel][lane] +=
                            middle + lanes[lane] * (slope + lanes[lane] * curve);
                    }
                }
                sink.take(row, &Approximate(levels));
            }
        }
        Some(Evaluations {
            specular: u64::from(coverage.pixels) * survey.highlights,
            ..Evaluations::of(survey.kind())
        })
    }

    /// Adds max(0, n.l) where its polynomial changes sign, or stays so near to zero that it may.
    #[inline(always)]
    fn add_terminator(
        &self,
        light: &PointLight,
        cosine: &Quadratic,
        patch: &Patch,
        pixels: &mut Pixels,
    ) {
        let ramps = cosine.ramps(-patch.row);
        let lanes = patch.lanes();
        let diffuse = self.surface.coefficients(light)[0].as_vec3().to_array();
        for (row, &(from, to)) in pixels.coverage.spans.iter().enumerate() {
            if from < to {
                let [middle, slope, curve] = ramps.row(row);
                let mut cosine = [0.0; TILE];
                for lane in 0..TILE {
                    let value = middle + lanes[lane] * (slope + lanes[lane] * curve);
                    cosine[lane] = if value > 0.0 { value } else { 0.0 };
                }
                pixels.add(row, diffuse, &cosine);
            }
        }
    }
}

/// The pixels of a tile, for what has to be evaluated one by one.
struct Pixels<'a> {
    coverage: &'a Coverage,
    scratch: &'a mut Scratch,
    /// Whether the scratch has unit vectors.
    normalised: bool,
}

impl<'a> Pixels<'a> {
    #[inline(always)]
    fn new(coverage: &'a Coverage, scratch: &'a mut Scratch) -> Self {
        Pixels {
            coverage,
            scratch,
            normalised: false,
        }
    }

    /// Begins with the same levels everywhere.
    #[inline(always)]
    fn fill(&mut self, levels: DVec3) {
        let levels = levels.as_vec3().to_array();
        self.scratch.levels.fill(levels.map(|level| [level; TILE]));
    }

    /// Adds a term to a row: a coefficient a channel, in levels, times a strength a lane.
    #[inline(always)]
    fn add(&mut self, row: usize, coefficients: [f32; 3], strength: &[f32; TILE]) {
        for channel in 0..3 {
            for lane in 0..TILE {
                self.scratch.levels[row][channel][lane] += coefficients[channel] * strength[lane];
            }
        }
    }
}

impl<S: Simd> Shader for Phong<'_, S> {
    #[inline(always)]
    fn polynomial(&self, triangle: &Triangle, patch: &Patch) -> Option<Polynomial> {
        if self.tolerance == 0.0 || !patch.steady {
            return None;
        }
        let mut own = None;
        let vectors = self.vectors(triangle, patch, &mut own);
        let survey = self.survey(&vectors, triangle, patch, None)?;
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
        let mut own = None;
        let vectors = self.vectors(triangle, patch, &mut own);
        if patch.steady
            && self.tolerance > 0.0
            && coverage.pixels > FEW
            && let Some(evaluations) =
                self.shade_certified(&vectors, triangle, patch, coverage, scratch, sink)
        {
            return evaluations;
        }
        let in_lanes = if patch.steady {
            apart(
                self.simd,
                #[inline(always)]
                || self.shade_lanes(&vectors, triangle, patch, coverage, scratch, sink),
            )
        } else {
            None
        };
        in_lanes.unwrap_or_else(|| self.shade_doubles(triangle, patch, coverage, sink))
    }
}
