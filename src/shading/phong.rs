//! Position and normal interpolated, the model at every pixel (Phong 1975).
//!
//! Per tile and light, what n.l and the highlight can do is bounded first (see [`super::certificate`]): a light behind
//! the whole tile is left out, a diffuse term becomes a certified polynomial, even one that is cut off at zero where the
//! tolerance hardly notices, a specular term is dropped where it cannot reach its share of the tolerance, and becomes a
//! polynomial too where it varies slowly (`highlight`). Only what remains is evaluated pixel by pixel.
//!
//! Rule: what every term costs, rounding included, is taken off the tolerance, and a tile that would overdraw it is
//! evaluated exactly; at tolerance 0 every tile is.

mod by_pixel;
mod exact;
mod highlight;
mod outlook;
mod products;

use std::ops::Range;

use fearless_simd::f64x4;
use fearless_simd::prelude::*;
use glam::DVec3;

use super::certificate::{Color, exponential};
use super::display::Approximate;
use super::number::{ABREAST, Number, Truth};
use super::patch::{Patch, Squares};
use super::polynomial::{Polynomial, Ways};
use super::rows::{Rows, Source};
use super::series::Quadratic;
use super::specular::Squarings;
use super::triangle::Triangle;
use super::{
    BLOCK, Coverage, Evaluations, Scratch, Shader, Sink, Surface, TILE, TileKind, TileRow, limit,
};
use crate::components::PointLight;
use crate::simd::apart;
use by_pixel::ByPixel;
use outlook::Survey;
use products::{Own, Shared, Vectors};

/// The part of the tolerance that dropped specular terms may use up together.
const DROPPED: f64 = 0.25;
/// The part of the tolerance that highlights as polynomials may use up together.
const SMOOTHED: f64 = 0.8;
/// The part of the tolerance that the rounding of highlights should keep to.
const ROUNDED: f64 = 0.5;
/// The part of the tolerance that a cheaper power may use up.
const POWERED: f64 = 0.125;

/// Of so many lights the products are made once a triangle, of others whenever squares are looked at.
const PREPARED: usize = 16;

/// What a triangle of a shaded object brings to all of its tiles.
pub struct Phong<'a, S> {
    /// The instructions there are.
    simd: S,
    surface: Surface<'a>,
    /// As asked for, in levels.
    tolerance: f64,
    /// See [`Surface::rounding`].
    rounding: f64,
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
        let mut lights = [None; PREPARED];
        for (products, light) in lights.iter_mut().zip(&surface.illumination.points) {
            *products = Some(Own::of(triangle, light.position - surface.centre));
        }
        Phong {
            simd,
            surface,
            tolerance,
            rounding: surface.rounding(),
            ambient: surface.ambient(),
            slope: exact::steepest(shininess),
            brightest,
            faint,
            reach,
            shared: Shared::new(&triangle.normal, &triangle.to_eye),
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
    fn reaches<N: Number>(&self, light: &PointLight, lambda: N) -> N::Truth {
        let near = !lambda.like(self.reach).below(lambda);
        let bright = self.surface.coefficients(light)[1].max_element();
        if bright >= self.brightest || !near.any() {
            return near;
        }
        let most = exponential(lambda * -self.surface.material.shininess) * bright;
        near & lambda.like(self.faint).below(most)
    }

    /// Whether anything is to be certified.
    #[inline(always)]
    fn certifies(&self, wanted: [bool; ABREAST]) -> bool {
        self.tolerance > 0.0 && wanted != [false; ABREAST]
    }

    /// The colours of squares as polynomials: four side by side where the instructions are as wide, one by one elsewhere,
    /// with the same bits. `pixels` take what is no polynomial; without them such a square gets none. One function for blocks
    /// and for tiles: two would not stay in the instruction cache together.
    #[inline(always)]
    fn certify(
        &self,
        triangle: &Triangle,
        patches: &[Patch; ABREAST],
        wanted: [bool; ABREAST],
        mut pixels: Option<&mut ByPixel<S>>,
        polynomials: &mut [Option<Polynomial>; ABREAST],
    ) {
        apart(
            self.simd,
            #[inline(always)]
            || {
                if const { size_of::<S::f64s>() >= size_of::<[f64; ABREAST]>() } {
                    let number = f64x4::splat(self.simd, 0.0);
                    let [place, half] = [
                        [
                            number.each(|index| patches[index].middle[0]),
                            number.each(|index| patches[index].middle[1]),
                        ],
                        [
                            number.each(|index| patches[index].half[0]),
                            number.each(|index| patches[index].half[1]),
                        ],
                    ];
                    let wanted = number.each(|index| f64::from(wanted[index]));
                    let wanted = number.below(wanted);
                    let (color, ways) = self.look(triangle, place, half, wanted, pixels);
                    for (index, polynomial) in polynomials.iter_mut().enumerate() {
                        *polynomial = ways.polynomial(index, &color);
                    }
                } else {
                    for (index, polynomial) in polynomials.iter_mut().enumerate() {
                        if wanted[index] {
                            let Patch { middle, half, .. } = patches[index];
                            if let Some(pixels) = &mut pixels {
                                pixels.first = index;
                            }
                            let pixels = pixels.as_deref_mut();
                            let (color, ways) = self.look(triangle, middle, half, true, pixels);
                            *polynomial = ways.polynomial(0, &color);
                        }
                    }
                }
            },
        );
    }

    /// The colours of those squares that are wanted, and how they may be drawn.
    #[inline(always)]
    fn look<N: Number>(
        &self,
        triangle: &Triangle,
        place: [N; 2],
        half: [N; 2],
        wanted: N::Truth,
        pixels: Option<&mut ByPixel<S>>,
    ) -> (Color<N>, Ways) {
        let vectors = apart(
            self.simd,
            #[inline(always)]
            || Vectors::new(&self.shared, place, half),
        );
        let Survey { color, budget } = self.survey(triangle, &vectors, wanted, pixels);
        let ways = apart(
            self.simd,
            #[inline(always)]
            || Ways::new(&color, half, budget),
        );
        (color, ways)
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
                let ramp = ramps.row(row);
                let mut cosine = [0.0; TILE];
                for lane in 0..TILE {
                    let value = exact::at(ramp, lanes[lane]);
                    cosine[lane] = if value > 0.0 { value } else { 0.0 };
                }
                pixels.add(row, diffuse, &cosine);
            }
        }
    }
}

/// A polynomial, and the levels that each pixel of a tile has besides.
struct Mixed<'a> {
    color: &'a Color,
    patch: &'a Patch,
    levels: &'a [TileRow; TILE],
}

impl Source<TILE> for Mixed<'_> {
    #[inline(always)]
    fn for_rows(&self, rows: Range<usize>, target: &mut impl Rows) {
        let ramps = [0, 1, 2].map(|channel| self.color.0[channel].ramps(-self.patch.row));
        let lanes = self.patch.lanes();
        for row in rows {
            let mut levels = self.levels[row];
            for channel in 0..3 {
                let ramp = ramps[channel].row(row);
                for lane in 0..TILE {
                    levels[channel][lane] += exact::at(ramp, lanes[lane]);
                }
            }
            target.take(row, &Approximate(&levels));
        }
    }
}

/// The pixels of a tile, for what has to be evaluated one by one.
struct Pixels<'a> {
    coverage: &'a Coverage,
    levels: &'a mut [TileRow; TILE],
    /// Whether there are no levels yet.
    blank: bool,
    /// Unit normals and unit vectors to the eye, by component, row and lane.
    vectors: &'a mut [[[f32; TILE]; TILE]; 6],
    /// Whether these are there.
    normalised: bool,
}

impl<'a> Pixels<'a> {
    /// Of the tile of a number.
    #[inline(always)]
    fn new(coverage: &'a Coverage, index: usize, scratch: &'a mut Scratch) -> Self {
        Pixels {
            coverage,
            levels: &mut scratch.levels[index],
            blank: true,
            vectors: &mut scratch.vectors,
            normalised: false,
        }
    }

    /// Begins with the same levels everywhere.
    #[inline(always)]
    fn fill(&mut self, levels: DVec3) {
        let levels = levels.as_vec3().to_array();
        self.levels.fill(levels.map(|level| [level; TILE]));
        self.blank = false;
    }

    /// Adds a term to a row: a coefficient a channel, in levels, times a strength a lane.
    #[inline(always)]
    fn add(&mut self, row: usize, coefficients: [f32; 3], strength: &[f32; TILE]) {
        let levels = &mut self.levels[row];
        for channel in 0..3 {
            for lane in 0..TILE {
                let term = coefficients[channel] * strength[lane];
                levels[channel][lane] = if self.blank {
                    term
                } else {
                    levels[channel][lane] + term
                };
            }
        }
    }
}

impl<S: Simd> Shader for Phong<'_, S> {
    #[inline(always)]
    fn certify_blocks(&self, triangle: &Triangle, blocks: &mut Squares<BLOCK>) {
        if self.certifies(blocks.wanted) {
            let polynomials = &mut blocks.polynomials;
            self.certify(triangle, &blocks.patches, blocks.wanted, None, polynomials);
        }
    }

    #[inline(always)]
    fn certify_tiles(&self, triangle: &Triangle, tiles: &mut Squares<TILE>, scratch: &mut Scratch) {
        if !self.certifies(tiles.wanted) {
            return;
        }
        let (patches, polynomials) = (&tiles.patches, &mut tiles.polynomials);
        let mut pixels = ByPixel::new(self, triangle, patches, &tiles.covered, scratch);
        let wanted = tiles.wanted;
        self.certify(triangle, patches, wanted, Some(&mut pixels), polynomials);
        for (index, polynomial) in polynomials.iter_mut().enumerate() {
            if let Some(polynomial) = polynomial {
                if pixels.highlights[index] > 0 {
                    polynomial.kind = TileKind::Highlight;
                } else if pixels.terminators[index] > 0 {
                    polynomial.kind = TileKind::Terminator;
                }
            }
        }
        scratch.highlights = pixels.highlights;
    }

    #[inline(always)]
    fn shade(
        &self,
        triangle: &Triangle,
        tiles: &Squares<TILE>,
        index: usize,
        scratch: &mut Scratch,
        sink: &mut impl Sink,
    ) -> Evaluations {
        let (patch, coverage) = (&tiles.patches[index], &tiles.covered[index]);
        if let Some(polynomial) = &tiles.polynomials[index] {
            let mixed = Mixed {
                color: &polynomial.color,
                patch,
                levels: &scratch.levels[index],
            };
            apart(
                self.simd,
                #[inline(always)]
                || sink.draw(&mixed, coverage),
            );
            return Evaluations {
                specular: u64::from(coverage.pixels) * scratch.highlights[index],
                ..Evaluations::of(polynomial.kind)
            };
        }
        let in_lanes = if patch.steady {
            apart(
                self.simd,
                #[inline(always)]
                || self.shade_lanes(triangle, tiles, index, scratch, sink),
            )
        } else {
            None
        };
        in_lanes.unwrap_or_else(|| self.shade_doubles(triangle, patch, coverage, sink))
    }
}
