//! Collects the lights that are on, and computes the vertex colours of Gouraud shading.
//!
//! Lights at one position are summed, since they have the same vectors l and r. Vertex colours are computed for cuboids
//! with Gouraud shading: at the eight corners, with face normals at the four corners of each visible face, or with several
//! segments at the points of each visible face whose cells may be seen, eight at a time. Points that are much denser than
//! pixels are lit by the pixels that need them. With flat shading they are those at the middle of each visible face.

use std::array::from_fn;
use std::cmp::Ordering::Equal;

use fearless_simd::Level;
use glam::DVec3;
use hecs::World;

use crate::components::{
    FACES, Illumination, Light, LightKind, Material, Mesh, Normals, PointLight, Projected,
    Projection, Segments, ShadingMode, Transform, VertexColors, View, WorldTransform, length, unit,
};
use crate::shading::Surface;
use crate::shading::affine::Affine;
use crate::shading::face::{Face, Plane, Rays};
use crate::shading::grid::{Cells, Grids};
use crate::shading::simd::{dispatch, inlined};
use crate::systems::frame::{DrawList, Frame};

/// Overwrites the frame's [`Illumination`], then the [`VertexColors`] of every cuboid under Gouraud or flat shading.
pub fn run(world: &mut World, view: &View, frame: &mut Frame) {
    gather(
        world.query_mut::<(&Transform, &Light)>().into_iter(),
        &mut frame.list.illumination,
    );
    let level = frame.workers().level();
    for (transform, mesh, material, own, segments, normals, projected, colors) in world
        .query_mut::<(
            &WorldTransform,
            &Mesh,
            &Material,
            &ShadingMode,
            &Segments,
            &Normals,
            &Projected,
            &mut VertexColors,
        )>()
    {
        let mode = view.mode(*own);
        if !matches!(mode, ShadingMode::Flat | ShadingMode::Gouraud) {
            continue;
        }
        let DrawList {
            rays,
            illumination,
            grids,
            ..
        } = &mut frame.list;
        let lit = LitCuboid {
            transform,
            mesh,
            normals,
            rays,
            surface: Surface::new(material, illumination, transform.position),
        };
        let segments = view.segments(*segments);
        let faces = (0..FACES.len()).filter(|face| projected.polygons[*face].meets(view.size));
        let evaluations;
        (*colors, evaluations) = match normals {
            _ if mode == ShadingMode::Flat => (lit.at_middles(faces.clone()), faces.count()),
            _ if segments.count() > 1 => {
                let lit_before = grids.lit_points();
                let seen = faces.map(|face| (face, projected.polygons[face].bounds(view.size)));
                let colors = lit.at_grid_points(seen, segments, grids, level);
                (colors, grids.lit_points() - lit_before)
            }
            Normals::Corner(normals) => (lit.at_corners(normals), normals.len()),
            Normals::Face(_) => (lit.at_corners_of_faces(faces.clone()), 4 * faces.count()),
        };
        let evaluations = evaluations as u64;
        frame.counts.model_evaluations += evaluations;
        frame.counts.specular_evaluations += evaluations * lit.surface.powers() as u64;
    }
}

/// With more points than this for a pixel, to light the three points of each pixel's own cell costs less.
const MOST_POINTS: f64 = 6.0;

/// A cuboid whose vertex colours are computed. Faces are given by their numbers.
struct LitCuboid<'a> {
    transform: &'a WorldTransform,
    mesh: &'a Mesh,
    normals: &'a Normals,
    rays: &'a Rays,
    surface: Surface<'a>,
}

impl LitCuboid<'_> {
    fn at_middles(&self, faces: impl Iterator<Item = usize>) -> VertexColors {
        let mut colors = [[DVec3::ZERO; 4]; 3];
        for face in faces {
            let (middle, normal) = (self.mesh).on_face(face, &self.normals.of_face(face), [0.0; 2]);
            let plane = self.plane(face);
            colors[face / 2] = [self.levels(plane.as_ref(), middle, unit(normal)); 4];
        }
        VertexColors::Face(colors)
    }

    fn at_grid_points(
        &self,
        faces: impl Iterator<Item = (usize, [[f64; 2]; 2])>,
        segments: Segments,
        grids: &mut Grids,
        level: Level,
    ) -> VertexColors {
        let mut indices = [0; 3];
        for (face, bounds) in faces {
            let plane = self.plane(face);
            let surface = Surface {
                plane: plane.as_ref(),
                ..self.surface
            };
            let functions = self.on_face(face);
            let cells = Cells::around(self.shown(face, bounds), segments);
            let [width, height] = [0, 1].map(|axis| bounds[1][axis] - bounds[0][axis]);
            if cells.points() as f64 > MOST_POINTS * width * height {
                indices[face / 2] = grids.add_unlit(segments, cells, functions);
                continue;
            }
            indices[face / 2] = dispatch!(level, simd => grids.add(
                simd,
                segments,
                cells,
                inlined!(|uv| surface.levels_in_lanes(&functions, uv))
            ));
        }
        VertexColors::Grid(indices)
    }

    fn at_corners(&self, normals: &[DVec3; 8]) -> VertexColors {
        let corners = &self.mesh.corners;
        VertexColors::Corner(from_fn(|it| self.levels(None, corners[it], normals[it])))
    }

    fn at_corners_of_faces(&self, faces: impl Iterator<Item = usize>) -> VertexColors {
        let mut colors = [[DVec3::ZERO; 4]; 3];
        for face in faces {
            let plane = self.plane(face);
            let (corners, normals) = (FACES[face].map(usize::from), self.normals.of_face(face));
            let place = |index: usize| self.mesh.corners[corners[index]];
            let level = |index| self.levels(plane.as_ref(), place(index), normals[index]);
            colors[face / 2] = from_fn(level);
        }
        VertexColors::Face(colors)
    }

    /// The plane of a face that has its own normal.
    fn plane(&self, face: usize) -> Option<Plane> {
        let has_own = matches!(self.normals, Normals::Face(_));
        has_own.then(|| Plane::new(face, self.transform, self.mesh.corners[7], self.rays))
    }

    /// The least and the largest (u, v) of a face within these bounds in the picture.
    fn shown(&self, face: usize, bounds: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
        let (half, middle) = (self.mesh.corners[7], self.rays.lens.middle);
        let plane = Plane::new(face, self.transform, half, self.rays);
        let face = Face::new(&plane, self.transform, half, self.rays);
        face.shown_in(bounds.map(|[x, y]| [x - middle[0], y - middle[1]]))
    }

    /// The levels at a place of the cuboid, in its own axes.
    fn levels(&self, plane: Option<&Plane>, place: DVec3, normal: DVec3) -> DVec3 {
        let (lens, offset) = (&self.rays.lens, self.transform.axes * place);
        let to_eye = match lens.projection {
            Projection::Perspective => unit(lens.eye - self.transform.position - offset),
            Projection::Orthographic => -lens.axes[2],
        };
        let surface = Surface {
            plane,
            ..self.surface
        };
        surface.levels(offset, normal, to_eye)
    }

    /// Offset, normal and vector to the eye at the points of a face, as functions of u and v; see [`Surface::levels_in_lanes`].
    fn on_face(&self, face: usize) -> [Affine; 3] {
        let (transform, lens) = (self.transform, &self.rays.lens);
        let at = |u, v| (self.mesh).on_face(face, &self.normals.of_face(face), [u, v]);
        let [middle, right, up] = [at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0)];
        let place = Affine::new(middle.0, right.0 - middle.0, up.0 - middle.0);
        let normal = Affine::new(middle.1, right.1 - middle.1, up.1 - middle.1);
        let offset = place.map(|it| transform.axes * it);
        let from_centre = lens.eye - transform.position;
        let constant = |to_eye| Affine::new(to_eye, DVec3::ZERO, DVec3::ZERO);
        let to_eye = match lens.projection {
            Projection::Orthographic => constant(-lens.axes[2]),
            // A cuboid is at most 1e100 wide, and larger squares overflow.
            Projection::Perspective if length(from_centre) > 1e150 => constant(unit(from_centre)),
            Projection::Perspective => {
                Affine::new(from_centre - offset.centre, -offset.dx, -offset.dy)
            }
        };
        [offset, normal, to_eye]
    }
}

/// Sums the lights that are on, by position. Ambient lights get a position at infinity, where no other light can be.
///
/// Sorting brings lights at one position together without a search among all the others for each. Their levels
/// are part of the sort key, so the sums do not depend on the order of the lights.
fn gather<'a>(
    lights: impl Iterator<Item = (&'a Transform, &'a Light)>,
    illumination: &mut Illumination,
) {
    illumination.points.clear();
    for (transform, light) in lights.filter(|(_, light)| light.on) {
        let (position, diffuse, specular) = match light.kind {
            LightKind::Ambient => (DVec3::INFINITY, light.strength(), DVec3::ZERO),
            LightKind::Diffuse => (transform.position, light.strength(), DVec3::ZERO),
            LightKind::Specular => (transform.position, DVec3::ZERO, light.strength()),
        };
        illumination.points.push(PointLight {
            position,
            diffuse,
            specular,
        });
    }
    let key = |point: &PointLight| {
        [point.position, point.diffuse, point.specular].map(|vector| vector.to_array())
    };
    let points = &mut illumination.points;
    // No number of a scene is NaN, so all compare.
    points.sort_unstable_by(|one, other| key(one).partial_cmp(&key(other)).unwrap_or(Equal));
    points.dedup_by(|later, first| {
        let together = later.position == first.position;
        if together {
            first.diffuse += later.diffuse;
            first.specular += later.specular;
        }
        together
    });
    let ambient = points.pop_if(|last| last.position == DVec3::INFINITY);
    illumination.ambient = ambient.map_or(DVec3::ZERO, |all| all.diffuse);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: f64) -> Transform {
        Transform::at(DVec3::X * x)
    }

    #[test]
    fn lights_are_the_same_in_whatever_order_they_come() {
        // Sums of these three depend on their order: (1e16 + 1) + 1 is not 1e16 + (1 + 1).
        let light = |kind, intensity| Light {
            kind,
            color: DVec3::new(0.0, 0.5, 1.0),
            intensity,
            gain: 2.0,
            on: true,
        };
        let places = [at(3.0), at(-2.0), at(3.0), at(3.0), at(-0.0), at(0.0)];
        let sizes = [1.0, 1e16, 1.0];
        let lights: [Light; 6] = from_fn(|it| light(LightKind::Diffuse, sizes[it % 3]));
        let ambient: [Light; 6] = from_fn(|it| light(LightKind::Ambient, sizes[it % 3]));
        let gathered = |order: [usize; 6]| {
            let mut illumination = Illumination::default();
            let pairs = order.map(|it| [(&places[it], &lights[it]), (&places[it], &ambient[it])]);
            gather(pairs.into_iter().flatten(), &mut illumination);
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
}
