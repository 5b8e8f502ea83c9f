//! The evaluation of pixels of a row in f64: the visible point, the vectors of the model and the term of each light.

use glam::DVec3;
use hecs::World;
use serde::Serialize;

use super::cells::touched;
use super::geometry::{CuboidGeometry, FacePoint};
use super::illumination::{blend, reflection};
use super::picture::{Met, Reference, ReferenceCuboid};
use super::real::RealVector;
use crate::components::{Light, LightKind, Name, View, in_file_order};

/// The evaluation of one pixel. Vectors are unit vectors in world space.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// The cuboid's index in the file, from 0.
    pub object: usize,
    /// The triangle's index in [`crate::components::TRIANGLES`].
    pub triangle: usize,
    /// The cells along an edge of a face under Gouraud.
    pub segments: usize,
    /// The vertices between which Gouraud interpolates: the corners of the triangle, or those of a cell's triangle. Each is
    /// given along the cuboid's axes, relative to its centre, divided by the lengths of its edges: -1/2..=1/2.
    pub vertices: [DVec3; 3],
    /// The barycentric weights of these vertices; their sum is 1.
    pub weights: [f64; 3],
    /// The visible point, in world units.
    pub position: DVec3,
    /// n under Phong: interpolated and normalised.
    pub normal: DVec3,
    /// o: towards the eye, or opposite to the view direction in orthographic projection.
    pub to_eye: DVec3,
    /// Every light that is on, in file order.
    pub lights: Vec<LightSample>,
    /// Gouraud's levels, unclamped.
    pub gouraud: DVec3,
    /// Phong's levels, unclamped.
    pub phong: DVec3,
    /// Blinn-Phong's levels with four times the exponent, unclamped.
    pub blinn_phong: DVec3,
    /// The length of n under interpolated unit vectors, 0..=1.
    pub normal_length: f64,
}

/// The contribution of one light to a [`Sample`].
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LightSample {
    /// The light's name.
    pub name: String,
    /// The term of the model that it contributes to.
    pub kind: LightKind,
    /// l; `None` for an ambient light and for a light exactly at the point.
    pub to_light: Option<DVec3>,
    /// r = 2 (n.l) n - l; `None` if l is.
    pub reflected: Option<DVec3>,
    /// h = unit(l + o); `None` if l is, or where l = -o.
    pub half_vector: Option<DVec3>,
    /// Blinn's max(0, n.h)^(4 rho) where n.l > 0, of a specular light.
    pub half_vector_factor: Option<f64>,
    /// The factor of its strength at the point: max(0, n.l), max(0, o.r)^rho where n.l > 0, or 1 for an ambient light.
    #[serde(skip)]
    pub factor: f64,
    /// The factor at [`Sample::vertices`].
    #[serde(skip)]
    pub vertex_factors: [f64; 3],
    /// Coefficient of the material * colour * intensity * gain, in levels of 255.
    #[serde(skip)]
    pub strength: DVec3,
    /// Its term under Gouraud, in unclamped levels.
    #[serde(skip)]
    pub gouraud: DVec3,
    /// Its term under Phong, in unclamped levels.
    #[serde(skip)]
    pub phong: DVec3,
    /// Its term under Blinn-Phong.
    #[serde(skip)]
    pub blinn_phong: DVec3,
}

/// The evaluations of these columns of row `y`, which must lie inside the picture for `view`; `None` for the background.
pub fn in_row(world: &World, view: &View, y: usize, columns: &[usize]) -> Vec<Option<Sample>> {
    let reference = Reference::new(world, view);
    let cuboids = reference.in_row(y);
    let lights = in_file_order::<(&Name, &Light), _>(world, |(name, light)| {
        light.on.then(|| name.0.clone())
    });
    let names: Vec<String> = lights.into_iter().flatten().collect();
    let mut met = Vec::new();
    let sample = |x: &usize| {
        reference.meet([*x, y], &cuboids, &mut met);
        reference.sample(met.first()?, &names)
    };
    columns.iter().map(sample).collect()
}

impl Reference<f64> {
    /// The evaluation where a line of sight meets a cuboid. `names` has the names of the lights that are on.
    fn sample(&self, met: &Met<f64>, names: &[String]) -> Option<Sample> {
        let ReferenceCuboid {
            solid,
            surface,
            segments,
            ..
        } = met.cuboid;
        let (face, place) = met.meeting.points.first()?;
        let is_first = place.is_on_first?;
        let (corners, on_face) = CuboidGeometry::weights(*face, is_first, place.share);
        let (vertices, weights) = if *segments == 1 {
            (corners.map(|corner| solid.corner_share(corner)), on_face)
        } else {
            touched(*face, place.share, *segments).0.pop()?
        };
        let named = names.iter().enumerate();
        let light = |(index, name): (usize, &String)| {
            let between = (vertices, weights);
            (met.cuboid).light_sample(index, name.clone(), (*face, place), between)
        };
        let lights: Vec<LightSample> = named.map(light).collect();
        let on_screen = solid.shortcut_weights(corners, on_face);
        let normals = corners.map(|corner| surface.corner_normal(*face, corner));
        Some(Sample {
            object: met.cuboid.number,
            triangle: 2 * face + usize::from(!is_first),
            segments: *segments,
            vertices: vertices.map(RealVector::to_dvec3),
            weights,
            position: self.sight.eye + solid.to_world(place.point),
            normal: solid.to_world(surface.normal(*face, place)),
            to_eye: solid.to_world(place.to_eye),
            gouraud: (met.cuboid)
                .gouraud(*face, corners, on_face, place.share, 0)
                .levels
                .to_dvec3(),
            phong: surface.phong(*face, place, 0).levels.to_dvec3(),
            blinn_phong: lights.iter().map(|light| light.blinn_phong).sum(),
            lights,
            normal_length: blend(normals, on_screen).length_squared().sqrt(),
        })
    }
}

impl ReferenceCuboid<f64> {
    /// The contribution of the light at this index to a point of a face. Gouraud interpolates between vertices with their
    /// weights.
    fn light_sample(
        &self,
        index: usize,
        name: String,
        (face, place): (usize, &FacePoint<f64>),
        (vertices, weights): ([RealVector<f64>; 3], [f64; 3]),
    ) -> LightSample {
        let (solid, surface) = (&self.solid, &self.surface);
        let light = &surface.lights[index];
        let factor_at = |at: &FacePoint<f64>| {
            let (normal, to_light) = (surface.normal(face, at), surface.to_light(index, at));
            surface.factor(light.kind, normal, at.to_eye, to_light, false)
        };
        let vertex_factors = vertices.map(|vertex| factor_at(&solid.at_share(vertex)));
        let factor = factor_at(place);
        let (normal, to_light) = (surface.normal(face, place), surface.to_light(index, place));
        let is_directed = light.kind != LightKind::Ambient && to_light.to_dvec3() != DVec3::ZERO;
        let directed = |vector| is_directed.then(|| solid.to_world(vector));
        let is_lit = normal.dot(to_light) > 0.0;
        let half_vector_factor = (light.kind == LightKind::Specular).then(|| {
            if is_lit {
                surface.half_vector_factor(normal, place.to_eye, to_light)
            } else {
                0.0
            }
        });
        let half = (to_light + place.to_eye).unit();
        let vertex_levels = vertex_factors.map(|factor| light.levels * factor);
        LightSample {
            name,
            kind: light.kind,
            to_light: directed(to_light),
            reflected: directed(reflection(normal, to_light)),
            half_vector: directed(half).filter(|it| *it != DVec3::ZERO),
            half_vector_factor,
            factor,
            vertex_factors,
            strength: light.levels.to_dvec3(),
            gouraud: blend(vertex_levels, weights).to_dvec3(),
            phong: (light.levels * factor).to_dvec3(),
            blinn_phong: (light.levels * half_vector_factor.unwrap_or(factor)).to_dvec3(),
        }
    }
}

impl CuboidGeometry<f64> {
    /// A vector in world space from one along the cuboid's axes.
    fn to_world(&self, v: RealVector<f64>) -> DVec3 {
        let [x, y, z] = v.0;
        (self.axes[0] * x + self.axes[1] * y + self.axes[2] * z).to_dvec3()
    }
}
