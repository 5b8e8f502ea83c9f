//! A point of a cuboid's surface in, levels out: the model, and the ways to spread it over a triangle.
//!
//! ```text
//! ambient   kA * levels                                  n  unit normal      r = 2 (n.l) n - l
//! diffuse   kD * levels * max(0, n.l)                    l  to the light     (Phong 1975, CACM 18(6), p. 311)
//! specular  kE * levels * max(0, o.r)^rho  if n.l > 0    o  to the eye
//! ```
//!
//! Rule: everything is along the cuboid's axes. Lights are seen from the eye (Phong) or from the corners (Gouraud). Two
//! choices: a light at the very point has no direction and adds nothing, and 0^0 is 1 where n.l > 0.

use glam::DVec3;

use super::real::Real;
use super::rule::Rule;
use super::sight::{Place, Solid};
use super::vector::Vector;
use crate::components::{Light, LightKind, Material, Mesh};

/// Which tied gates are open, one bit for each corner of a triangle under Gouraud, for each specular light (by its number
/// modulo [`TIES`]) elsewhere. Lights that share a bit are taken to be open together: where more than that are tied at one
/// point, which takes lights in one plane with it, not every legal picture is enclosed.
pub type Open = usize;

/// The bits of [`Open`].
pub const TIES: usize = 3;

/// All tied gates are open.
const ALL: Open = (1 << TIES) - 1;

/// A light that is on, as a cuboid sees it.
pub struct LightTerm<R> {
    pub kind: LightKind,
    /// What it sends times what the material returns of it, in levels.
    pub levels: Vector<R>,
    /// In world units; an ambient light's is not used.
    place: DVec3,
    /// The place from the eye and from the cuboid's centre.
    from_eye: Vector<R>,
    from_centre: Vector<R>,
}

/// What the model needs to know of a corner.
struct Corner<R> {
    normal: Vector<R>,
    to_eye: Vector<R>,
    /// l of every light.
    to_lights: Vec<Vector<R>>,
}

/// Levels, and whether they rest on a gate that may fall either way.
#[derive(Clone, Copy)]
pub struct Lit<R> {
    pub levels: Vector<R>,
    pub is_tied: bool,
}

/// A cuboid's surface under its lights.
pub struct Surface<R> {
    /// The rule that is left out, if any.
    without: Option<Rule>,
    shininess: f64,
    /// In file order.
    pub lights: Vec<LightTerm<R>>,
    corners: [Corner<R>; 8],
    /// The levels at the corners with tied gates closed, and open.
    corner_levels: [[Lit<R>; 8]; 2],
}

impl<R: Real> Surface<R> {
    /// The surface of a cuboid; `lights` are places and what stands there, all of them on.
    pub fn new(
        solid: &Solid<R>,
        mesh: &Mesh,
        material: &Material,
        lights: &[(DVec3, Light)],
        (eye, centre): (DVec3, DVec3),
        without: Option<Rule>,
    ) -> Self {
        let light_term = |(position, light): &(DVec3, Light)| {
            let coefficient = match light.kind {
                LightKind::Ambient => material.ambient,
                LightKind::Diffuse => material.diffuse,
                LightKind::Specular => material.specular,
            };
            let sent = Vector::exact(light.color) * R::of(light.intensity) * R::of(light.gain);
            let seen_from = |from| solid.own(Vector::exact(*position) - Vector::exact(from));
            LightTerm {
                kind: light.kind,
                levels: Vector::exact(coefficient).zip(sent, R::mul),
                place: *position,
                from_eye: seen_from(eye),
                from_centre: seen_from(centre),
            }
        };
        let lights: Vec<_> = lights.iter().map(light_term).collect();
        let corners = mesh.corners.map(|corner| {
            let place = Vector::exact(corner);
            Corner {
                // The three faces that meet at a corner face the way it lies: along +x or -x, +y or -y, +z or -z.
                normal: Vector::exact(corner.signum()).unit(),
                to_eye: solid.to_eye(place - solid.eye),
                to_lights: (lights.iter())
                    .map(|light| (light.from_centre - place).unit())
                    .collect(),
            }
        });
        let mut surface = Surface {
            without,
            shininess: material.shininess,
            lights,
            corners,
            corner_levels: [[Lit {
                levels: Vector::exact(DVec3::ZERO),
                is_tied: false,
            }; 8]; 2],
        };
        surface.corner_levels = [0, ALL].map(|open| {
            surface.corners.each_ref().map(|corner| {
                surface.lit(
                    corner.normal,
                    corner.to_eye,
                    |light| corner.to_lights[light],
                    open,
                )
            })
        });
        surface
    }

    /// What the model multiplies a light's levels with where `to_light` is l; `tied` opens a tied gate.
    pub fn factor(
        &self,
        kind: LightKind,
        normal: Vector<R>,
        to_eye: Vector<R>,
        to_light: Vector<R>,
        tied: bool,
    ) -> R {
        let (zero, one) = (R::of(0.0), R::of(1.0));
        let power = || {
            let reflected = reflection(normal, to_light);
            let along = to_eye.dot(reflected);
            let along = if self.without == Some(Rule::UnitNormal) {
                along
            } else {
                // Of unit vectors |r - o|^2 / 2 is 1 - o.r, and sharp where o.r is nearly 1.
                along.both(one - (reflected - to_eye).length_squared() / R::of(2.0))
            };
            along.max(zero).min(one).power(self.shininess)
        };
        match kind {
            LightKind::Ambient => one,
            LightKind::Diffuse => normal.dot(to_light).max(zero),
            LightKind::Specular => match normal.dot(to_light).gate(tied) {
                _ if self.without == Some(Rule::SpecularGate) => power(),
                Some(true) => power(),
                Some(false) => zero,
                None => power().either(zero),
            },
        }
    }

    /// The model at a point; `to_light` gives l of a light by its number.
    fn lit(
        &self,
        normal: Vector<R>,
        to_eye: Vector<R>,
        to_light: impl Fn(usize) -> Vector<R>,
        mut open: Open,
    ) -> Lit<R> {
        let mut levels = Vector::exact(DVec3::ZERO);
        let mut is_tied = false;
        let mut last = None;
        for (index, light) in self.lights.iter().enumerate() {
            if light.kind == LightKind::Ambient {
                levels = levels + light.levels;
                continue;
            }
            // Lights at one place follow one another in most files, and share l.
            let shared = last.filter(|(place, _)| *place == light.place);
            let to_light = shared.map_or_else(|| to_light(index), |(_, to_light)| to_light);
            last = Some((light.place, to_light));
            let factor = self.factor(light.kind, normal, to_eye, to_light, open & 1 == 1);
            levels = levels + light.levels * factor;
            if light.kind == LightKind::Specular {
                is_tied |= normal.dot(to_light).is_tied();
                // The next specular light has the next bit, and after the last one the first again.
                open = open >> 1 | (open & 1) << (TIES - 1);
            }
        }
        Lit { levels, is_tied }
    }

    /// Phong (1975): the model at a point of a face.
    pub fn phong(&self, place: &Place<R>, open: Open) -> Lit<R> {
        let to_light = |light| self.to_light(light, place);
        let normal = if self.without == Some(Rule::UnitNormal) {
            // A corner is at 1/2 along every axis, where its normal has 1 / sqrt(3).
            place.share * (R::of(2.0) / R::of(3.0).sqrt())
        } else {
            place.share.unit()
        };
        self.lit(normal, place.to_eye, to_light, open)
    }

    /// l of a light at a point of a face.
    pub fn to_light(&self, light: usize, place: &Place<R>) -> Vector<R> {
        (self.lights[light].from_eye - place.point).unit()
    }

    /// Gouraud (1971): the levels at the corners, interpolated over the triangle.
    pub fn gouraud(&self, corners: [usize; 3], weights: [R; 3], open: Open) -> Lit<R> {
        let lit: [_; 3] = std::array::from_fn(|i| self.corner_levels[open >> i & 1][corners[i]]);
        Lit {
            levels: blend(lit.map(|lit| lit.levels), weights),
            is_tied: lit.iter().any(|lit| lit.is_tied),
        }
    }

    /// What the model multiplies a light's levels with at a corner.
    pub fn factor_at_corner(&self, light: usize, corner: usize) -> R {
        let (kind, corner) = (self.lights[light].kind, &self.corners[corner]);
        let to_light = corner.to_lights[light];
        self.factor(kind, corner.normal, corner.to_eye, to_light, false)
    }

    /// The assignment's shortcut: the corners' unit n, l and o, interpolated and left as short as that makes them.
    pub fn unit_vectors(&self, corners: [usize; 3], weights: [R; 3]) -> Lit<R> {
        let between = |vector: &dyn Fn(&Corner<R>) -> Vector<R>| {
            blend(corners.map(|corner| vector(&self.corners[corner])), weights)
        };
        let to_light = |light: usize| between(&|corner| corner.to_lights[light]);
        let normal = between(&|corner| corner.normal);
        self.lit(normal, between(&|corner| corner.to_eye), to_light, 0)
    }
}

/// r: `to_light` mirrored at the normal.
pub fn reflection<R: Real>(normal: Vector<R>, to_light: Vector<R>) -> Vector<R> {
    normal * (R::of(2.0) * normal.dot(to_light)) - to_light
}

/// What three corners have, by their weights.
pub fn blend<R: Real>(values: [Vector<R>; 3], weights: [R; 3]) -> Vector<R> {
    values[0] * weights[0] + values[1] * weights[1] + values[2] * weights[2]
}
