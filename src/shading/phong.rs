//! Position and normal interpolated, the model at every pixel (Phong 1975): the whole of it, certified square by square.
//!
//! A light behind the whole square is left out, and a highlight that stays below its share of the tolerance. What remains
//! is interpolated through nine samples where [`super::bound`] shows that this keeps the tolerance, and evaluated at every
//! pixel elsewhere.
//!
//! Rule: what every term costs, rounding included, is taken off the tolerance. At tolerance 0 every pixel is evaluated, and
//! the tolerance is what the contract calls exact.

mod tile;

use fearless_simd::{Simd, f32x16, f64x4};
use glam::DVec3;

pub use self::tile::TileLights;
use self::tile::has;
use super::affine::Affine;
use super::face::{Face, Linear};
use super::field::Moving;
use super::gloss::Gloss;
use super::interpolation::LEBESGUE;
use super::kernel::{self, Light, Model, Reals, Vector, elements};
use super::pixels::Pixels;
use super::rounding::{Extent, Rounding};
use super::square::{MIN_SIDE, Square};
use super::{Evaluations, Scratch, Surface, TileKind, U, limit};
use crate::components::{PointLight, length, unit};

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
    fn new(
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
    /// The rounding error of a node's levels (powers in f32, all else in f64) times the Lebesgue constant 25/9. Nodes are not
    /// displayed: the two roundings counted for the display cover those of the interpolation in f64.
    sample_error: f64,
}

impl<'a> Phong<'a> {
    /// A face of an object, from its normals; `lights` is overwritten with those that reach it.
    pub fn new(
        face: &'a Face,
        normals: Linear,
        surface: Surface<'a>,
        eye: DVec3,
        gloss: &'a Gloss,
        lights: &'a mut Vec<FaceLight>,
        tolerance: f64,
    ) -> Self {
        lights.clear();
        let points = surface.illumination.points.iter();
        lights.extend(
            points.filter_map(|light| FaceLight::new(face, &normals, &surface, light, eye)),
        );
        let mut rounding = Rounding::new(
            kernel::DOUBLE,
            [Extent::LARGEST; 2],
            surface.ambient().max_element(),
        );
        for light in lights.iter() {
            rounding.diffuse(Extent::LARGEST, light.diffuse.max_element());
            if light.specular != DVec3::ZERO {
                rounding.specular(Extent::LARGEST, light.specular.max_element(), &gloss.full);
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
            sample_error: rounding.levels() * LEBESGUE,
        }
    }

    /// See [`super::Shader::evaluate`].
    pub fn evaluate<S: Simd>(
        &self,
        simd: S,
        square: &Square,
        picture: [f64; 2],
        index: usize,
        scratch: &mut Scratch,
    ) -> Option<Evaluations> {
        let middle = square.middle_from(picture);
        if !self.face.is_steady_on(middle, square.half()) {
            return None;
        }
        let Scratch {
            pixels,
            tile,
            single,
            double,
            ..
        } = scratch;
        let kind = self.precision(tile, index)?;
        // f64 takes four times as long, and on a quarter f32 may suffice.
        if kind == TileKind::Double && square.side > MIN_SIDE {
            return None;
        }
        let highlights = if kind == TileKind::Exact {
            self.fill::<S, f32x16<S>>(simd, middle, tile, index, single, pixels)
        } else {
            self.fill::<S, f64x4<S>>(simd, middle, tile, index, double, pixels)
        };
        let pixels = pixels.count();
        Some(Evaluations {
            kind,
            model: pixels as u64,
            specular: (pixels * highlights) as u64,
        })
    }

    /// In which arithmetic the lights of one of four squares are evaluated; none where neither keeps the tolerance.
    fn precision(&self, tile: &TileLights, index: usize) -> Option<TileKind> {
        let extents = [tile.normal[index], tile.eye[index]];
        let ambient = self.surface.ambient().max_element();
        let mut roundings = [U, kernel::DOUBLE].map(|unit| Rounding::new(unit, extents, ambient));
        // The specular term jumps where n.l = 0. f32 may put a pixel on the wrong side, so squares where it jumps by more than
        // what is faint take f64.
        let (mut dropped, mut gated) = (0.0, false);
        for on in tile.lights.iter().filter(|on| !has(on.dark, index)) {
            let (light, extent) = (&self.lights[on.light], on.extents[index]);
            let shines = has(on.shines, index);
            if light.specular != DVec3::ZERO {
                // Where it is drawn, a cheaper power may still leave out what is as faint.
                dropped += self.gloss.faint;
            }
            if shines && !light.lit && !has(on.lit, index) {
                let least = self.gloss.least - 2.0 * roundings[0].cosine(extent);
                // Not below: what is not a number may jump.
                let faint = on.gates[index] < least;
                gated |= !faint;
            }
            for rounding in &mut roundings {
                rounding.diffuse(extent, light.diffuse.max_element());
                if shines {
                    rounding.specular(extent, light.specular.max_element(), &self.gloss.truncated);
                }
            }
        }
        let budget = limit(self.tolerance) - dropped;
        let [single, double] = roundings.map(|rounding| rounding.levels());
        if single <= budget && !gated {
            Some(TileKind::Exact)
        } else {
            (double <= budget).then_some(TileKind::Double)
        }
    }

    /// Evaluates the lights of one of four squares; how many of them have a highlight.
    fn fill<S: Simd, V: Reals<S>>(
        &self,
        simd: S,
        [x, y]: [f64; 2],
        tile: &TileLights,
        index: usize,
        lights: &mut Vec<Light<V::Element>>,
        pixels: &mut Pixels,
    ) -> usize {
        let unit = |vector: &Affine| {
            let centre = vector.at(x, y);
            let scale = 1.0 / length(centre);
            Vector::new::<S, V>(&Affine { centre, ..*vector }.map(|v| v * scale))
        };
        lights.clear();
        let reaching = tile.lights.iter().filter(|on| !has(on.dark, index));
        lights.extend(reaching.map(|on| {
            let light = &self.lights[on.light];
            Light {
                vector: unit(&light.towards.vector),
                diffuse: elements::<S, V>(light.diffuse),
                specular: elements::<S, V>(light.specular),
                has_diffuse: light.diffuse != DVec3::ZERO,
                has_specular: has(on.shines, index),
            }
        }));
        let model = Model::<S, V> {
            simd,
            normal: unit(&self.normal.vector),
            eye: unit(&self.face.rays.to_eye.vector),
            highlights: lights.iter().filter(|light| light.has_specular).count(),
            lights,
            ambient: elements::<S, V>(self.surface.ambient()),
            power: &self.gloss.truncated,
        };
        model.fill(pixels);
        model.highlights
    }

    /// See [`super::Shader::define`].
    pub fn define(&self, x: f64, y: f64) -> DVec3 {
        let point = self.face.point(x, y);
        let normal = unit(self.normals.at(point.place));
        let to_eye = if point.clamped {
            self.face.clamped_to_eye(&point)
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
