//! Projects the faces of cuboids to convex polygons on the screen, in units of 1/256 pixel.
//!
//! ```text
//!  corner - eye  --axes-->  (right, up, forward)  --near plane, guard band-->  polygon  --divide, viewport, snap--> 24.8
//! ```
//! The eye is subtracted first, in f64, so a scene a billion units from the origin is as exact as one at the origin. A face
//! is drawn if the eye is on its outer side. Clipping changes the polygon but not the values at vertices. It uses the cuboid's
//! own axes, in which long edges are cut as exactly as short ones, and cuts an edge at the same point for both its faces.
//! Snapping affects coverage only.

mod frustum;

use glam::DVec3;
use hecs::World;

use self::frustum::Frustum;
use crate::components::{
    FACES, Lens, Mesh, Projected, Projection, View, WorldTransform, outward_sign,
};
use crate::shading::face::Rays;
use crate::systems::frame::Frame;

/// Overwrites the lens and the lines of sight of the frame, and the [`Projected`] of every cuboid.
pub fn run(world: &mut World, view: &View, frame: &mut Frame) {
    frame.list.rays = Rays::new(&Lens::new(view));
    for (transform, mesh, projected) in
        world.query_mut::<(&WorldTransform, &Mesh, &mut Projected)>()
    {
        project(transform, mesh, frame.lens(), projected);
    }
}

/// Projects one cuboid.
pub fn project(transform: &WorldTransform, mesh: &Mesh, lens: &Lens, projected: &mut Projected) {
    let axes = transform.axes;
    let centre = transform.position - lens.eye;
    let [right, up, forward] = lens.axes;
    for (seen, corner) in projected.seen.iter_mut().zip(mesh.corners) {
        let from_eye = centre + axes * corner;
        *seen = DVec3::new(right.dot(from_eye), up.dot(from_eye), forward.dot(from_eye));
    }
    let eye_side = match lens.projection {
        Projection::Perspective => axes.transpose() * -centre,
        // The eye is infinitely far away, opposite to the view direction. 0 * infinity is NaN, which is in front of no face:
        // a face seen edge-on is not drawn.
        Projection::Orthographic => axes.transpose() * -lens.axes[2] * f64::INFINITY,
    };
    let frustum = Frustum::new(lens, axes, centre);
    let half = mesh.corners[7];
    let is_whole = frustum.holds(half);
    let mut snapped = [[0; 2]; 8];
    if is_whole {
        for (pixel, seen) in snapped.iter_mut().zip(projected.seen) {
            *pixel = frustum.snapped(seen);
        }
    }
    for (index, polygon) in projected.polygons.iter_mut().enumerate() {
        let corners = FACES[index];
        let axis = index / 2;
        let is_front = outward_sign(index) * eye_side[axis] > half[axis];
        if !is_front {
            polygon.len = 0;
        } else if is_whole {
            polygon.len = 4;
            for (vertex, corner) in polygon.vertices.iter_mut().zip(corners) {
                *vertex = snapped[usize::from(corner)];
            }
        } else {
            let places = corners.map(|corner| mesh.corners[usize::from(corner)]);
            *polygon = frustum.clip(axis, places);
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::DMat3;

    use super::*;
    use crate::components::Camera;

    pub(super) fn view(projection: Projection, size: [usize; 2]) -> View {
        let camera = Camera {
            position: DVec3::new(0.0, 0.0, 10.0),
            target: DVec3::ZERO,
            up: DVec3::Y,
            fov: 90.0,
            height: 20.0,
            near: Some(1.0),
        };
        View {
            size,
            camera,
            projection,
            background: DVec3::ZERO,
            turned: 0,
            shading: None,
            segments: None,
            tolerance: 0.0,
        }
    }

    fn project_at(position: DVec3, size: DVec3, view: &View) -> Projected {
        let mut projected = Projected::default();
        let transform = WorldTransform {
            position,
            axes: DMat3::IDENTITY,
        };
        project(
            &transform,
            &Mesh::cuboid(size),
            &Lens::new(view),
            &mut projected,
        );
        projected
    }

    #[test]
    fn a_known_corner_falls_on_a_known_pixel_in_orthographic_projection() {
        // 20 units over 200 rows: 10 pixels a unit at any depth. Corner (1, 2) is at (150 + 10, 100 - 20).
        let view = view(Projection::Orthographic, [300, 200]);
        let projected = project_at(DVec3::new(0.0, 0.0, 4.0), DVec3::new(2.0, 4.0, 2.0), &view);
        // Face +z is 4 5 7 6.
        assert_eq!(
            projected.polygons[4].vertices(),
            [
                [140 * 256, 120 * 256],
                [160 * 256, 120 * 256],
                [160 * 256, 80 * 256],
                [140 * 256, 80 * 256]
            ]
        );
        // A wider one is cut at the guard band.
        let wide = project_at(DVec3::ZERO, DVec3::new(1e9, 4.0, 2.0), &view);
        let ends = wide.polygons[4].vertices().iter().map(|[x, _]| x / 256);
        assert!(ends.eq([-1, 1, 1, -1].map(|side| 150 + side * 2_097_152)));
    }

    #[test]
    fn only_faces_towards_the_eye_are_drawn() {
        for (projection, position, drawn) in [
            (Projection::Perspective, DVec3::ZERO, vec![4]),
            (
                Projection::Orthographic,
                DVec3::new(-5.0, 5.0, 0.0),
                vec![4],
            ),
            (
                Projection::Perspective,
                DVec3::new(-5.0, 0.0, 0.0),
                vec![0, 4],
            ),
            (
                Projection::Perspective,
                DVec3::new(0.0, -5.0, 0.0),
                vec![2, 4],
            ),
            (Projection::Perspective, DVec3::new(0.0, 0.0, 10.0), vec![]),
        ] {
            let projected = project_at(position, DVec3::splat(2.0), &view(projection, [300, 200]));
            let polygons = projected
                .polygons
                .iter()
                .enumerate()
                .filter(|(_, polygon)| polygon.len > 0);
            assert_eq!(
                polygons.map(|(index, _)| index).collect::<Vec<_>>(),
                drawn,
                "{projection:?} {position}"
            );
        }
    }

    #[test]
    fn an_eye_in_the_plane_of_a_face_does_not_see_it() {
        let projected = project_at(
            DVec3::new(-1.0, 0.0, 0.0),
            DVec3::splat(2.0),
            &view(Projection::Perspective, [300, 200]),
        );
        assert_eq!(projected.polygons[0].len, 0);
    }

    #[test]
    fn a_floor_of_any_length_is_cut_by_the_near_plane_in_the_same_row() {
        // Its top lies 2 below the eye: at the near plane, 1 away, that is 200 pixels below row 100.
        let view = view(Projection::Perspective, [300, 200]);
        for length in [100.0, 1e5, 1e9, 1e15, 1e100] {
            let size = DVec3::new(length, 4.0, length);
            let projected = project_at(DVec3::new(0.0, -4.0, 7.0), size, &view);
            let top = projected.polygons[2].vertices();
            let lowest = top.iter().map(|[_, y]| *y).max();
            assert_eq!(lowest, Some(300 * 256), "{length}: {top:?}");
            let highest = top.iter().map(|[_, y]| *y).min();
            assert!(highest < Some(105 * 256), "{length}: {top:?}");
            // Sideways it is cut at the guard band, unless it ends before.
            let lowest = top.iter().filter(|[_, y]| *y == 300 * 256);
            let leftmost = lowest.map(|[x, _]| x / 256).min();
            let expected = if length > 100.0 {
                150 - 2_097_152
            } else {
                150 - 5_000
            };
            assert_eq!(leftmost, Some(expected), "{length}");
            // The side runs from 50 pixels for each unit of length, in row 300, to the middle.
            let ends = top.iter().filter(|[x, _]| Some(*x / 256) == leftmost);
            let highest = ends
                .map(|[_, y]| f64::from(*y) / 256.0)
                .fold(300.0, f64::min);
            let row = 100.0 + 4.0 * f64::min(2_097_152.0 / length, 50.0);
            assert!((highest - row).abs() < 0.01, "{length}: {highest}, {row}");
        }
    }
}
