//! Corners in world space in, convex screen polygons in 1/256 pixel out.
//!
//! ```text
//!  corner - eye  --axes-->  (right, up, forward)  --near plane, guard band-->  polygon  --divide, viewport, snap--> 24.8
//! ```
//! Rules: the eye is subtracted in f64 before anything else, so a scene a billion units from the origin is as exact as
//! one at it. A face is drawn where the eye is on its outer side. Clipping cuts polygons, never the values at vertices,
//! and cuts an edge the same way for both triangles that share it. Snapping decides coverage only.

use glam::DVec3;
use hecs::World;

use crate::components::{Mesh, Polygon, Projected, Projection, TRIANGLES, Transform, View};
use crate::frame::Frame;

/// Half the side of the square, in pixels round the picture's centre, to which polygons are clipped: with it and
/// pictures of at most 16384 pixels a side, the edge functions of rasterization stay below 2^62.
const GUARD_BAND: f64 = 2_097_152.0;

/// The camera as the projection needs it.
#[derive(Clone, Copy, Debug)]
pub struct Lens {
    /// Right, up and forward: unit vectors in world space.
    pub axes: [DVec3; 3],
    /// In world units.
    pub eye: DVec3,
    /// Distance of the near plane in world units.
    pub near: f64,
    /// Perspective or orthographic.
    pub projection: Projection,
    /// See [`crate::components::Viewpoint::pixel_pitch`].
    pub pitch: f64,
    /// Half the picture's width and height in pixels.
    pub half: [f64; 2],
}

impl Lens {
    /// The lens of a view.
    pub fn new(view: &View) -> Self {
        Lens {
            axes: view.viewpoint.axes(),
            eye: view.viewpoint.position,
            near: view.viewpoint.near(),
            projection: view.projection,
            pitch: view.viewpoint.pixel_pitch(view.projection, view.size[1]),
            half: view.size.map(|pixels| pixels as f64 / 2.0),
        }
    }

    /// A point relative to the eye, given along right, up and forward, in homogeneous screen coordinates: x / w and
    /// y / w are world units on the plane whose pixels are [`Lens::pitch`] apart.
    pub fn homogeneous(&self, seen: DVec3) -> DVec3 {
        match self.projection {
            Projection::Perspective => seen,
            Projection::Orthographic => DVec3::new(seen.x, seen.y, 1.0),
        }
    }

    /// Where that point falls, in pixels from the top left corner; `w` must be positive.
    pub fn pixel(&self, point: DVec3) -> [f64; 2] {
        [
            self.half[0] + point.x / point.z / self.pitch,
            self.half[1] - point.y / point.z / self.pitch,
        ]
    }
}

/// Overwrites the [`Projected`] of every cuboid.
pub fn run(world: &mut World, view: &View, _frame: &mut Frame) {
    let lens = Lens::new(view);
    for (transform, mesh, projected) in world.query_mut::<(&Transform, &Mesh, &mut Projected)>() {
        project(transform, mesh, &lens, projected);
    }
}

/// Projects one cuboid.
pub fn project(transform: &Transform, mesh: &Mesh, lens: &Lens, projected: &mut Projected) {
    let axes = transform.axes();
    let centre = transform.position - lens.eye;
    projected.axes = axes;
    projected.offsets = mesh.corners.map(|corner| axes * corner);
    projected.seen = projected.offsets.map(|offset| {
        let from_eye = centre + offset;
        DVec3::from_array(lens.axes.map(|axis| axis.dot(from_eye)))
    });
    let eye_side = match lens.projection {
        Projection::Perspective => axes.transpose() * -centre,
        // The eye is infinitely far against the view direction: no corner's own place matters.
        Projection::Orthographic => axes.transpose() * -lens.axes[2] * f64::INFINITY,
    };
    for (index, triangle) in TRIANGLES.iter().enumerate() {
        let axis = index / 4;
        let outwards = if index / 2 % 2 == 0 { 1.0 } else { -1.0 };
        let front = outwards * eye_side[axis] > mesh.corners[7][axis];
        projected.polygons[index] = if front {
            clip(
                triangle.map(|corner| projected.seen[usize::from(corner)]),
                lens,
            )
        } else {
            Polygon::default()
        };
    }
}

/// A vertex on its way through the clipper: homogeneous, and its depth along forward.
#[derive(Clone, Copy)]
struct Vertex {
    point: DVec3,
    depth: f64,
}

/// The part of a triangle (relative to the eye, along right, up and forward) that is beyond the near plane and inside
/// the guard band, snapped.
fn clip(triangle: [DVec3; 3], lens: &Lens) -> Polygon {
    let first = triangle.map(|seen| Vertex {
        point: lens.homogeneous(seen),
        depth: seen.z,
    });
    let mut vertices = [first[0]; Polygon::MOST];
    vertices[..3].copy_from_slice(&first);
    let mut len = 3;
    let reach = GUARD_BAND * lens.pitch;
    let planes: [&dyn Fn(&Vertex) -> f64; 5] = [
        &|vertex| vertex.depth - lens.near,
        &|vertex| reach * vertex.point.z - vertex.point.x,
        &|vertex| reach * vertex.point.z + vertex.point.x,
        &|vertex| reach * vertex.point.z - vertex.point.y,
        &|vertex| reach * vertex.point.z + vertex.point.y,
    ];
    for inside in planes {
        if !vertices[..len].iter().all(|vertex| inside(vertex) >= 0.0) {
            (vertices, len) = cut(&vertices[..len], inside);
        }
    }
    let mut polygon = Polygon {
        len: len as u8,
        ..Polygon::default()
    };
    for (snapped, vertex) in polygon.vertices.iter_mut().zip(&vertices[..len]) {
        *snapped = lens.pixel(vertex.point).map(snap);
    }
    polygon
}

/// Cuts a convex polygon with one plane (Sutherland and Hodgman 1974); a vertex on the plane is inside.
fn cut(polygon: &[Vertex], inside: &dyn Fn(&Vertex) -> f64) -> ([Vertex; Polygon::MOST], usize) {
    let mut kept = [polygon[0]; Polygon::MOST];
    let mut len = 0;
    for (index, &vertex) in polygon.iter().enumerate() {
        let next = polygon[(index + 1) % polygon.len()];
        let (here, there) = (inside(&vertex), inside(&next));
        let mut keep = |vertex| {
            // Rounding can make a plane cut a convex polygon more than twice; what is lost then is below a snap.
            if len < Polygon::MOST {
                kept[len] = vertex;
                len += 1;
            }
        };
        if here >= 0.0 {
            keep(vertex);
        }
        if (here >= 0.0) != (there >= 0.0) {
            // Always from the vertex inside to the one outside, so that both triangles of an edge get the same point.
            let (from, to, a, b) = if here >= 0.0 {
                (vertex, next, here, there)
            } else {
                (next, vertex, there, here)
            };
            let t = a / (a - b);
            keep(Vertex {
                point: from.point + (to.point - from.point) * t,
                depth: from.depth + (to.depth - from.depth) * t,
            });
        }
    }
    if len < 3 { (kept, 0) } else { (kept, len) }
}

/// Pixels to the nearest 1/256 pixel; halves go up, so that a shift by whole pixels shifts the result.
fn snap(pixels: f64) -> i32 {
    (pixels * 256.0 + 0.5).floor() as i32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::components::{Camera, Viewpoint};

    fn view(projection: Projection, size: [usize; 2]) -> View {
        let camera = Camera {
            target: DVec3::ZERO,
            up: DVec3::Y,
            fov: 90.0,
            height: 20.0,
            near: Some(1.0),
        };
        let viewpoint = Viewpoint {
            position: DVec3::new(0.0, 0.0, 10.0),
            camera,
        };
        View {
            size,
            viewpoint,
            projection,
            background: DVec3::ZERO,
            shading: None,
            tolerance: 0.0,
        }
    }

    fn project_at(position: DVec3, size: DVec3, view: &View) -> Projected {
        let mut projected = Projected::default();
        let transform = Transform {
            position,
            rotation: DVec3::ZERO,
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
    fn a_known_corner_falls_on_a_known_pixel_in_perspective() {
        // The eye at z = 10 looks along -z with 90 degrees over 200 rows: at distance d, 1 unit is 100 / d pixels.
        // Corner (1, 2, 5) is 5 away: 20 and 40 pixels from the centre (150, 100), that is (170, 60).
        let view = view(Projection::Perspective, [300, 200]);
        let projected = project_at(DVec3::new(0.0, 0.0, 4.0), DVec3::new(2.0, 4.0, 2.0), &view);
        assert_eq!(projected.seen[7], DVec3::new(1.0, 2.0, 5.0));
        let lens = Lens::new(&view);
        let [x, y] = lens.pixel(lens.homogeneous(projected.seen[7]));
        assert!(
            (x - 170.0).abs() < 1e-9 && (y - 60.0).abs() < 1e-9,
            "{x} {y}"
        );
    }

    #[test]
    fn a_known_corner_falls_on_a_known_pixel_in_orthographic_projection() {
        // 20 units over 200 rows: 10 pixels a unit at any depth. Corner (1, 2) is at (150 + 10, 100 - 20).
        let view = view(Projection::Orthographic, [300, 200]);
        let projected = project_at(DVec3::new(0.0, 0.0, 4.0), DVec3::new(2.0, 4.0, 2.0), &view);
        // Face +z is 4 5 7 6: its first triangle is 4 5 7.
        assert_eq!(
            projected.polygons[8].vertices(),
            [
                [140 * 256, 120 * 256],
                [160 * 256, 120 * 256],
                [160 * 256, 80 * 256]
            ]
        );
    }

    #[test]
    fn only_faces_towards_the_eye_are_drawn() {
        for (projection, position, drawn) in [
            (Projection::Perspective, DVec3::ZERO, vec![8, 9]),
            (
                Projection::Orthographic,
                DVec3::new(-5.0, 5.0, 0.0),
                vec![8, 9],
            ),
            (
                Projection::Perspective,
                DVec3::new(-5.0, 0.0, 0.0),
                vec![0, 1, 8, 9],
            ),
            (
                Projection::Perspective,
                DVec3::new(0.0, -5.0, 0.0),
                vec![4, 5, 8, 9],
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
    fn the_near_plane_cuts_one_two_or_no_corners_off_a_triangle() {
        let lens = Lens::new(&view(Projection::Perspective, [300, 200]));
        let corner = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
        let (far, near) = (4.0, 0.5);
        assert_eq!(
            clip(
                [
                    corner(0.0, 0.0, far),
                    corner(1.0, 0.0, far),
                    corner(0.0, 1.0, far)
                ],
                &lens
            )
            .len,
            3
        );
        assert_eq!(
            clip(
                [
                    corner(0.0, 0.0, near),
                    corner(1.0, 0.0, far),
                    corner(0.0, 1.0, far)
                ],
                &lens
            )
            .len,
            4
        );
        assert_eq!(
            clip(
                [
                    corner(0.0, 0.0, near),
                    corner(1.0, 0.0, near),
                    corner(0.0, 1.0, far)
                ],
                &lens
            )
            .len,
            3
        );
        assert_eq!(
            clip(
                [
                    corner(0.0, 0.0, near),
                    corner(1.0, 0.0, near),
                    corner(0.0, 1.0, near)
                ],
                &lens
            )
            .len,
            0
        );
        // Exactly on the plane is inside.
        assert_eq!(
            clip(
                [
                    corner(0.0, 0.0, 1.0),
                    corner(1.0, 0.0, far),
                    corner(0.0, 1.0, far)
                ],
                &lens
            )
            .len,
            3
        );
        // Behind the eye: depth -4 to 4 meets the near plane at depth 1, where x = 0.625 is 62.5 pixels right.
        let behind = clip(
            [
                corner(0.0, 0.0, -4.0),
                corner(1.0, 0.0, 4.0),
                corner(0.0, 1.0, 4.0),
            ],
            &lens,
        );
        assert!(
            behind
                .vertices()
                .contains(&[(150 * 256) + 16000, 100 * 256]),
            "{behind:?}"
        );
    }

    #[test]
    fn a_clipped_edge_is_the_same_for_both_its_triangles() {
        let lens = Lens::new(&view(Projection::Perspective, [300, 200]));
        let a = DVec3::new(-1.3, 0.7, 0.3);
        let b = DVec3::new(2.1, -0.9, 17.7);
        let cuts = |polygon: Polygon| polygon.vertices().to_vec();
        let one = cuts(clip([a, b, DVec3::new(3.0, 3.0, 5.0)], &lens));
        let other = cuts(clip([b, a, DVec3::new(-3.0, -3.0, 5.0)], &lens));
        assert_eq!(
            one.iter().filter(|vertex| other.contains(vertex)).count(),
            2,
            "{one:?} {other:?}"
        );
    }

    #[test]
    fn polygons_far_beyond_the_picture_stay_in_the_guard_band() {
        let lens = Lens::new(&view(Projection::Perspective, [300, 200]));
        let polygon = clip(
            [
                DVec3::new(-1e80, -1e80, 2.0),
                DVec3::new(1e80, -1e80, 2.0),
                DVec3::new(0.0, 1e80, 2.0),
            ],
            &lens,
        );
        assert!(polygon.len >= 3);
        assert!(
            polygon
                .vertices()
                .iter()
                .flatten()
                .all(|&coordinate| i64::from(coordinate).abs() < 1 << 30)
        );
    }

    #[test]
    fn snapping_rounds_to_the_nearest_and_halves_up() {
        assert_eq!(
            [0.0, 1.0, 0.5 / 256.0, 0.49 / 256.0, -0.5 / 256.0, -1.0].map(snap),
            [0, 256, 1, 0, 0, -256]
        );
    }
}
