//! The illumination model (Phong 1975), in f64: at one point, or at eight points of a face at once.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x8, mask64x8};
use glam::DVec3;

use super::affine::Affine;
use super::face::Plane;
use super::lanes::dot;
use super::specular;
use crate::components::{Illumination, Material, PointLight, unit};
use crate::shading::simd::{inlined, three};

/// An object's material and position, under its light.
#[derive(Clone, Copy, Debug)]
pub struct Surface<'a> {
    /// Its coefficients.
    pub material: &'a Material,
    /// All light that falls on it.
    pub illumination: &'a Illumination,
    /// Its centre, from which offsets are counted, in world units.
    pub centre: DVec3,
    /// The plane of a face that has the face's own normal all over.
    pub plane: Option<&'a Plane>,
}

impl<'a> Surface<'a> {
    /// An object of this material, with its centre here.
    pub fn new(material: &'a Material, illumination: &'a Illumination, centre: DVec3) -> Self {
        Surface {
            material,
            illumination,
            centre,
            plane: None,
        }
    }

    /// Whether the normal and a light enclose less than a right angle, which their cosine n.l says. On a face with the face's own
    /// normal the height of the light over the face says it, once for all points: where the height is 0, rounding
    /// would give n.l any sign from point to point.
    pub fn is_lit(&self, light: &PointLight, cosine: f64) -> bool {
        let height = self
            .plane
            .map(|plane| plane.height_of(light.position - self.centre));
        height.unwrap_or(cosine) > 0.0
    }

    /// The ambient term, in levels.
    pub fn ambient(&self) -> DVec3 {
        self.material.ambient * self.illumination.ambient
    }

    /// The factors of a point light's n.l and s^rho, in levels.
    pub fn coefficients(&self, light: &PointLight) -> [DVec3; 2] {
        [
            self.material.diffuse * light.diffuse,
            self.material.specular * light.specular,
        ]
    }

    /// How many powers one evaluation of the model takes at most: the lights with a specular term here.
    pub fn powers(&self) -> usize {
        self.illumination
            .points
            .iter()
            .filter(|light| self.coefficients(light)[1] != DVec3::ZERO)
            .count()
    }

    /// The illumination model (Phong 1975, see the [crate]) at `offset` from the centre, with unit normal and
    /// unit vector to the eye; in levels, unclamped.
    pub fn levels(&self, offset: DVec3, normal: DVec3, to_eye: DVec3) -> DVec3 {
        self.sum(normal, to_eye, |light| {
            unit(light.position - self.centre - offset)
        })
    }

    /// The same, with the unit vector to each light as it is given.
    pub(super) fn sum(
        &self,
        normal: DVec3,
        to_eye: DVec3,
        to_light: impl Fn(&PointLight) -> DVec3,
    ) -> DVec3 {
        let mut levels = self.ambient();
        for light in &self.illumination.points {
            let [diffuse, specular] = self.coefficients(light);
            // A light at the very point has no direction: its l is zero, n.l is zero, and it contributes nothing.
            let to_light = to_light(light);
            let cosine = normal.dot(to_light);
            if self.is_lit(light, cosine) {
                levels += diffuse * cosine.max(0.0);
                if specular != DVec3::ZERO {
                    let reflected = 2.0 * cosine * normal - to_light;
                    let one_minus_cos = (reflected - to_eye).length_squared() / 2.0;
                    levels +=
                        specular * specular::power_exact(self.material.shininess, one_minus_cos);
                }
            }
        }
        levels
    }

    /// [`Self::levels`] at eight points (u, v) of a face. Offsets, normals and vectors to the eye are functions of u and v; normals and
    /// vectors to the eye have any length whose square is a normal float.
    ///
    /// The formula is the same, so levels differ by the rounding of f64, and by the error of [`specular::power_in_lanes`].
    #[inline(always)]
    pub fn levels_in_lanes<S: Simd>(
        &self,
        [offset, normal, to_eye]: &[Affine; 3],
        [u, v]: [f64x8<S>; 2],
    ) -> [f64x8<S>; 3] {
        let simd = u.token();
        let zero = f64x8::splat(simd, 0.0);
        let vector = inlined!(|of: &Affine| three!(|axis| {
            u * of.dx[axis] + (v * of.dy[axis] + of.centre[axis])
        }));
        // A light nearer than 1e-145 is at the very point: no face is narrower than 1e-100.
        let unit = inlined!(|vector: [f64x8<S>; 3]| {
            let square = dot(&vector, &vector);
            let inverse = square.simd_gt(1e-290).select(1.0 / square.sqrt(), zero);
            three!(|axis| vector[axis] * inverse)
        });
        let (offset, n, o) = (vector(offset), unit(vector(normal)), unit(vector(to_eye)));
        let ambient = self.ambient();
        let mut levels = three!(|channel| f64x8::splat(simd, ambient[channel]));
        for light in &self.illumination.points {
            let [diffuse, specular] = self.coefficients(light);
            let from_centre = light.position - self.centre;
            let l = unit(three!(|axis| from_centre[axis] - offset[axis]));
            let cosine = dot(&n, &l);
            let lit = match self.plane {
                Some(_) => mask64x8::splat(simd, self.is_lit(light, 0.0)),
                None => cosine.simd_gt(0.0),
            };
            let lit_cosine = lit.select(cosine.max(zero), zero);
            levels = three!(|channel| levels[channel] + lit_cosine * diffuse[channel]);
            if specular != DVec3::ZERO {
                let e = three!(|axis| n[axis] * (cosine + cosine) - l[axis] - o[axis]);
                let one_minus_cos = dot(&e, &e) * 0.5;
                let power = specular::power_in_lanes(self.material.shininess, one_minus_cos);
                let power = lit.select(power, zero);
                levels = three!(|channel| levels[channel] + power * specular[channel]);
            }
        }
        levels
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shading::simd::baseline;

    #[test]
    fn eight_points_have_the_levels_of_single_ones() {
        let mut seed = 0.1;
        let mut part = || {
            seed = (seed * 97.0 + 0.618_034_f64).fract();
            2.0 * seed - 1.0
        };
        let mut vector = || DVec3::new(part(), part(), part());
        let (mut worst, mut compared) = (0.0_f64, 0);
        for case in 0..2000 {
            // Sizes from the least to the largest.
            let size = 10.0_f64.powi(case % 5 * 50 - 100);
            let material = Material {
                ambient: vector().abs(),
                diffuse: vector().abs(),
                specular: vector().abs(),
                shininess: [0.0, 1e-3, 0.3, 1.0, 2.5, 76.8, 1e4, 1e6][case as usize % 8],
            };
            let face = Affine::new(vector(), vector(), vector());
            let offset = face.map(|it| it * size);
            // One is at the point u = v = 0, and one shines into the eye from there.
            let centre = vector() * size * f64::from(case % 2);
            let (normal, eye) = (unit(vector()), unit(vector()));
            let mirrored = 2.0 * normal.dot(eye) * normal - eye;
            let places = [
                offset.centre,
                offset.centre + mirrored * size,
                vector() * size,
            ];
            let points = places.map(|place| PointLight {
                position: centre + place,
                diffuse: vector().abs() * 100.0,
                specular: vector().abs() * 100.0,
            });
            let illumination = Illumination {
                ambient: DVec3::ONE,
                points: points.to_vec(),
            };
            let surface = Surface::new(&material, &illumination, centre);
            let normals = Affine::new(normal, vector() * 0.1, vector() * 0.1);
            let to_eye = Affine::new(eye, -face.dx, -face.dy);
            let places = [
                [0.0, 1.0, 0.25, -1.0, 0.5, 0.125, -0.75, 1.0],
                [0.0, -1.0, 0.5, -1.0, 0.25, 0.875, 0.375, 1.0],
            ];
            let uv = places.map(|it: [f64; 8]| f64x8::simd_from(baseline(), it));
            let found = surface.levels_in_lanes(&[offset, normals, to_eye], uv);
            for lane in 0..8 {
                let [offset, normal, to_eye] =
                    [offset, normals, to_eye].map(|it| it.at(places[0][lane], places[1][lane]));
                let [normal, to_eye] = [normal, to_eye].map(unit);
                let expected = surface.levels(offset, normal, to_eye);
                // Near a light, and at a right angle, rounding decides.
                let is_clear = |point: &PointLight| {
                    let light = point.position - centre - offset;
                    let is_far = light.length() > 0.01 * size;
                    light == DVec3::ZERO || is_far && normal.dot(unit(light)).abs() > 1e-9
                };
                if points.iter().all(is_clear) {
                    compared += 1;
                    for channel in 0..3 {
                        worst = worst.max((found[channel][lane] - expected[channel]).abs());
                    }
                }
            }
        }
        println!("{compared} points, {worst:.1e} levels");
        assert!(compared > 14_000, "{compared} points");
        assert!(worst < 1e-9, "{worst}");
    }
}
