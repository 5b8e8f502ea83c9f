//! One pixel in; what is seen there out, and why it looks as it does.

use glam::DVec3;
use hecs::World;
use serde::Serialize;

use super::illumination::{Incidence, blend, reflection};
use super::sight::Solid;
use super::vector::Vector;
use super::{Cuboid, Reference, in_file_order};
use crate::components::{FileOrder, Light, LightKind, Name, View};

/// What is seen at one pixel, and why it looks as it does. Vectors are of unit length, in world space.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// The cuboid's place in the file, from 0.
    pub object: usize,
    /// The triangle's place in [`crate::components::TRIANGLES`].
    pub triangle: usize,
    /// The point seen, in world units.
    pub position: DVec3,
    /// n as Phong has it: interpolated and normalised.
    pub normal: DVec3,
    /// o: to the eye, or against the view direction if the projection is orthographic.
    pub to_eye: DVec3,
    /// Every light that is on, in file order.
    pub lights: Vec<LightSample>,
    /// Gouraud's levels, unclamped.
    pub gouraud: DVec3,
    /// Phong's levels, unclamped.
    pub phong: DVec3,
}

/// What one light does at a [`Sample`].
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LightSample {
    /// The light's name.
    pub name: String,
    /// The term it feeds.
    pub kind: LightKind,
    /// l; `None` for an ambient light and for one that stands at the very point.
    pub to_light: Option<DVec3>,
    /// r = 2 (n.l) n - l; exists where l does.
    pub reflected: Option<DVec3>,
    /// What the model multiplies its strength with at the point: max(0, n.l), (o.r)^rho where n.l > 0, or 1 for an ambient light.
    #[serde(skip)]
    pub factor: f64,
    /// Coefficient, colour, intensity and gain together, in levels.
    #[serde(skip)]
    pub strength: DVec3,
    /// Its term in levels under Gouraud, unclamped.
    #[serde(skip)]
    pub gouraud: DVec3,
    /// Its term in levels under Phong, unclamped.
    #[serde(skip)]
    pub phong: DVec3,
}

/// What is seen at pixel (`x`, `y`) of the picture that `view` asks for; `None` is background, or outside of it.
pub fn at_pixel(world: &World, view: &View, x: usize, y: usize) -> Option<Sample> {
    let reference = Reference::new(world, view);
    let cuboids: Vec<_> = reference.cuboids.iter().collect();
    let mut met = Vec::new();
    reference.meet([x, y], &cuboids, &mut met);
    let met = met.first()?;
    let Cuboid { solid, surface, .. } = met.cuboid;
    let (line, face) = (&met.line, met.meeting.faces().next()?);
    let place = solid.place(face, line);
    let is_first = solid.is_on_first(face, line, &place)?;
    let (corners, weights) = Solid::weights(face, is_first, &place);
    let [normal, to_eye] = [place.share.unit(), -line.along.unit()];
    let to_world = |v: Vector<f64>| {
        let [x, y, z] = v.0;
        (solid.axes[0] * x + solid.axes[1] * y + solid.axes[2] * z).to_dvec3()
    };
    let mut query = world.query::<(&FileOrder, &Name, &Light)>();
    let names = query.iter().filter(|(_, _, light)| light.on);
    let names = in_file_order(names.map(|(order, name, _)| (*order, name.0.clone())));
    let lights = surface
        .light_terms
        .iter()
        .zip(names)
        .map(|(light_term, name)| {
            let factor = |incidence: Incidence<f64>| match light_term.kind {
                LightKind::Ambient => 1.0,
                LightKind::Diffuse => incidence.diffuse,
                LightKind::Specular => incidence.specular,
            };
            let term = |incidence| light_term.levels * factor(incidence);
            let to_light = light_term
                .source
                .map(|source| surface.to_light(source, &place, line));
            let to_light = to_light.filter(|to_light| to_light.to_dvec3() != DVec3::ZERO);
            let nothing = Incidence {
                diffuse: 0.0,
                specular: 0.0,
            };
            let at_point = to_light.map_or(nothing, |to_light| {
                surface.incidence(normal, to_eye, to_light, false)
            });
            let at_corners = corners.map(|corner| {
                let source = light_term.source;
                term(source.map_or(nothing, |source| surface.at_corner(corner, source)))
            });
            LightSample {
                name,
                kind: light_term.kind,
                to_light: to_light.map(to_world),
                reflected: to_light.map(|to_light| to_world(reflection(normal, to_light))),
                factor: factor(at_point),
                strength: light_term.levels.to_dvec3(),
                gouraud: blend(at_corners, weights).to_dvec3(),
                phong: term(at_point).to_dvec3(),
            }
        });
    Some(Sample {
        object: met.cuboid.number,
        triangle: 2 * face + usize::from(!is_first),
        position: reference.sight.eye
            + to_world(line.offset + line.along * (place.height / place.slope)),
        normal: to_world(normal),
        to_eye: to_world(to_eye),
        lights: lights.collect(),
        gouraud: surface.gouraud(corners, weights, 0).levels.to_dvec3(),
        phong: surface.phong(&place, line, to_eye, 0).levels.to_dvec3(),
    })
}
