//! The illumination model (Phong 1975), in f64 at one point.

use glam::DVec3;

use super::face::Plane;
use super::specular;
use crate::components::{Illumination, Material, PointLight, unit};

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
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One light of each kind, 10 above the origin of a surface that lies in the plane z = 0.
    fn levels(kind: &str, normal: DVec3, to_eye: DVec3) -> DVec3 {
        let material = Material {
            ambient: DVec3::new(0.1, 0.2, 0.3),
            diffuse: DVec3::new(0.5, 0.25, 1.0),
            specular: DVec3::new(1.0, 0.5, 0.25),
            shininess: 2.0,
        };
        let share = |own: &str| {
            if own == kind {
                DVec3::splat(100.0)
            } else {
                DVec3::ZERO
            }
        };
        let points = vec![PointLight {
            position: DVec3::new(5.0, 5.0, 15.0),
            diffuse: share("diffuse"),
            specular: share("specular"),
        }];
        let illumination = Illumination {
            ambient: share("ambient"),
            points,
        };
        Surface {
            material: &material,
            illumination: &illumination,
            centre: DVec3::splat(5.0),
            plane: None,
        }
        .levels(DVec3::ZERO, normal, to_eye)
    }

    fn assert_near(found: DVec3, expected: [f64; 3]) {
        assert!(
            (found - DVec3::from_array(expected)).length() < 1e-12,
            "{found} is not {expected:?}"
        );
    }

    #[test]
    fn ambient_light_is_the_same_everywhere() {
        assert_near(levels("ambient", DVec3::Z, DVec3::Z), [10.0, 20.0, 30.0]);
        assert_near(
            levels("ambient", DVec3::NEG_Z, DVec3::X),
            [10.0, 20.0, 30.0],
        );
    }

    #[test]
    fn diffuse_light_goes_with_the_cosine() {
        assert_near(levels("diffuse", DVec3::Z, DVec3::X), [50.0, 25.0, 100.0]);
        // n is 60 degrees off: cos 60 = 1/2.
        assert_near(
            levels("diffuse", DVec3::new(0.75_f64.sqrt(), 0.0, 0.5), DVec3::X),
            [25.0, 12.5, 50.0],
        );
        assert_near(levels("diffuse", DVec3::X, DVec3::X), [0.0; 3]);
        assert_near(levels("diffuse", DVec3::NEG_Z, DVec3::X), [0.0; 3]);
    }

    #[test]
    fn specular_light_goes_with_the_power_of_the_mirror_direction() {
        // l = n = z, so r = z; the eye 45 degrees off sees cos 45 squared = 1/2.
        let slanted = DVec3::new(0.5_f64.sqrt(), 0.0, 0.5_f64.sqrt());
        assert_near(levels("specular", DVec3::Z, DVec3::Z), [100.0, 50.0, 25.0]);
        assert_near(levels("specular", DVec3::Z, slanted), [50.0, 25.0, 12.5]);
        // n at 45 degrees sends r to x: an eye there sees it whole, one at z not at all.
        assert_near(levels("specular", slanted, DVec3::X), [100.0, 50.0, 25.0]);
        assert_near(levels("specular", slanted, DVec3::Z), [0.0; 3]);
    }

    #[test]
    fn the_specular_term_needs_the_light_in_front_of_the_surface() {
        // n = -z turned so that r = 2(n.l)n - l would point at the eye: without the gate it would shine through.
        assert_near(levels("specular", DVec3::NEG_Z, DVec3::Z), [0.0; 3]);
        assert_near(levels("specular", DVec3::X, DVec3::NEG_Z), [0.0; 3]);
    }
}
