//! Lights that are on, and the model at the vertices: Gouraud's half of the work.
//!
//! Rule: a light that is off appears nowhere; lights at one position are summed, since they share l and r; vertex
//! colours are computed for the cuboids that will interpolate them and for no others.

use std::cmp::Ordering::Equal;

use glam::DVec3;
use hecs::World;

use crate::components::{
    Illumination, Light, LightKind, Material, Normals, PointLight, Projected, Projection,
    ShadingMode, Transform, VertexColors, View, unit,
};
use crate::frame::Frame;
use crate::shading::Surface;

/// Overwrites the [`Illumination`], then the [`VertexColors`] of every cuboid shaded after Gouraud.
pub fn run(world: &mut World, view: &View, frame: &mut Frame) {
    for illumination in world.query::<&mut Illumination>().iter() {
        gather(world.query::<(&Transform, &Light)>().iter(), illumination);
        for (transform, material, own, normals, projected, colors) in world
            .query::<(
                &Transform,
                &Material,
                &ShadingMode,
                &Normals,
                &Projected,
                &mut VertexColors,
            )>()
            .iter()
        {
            if view.shading.unwrap_or(*own) == ShadingMode::Gouraud {
                let surface = Surface {
                    material,
                    illumination,
                    centre: transform.position,
                };
                let to_eye = |offset: DVec3| match view.projection {
                    Projection::Perspective => {
                        unit(view.viewpoint.position - transform.position - offset)
                    }
                    Projection::Orthographic => -view.viewpoint.axes()[2],
                };
                colors.0 = vertex_colors(&surface, &projected.offsets, &normals.0, to_eye);
                frame.count_vertices(surface.powers());
            }
        }
    }
}

/// Sums the lights that are on: the ambient ones in file order, the others by position.
///
/// Sorting brings lights at one position together without a search among all the others for each. What would tell two
/// of them apart is sorted too, so that the sums do not depend on how the sort treats equals.
pub fn gather<'a>(
    lights: impl Iterator<Item = (&'a Transform, &'a Light)>,
    illumination: &mut Illumination,
) {
    illumination.ambient = DVec3::ZERO;
    illumination.points.clear();
    for (transform, light) in lights.filter(|(_, light)| light.on) {
        let (diffuse, specular) = match light.kind {
            LightKind::Ambient => {
                illumination.ambient += light.levels();
                continue;
            }
            LightKind::Diffuse => (light.levels(), DVec3::ZERO),
            LightKind::Specular => (DVec3::ZERO, light.levels()),
        };
        illumination.points.push(PointLight {
            position: transform.position,
            diffuse,
            specular,
        });
    }
    let key = |point: &PointLight| {
        [point.position, point.diffuse, point.specular].map(|vector| vector.to_array())
    };
    let points = &mut illumination.points;
    // Scenes hold finite numbers alone, and those all compare.
    points.sort_unstable_by(|one, other| key(one).partial_cmp(&key(other)).unwrap_or(Equal));
    points.dedup_by(|later, first| {
        let together = later.position == first.position;
        if together {
            first.diffuse += later.diffuse;
            first.specular += later.specular;
        }
        together
    });
}

/// The model at eight corners (`offsets` from the cuboid's centre), in levels, unclamped.
pub fn vertex_colors(
    surface: &Surface,
    offsets: &[DVec3; 8],
    normals: &[DVec3; 8],
    to_eye: impl Fn(DVec3) -> DVec3,
) -> [DVec3; 8] {
    std::array::from_fn(|corner| {
        surface.levels(offsets[corner], normals[corner], to_eye(offsets[corner]))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn light(kind: LightKind, intensity: f64, on: bool) -> Light {
        Light {
            kind,
            color: DVec3::new(1.0, 0.5, 0.0),
            intensity,
            gain: 2.0,
            on,
        }
    }

    fn at(x: f64) -> Transform {
        Transform {
            position: DVec3::new(x, 0.0, 0.0),
            rotation: DVec3::ZERO,
        }
    }

    #[test]
    fn lights_at_one_position_are_one_point_and_those_off_are_none() {
        let lights = [
            (at(1.0), light(LightKind::Diffuse, 10.0, true)),
            (at(2.0), light(LightKind::Diffuse, 1.0, true)),
            (at(1.0), light(LightKind::Specular, 3.0, true)),
            (at(1.0), light(LightKind::Diffuse, 4.0, true)),
            (at(1.0), light(LightKind::Specular, 1.0, true)),
            (at(3.0), light(LightKind::Specular, 3.0, false)),
            (at(0.0), light(LightKind::Ambient, 5.0, true)),
            (at(9.0), light(LightKind::Ambient, 5.0, true)),
        ];
        let mut illumination = Illumination::default();
        gather(
            lights.iter().map(|(transform, light)| (transform, light)),
            &mut illumination,
        );
        assert_eq!(illumination.ambient, DVec3::new(20.0, 10.0, 0.0));
        assert_eq!(
            illumination.points,
            [
                PointLight {
                    position: DVec3::X,
                    diffuse: DVec3::new(28.0, 14.0, 0.0),
                    specular: DVec3::new(8.0, 4.0, 0.0)
                },
                PointLight {
                    position: DVec3::X * 2.0,
                    diffuse: DVec3::new(2.0, 1.0, 0.0),
                    specular: DVec3::ZERO
                },
            ]
        );
    }

    #[test]
    fn lights_are_the_same_in_whatever_order_they_come() {
        // Sums of these three depend on their order: (1e16 + 1) + 1 is not 1e16 + (1 + 1).
        let lights = [1.0, 1e16, 1.0].map(|intensity| light(LightKind::Diffuse, intensity, true));
        let places = [at(3.0), at(-2.0), at(3.0), at(3.0), at(-0.0), at(0.0)];
        let gathered = |order: [usize; 6]| {
            let mut illumination = Illumination::default();
            let pairs = order.map(|index| (&places[index], &lights[index % 3]));
            gather(pairs.into_iter(), &mut illumination);
            illumination
        };
        let expected = gathered([0, 1, 2, 3, 4, 5]);
        let positions: Vec<f64> = expected
            .points
            .iter()
            .map(|point| point.position.x)
            .collect();
        assert_eq!(positions, [-2.0, 0.0, 3.0]);
        for order in [[5, 4, 3, 2, 1, 0], [2, 0, 4, 1, 5, 3], [3, 5, 1, 0, 2, 4]] {
            assert_eq!(gathered(order), expected);
        }
    }

    #[test]
    fn a_second_gathering_forgets_the_first() {
        let mut illumination = Illumination::default();
        let (transform, lamp) = (at(1.0), light(LightKind::Diffuse, 10.0, true));
        gather([(&transform, &lamp)].into_iter(), &mut illumination);
        gather(std::iter::empty(), &mut illumination);
        assert_eq!(illumination, Illumination::default());
    }
}
