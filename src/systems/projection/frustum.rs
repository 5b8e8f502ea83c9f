//! A triangle of a cuboid in, the polygon that is in sight of it, on the screen and snapped, out.
//!
//! ```text
//!        c                     Each side is a line of the face, given by its middle and its direction. A plane meets it
//!       / \   plane            where  plane(middle) + t plane(direction) = 0.  The coordinates are the cuboid's own, so the
//!   ---*---*---------          middle of an edge is exact. From the eye, and from the point of the line that is nearest to
//!     /     \                  it, a million units of edge on either side are no larger than what is asked for: the
//!    a-------b                 point * itself, and how far it is from the near plane.
//! ```
//!
//! Rule: the two triangles of an edge cut it in the same point, bit for bit, and so do the two faces of it.

use glam::{DMat3, DVec3};

use crate::components::{Lens, Polygon, Projection, length, unit};

/// Half the side of the square, in pixels round the picture's centre, to which polygons are clipped: with it and
/// pictures of at most 16384 pixels a side, the edge functions of rasterization stay below 2^62.
const GUARD_BAND: f64 = 2_097_152.0;

/// How far rounding takes a place in sight aside, as a share of its depth: products and sums of three f64. Where the guard
/// band is narrower than that, one of its sides could cut off what the opposite one left.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// What is in sight of a lens, in the coordinates of one cuboid: along its axes, from the eye.
pub struct Frustum<'a> {
    lens: &'a Lens,
    /// From those coordinates to right, up and forward.
    to_camera: DMat3,
    /// The cuboid's centre.
    centre: DVec3,
    /// The near plane and the four sides of the guard band.
    planes: [Plane; 5],
}

/// Where `normal . place + offset` is not negative.
#[derive(Clone, Copy)]
struct Plane {
    normal: DVec3,
    offset: f64,
}

/// A straight line on a face, from about its point nearest to the eye.
#[derive(Clone, Copy)]
struct Side {
    nearest: DVec3,
    along: DVec3,
    /// How many times `along` it begins and ends.
    ends: [f64; 2],
}

/// A vertex on its way through the clipper, and the side that leads to the next one.
#[derive(Clone, Copy)]
struct Vertex {
    place: DVec3,
    side: Side,
}

impl<'a> Frustum<'a> {
    /// For a cuboid with these axes whose centre is there from the eye.
    pub fn new(lens: &'a Lens, axes: DMat3, centre: DVec3) -> Self {
        let [right, up, forward] = lens.axes.map(|axis| axes.transpose() * axis);
        let reach = GUARD_BAND * lens.pitch;
        let near = Plane {
            normal: forward,
            offset: -lens.near,
        };
        // Aside at most `reach` times w, which is the depth in perspective and one in orthographic projection.
        let (slope, offset) = match lens.projection {
            Projection::Perspective => (reach, 0.0),
            Projection::Orthographic => (0.0, reach),
        };
        let side = |aside: DVec3| Plane {
            normal: forward * (slope + ROUNDING) - aside,
            offset,
        };
        Frustum {
            lens,
            to_camera: DMat3::from_cols(right, up, forward).transpose(),
            centre: axes.transpose() * centre,
            planes: [near, side(right), side(-right), side(up), side(-up)],
        }
    }

    /// Whether all of a cuboid with these half edges is in sight, so that nothing of it is cut: whether its corner farthest
    /// behind each plane is.
    pub fn holds(&self, half: DVec3) -> bool {
        self.planes
            .iter()
            .all(|plane| plane.at(self.centre - half * plane.normal.signum()) >= 0.0)
    }

    /// The part of a triangle on a face across `axis` that is in sight, snapped; each corner is given from the cuboid's centre.
    pub fn clip(&self, axis: usize, corners: [DVec3; 3]) -> Polygon {
        let first = [0, 1, 2].map(|index| Vertex {
            place: self.centre + corners[index],
            side: Side::between(corners[index], corners[(index + 1) % 3], self.centre),
        });
        let mut vertices = [first[0]; Polygon::MAX_VERTICES];
        vertices[..3].copy_from_slice(&first);
        let mut len = 3;
        for plane in &self.planes {
            let mut places = vertices[..len].iter().map(|vertex| vertex.place);
            if !places.all(|place| plane.at(place) >= 0.0) {
                (vertices, len) = cut(&vertices[..len], axis, plane);
            }
        }
        // Rounding must not take a place before the near plane.
        let seen = |place: DVec3| {
            let seen = self.to_camera * place;
            DVec3::new(seen.x, seen.y, seen.z.max(self.lens.near))
        };
        Polygon {
            vertices: vertices.map(|vertex| self.snapped(seen(vertex.place))),
            len: len as u8,
        }
    }

    /// The snapped pixel of a place in sight. Where the numbers are so large that rounding takes a vertex out of the guard
    /// band again, it is held to it, since rasterization counts on that.
    pub fn snapped(&self, seen: DVec3) -> [i32; 2] {
        let pixel = self.lens.pixel(self.lens.homogeneous(seen));
        [0, 1].map(|axis| {
            let middle = self.lens.half[axis];
            snap(pixel[axis].clamp(middle - GUARD_BAND, middle + GUARD_BAND))
        })
    }
}

/// Cuts a convex polygon on a face with one plane (Sutherland and Hodgman 1974); a vertex on the plane is inside.
fn cut(polygon: &[Vertex], axis: usize, plane: &Plane) -> ([Vertex; Polygon::MAX_VERTICES], usize) {
    let mut kept = [polygon[0]; Polygon::MAX_VERTICES];
    let mut len = 0;
    let mut keep = |vertex| {
        // Rounding can make a plane cut a convex polygon more than twice; what is lost then is below a snap.
        if len < Polygon::MAX_VERTICES {
            kept[len] = vertex;
            len += 1;
        }
    };
    for (index, &vertex) in polygon.iter().enumerate() {
        let next = polygon[(index + 1) % polygon.len()];
        let [here, there] = [vertex, next].map(|vertex| plane.at(vertex.place) >= 0.0);
        if here {
            keep(vertex);
        }
        if here != there {
            let place = vertex.side.meet(plane);
            let side = if here {
                plane.on_face(axis, place[axis])
            } else {
                vertex.side
            };
            keep(Vertex { place, side });
        }
    }
    (kept, if len < 3 { 0 } else { len })
}

impl Plane {
    fn at(&self, place: DVec3) -> f64 {
        self.normal.dot(place) + self.offset
    }

    /// The line in which it cuts the face at `at` across `axis`.
    fn on_face(&self, axis: usize, at: f64) -> Side {
        let mut outwards = DVec3::ZERO;
        outwards[axis] = 1.0;
        let (face, along) = (outwards * at, outwards.cross(self.normal));
        let towards = along.cross(outwards);
        Side {
            nearest: face - towards * (self.at(face) / towards.length_squared()),
            along,
            ends: [f64::NEG_INFINITY, f64::INFINITY],
        }
    }
}

impl Side {
    /// From one corner of a triangle to another, given from the cuboid's centre. The middle of an edge is exact, so where a
    /// plane meets it is found as exactly on a long edge as on a short one; and it is the same from either end.
    fn between(from: DVec3, to: DVec3, centre: DVec3) -> Self {
        let (middle, along) = (centre + (from + to) / 2.0, (to - from) / 2.0);
        let direction = unit(along);
        let times = middle.dot(direction) / length(along);
        Side {
            // What two vector products leave of the middle, for a difference along a long edge would round by its length.
            nearest: direction.cross(middle.cross(direction)),
            along,
            ends: [times - 1.0, times + 1.0],
        }
    }

    /// Where it meets a plane that passes between its ends.
    fn meet(&self, plane: &Plane) -> DVec3 {
        let times = -plane.at(self.nearest) / plane.normal.dot(self.along);
        // Zero by zero is held to an end too.
        self.nearest + self.along * times.max(self.ends[0]).min(self.ends[1])
    }
}

/// Pixels to the nearest 1/256 pixel; halves go up, so that a shift by whole pixels shifts the result.
fn snap(pixels: f64) -> i32 {
    (pixels * 256.0 + 0.5).floor() as i32
}

#[cfg(test)]
mod tests {
    use super::super::tests::view;
    use super::*;

    /// The visible part of a triangle given along right, up and forward, as on a face across the last axis of a cuboid.
    fn clip(corners: [DVec3; 3], lens: &Lens) -> Polygon {
        let axes = DMat3::from_cols_array_2d(&lens.axes.map(|axis| axis.to_array()));
        Frustum::new(lens, axes, DVec3::ZERO).clip(2, corners)
    }

    #[test]
    fn the_near_plane_cuts_one_two_or_no_corners_off_a_triangle() {
        let lens = Lens::new(&view(Projection::Perspective, [300, 200]));
        let triangle = |[first, second, third]: [f64; 3]| {
            let corners = [
                DVec3::new(0.0, 0.0, first),
                DVec3::new(1.0, 0.0, second),
                DVec3::new(0.0, 1.0, third),
            ];
            clip(corners, &lens)
        };
        let (far, near) = (4.0, 0.5);
        for (depths, corners) in [
            ([far, far, far], 3),
            ([near, far, far], 4),
            ([near, near, far], 3),
            ([near, near, near], 0),
            // Exactly on the plane is inside.
            ([1.0, far, far], 3),
        ] {
            assert_eq!(triangle(depths).len, corners, "{depths:?}");
        }
        // Behind the eye: depth -4 to 4 meets the near plane at depth 1, where x = 0.625 is 62.5 pixels right.
        let behind = triangle([-4.0, 4.0, 4.0]);
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
