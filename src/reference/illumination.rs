//! A point of a cuboid's surface in, levels out: the model in f64, and the ways to spread it over a triangle.
//!
//! ```text
//! ambient   kA * levels                                  n  unit normal      r = 2 (n.l) n - l
//! diffuse   kD * levels * max(0, n.l)                    l  to the light     (Phong 1975, CACM 18(6), p. 311)
//! specular  kE * levels * max(0, o.r)^rho  if n.l > 0    o  to the eye
//! ```
//!
//! Rule: everything is seen from the cuboid: places are relative to its centre, along its axes, and become directions
//! before anything is multiplied. Two choices: a light at the very point has no direction and adds nothing, and 0^0 is 1
//! where n.l > 0.

use glam::DVec3;

use crate::components::{LightKind, Material, Mesh, unit};

/// A light that is on.
pub struct Lamp {
    /// The term it feeds.
    pub kind: LightKind,
    /// What it sends, per channel.
    pub levels: DVec3,
    /// From the cuboid's centre along its axes, in world units; of no meaning for an ambient light.
    pub position: DVec3,
}

/// Where o points.
pub enum Eye {
    /// To here, from the cuboid's centre along its axes, in world units.
    At(DVec3),
    /// This way from everywhere, along the cuboid's axes.
    Towards(DVec3),
}

/// What the model needs to know of a point besides the lights; along the cuboid's axes.
pub struct Point {
    /// From the cuboid's centre, in world units.
    pub place: DVec3,
    /// n.
    pub normal: DVec3,
    /// o.
    pub to_eye: DVec3,
}

/// A cuboid's surface under its lights.
pub struct Surface {
    half: DVec3,
    material: Material,
    /// Every light, in file order.
    pub lamps: Vec<Lamp>,
    /// For each lamp the levels of its term at each corner.
    pub corner_terms: Vec<[DVec3; 8]>,
    corners: [Point; 8],
    corner_levels: [DVec3; 8],
}

impl Lamp {
    /// l at a place from the cuboid's centre; zero where there is none.
    pub fn from(&self, place: DVec3) -> DVec3 {
        match self.kind {
            LightKind::Ambient => DVec3::ZERO,
            LightKind::Diffuse | LightKind::Specular => unit(self.position - place),
        }
    }
}

impl Surface {
    /// The surface of a cuboid of this shape and material.
    pub fn new(mesh: &Mesh, material: Material, eye: &Eye, lamps: Vec<Lamp>) -> Self {
        let corners = mesh.corners.map(|place| Point {
            place,
            // The three faces that meet at a corner face the way it lies: along +x or -x, +y or -y, +z or -z.
            normal: unit(place.signum()),
            to_eye: eye.from(place),
        });
        let mut surface = Surface {
            half: mesh.corners[7],
            material,
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
            .map(|corner| self.term(lamp, corner.normal, lamp.from(corner.place), corner.to_eye))
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

    /// The point met at `place`, its normal interpolated between the corners' and normalised.
    ///
    /// Linear interpolation of (+-1, +-1, +-1) / sqrt(3) over a face, or either half of it, is (x / h_x, y / h_y, z / h_z)
    /// / sqrt(3).
    pub fn point(&self, place: DVec3, to_eye: DVec3) -> Point {
        Point {
            place,
            normal: unit(place / self.half),
            to_eye,
        }
    }

    /// Gouraud (1971): the corners' levels, interpolated over the triangle.
    pub fn gouraud(&self, corners: [usize; 3], weights: [f64; 3]) -> DVec3 {
        blend(corners.map(|corner| self.corner_levels[corner]), weights)
    }

    /// Phong (1975): the model at the point.
    pub fn phong(&self, point: &Point) -> DVec3 {
        self.lamps
            .iter()
            .map(|lamp| self.term(lamp, point.normal, lamp.from(point.place), point.to_eye))
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
                    between(&|corner| lamp.from(corner.place)),
                    to_eye,
                )
            })
            .sum()
    }
}

impl Eye {
    fn from(&self, place: DVec3) -> DVec3 {
        match self {
            Eye::At(position) => unit(*position - place),
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
