//! Phong shading of a face (Phong 1975): position and normal are interpolated, the illumination model is evaluated at every
//! pixel, or at nine nodes of a square.
//!
//! ```text
//!   on a square a light is       dark, n.l <= 0 all over; lit, n.l > 0 all over; or neither
//!   its highlight is             drawn, or so faint that it is left out
//!   levels                       ambient + sum of diffuse n.l + specular s^rho, where 1 - s = |r - o|^2 / 2
//! ```
//! The lights are classified once. If all errors together leave something of the tolerance, the square is interpolated
//! through nine samples. One light may have a fourth channel to itself: its n.l, if that crosses 0, or the logarithm of its
//! highlight. Otherwise the same lights are evaluated at the pixels. Samples and pixels share one function, whose rounding
//! errors [`super::rounding`] counts. For unit vectors 1 - s equals |r - o|^2 / 2, which loses no digits
//! (Lyon 1993).
//!
//! f32 does not suffice where the sign of n.l is in doubt, because a highlight jumps there, and where |s| < 1/256 and 0 <
//! rho < 1, because the slope of s^rho is too steep. Such a pixel is marked by a level that is not a number, and evaluated
//! again in f64. Without these marks the whole square would be evaluated in f64.
//!
//! Decisions depend on the face and on the square, with one exception: bounds are computed only if a group of four squares covers
//! enough pixels (`WORTHWHILE` of `systems/rasterization/quadtree.rs`). A group is four neighbours in a row, counted from the first
//! square of the face, or the quarters of one square. So neither threads nor parts of a picture change a decision.

mod light;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, f64x4, mask64x4};
use glam::DVec3;

use self::light::Budget;
pub use self::light::FaceLight;
use super::affine::Affine;
use super::face::Face;
use super::gloss::Gloss;
use super::interpolation::{AMPLIFICATION, FOURTH, Interpolant, sampled};
use super::lanes::{SquareSet, affine_at, dot, has};
use super::limit;
use super::moving::{Extents, MovingVector};
use super::rounding::Rounding;
use super::specular;
use super::surface::Surface;
use crate::components::{Projection, unit};
use crate::shading::simd::{inlined, three};

/// A face of an object, its lights and its normals; and the squares of it that were prepared last.
pub struct Phong<'a> {
    pub face: &'a Face<'a>,
    pub surface: Surface<'a>,
    gloss: &'a Gloss,
    /// The lights that reach it.
    lights: &'a mut Vec<FaceLight>,
    /// In levels.
    pub tolerance: f64,
    /// The ambient term, in levels.
    ambient: [f32; 3],
    /// The interpolated normal by u and v; and times w, by pixel.
    normal_by_uv: Affine,
    normal_by_pixel: Affine,
    /// w n and w (O - P), scaled to length one at the middle of each square.
    normal_by_square: [Affine<[f32; 4]>; 3],
    eye_by_square: [Affine<[f32; 4]>; 3],
    /// Where any highlight is drawn.
    shines: SquareSet,
    /// Where levels in f32 keep the tolerance.
    pub in_f32: SquareSet,
}

impl<'a> Phong<'a> {
    /// A face with these normals; `lights` is overwritten with the lights that may add to it.
    pub fn new(
        face: &'a Face,
        normals: Affine,
        surface: Surface<'a>,
        gloss: &'a Gloss,
        lights: &'a mut Vec<FaceLight>,
        tolerance: f64,
    ) -> Self {
        let points = &surface.illumination.points;
        // Lights are overwritten in place. To copy new ones takes 2 % of the time of many small cuboids.
        lights.resize(points.len(), FaceLight::default());
        for (light, point) in lights.iter_mut().zip(points) {
            let coefficients = surface.coefficients(point);
            light.most = coefficients.map(DVec3::max_element);
            if surface.plane.is_some() && !surface.is_lit(point, 0.0) {
                light.most = [0.0; 2];
            }
            if light.most != [0.0; 2] {
                let from_eye = point.position - face.rays.lens.eye;
                light.by_pixel = face.towards(from_eye, point.position - surface.centre);
                [light.diffuse, light.specular] = coefficients.map(|it| it.as_vec3().to_array());
            }
        }
        lights.retain(|light| light.most != [0.0; 2]);
        Phong {
            face,
            surface,
            gloss,
            lights,
            tolerance,
            ambient: surface.ambient().as_vec3().to_array(),
            normal_by_uv: normals,
            normal_by_pixel: face.uvw.map(|it| normals.homogeneous(it.x, it.y, it.z)),
            normal_by_square: Default::default(),
            eye_by_square: Default::default(),
            shines: 0,
            in_f32: 0,
        }
    }

    /// See [`super::Shader::prepare`].
    #[inline(always)]
    pub fn prepare<S: Simd>(
        &mut self,
        simd: S,
        extents: &Extents<S>,
        interpolate: bool,
    ) -> Option<Interpolant<S>> {
        let rest = self.classify(extents, interpolate);
        let possible = rest.simd_gt(0.0).to_bitmask();
        if !interpolate || possible == 0 {
            return None;
        }
        let sample = inlined!(|square, xy| self.levels(simd, square, true, xy));
        let terms = sampled(simd, possible, sample);
        let (mut factors, mut logarithms) = ([[0.0; 3]; 4], 0);
        for light in self.lights.iter() {
            for square in 0..4 {
                if has(light.kink, square) {
                    factors[square] = light.diffuse;
                } else if has(light.logarithm, square) {
                    factors[square] = light.specular;
                }
            }
            logarithms |= light.logarithm;
        }
        Some(Interpolant::new(terms, factors, logarithms, rest))
    }

    /// Whether f32 has the signs of n.l and s at all pixels of a square, wherever a highlight depends on them.
    pub fn has_signs(&self, index: usize) -> bool {
        self.highlights(index)
            .all(|light| light.doubt[index] == 0.0 && self.gloss.doubt == 0.0)
    }

    /// Classifies the lights on squares, and decides where f32 suffices. Returns what remains of the tolerance for the rows of an
    /// interpolated square: at most 0 where an error has no bound. Unless the caller uses it, the compiler removes its computation.
    #[inline(always)]
    fn classify<S: Simd>(&mut self, extents: &Extents<S>, interpolate: bool) -> f64x4<S> {
        let w = extents.affine(&self.face.plane.w);
        let simd = w.centre.token();
        let splat = inlined!(|number: f64| f64x4::splat(simd, number));
        let normal = &MovingVector::new(&self.normal_by_pixel, extents);
        let eye = &MovingVector::new(&self.face.rays.to_eye, extents);
        self.normal_by_square = normal.single();
        self.eye_by_square = eye.single();
        // A square with pixels that may be clamped to the face is not interpolated.
        let least_w = w.centre - w.dx.abs() - w.dy.abs();
        let steady = least_w.simd_gt(self.face.least_steady().max(0.0));
        let mut budget = Budget {
            rest: splat(self.tolerance),
            rounding: Rounding::new(normal, eye, self.surface.ambient().max_element()),
            left_out: splat(0.0),
            is_bounded: steady & normal.is_direction_bounded() & eye.is_direction_bounded(),
            is_fourth_taken: mask64x4::splat(simd, !interpolate),
        };
        let all_lit = mask64x4::splat(simd, self.surface.plane.is_some());
        self.shines = 0;
        for light in self.lights.iter_mut() {
            light.classify(self.gloss, [normal, eye], extents, all_lit, &mut budget);
            self.shines |= light.shines;
        }
        let rounding = budget.rounding.total();
        let error = rounding + budget.left_out;
        self.in_f32 = (steady & error.simd_le(limit(self.tolerance))).to_bitmask();
        let rest = budget.rest - rounding * AMPLIFICATION;
        budget.is_bounded.select(rest, splat(-1.0))
    }

    /// The levels at points of a square, x and y from -1 to 1; and at nodes the fourth channel, whose light is left out of them.
    #[inline(always)]
    pub fn levels<S: Simd>(
        &self,
        simd: S,
        square: usize,
        are_nodes: bool,
        xy: [f32x16<S>; 2],
    ) -> [f32x16<S>; 4] {
        let zero = f32x16::splat(simd, 0.0);
        let vector = inlined!(|of: &[Affine<[f32; 4]>; 3]| {
            three!(|axis| affine_at(&of[axis], square, xy))
        });
        let unit = inlined!(|vector: [f32x16<S>; 3]| {
            let inverse = 1.0 / dot(&vector, &vector).sqrt();
            three!(|axis| vector[axis] * inverse)
        });
        let normal = vector(&self.normal_by_square);
        // Only highlights need unit vectors. Without them n.l takes one root, and exact frames 5 % less time.
        let (n, o, n2) = if has(self.shines, square) {
            (unit(normal), unit(vector(&self.eye_by_square)), zero + 1.0)
        } else {
            (normal, normal, dot(&normal, &normal))
        };
        let [red, green, blue] = three!(|channel| f32x16::splat(simd, self.ambient[channel]));
        let mut levels = [red, green, blue, zero];
        let lights = self.lights.iter();
        for light in lights.filter(|light| has(light.reaches, square)) {
            let l = vector(&light.by_square);
            let inverse = 1.0 / (n2 * dot(&l, &l)).sqrt();
            let cosine = dot(&n, &l) * inverse;
            if are_nodes && has(light.kink, square) {
                levels[FOURTH] += cosine;
            } else if light.most[0] > 0.0 {
                let lit = cosine.max(zero);
                for channel in 0..3 {
                    levels[channel] += lit * light.diffuse[channel];
                }
            }
            if has(light.shines, square) {
                let twice = cosine + cosine;
                let e = three!(|axis| n[axis] * twice - l[axis] * inverse - o[axis]);
                let one_minus_cos = dot(&e, &e) * 0.5;
                if are_nodes && has(light.logarithm, square) {
                    levels[FOURTH] += specular::exponent(self.gloss.shininess, one_minus_cos);
                } else {
                    let power = specular::power(self.gloss.shininess, one_minus_cos);
                    let power = if self.surface.plane.is_some() {
                        power
                    } else {
                        cosine.simd_gt(zero).select(power, zero)
                    };
                    for channel in 0..3 {
                        levels[channel] += power * light.specular[channel];
                    }
                }
                let doubt = cosine.abs().simd_lt(light.doubt[square])
                    | (1.0 - one_minus_cos).abs().simd_lt(self.gloss.doubt);
                levels[0] = doubt.select(f32x16::splat(simd, f32::NAN), levels[0]);
            }
        }
        levels
    }

    /// The lights whose highlights are evaluated at a pixel of a square in f32.
    pub fn highlights(&self, index: usize) -> impl Iterator<Item = &FaceLight> {
        let lights = self.lights.iter();
        lights.filter(move |light| has(light.shines, index))
    }

    /// See [`super::Shader::levels_f64`].
    pub fn levels_f64(&self, x: f64, y: f64) -> DVec3 {
        let face = self.face;
        let ([u, v], is_clamped) = face.uv_at(x, y);
        // A clamped point is not where the line of sight through the pixel meets the plane.
        let point = face.from_eye([u, v]);
        let is_turned = is_clamped && face.rays.lens.projection == Projection::Perspective;
        let to_eye = if is_turned {
            -point
        } else {
            face.rays.to_eye.at(x, y)
        };
        let normal = unit(self.normal_by_uv.at(u, v));
        self.surface.sum(normal, unit(to_eye), |light| {
            let from_eye = light.position - face.rays.lens.eye;
            unit(if is_clamped {
                from_eye - point
            } else {
                let from_centre = light.position - self.surface.centre;
                face.towards(from_eye, from_centre).at(x, y)
            })
        })
    }
}
