//! Position and normal interpolated, the model at every pixel (Phong 1975): the whole of it, certified square by square.
//!
//! A light behind the whole square is left out, and a highlight that stays below its share of the tolerance. What remains
//! is interpolated through nine samples where [`super::bound`] shows that this keeps the tolerance, and evaluated at every
//! pixel elsewhere.
//!
//! Rule: what every term costs, rounding included, is taken off the tolerance. At tolerance 0 every pixel is evaluated, and
//! the tolerance is what the contract calls exact.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, f64x4, mask64x4};
use glam::DVec3;

use super::affine::Affine;
use super::bound;
use super::display::Levels;
use super::face::{Face, Linear};
use super::field::{self, Field, Lanes, Moving, Places};
use super::gloss::Gloss;
use super::interpolation::{Colors, Interpolant, LEBESGUE, Nine, biquadratic};
use super::kernel::{self, Light, Model, Reals, Vector, elements};
use super::rounding::{Extent, Rounding};
use super::square::Region;
use super::{Evaluations, Scratch, Surface, TileKind, U, limit};
use crate::components::{PointLight, length, unit};
use crate::simd::{outlined, three, two};

/// A point light as a face sees it.
#[derive(Clone, Copy, Debug)]
pub struct FaceLight {
    /// w (L - P).
    towards: Moving,
    /// What n.l and s^rho are multiplied with, in levels.
    diffuse: DVec3,
    specular: DVec3,
    /// Whether it lights all of the face.
    lit: bool,
}

impl FaceLight {
    /// A light that lights a face at all; `eye` in world units.
    pub fn new(
        face: &Face,
        normals: &Linear,
        surface: &Surface,
        light: &PointLight,
        eye: DVec3,
    ) -> Option<Self> {
        let [diffuse, specular] = surface.coefficients(light);
        if diffuse == DVec3::ZERO && specular == DVec3::ZERO {
            return None;
        }
        let position = light.position - eye;
        let [most, least] = face.light_from(position, normals);
        // Not below: what is not a number may light.
        let dark = most < 0.0;
        (!dark).then(|| FaceLight {
            towards: face
                .towards(position, light.position - surface.centre)
                .into(),
            diffuse,
            specular,
            lit: least > 0.0,
        })
    }
}

/// What a face of a shaded object brings to all of its squares.
pub struct Phong<'a> {
    /// What is interpolated.
    pub face: &'a Face<'a>,
    /// What is shaded.
    pub surface: Surface<'a>,
    /// The eye, in world units.
    pub eye: DVec3,
    /// Its highlights.
    pub gloss: &'a Gloss,
    /// The lights that reach it.
    pub lights: &'a [FaceLight],
    /// As asked for, in levels.
    pub tolerance: f64,
    /// The interpolated normal, and the same times w.
    normals: Linear,
    normal: Moving,
    /// What samples err by, in levels, times what interpolation makes of it: powers are in f32, all else in f64. Samples go to
    /// no display, so what is counted for that covers the rounding of middles and coefficients in f64.
    sampling: f64,
}

/// A light that reaches any of four squares, and sets of these, a bit each: those that it lights all over, on which its
/// highlight is drawn, and that its terminator crosses.
#[derive(Clone, Copy, Debug)]
pub struct Reaching {
    light: usize,
    squares: [u64; 3],
}

/// A light that is evaluated on one square, and which of its terms.
#[derive(Clone, Copy, Debug)]
pub struct Active {
    light: usize,
    terms: [bool; 2],
}

impl<'a> Phong<'a> {
    /// A face of an object, from the normals at its middle and what changes them.
    pub fn new(
        face: &'a Face,
        normals: Linear,
        surface: Surface<'a>,
        eye: DVec3,
        gloss: &'a Gloss,
        lights: &'a [FaceLight],
        tolerance: f64,
    ) -> Self {
        let mut rounding = Rounding::new(
            kernel::DOUBLE,
            [Extent::CALM; 2],
            surface.ambient().max_element(),
        );
        for light in lights {
            rounding.diffuse(Extent::CALM, light.diffuse.max_element());
            if light.specular != DVec3::ZERO {
                rounding.specular(Extent::CALM, light.specular.max_element(), &gloss.every);
            }
        }
        Phong {
            face,
            surface,
            eye,
            gloss,
            lights,
            tolerance,
            normals,
            normal: face.place.map(|place| normals.scaled(place)).into(),
            sampling: rounding.levels() * LEBESGUE,
        }
    }

    /// Whether a highlight is drawn on squares where s is at most so much.
    #[inline(always)]
    fn shines<S: Simd>(&self, most: Lanes<S>, dark: mask64x4<S>) -> mask64x4<S> {
        most.simd_gt(self.gloss.least) & !dark
    }

    /// See [`super::Shader::interpolate`].
    #[inline(always)]
    pub fn interpolate<S: Simd>(
        &self,
        simd: S,
        places: &Places<S>,
        reaching: &mut Vec<Reaching>,
    ) -> Option<Interpolant<S>> {
        let normal = Field::new(&self.normal, places);
        let eye = Field::new(&self.face.rays.to_eye, places);
        // Of all lights first: what they leave of the tolerance often is nothing.
        let budget = self.budget(places, &normal, &eye, reaching)?;
        let zero = Lanes::splat(simd, 0.0);
        let ambient = self.surface.ambient();
        let mut colors: [Nine<S>; 4] = [[[zero; 3]; 3]; 4];
        for channel in 0..3 {
            colors[channel][0][0] += ambient[channel];
        }
        let mut crossing = [zero; 3];
        let mut crosses = 0;
        for light in reaching.iter() {
            let [lit, shines, cut] = three!(|set| mask64x4::from_bitmask(simd, light.squares[set]));
            let light = &self.lights[light.light];
            let to_light = Field::new(&light.towards, places);
            let [mut cosines, mut powers]: [Nine<S>; 2] = [[[zero; 3]; 3]; 2];
            let any_shines = shines.any_true();
            for row in 0..3 {
                for column in 0..3 {
                    let (n, l) = (normal.node(row, column), to_light.node(row, column));
                    if any_shines {
                        let (n, o) = (
                            kernel::unit(simd, n),
                            kernel::unit(simd, eye.node(row, column)),
                        );
                        [cosines[row][column], powers[row][column]] =
                            kernel::highlight(simd, &self.gloss.every, &n, &l, &o);
                    } else {
                        cosines[row][column] = kernel::cosine(&n, kernel::dot(&n, &n), &l);
                    }
                }
            }
            let cosines = biquadratic(&cosines);
            add_to(&mut colors, &cosines, light.diffuse, lit);
            if any_shines {
                add_to(&mut colors, &biquadratic(&powers), light.specular, shines);
            }
            if cut.any_true() {
                crosses |= cut.to_bitmask();
                for channel in 0..3 {
                    let levels = Lanes::splat(simd, light.diffuse[channel]);
                    crossing[channel] = cut.select(levels, crossing[channel]);
                }
                for j in 0..3 {
                    for i in 0..3 {
                        colors[3][j][i] = cut.select(cosines[j][i], colors[3][j][i]);
                    }
                }
            }
        }
        Some(Interpolant::new(Colors {
            terms: colors,
            crossing,
            crosses: mask64x4::from_bitmask(simd, crosses),
            budget,
        }))
    }

    /// What the lights leave of the tolerance on four squares, and which of them reach any of these; none where nothing is left
    /// on any.
    #[inline(always)]
    fn budget<S: Simd>(
        &self,
        places: &Places<S>,
        normal: &Field<S>,
        eye: &Field<S>,
        reaching: &mut Vec<Reaching>,
    ) -> Option<Lanes<S>> {
        // What pixels show of a sliver is held on the face, one by one.
        let least = field::least(&self.face.plane.w, places);
        let simd = least.token();
        let zero = Lanes::splat(simd, 0.0);
        let never = Lanes::splat(simd, f64::NEG_INFINITY);
        let steady = least.simd_gt(self.face.least_steady().max(0.0));
        let steady = steady & normal.is_calm() & eye.is_calm();
        let mut budget = steady.select(Lanes::splat(simd, self.tolerance - self.sampling), never);
        let mut crosses = mask64x4::splat(simd, false);
        reaching.clear();
        for (index, light) in self.lights.iter().enumerate() {
            let to_light = Field::new(&light.towards, places);
            let side = bound::side(normal, &to_light);
            if side.dark.all_true() {
                continue;
            }
            let mut error = bound::cosine_error(normal, &to_light) * light.diffuse.max_element();
            let mut shines = mask64x4::splat(simd, false);
            if light.specular != DVec3::ZERO {
                let reflection = bound::reflection(normal, &to_light, eye, side.cosine);
                shines = self.shines(reflection.most, side.dark);
                let power = bound::power(&self.gloss.every, reflection.most);
                let mut highlight = power;
                if shines.any_true() {
                    let bound = &self.gloss.bound;
                    let bound = bound.error(normal, &to_light, eye, &reflection, power);
                    highlight = shines.select(bound, power);
                }
                error += highlight * light.specular.max_element();
            }
            // One light of a square may cross n.l = 0 there, if its highlight is not drawn.
            let idle = mask64x4::splat(simd, light.diffuse == DVec3::ZERO) & !shines;
            let cut = !(side.lit | side.dark | idle | shines | crosses);
            crosses |= cut;
            let sure = to_light.is_calm() & (side.lit | side.dark | idle | cut);
            budget -= side.dark.select(zero, error);
            budget = sure.select(budget, never);
            if !budget.simd_gt(0.0).any_true() {
                return None;
            }
            let squares = [side.lit, shines, cut];
            reaching.push(Reaching {
                light: index,
                squares: three!(|set| squares[set].to_bitmask()),
            });
        }
        Some(budget)
    }

    /// See [`super::Shader::evaluate`].
    pub fn evaluate<S: Simd>(
        &self,
        simd: S,
        region: &Region,
        scratch: &mut Scratch,
    ) -> Option<Evaluations> {
        let (middle, half) = (region.middle(), region.square.half());
        if !self.face.is_steady_on(middle, half) {
            return None;
        }
        let places = Places::single(simd, middle, half);
        let Scratch {
            levels,
            active,
            single,
            double,
            ..
        } = scratch;
        let kind = outlined!(simd, self.survey(&places, active))?;
        let highlights = if kind == TileKind::Exact {
            self.fill::<S, f32x16<S>>(simd, region, active, single, levels)
        } else {
            self.fill::<S, f64x4<S>>(simd, region, active, double, levels)
        };
        let pixels = region.square.pixels;
        Some(Evaluations {
            kind,
            model: pixels as u64,
            specular: (pixels * highlights) as u64,
        })
    }

    /// Finds the lights that are evaluated on a square, and in which arithmetic; none where neither keeps the tolerance.
    #[inline(always)]
    fn survey<S: Simd>(&self, places: &Places<S>, active: &mut Vec<Active>) -> Option<TileKind> {
        let normal = Field::new(&self.normal, places);
        let eye = Field::new(&self.face.rays.to_eye, places);
        let extents = [(&normal).into(), (&eye).into()];
        let ambient = self.surface.ambient().max_element();
        let mut roundings =
            two!(|index| Rounding::new([U, kernel::DOUBLE][index], extents, ambient));
        // The specular term jumps where n.l = 0. f32 may put a pixel on the wrong side, so squares where it jumps by more than
        // what is faint take f64.
        let (mut dropped, mut gated) = (0.0, false);
        active.clear();
        for (index, light) in self.lights.iter().enumerate() {
            let to_light = Field::new(&light.towards, places);
            let extent = Extent::from(&to_light);
            let side = bound::side(&normal, &to_light);
            if side.dark.test(0) {
                continue;
            }
            let mut specular = false;
            if light.specular != DVec3::ZERO {
                let reflection = bound::reflection(&normal, &to_light, &eye, side.cosine);
                specular = self.shines(reflection.most, side.dark).test(0);
                // Where it is drawn, a cheaper power may still leave out what is as faint.
                dropped += self.gloss.faint;
                if specular {
                    let least = self.gloss.least - 2.0 * roundings[0].cosine(extent);
                    let faint = bound::gate(&to_light, &eye).simd_lt(least);
                    gated |= !(light.lit || side.lit.test(0) || faint.test(0));
                }
            }
            for rounding in &mut roundings {
                rounding.diffuse(extent, light.diffuse.max_element());
                if specular {
                    rounding.specular(extent, light.specular.max_element(), &self.gloss.bright);
                }
            }
            active.push(Active {
                light: index,
                terms: [light.diffuse != DVec3::ZERO, specular],
            });
        }
        let budget = limit(self.tolerance) - dropped;
        let [single, double] = roundings.map(|rounding| rounding.levels());
        if single <= budget && !gated {
            Some(TileKind::Exact)
        } else {
            (double <= budget).then_some(TileKind::Double)
        }
    }

    /// Evaluates the active lights on a square; how many of them have a highlight.
    fn fill<S: Simd, V: Reals<S>>(
        &self,
        simd: S,
        region: &Region,
        active: &[Active],
        lights: &mut Vec<Light<V::Element>>,
        levels: &mut Levels,
    ) -> usize {
        let [x, y] = region.middle();
        let unit = |vector: &Affine| {
            let centre = vector.at(x, y);
            let scale = 1.0 / length(centre);
            Vector::new::<S, V>(&Affine { centre, ..*vector }.map(|v| v * scale))
        };
        lights.clear();
        for &Active { light, terms } in active {
            let light = &self.lights[light];
            lights.push(Light {
                vector: unit(&light.towards.vector),
                levels: [light.diffuse, light.specular].map(elements::<S, V>),
                is: terms,
            });
        }
        let model = Model::<S, V, false> {
            simd,
            normal: unit(&self.normal.vector),
            eye: unit(&self.face.rays.to_eye.vector),
            highlights: lights.iter().filter(|light| light.is[1]).count(),
            lights,
            ambient: elements::<S, V>(self.surface.ambient()),
            power: &self.gloss.bright,
        };
        model.fill(region, levels, |_| true);
        model.highlights
    }

    /// See [`super::Shader::define`].
    pub fn define(&self, x: f64, y: f64) -> DVec3 {
        let point = self.face.point(x, y);
        let normal = unit(self.normals.at(point.place));
        let to_eye = if point.held {
            self.face.held_to_eye(&point)
        } else {
            self.face.rays.to_eye.vector.at(x, y)
        };
        self.surface.sum(normal, unit(to_eye), |light| {
            let [from_eye, from_centre] =
                [self.eye, self.surface.centre].map(|origin| light.position - origin);
            unit(self.face.to_light(&point, from_eye, from_centre, [x, y]))
        })
    }
}

/// Adds a light's term on some of the squares: a value times what it is multiplied with.
#[inline(always)]
fn add_to<S: Simd>(colors: &mut [Nine<S>; 4], term: &Nine<S>, levels: DVec3, on: mask64x4<S>) {
    let zero = Lanes::splat(term[0][0].token(), 0.0);
    for channel in 0..3 {
        let levels = on.select(Lanes::splat(zero.token(), levels[channel]), zero);
        for j in 0..3 {
            for i in 0..3 {
                colors[channel][j][i] += term[j][i] * levels;
            }
        }
    }
}
