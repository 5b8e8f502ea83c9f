//! The illumination model at a point of a cuboid's surface, and its interpolation over a triangle.
//!
//! ```text
//! ambient   kA * levels                                  n  unit normal      r = 2 (n.l) n - l
//! diffuse   kD * levels * max(0, n.l)                    l  to the light     (Phong 1975, CACM 18(6), p. 311)
//! specular  kE * levels * max(0, o.r)^rho  if n.l > 0    o  to the eye
//! ```
//!
//! Vectors are given in the cuboid's axes. Positions of lights are relative to the eye (Phong) or to the corners
//! (Gouraud). Two cases are defined here: a light exactly at the point has no direction and adds nothing, and 0^0 is 1
//! where n.l > 0.

use std::cmp::Ordering;

use glam::DVec3;

use super::geometry::{CuboidGeometry, FacePoint, across};
use super::real::{Real, RealVector};
use super::rule::Rule;
use crate::components::{Light, LightKind, Material, NormalMode};

/// The tied gates that are open: under Gouraud one bit per corner of the triangle, otherwise one bit per tied gate. Where
/// more gates are tied at a point than it has bits, one enclosure holds all combinations.
pub type Open = usize;

/// The bits of [`Open`].
pub const TIES: usize = 3;

/// All tied gates are open.
const ALL: Open = (1 << TIES) - 1;

/// A light that is on, in the coordinates of a cuboid.
pub struct LightTerm<R> {
    pub kind: LightKind,
    /// Coefficient of the material * colour * intensity * gain, in levels of 255.
    pub levels: RealVector<R>,
    /// Its position in world units; not used for an ambient light.
    place: DVec3,
    /// Its position relative to the eye and to the cuboid's centre.
    from_eye: RealVector<R>,
    from_centre: RealVector<R>,
}

/// The vectors of the model at a corner.
struct Corner<R> {
    /// n on the faces across x, y and z.
    normals: [RealVector<R>; 3],
    to_eye: RealVector<R>,
    /// l of every light.
    to_lights: Vec<RealVector<R>>,
}

impl<R: Real> Corner<R> {
    /// The vectors at a corner that is given relative to the cuboid's centre.
    fn new(
        solid: &CuboidGeometry<R>,
        corner: DVec3,
        normals: NormalMode,
        lights: &[LightTerm<R>],
    ) -> Self {
        let place = RealVector::exact(corner);
        let to_light = |light: &LightTerm<R>| (light.from_centre - place).unit();
        Corner {
            normals: match normals {
                // The normals of the three faces there are the axes with these signs.
                NormalMode::Corner => [RealVector::exact(corner.signum()).unit(); 3],
                NormalMode::Face => {
                    DVec3::AXES.map(|axis| RealVector::exact(corner.signum() * axis))
                }
            },
            to_eye: solid.to_eye(place - solid.eye),
            to_lights: lights.iter().map(to_light).collect(),
        }
    }
}

/// Levels, and how many tied gates they depend on. Gates of lights at one position open together and count once.
#[derive(Clone, Copy)]
pub struct Lit<R> {
    pub levels: RealVector<R>,
    pub ties: usize,
}

/// The illumination of a cuboid's surface.
pub struct ReferenceSurface<R> {
    /// The rule that is left out, if any.
    without: Option<Rule>,
    pub shininess: f64,
    normals: NormalMode,
    /// In file order.
    pub lights: Vec<LightTerm<R>>,
    corners: [Corner<R>; 8],
    /// The levels at the corners with tied gates closed, and with tied gates open; of face normals, with those along x, y
    /// and z.
    corner_levels: [Vec<[Lit<R>; 8]>; 2],
}

impl<R: Real> ReferenceSurface<R> {
    /// The surface of a cuboid. `lights` are the lights that are on with their positions; positions are in world units.
    pub fn new(
        solid: &CuboidGeometry<R>,
        material: &Material,
        normals: NormalMode,
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
            let sent = RealVector::exact(light.color) * R::of(light.intensity) * R::of(light.gain);
            let seen_from =
                |from| solid.own(RealVector::exact(*position) - RealVector::exact(from));
            LightTerm {
                kind: light.kind,
                levels: RealVector::exact(coefficient).zip(sent, R::mul),
                place: *position,
                from_eye: seen_from(eye),
                from_centre: seen_from(centre),
            }
        };
        let lights: Vec<_> = lights.iter().map(light_term).collect();
        let corners =
            (solid.mesh.corners).map(|corner| Corner::new(solid, corner, normals, &lights));
        let mut surface = ReferenceSurface {
            without,
            shininess: material.shininess,
            normals,
            lights,
            corners,
            corner_levels: Default::default(),
        };
        let axes = match normals {
            NormalMode::Corner => 1,
            NormalMode::Face => 3,
        };
        let lit = |corner: &Corner<R>, axis: usize, open| {
            let to_light = |light: usize| corner.to_lights[light];
            surface.lit(corner.normals[axis], corner.to_eye, to_light, open, 1)
        };
        let lit = |axis, open| (surface.corners.each_ref()).map(|corner| lit(corner, axis, open));
        surface.corner_levels = [0, ALL].map(|open| (0..axes).map(|it| lit(it, open)).collect());
        surface
    }

    /// The unit normal at a corner of a face.
    pub fn corner_normal(&self, face: usize, corner: usize) -> RealVector<R> {
        self.corners[corner].normals[across(face).0]
    }

    /// The unit normal at a point of a face.
    pub fn normal(&self, face: usize, place: &FacePoint<R>) -> RealVector<R> {
        match self.normals {
            NormalMode::Corner => place.share.unit(),
            NormalMode::Face => {
                let (axis, outwards) = across(face);
                RealVector::exact(DVec3::AXES[axis] * outwards)
            }
        }
    }

    pub fn is_perspective_correct(&self) -> bool {
        self.without != Some(Rule::PerspectiveCorrect)
    }

    /// Blinn's factor max(0, n.h)^(4 rho); 0 where l = -o, which has no h.
    pub fn half_vector_factor(
        &self,
        normal: RealVector<R>,
        to_eye: RealVector<R>,
        to_light: RealVector<R>,
    ) -> R {
        let (zero, one) = (R::of(0.0), R::of(1.0));
        let sum = to_light + to_eye;
        let half = sum.unit();
        // As for o.r.
        let cosine = (normal.dot(half)).both(one - (normal - half).length_squared() / R::of(2.0));
        let factor = cosine.max(zero).min(one).power(4.0 * self.shininess);
        match sum.length_squared().sign(0.0) {
            Some(Ordering::Greater) => factor,
            Some(_) => zero,
            None => factor.either(zero),
        }
    }

    /// The factor of a light's levels in the model: 1, max(0, n.l) or the gated max(0, o.r)^rho. `to_light` is l; `if_tied`
    /// opens a tied gate.
    pub fn factor(
        &self,
        kind: LightKind,
        normal: RealVector<R>,
        to_eye: RealVector<R>,
        to_light: RealVector<R>,
        if_tied: bool,
    ) -> R {
        let (zero, one) = (R::of(0.0), R::of(1.0));
        let power = || {
            if self.without == Some(Rule::Reflection) {
                return self.half_vector_factor(normal, to_eye, to_light);
            }
            let reflected = reflection(normal, to_light);
            let mut cosine = to_eye.dot(reflected);
            if self.without != Some(Rule::UnitNormal) {
                // For unit vectors |r - o|^2 / 2 is 1 - o.r, and its enclosure is tighter where o.r is nearly 1.
                cosine = cosine.both(one - (reflected - to_eye).length_squared() / R::of(2.0));
            }
            cosine.max(zero).min(one).power(self.shininess)
        };
        match kind {
            LightKind::Ambient => one,
            LightKind::Diffuse if self.without == Some(Rule::DiffuseClamp) => normal.dot(to_light),
            LightKind::Diffuse => normal.dot(to_light).max(zero),
            LightKind::Specular => match normal.dot(to_light).gate(if_tied) {
                _ if self.without == Some(Rule::SpecularGate) => power(),
                Some(true) => power(),
                Some(false) => zero,
                None => power().either(zero),
            },
        }
    }

    /// The model at a point whose gates have this many bits in `open`; `to_light` returns l for the index of a light.
    fn lit(
        &self,
        normal: RealVector<R>,
        to_eye: RealVector<R>,
        to_light: impl Fn(usize) -> RealVector<R>,
        open: Open,
        bits: usize,
    ) -> Lit<R> {
        let sum = |open| self.sum(normal, to_eye, &to_light, open);
        let lit = sum(open);
        if lit.ties <= bits {
            return lit;
        }
        // A highlight only adds light, so every combination lies between none and all of them.
        Lit {
            levels: sum(0).levels.zip(sum(ALL).levels, R::either),
            ..lit
        }
    }

    /// The sum over all lights, with these tied gates open.
    fn sum(
        &self,
        normal: RealVector<R>,
        to_eye: RealVector<R>,
        to_light: impl Fn(usize) -> RealVector<R>,
        open: Open,
    ) -> Lit<R> {
        let mut levels = RealVector::exact(DVec3::ZERO);
        // The places of lights with a tied gate.
        let mut tied = Vec::new();
        let mut last = None;
        for (index, light) in self.lights.iter().enumerate() {
            if light.kind == LightKind::Ambient {
                levels = levels + light.levels;
                continue;
            }
            // In most files lights at one position follow one another, and share l.
            let shared = last.filter(|(place, _)| *place == light.place);
            let to_light = shared.map_or_else(|| to_light(index), |(_, to_light)| to_light);
            last = Some((light.place, to_light));
            let mut is_open = false;
            if light.kind == LightKind::Specular && normal.dot(to_light).is_tied() {
                let known = tied.iter().position(|place| *place == light.place);
                let bit = known.unwrap_or(tied.len());
                if known.is_none() {
                    tied.push(light.place);
                }
                is_open = open >> (bit % TIES) & 1 == 1;
            }
            let factor = self.factor(light.kind, normal, to_eye, to_light, is_open);
            levels = levels + light.levels * factor;
        }
        Lit {
            levels,
            ties: tied.len(),
        }
    }

    /// Phong (1975): the model at a point of a face.
    pub fn phong(&self, face: usize, place: &FacePoint<R>, open: Open) -> Lit<R> {
        let to_light = |light| self.to_light(light, place);
        let is_shared = self.normals == NormalMode::Corner;
        let normal = if self.without == Some(Rule::UnitNormal) && is_shared {
            // At a corner the share is (±1, ±1, ±1) / 2, and the unit normal is (±1, ±1, ±1) / sqrt(3).
            place.share * (R::of(2.0) / R::of(3.0).sqrt())
        } else {
            self.normal(face, place)
        };
        self.lit(normal, place.to_eye, to_light, open, TIES)
    }

    /// l of a light at a point of a face.
    pub fn to_light(&self, light: usize, place: &FacePoint<R>) -> RealVector<R> {
        self.way_to_light(light, place).unit()
    }

    /// The vector from a point of a face to a light, in world units.
    pub fn way_to_light(&self, light: usize, place: &FacePoint<R>) -> RealVector<R> {
        self.lights[light].from_eye - place.point
    }

    /// The lights that have a place, in groups that share it and follow one another, each with the index of its first light.
    pub fn lights_by_place(&self) -> impl Iterator<Item = (usize, &[LightTerm<R>])> {
        let is_ambient = |light: &LightTerm<R>| light.kind == LightKind::Ambient;
        let groups = self.lights.chunk_by(move |one, other| {
            !is_ambient(one) && !is_ambient(other) && one.place == other.place
        });
        let mut next = 0;
        let groups = groups.map(move |group| {
            next += group.len();
            (next - group.len(), group)
        });
        groups.filter(move |(_, group)| !is_ambient(&group[0]))
    }

    /// Whether normals vary over a face, because the faces at a corner share one.
    pub fn has_shared_normals(&self) -> bool {
        self.normals == NormalMode::Corner
    }

    /// Gouraud (1971): the levels at the corners, interpolated over the triangle.
    pub fn gouraud(&self, face: usize, corners: [usize; 3], weights: [R; 3], open: Open) -> Lit<R> {
        let lit = |i: usize| {
            let levels = &self.corner_levels[open >> i & 1];
            levels[across(face).0 % levels.len()][corners[i]]
        };
        interpolated([lit(0), lit(1), lit(2)], weights)
    }

    /// The levels at a vertex of a face's grid, or at the middle of a flat face, with its tied gates closed or open.
    pub fn at_vertex(&self, face: usize, place: &FacePoint<R>, is_open: bool) -> Lit<R> {
        let to_light = |light| self.to_light(light, place);
        let (normal, open) = (self.normal(face, place), if is_open { ALL } else { 0 });
        self.lit(normal, place.to_eye, to_light, open, 1)
    }

    /// The assignment's shortcut: the corners' unit n, l and o are interpolated and not normalised again.
    pub fn unit_vectors(
        &self,
        face: usize,
        corners: [usize; 3],
        weights: [R; 3],
        open: Open,
    ) -> Lit<R> {
        let between = |vector: &dyn Fn(&Corner<R>) -> RealVector<R>| {
            let [a, b, c] = corners.map(|corner| &self.corners[corner]);
            blend([vector(a), vector(b), vector(c)], weights)
        };
        let to_light = |light: usize| between(&|corner| corner.to_lights[light]);
        let normal = between(&|corner| corner.normals[across(face).0]);
        self.lit(
            normal,
            between(&|corner| corner.to_eye),
            to_light,
            open,
            TIES,
        )
    }
}

/// r: `to_light` reflected about the normal.
pub fn reflection<R: Real>(normal: RealVector<R>, to_light: RealVector<R>) -> RealVector<R> {
    normal * (R::of(2.0) * normal.dot(to_light)) - to_light
}

/// The levels between three vertices.
pub fn interpolated<R: Real>(lit: [Lit<R>; 3], weights: [R; 3]) -> Lit<R> {
    Lit {
        levels: blend([lit[0].levels, lit[1].levels, lit[2].levels], weights),
        ties: lit[0].ties + lit[1].ties + lit[2].ties,
    }
}

/// The weighted sum of the values at three corners.
pub fn blend<R: Real>(values: [RealVector<R>; 3], weights: [R; 3]) -> RealVector<R> {
    values[0] * weights[0] + values[1] * weights[1] + values[2] * weights[2]
}
