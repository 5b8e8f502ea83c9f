//! Phong shading of a face (Phong 1975): position and normal are interpolated, the illumination model is evaluated at every
//! pixel, or at nine nodes of a square.
//!
//! ```text
//!   on a square a light is       dark, n.l <= 0 all over      lit, n.l > 0 all over      crossing      unsure
//!   its highlight is             drawn, in a polynomial or from its logarithm, or so faint that it is left out
//!   levels                       ambient + sum of diffuse n.l + specular s^rho, where 1 - s = |r - o|^2 / 2
//! ```
//! The lights are classified once. If all errors together leave something of the tolerance, the square is interpolated
//! through nine samples. Otherwise the same lights are evaluated at its pixels. Samples and pixels share one function,
//! whose rounding errors [`super::rounding`] counts. For unit vectors 1 - s equals |r - o|^2 / 2, which loses no digits
//! (Lyon 1993).
//!
//! f32 does not suffice where the sign of n.l is in doubt, because a highlight jumps there, and where |s| < 1/256 and 0 <
//! rho < 1, because the slope of s^rho is too steep. Such a pixel is marked by a level that is not a number, and evaluated
//! again in f64. Without these marks the whole square would be evaluated in f64.
//!
//! All decisions depend on the four squares and their face alone, so neither threads nor parts of a picture change them.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, f64x4, mask64x4};
use glam::DVec3;

use super::affine::Affine;
use super::face::Face;
use super::field::{Extents, Field};
use super::gloss::Gloss;
use super::interpolation::{AMPLIFICATION, Interpolant, sampled};
use super::lanes::{LaneLayout, Squares, dot, has};
use super::rounding::Rounding;
use super::specular::{self, POWER_ERROR};
use super::square::MIN_SIDE;
use super::surface::Surface;
use super::{U, bound, limit};
use crate::components::{PointLight, Projection, unit};
use crate::simd::{four, inlined, three};

/// A square that can be cut is drawn with the power of a highlight at each pixel only if the error of a polynomial exceeds what
/// is left of the tolerance by this factor: otherwise its quarters may be polynomials, which are cheaper.
const QUARTERS_BEND: f64 = 16.0;

/// A point light on a face, and on the four squares prepared last.
#[derive(Clone, Copy, Debug, Default)]
pub struct FaceLight {
    /// w (L - P).
    by_pixel: Affine,
    /// The factors of n.l and s^rho, in levels.
    diffuse: [f32; 3],
    specular: [f32; 3],
    /// The largest channel of each.
    most: [f64; 2],
    /// Where n.l may be above 0.
    reaches: Squares,
    /// Where its highlight is drawn.
    shines: Squares,
    /// Where it is the light that crosses n.l = 0. Its highlight is left out there.
    crosses: Squares,
    /// Where the logarithm of its highlight is interpolated.
    logarithms: Squares,
    /// `by_pixel`, scaled to length one at the middle of each square.
    by_square: [Affine<[f32; 4]>; 3],
    /// If |n.l| is smaller than this, f32 may have the wrong sign of n.l, on which the highlight depends.
    doubt: [f32; 4],
}

impl FaceLight {
    /// Overwrites it with a light on a face. `most` is 0 if it adds nothing to the face.
    fn set(&mut self, face: &Face, surface: &Surface, light: &PointLight) {
        let position = light.position - face.rays.lens.eye;
        let coefficients = surface.coefficients(light);
        self.most = coefficients.map(DVec3::max_element);
        if self.most == [0.0; 2] {
            return;
        }
        self.by_pixel = face.towards(position, light.position - surface.centre);
        [self.diffuse, self.specular] = coefficients.map(|levels| levels.as_vec3().to_array());
    }
}

/// A face of an object, its lights and its normals; and the four squares of it that were prepared last.
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
    shines: Squares,
    /// Where levels in f32 keep the tolerance.
    pub in_f32: Squares,
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
            light.set(face, &surface, point);
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
        if !interpolate || !rest.simd_gt(0.0).any_true() {
            return None;
        }
        let zero = f64x4::splat(simd, 0.0);
        let sample = inlined!(|xy| self.levels(simd, LaneLayout::Nodes, xy));
        let terms = sampled(simd, sample);
        let (mut factors, mut highlights) = ([zero; 3], 0);
        for light in self.lights.iter() {
            for (set, levels) in [
                (light.crosses, light.diffuse),
                (light.logarithms, light.specular),
            ] {
                if set == 0 {
                    continue;
                }
                let set = mask64x4::from_bitmask(simd, set);
                for channel in 0..3 {
                    let levels = f64x4::splat(simd, f64::from(levels[channel]));
                    factors[channel] += set.select(levels, zero);
                }
            }
            highlights |= light.logarithms;
        }
        Some(Interpolant::new(terms, factors, highlights, rest))
    }

    /// Whether f32 has the signs of n.l and s at all pixels of a square, wherever a highlight depends on them.
    pub fn has_signs(&self, index: usize) -> bool {
        self.highlights(index)
            .all(|light| light.doubt[index] == 0.0 && self.gloss.doubt == 0.0)
    }

    /// Classifies the lights on four squares. Returns what remains of the tolerance on each square after the errors of
    /// interpolation, of missing highlights and of samples, and at most 0 where an error has no bound.
    #[inline(always)]
    fn classify<S: Simd>(&mut self, extents: &Extents<S>, interpolate: bool) -> f64x4<S> {
        let w = extents.affine(&self.face.w);
        let least_w = w.centre - w.dx.abs() - w.dy.abs();
        let simd = w.centre.token();
        let splat = inlined!(|number: f64| f64x4::splat(simd, number));
        let [zero, one] = [splat(0.0), splat(1.0)];
        let none = mask64x4::splat(simd, false);
        let normal = Field::new(&self.normal_by_pixel, extents);
        let eye = Field::new(&self.face.rays.to_eye, extents);
        // A square with pixels that may be clamped to the face is not interpolated.
        let steady = least_w.simd_gt(self.face.least_steady().max(0.0));
        let mut bounded = steady & normal.is_direction_bounded() & eye.is_direction_bounded();
        let mut rest = splat(self.tolerance);
        let ambient = self.surface.ambient().max_element();
        let mut rounding = Rounding::new(&normal, &eye, ambient);
        let (mut left_out, mut has_fourth) = (zero, none);
        let large = extents.half[0]
            .max(extents.half[1])
            .simd_gt(MIN_SIDE as f64 / 2.0);
        self.normal_by_square = normal.single();
        self.eye_by_square = eye.single();
        self.shines = 0;
        for light in self.lights.iter_mut() {
            let to_light = Field::new(&light.by_pixel, extents);
            let cosine_rounding = rounding.cosine(&to_light);
            let (cosine, lit, dark) = bound::facing(&normal, &to_light, cosine_rounding * U);
            let [diffuse, specular] = [splat(light.most[0]), splat(light.most[1])];
            let [mut shines, mut crosses, mut logarithmic] = [none; 3];
            let mut doubt = zero;
            rounding.add(dark.select(zero, diffuse), cosine_rounding);
            if interpolate {
                let error = bound::cosine_error(&normal, &to_light) * diffuse;
                rest -= dark.select(zero, error);
            }
            if light.most[1] > 0.0 {
                let reflection = bound::reflection(&normal, &to_light, &eye, cosine);
                shines = reflection.most.simd_gt(self.gloss.drawn_above) & !dark;
                left_out += (shines | dark).select(zero, splat(self.gloss.faint));
                let chord = rounding.chord(&to_light);
                let propagated = self.gloss.propagated(chord);
                rounding.add(shines.select(specular, zero), propagated + POWER_ERROR);
                doubt = (lit | !shines).select(zero, cosine_rounding * U);
                if interpolate {
                    // A highlight that is left out errs by its largest value.
                    let power = bound::power(self.gloss.shininess, reflection.most);
                    let mut error = power;
                    if shines.any_true() {
                        let (gloss, fields) = (self.gloss, [&normal, &to_light, &eye]);
                        let drawn = bound::highlight_error(gloss, fields, reflection, power);
                        error = shines.select(drawn, power);
                        let bend = large.select(splat(QUARTERS_BEND), one);
                        logarithmic =
                            shines & lit & !has_fourth & (error * specular).simd_gt(rest * bend);
                        if logarithmic.any_true() {
                            let drawn =
                                bound::logarithm_error(gloss, fields, reflection, power, chord);
                            logarithmic &= (drawn * specular).simd_lt(rest);
                            error = logarithmic.select(drawn, error);
                            has_fourth |= logarithmic;
                        }
                    }
                    rest -= dark.select(zero, error * specular);
                }
            }
            if interpolate {
                // A polynomial may carry the kink max(0, n.l) of one light. The highlight of that light must be left out: it
                // jumps at n.l = 0, and no polynomial follows a jump.
                let adds_nothing = mask64x4::splat(simd, light.most[0] == 0.0) & !shines;
                let is_decided = lit | dark | adds_nothing;
                crosses = !(is_decided | shines | has_fourth);
                has_fourth |= crosses;
                bounded &= to_light.is_direction_bounded() & (is_decided | crosses);
            }
            light.reaches = (!dark).to_bitmask();
            light.shines = shines.to_bitmask();
            light.crosses = crosses.to_bitmask();
            light.logarithms = logarithmic.to_bitmask();
            light.by_square = to_light.single();
            light.doubt = four!(|square| doubt.as_array()[square] as f32);
            self.shines |= light.shines;
        }
        let rounding = rounding.levels();
        self.in_f32 = (steady & (rounding + left_out).simd_le(limit(self.tolerance))).to_bitmask();
        bounded.select(rest - rounding * AMPLIFICATION, -one)
    }

    /// The levels at points of squares, x and y from -1 to 1; and at nodes the fourth channel, whose light is left out of them.
    #[inline(always)]
    pub fn levels<S: Simd>(&self, simd: S, at: LaneLayout, xy: [f32x16<S>; 2]) -> [f32x16<S>; 4] {
        let zero = f32x16::splat(simd, 0.0);
        let vector = inlined!(|of: &[Affine<[f32; 4]>; 3]| three!(|axis| at.affine(&of[axis], xy)));
        let unit = inlined!(|vector: [f32x16<S>; 3]| {
            let inverse = 1.0 / dot(&vector, &vector).sqrt();
            three!(|axis| vector[axis] * inverse)
        });
        let normal = vector(&self.normal_by_square);
        // Only highlights need unit vectors. Without them n.l takes one root, and exact frames 5 % less time.
        let (n, o, n2) = if at.any(self.shines) {
            (unit(normal), unit(vector(&self.eye_by_square)), zero + 1.0)
        } else {
            (normal, normal, dot(&normal, &normal))
        };
        let [red, green, blue] = three!(|channel| f32x16::splat(simd, self.ambient[channel]));
        let mut levels = [red, green, blue, zero];
        for light in self.lights.iter().filter(|light| at.any(light.reaches)) {
            let l = vector(&light.by_square);
            let inverse = 1.0 / (n2 * dot(&l, &l)).sqrt();
            let cosine = dot(&n, &l) * inverse;
            if light.most[0] > 0.0 {
                let lit = cosine.max(zero);
                let (diffuse, mut set) = (light.diffuse, light.reaches);
                if let LaneLayout::Nodes = at {
                    set &= !light.crosses;
                    levels[3] += cosine * at.within(simd, light.crosses, 1.0);
                }
                for channel in 0..3 {
                    levels[channel] += lit * at.within(simd, set, diffuse[channel]);
                }
            }
            if at.any(light.shines) {
                let twice = cosine + cosine;
                let e = three!(|axis| n[axis] * twice - l[axis] * inverse - o[axis]);
                let one_minus_cos = dot(&e, &e) * 0.5;
                let power = specular::power(self.gloss.shininess, one_minus_cos);
                let power = cosine.simd_gt(zero).select(power, zero);
                let mut set = light.shines;
                if let LaneLayout::Nodes = at
                    && light.logarithms != 0
                {
                    set &= !light.logarithms;
                    let exponent = specular::exponent(self.gloss.shininess, one_minus_cos);
                    levels[3] += exponent * at.within(simd, light.logarithms, 1.0);
                }
                for channel in 0..3 {
                    levels[channel] += power * at.within(simd, set, light.specular[channel]);
                }
                let doubt = cosine.abs().simd_lt(at.lanes(simd, &light.doubt))
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
