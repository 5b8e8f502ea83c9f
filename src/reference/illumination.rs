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

use std::collections::HashMap;

use glam::DVec3;

use super::real::Real;
use super::rule::Rule;
use super::sight::{Line, Place, Solid};
use super::vector::Vector;
use crate::components::{Light, LightKind, Material, Mesh};

/// Which tied gates are open, one bit for each corner of a triangle under Gouraud, for each source (by its place modulo
/// [`TIES`]) elsewhere.
pub type Open = usize;

/// The bits of [`Open`].
pub const TIES: usize = 3;

/// All tied gates are open.
const ALL: Open = (1 << TIES) - 1;

/// A light that is on, as a cuboid sees it.
pub struct LightTerm<R> {
    pub kind: LightKind,
    /// Which of the sources; none for an ambient light.
    pub source: Option<usize>,
    /// What it sends times what the material returns of it, in levels.
    pub levels: Vector<R>,
}

/// A place with lights.
struct Source<R> {
    /// From the eye, in world units.
    from_eye: Vector<R>,
    /// From the cuboid's centre.
    from_centre: Vector<R>,
    /// Sums over its lights, in levels.
    diffuse: Vector<R>,
    specular: Vector<R>,
    has_specular: bool,
}

/// What the model needs to know of a corner.
struct Corner<R> {
    normal: Vector<R>,
    to_eye: Vector<R>,
    /// l of every source.
    to_lights: Vec<Vector<R>>,
}

/// What the lights at one place do at a point.
#[derive(Clone, Copy)]
pub struct Incidence<R> {
    /// max(0, n.l).
    pub diffuse: R,
    /// max(0, o.r)^rho where n.l > 0, else 0.
    pub specular: R,
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
    ambient: Vector<R>,
    sources: Vec<Source<R>>,
    /// Every light that is on, in file order.
    pub light_terms: Vec<LightTerm<R>>,
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
        let zero = Vector::exact(DVec3::ZERO);
        let mut ambient = zero;
        let mut sources: Vec<Source<R>> = Vec::new();
        let mut found = HashMap::new();
        let mut light_terms = Vec::new();
        for (position, light) in lights {
            let coefficient = match light.kind {
                LightKind::Ambient => material.ambient,
                LightKind::Diffuse => material.diffuse,
                LightKind::Specular => material.specular,
            };
            let sent = Vector::exact(light.color) * R::of(light.intensity) * R::of(light.gain);
            let levels = Vector::exact(coefficient).zip(sent, R::mul);
            let source = (light.kind != LightKind::Ambient).then(|| {
                // -0 and 0 are one place.
                let place = (*position + DVec3::ZERO).to_array().map(f64::to_bits);
                *found.entry(place).or_insert_with(|| {
                    let seen_from =
                        |from| solid.own(Vector::exact(*position) - Vector::exact(from));
                    sources.push(Source {
                        from_eye: seen_from(eye),
                        from_centre: seen_from(centre),
                        diffuse: zero,
                        specular: zero,
                        has_specular: false,
                    });
                    sources.len() - 1
                })
            });
            match (light.kind, source) {
                (LightKind::Diffuse, Some(index)) => {
                    sources[index].diffuse = sources[index].diffuse + levels;
                }
                (LightKind::Specular, Some(index)) => {
                    sources[index].specular = sources[index].specular + levels;
                    sources[index].has_specular |= coefficient * light.levels() != DVec3::ZERO;
                }
                _ => ambient = ambient + levels,
            }
            light_terms.push(LightTerm {
                kind: light.kind,
                source,
                levels,
            });
        }
        let corners = mesh.corners.map(|corner| {
            let place = Vector::exact(corner);
            Corner {
                // The three faces that meet at a corner face the way it lies: along +x or -x, +y or -y, +z or -z.
                normal: Vector::exact(corner.signum()).unit(),
                to_eye: solid.to_eye(place - solid.eye),
                to_lights: (sources
                    .iter()
                    .map(|source| (source.from_centre - place).unit()))
                .collect(),
            }
        });
        let mut surface = Surface {
            without,
            shininess: material.shininess,
            ambient,
            sources,
            light_terms,
            corners,
            corner_levels: [[Lit {
                levels: zero,
                is_tied: false,
            }; 8]; 2],
        };
        surface.corner_levels = [0, ALL].map(|open| {
            surface.corners.each_ref().map(|corner| {
                surface.lit(
                    corner.normal,
                    corner.to_eye,
                    |source| corner.to_lights[source],
                    open,
                )
            })
        });
        surface
    }

    /// What the lights of a source do where `to_light` is l; `tied` opens tied gates.
    pub fn incidence(
        &self,
        normal: Vector<R>,
        to_eye: Vector<R>,
        to_light: Vector<R>,
        tied: bool,
    ) -> Incidence<R> {
        let (zero, one) = (R::of(0.0), R::of(1.0));
        let facing = normal.dot(to_light);
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
        Incidence {
            diffuse: facing.max(zero),
            specular: match facing.gate(tied) {
                _ if self.without == Some(Rule::SpecularGate) => power(),
                Some(true) => power(),
                Some(false) => zero,
                None => power().either(zero),
            },
        }
    }

    /// The model at a point; `to_light` gives l of a source.
    fn lit(
        &self,
        normal: Vector<R>,
        to_eye: Vector<R>,
        to_light: impl Fn(usize) -> Vector<R>,
        open: Open,
    ) -> Lit<R> {
        let mut levels = self.ambient;
        let mut is_tied = false;
        for (index, source) in self.sources.iter().enumerate() {
            let to_light = to_light(index);
            if source.has_specular {
                let tied = open >> (index % TIES) & 1 == 1;
                let incidence = self.incidence(normal, to_eye, to_light, tied);
                levels = levels + source.diffuse * incidence.diffuse;
                levels = levels + source.specular * incidence.specular;
                is_tied |= normal.dot(to_light).is_tied();
            } else {
                levels = levels + source.diffuse * normal.dot(to_light).max(R::of(0.0));
            }
        }
        Lit { levels, is_tied }
    }

    /// Phong (1975): the model at the point of a face that the line meets.
    pub fn phong(&self, place: &Place<R>, line: &Line<R>, to_eye: Vector<R>, open: Open) -> Lit<R> {
        let to_light = |source| self.to_light(source, place, line);
        let normal = if self.without == Some(Rule::UnitNormal) {
            // A corner is at 1/2 along every axis, where its normal has 1 / sqrt(3).
            place.share * (R::of(2.0) / R::of(3.0).sqrt())
        } else {
            place.share.unit()
        };
        self.lit(normal, to_eye, to_light, open)
    }

    /// l of a source at a point: w (L - P) = w (L - O) - H d, all along the cuboid's axes.
    pub fn to_light(&self, source: usize, place: &Place<R>, line: &Line<R>) -> Vector<R> {
        if let Some(point) = place.point {
            return (self.sources[source].from_eye - point).unit();
        }
        let from_line = self.sources[source].from_eye - line.offset;
        (from_line * place.slope - line.along * place.height).unit()
    }

    /// Gouraud (1971): the levels at the corners, interpolated over the triangle.
    pub fn gouraud(&self, corners: [usize; 3], weights: [R; 3], open: Open) -> Lit<R> {
        let lit: [_; 3] = std::array::from_fn(|i| self.corner_levels[open >> i & 1][corners[i]]);
        Lit {
            levels: blend(lit.map(|lit| lit.levels), weights),
            is_tied: lit.iter().any(|lit| lit.is_tied),
        }
    }

    /// What a source does at a corner.
    pub fn at_corner(&self, corner: usize, source: usize) -> Incidence<R> {
        let corner = &self.corners[corner];
        self.incidence(
            corner.normal,
            corner.to_eye,
            corner.to_lights[source],
            false,
        )
    }

    /// The assignment's shortcut: the corners' unit n, l and o, interpolated and left as short as that makes them.
    pub fn unit_vectors(&self, corners: [usize; 3], weights: [R; 3]) -> Lit<R> {
        let between = |vector: &dyn Fn(&Corner<R>) -> Vector<R>| {
            blend(corners.map(|corner| vector(&self.corners[corner])), weights)
        };
        let to_light = |source: usize| between(&|corner| corner.to_lights[source]);
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
