//! A point of a cuboid's surface in, levels out: the model in f64, and the ways to spread it over a triangle.
//!
//! ```text
//! ambient   kA * levels                                  n  unit normal      r = 2 (n.l) n - l
//! diffuse   kD * levels * max(0, n.l)                    l  to the light     (Phong 1975, CACM 18(6), p. 311)
//! specular  kE * levels * max(0, o.r)^rho  if n.l > 0    o  to the eye
//! ```
//!
//! Rule: places are relative to the cuboid's centre and become directions before anything is multiplied. Two choices:
//! a light at the very point has no direction and adds nothing, and 0^0 is 1 where n.l > 0.

use glam::DVec3;

use crate::components::{LightKind, Material, Mesh, Transform, unit};

/// A light that is on.
pub struct Lamp {
    /// The term it feeds.
    pub kind: LightKind,
    /// What it sends, per channel.
    pub levels: DVec3,
    /// From the cuboid's centre, in world units; of no meaning for an ambient light.
    pub position: DVec3,
}

/// Where o points.
pub enum Eye {
    /// To here, from the cuboid's centre, in world units.
    At(DVec3),
    /// This way from everywhere.
    Towards(DVec3),
}

/// What the model needs to know of a point besides the lights.
pub struct Point {
    /// From the cuboid's centre, in world units.
    pub offset: DVec3,
    /// n.
    pub normal: DVec3,
    /// o.
    pub to_eye: DVec3,
}

/// A cuboid's surface under its lights.
pub struct Surface {
    material: Material,
    eye: Eye,
    /// Every light, in file order.
    pub lamps: Vec<Lamp>,
    /// For each lamp the levels of its term at each corner.
    pub corner_terms: Vec<[DVec3; 8]>,
    corners: [Point; 8],
    corner_levels: [DVec3; 8],
}

impl Lamp {
    /// l at a point this far from the cuboid's centre; zero where there is none.
    pub fn from(&self, offset: DVec3) -> DVec3 {
        match self.kind {
            LightKind::Ambient => DVec3::ZERO,
            LightKind::Diffuse | LightKind::Specular => unit(self.position - offset),
        }
    }
}

impl Surface {
    /// The surface of a cuboid of this place, shape and material.
    pub fn new(
        transform: &Transform,
        mesh: &Mesh,
        material: Material,
        eye: Eye,
        lamps: Vec<Lamp>,
    ) -> Self {
        let axes = transform.axes();
        let corners = mesh.corners.map(|corner| {
            let offset = axes * corner;
            // The three faces that meet at a corner face the way it lies: along +x or -x, +y or -y, +z or -z.
            Point {
                offset,
                normal: axes * unit(corner.signum()),
                to_eye: eye.from(offset),
            }
        });
        let mut surface = Surface {
            material,
            eye,
            lamps,
            corner_terms: Vec::new(),
            corners,
            corner_levels: [DVec3::ZERO; 8],
        };
        surface.corner_terms = surface
            .lamps
            .iter()
            .map(|lamp| surface.terms_at_corners(lamp))
            .collect();
        for terms in &surface.corner_terms {
            surface
                .corner_levels
                .iter_mut()
                .zip(terms)
                .for_each(|(levels, term)| *levels += *term);
        }
        surface
    }

    fn terms_at_corners(&self, lamp: &Lamp) -> [DVec3; 8] {
        self.corners
            .each_ref()
            .map(|corner| self.term(lamp, corner.normal, lamp.from(corner.offset), corner.to_eye))
    }

    /// One light's term of the model, in levels.
    pub fn term(&self, lamp: &Lamp, normal: DVec3, to_light: DVec3, to_eye: DVec3) -> DVec3 {
        let facing = normal.dot(to_light);
        match lamp.kind {
            LightKind::Ambient => self.material.ambient * lamp.levels,
            LightKind::Diffuse => self.material.diffuse * lamp.levels * facing.max(0.0),
            LightKind::Specular if facing > 0.0 => {
                // o.r errs by some 1e-16, which the largest exponent, 1e6, makes some 1e-10 of the highlight.
                let along = to_eye.dot(reflection(normal, to_light)).clamp(0.0, 1.0);
                self.material.specular * lamp.levels * along.powf(self.material.shininess)
            }
            LightKind::Specular => DVec3::ZERO,
        }
    }

    /// The point with these weights between these corners, its normal normalised.
    pub fn point(&self, corners: [usize; 3], weights: [f64; 3]) -> Point {
        let offset = blend(corners.map(|corner| self.corners[corner].offset), weights);
        let normal = unit(blend(
            corners.map(|corner| self.corners[corner].normal),
            weights,
        ));
        Point {
            offset,
            normal,
            to_eye: self.eye.from(offset),
        }
    }

    /// Gouraud (1971): the corners' levels, interpolated over the triangle.
    pub fn gouraud(&self, corners: [usize; 3], weights: [f64; 3]) -> DVec3 {
        blend(corners.map(|corner| self.corner_levels[corner]), weights)
    }

    /// Phong (1975): the model at the interpolated point.
    pub fn phong(&self, corners: [usize; 3], weights: [f64; 3]) -> DVec3 {
        let Point {
            offset,
            normal,
            to_eye,
        } = self.point(corners, weights);
        self.lamps
            .iter()
            .map(|lamp| self.term(lamp, normal, lamp.from(offset), to_eye))
            .sum()
    }

    /// The assignment's shortcut: the corners' unit n, l and o, interpolated and left as short as that makes them.
    pub fn unit_vectors(&self, corners: [usize; 3], screen_weights: [f64; 3]) -> DVec3 {
        let between = |vector: &dyn Fn(&Point) -> DVec3| {
            blend(
                corners.map(|corner| vector(&self.corners[corner])),
                screen_weights,
            )
        };
        let normal = between(&|corner| corner.normal);
        let to_eye = between(&|corner| corner.to_eye);
        self.lamps
            .iter()
            .map(|lamp| {
                self.term(
                    lamp,
                    normal,
                    between(&|corner| lamp.from(corner.offset)),
                    to_eye,
                )
            })
            .sum()
    }
}

impl Eye {
    fn from(&self, offset: DVec3) -> DVec3 {
        match self {
            Eye::At(position) => unit(*position - offset),
            Eye::Towards(direction) => *direction,
        }
    }
}

/// r: `to_light` mirrored at the normal.
pub fn reflection(normal: DVec3, to_light: DVec3) -> DVec3 {
    2.0 * normal.dot(to_light) * normal - to_light
}

/// What three corners have, by their weights.
pub fn blend(values: [DVec3; 3], weights: [f64; 3]) -> DVec3 {
    values[0] * weights[0] + values[1] * weights[1] + values[2] * weights[2]
}
