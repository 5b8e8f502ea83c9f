//! Clips a face of a cuboid to the view frustum, and projects and snaps the polygon that remains.
//!
//! ```text
//!      d-----c                 An edge line is given by a point p and a direction d. A plane cuts it at p + t d where
//!      |     |    plane        plane(p) + t (normal . d) = 0. The coordinates are along the cuboid's axes, so the middle of
//!   ---*-----*-------          an edge is exact. The point p is the point of the line nearest to the eye. Then the rounding
//!      |     |                 error of the cut * is relative to its distance from the eye, not to the length of
//!      a-----b                 the edge.
//! ```
//!
//! The two faces of an edge get the same point bit for bit.

use glam::{DMat3, DVec3};

use crate::components::{Lens, Polygon, Projection, length, unit};

/// Polygons are clipped to a square round the picture's centre. This is half its side, in pixels. In pictures of at most 16384
/// pixels a side the edge functions of rasterization then stay below 2^62.
const GUARD_BAND: f64 = 2_097_152.0;

/// The rounding error of the sideways position of a visible point, relative to its depth: products and sums of three f64. If the
/// guard band is narrower than that, one of its sides could cut off all that the opposite side left.
const SIDEWAYS_ERROR: f64 = 8.0 * f64::EPSILON;

/// The view frustum of a lens, in coordinates along the axes of one cuboid, relative to the eye.
pub struct Frustum<'a> {
    lens: &'a Lens,
    /// From those coordinates to right, up and forward.
    to_camera: DMat3,
    /// The cuboid's centre.
    centre: DVec3,
    /// The near plane and the four sides of the guard band.
    planes: [HalfSpace; 5],
}

/// The points where `normal . place + offset` is not negative.
#[derive(Clone, Copy)]
struct HalfSpace {
    normal: DVec3,
    offset: f64,
}

/// A line segment or a whole line on a face.
#[derive(Clone, Copy)]
struct EdgeLine {
    /// Its point nearest to the eye, up to rounding.
    nearest: DVec3,
    along: DVec3,
    /// The multiples of `along` at which it starts and ends.
    ends: [f64; 2],
}

impl<'a> Frustum<'a> {
    /// For a cuboid with these axes and this centre relative to the eye.
    pub fn new(lens: &'a Lens, axes: DMat3, centre: DVec3) -> Self {
        let [right, up, forward] = lens.axes.map(|axis| axes.transpose() * axis);
        let reach = GUARD_BAND * lens.pitch;
        let near = HalfSpace {
            normal: forward,
            offset: -lens.near,
        };
        // Aside at most `reach` times w, which is the depth in perspective and one in orthographic projection.
        let (slope, offset) = match lens.projection {
            Projection::Perspective => (reach, 0.0),
            Projection::Orthographic => (0.0, reach),
        };
        let side = |aside: DVec3| HalfSpace {
            normal: forward * (slope + SIDEWAYS_ERROR) - aside,
            offset,
        };
        Frustum {
            lens,
            to_camera: DMat3::from_cols(right, up, forward).transpose(),
            centre: axes.transpose() * centre,
            planes: [near, side(right), side(-right), side(up), side(-up)],
        }
    }

    /// Whether the whole cuboid with these half edges is visible, so that nothing of it is cut: tests the corner farthest
    /// behind each plane.
    pub fn holds(&self, half: DVec3) -> bool {
        self.planes
            .iter()
            .all(|plane| plane.at(self.centre - half * plane.normal.signum()) >= 0.0)
    }

    /// The visible part of a face perpendicular to `axis`, snapped. Corners are relative to the cuboid's centre.
    pub fn clip(&self, axis: usize, corners: [DVec3; 4]) -> Polygon {
        let first = [0, 1, 2, 3].map(|index| {
            let [from, to] = [corners[index], corners[(index + 1) % 4]];
            (self.centre + from, EdgeLine::between(from, to, self.centre))
        });
        let mut vertices = [first[0]; Polygon::MAX_VERTICES];
        vertices[..4].copy_from_slice(&first);
        let mut len = 4;
        for plane in &self.planes {
            let mut places = vertices[..len].iter().map(|vertex| vertex.0);
            if !places.all(|place| plane.at(place) >= 0.0) {
                (vertices, len) = cut(&vertices[..len], axis, plane);
            }
        }
        Polygon {
            vertices: vertices.map(|(place, _)| self.snapped(self.to_camera * place)),
            len: len as u8,
        }
    }

    /// The snapped pixel of a visible point. Rasterization relies on the guard band, which rounding of large numbers may leave,
    /// so the pixel is clamped to it.
    pub fn snapped(&self, seen: DVec3) -> [i32; 2] {
        let [x, y] = self.lens.pixel(self.lens.homogeneous(seen));
        let [column, row] = self.lens.middle;
        [
            snap(x.clamp(column - GUARD_BAND, column + GUARD_BAND)),
            snap(y.clamp(row - GUARD_BAND, row + GUARD_BAND)),
        ]
    }
}

/// Cuts a convex polygon on a face with one plane (Sutherland and Hodgman 1974); a vertex on the plane is inside. A vertex
/// comes with the line of the edge to the next one.
fn cut(
    polygon: &[(DVec3, EdgeLine)],
    axis: usize,
    plane: &HalfSpace,
) -> ([(DVec3, EdgeLine); Polygon::MAX_VERTICES], usize) {
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
        let [here, there] = [vertex, next].map(|(place, _)| plane.at(place) >= 0.0);
        if here {
            keep(vertex);
        }
        if here != there {
            let place = vertex.1.meet(plane);
            let edge = if here {
                plane.on_face(axis, place[axis])
            } else {
                vertex.1
            };
            keep((place, edge));
        }
    }
    (kept, if len < 3 { 0 } else { len })
}

impl HalfSpace {
    fn at(&self, place: DVec3) -> f64 {
        self.normal.dot(place) + self.offset
    }

    /// The line in which its plane cuts the face at `at` perpendicular to `axis`.
    fn on_face(&self, axis: usize, at: f64) -> EdgeLine {
        let mut outwards = DVec3::ZERO;
        outwards[axis] = 1.0;
        let (face, along) = (outwards * at, outwards.cross(self.normal));
        let towards = along.cross(outwards);
        EdgeLine {
            nearest: face - towards * (self.at(face) / towards.length_squared()),
            along,
            ends: [f64::NEG_INFINITY, f64::INFINITY],
        }
    }
}

impl EdgeLine {
    /// From one corner of a face to another, relative to the cuboid's centre. The middle of an edge is exact, so cuts of
    /// long edges are as exact as those of short ones, and they are the same from either end.
    fn between(from: DVec3, to: DVec3, centre: DVec3) -> Self {
        let (middle, along) = (centre + (from + to) / 2.0, (to - from) / 2.0);
        let direction = unit(along);
        let times = middle.dot(direction) / length(along);
        EdgeLine {
            // The rounding error of a difference along the edge would grow with its length; that of two vector products does not.
            nearest: direction.cross(middle.cross(direction)),
            along,
            ends: [times - 1.0, times + 1.0],
        }
    }

    /// Its intersection with a plane that passes between its ends.
    fn meet(&self, plane: &HalfSpace) -> DVec3 {
        let times = -plane.at(self.nearest) / plane.normal.dot(self.along);
        // `max` and `min` also replace the NaN of 0 / 0.
        self.nearest + self.along * times.max(self.ends[0]).min(self.ends[1])
    }
}

/// Pixels to the nearest 1/256 pixel; halves go up, so that a shift by whole pixels shifts the result.
fn snap(pixels: f64) -> i32 {
    let place = pixels * 256.0 + 0.5;
    let towards_zero = place as i32;
    // `f64::floor` is a function call on x86-64 without SSE4.1.
    towards_zero - i32::from(f64::from(towards_zero) > place)
}

#[cfg(test)]
mod tests {
    use super::super::tests::view;
    use super::*;

    /// The visible part of a quadrilateral given along right, up and forward, as a face across the last axis of a cuboid.
    fn clip(corners: [DVec3; 4], lens: &Lens) -> Polygon {
        let axes = DMat3::from_cols_array_2d(&lens.axes.map(|axis| axis.to_array()));
        Frustum::new(lens, axes, DVec3::ZERO).clip(2, corners)
    }

    #[test]
    fn the_near_plane_cuts_one_to_three_or_no_corners_off_a_face() {
        let lens = Lens::new(&view(Projection::Perspective, [300, 200]));
        let face = |[first, second, third]: [f64; 3]| {
            let corners = [
                DVec3::new(0.0, 0.0, first),
                DVec3::new(1.0, 0.0, second),
                DVec3::new(1.0, 1.0, second + third - first),
                DVec3::new(0.0, 1.0, third),
            ];
            clip(corners, &lens)
        };
        let (far, near) = (4.0, 0.5);
        for (depths, corners) in [
            ([far, far, far], 4),
            ([near, far, far], 5),
            ([near, near, far], 4),
            ([near, near, near], 0),
            ([far, near, near], 3),
            // Exactly on the plane is inside.
            ([1.0, far, far], 4),
        ] {
            assert_eq!(face(depths).len, corners, "{depths:?}");
        }
        // Behind the eye: depth -4 to 4 meets the near plane at depth 1, where x = 0.625 is 62.5 pixels right.
        let behind = face([-4.0, 4.0, 4.0]);
        assert!(
            behind
                .vertices()
                .contains(&[(150 * 256) + 16000, 100 * 256]),
            "{behind:?}"
        );
    }

    #[test]
    fn a_clipped_edge_is_the_same_for_both_its_faces() {
        let lens = Lens::new(&view(Projection::Perspective, [300, 200]));
        let a = DVec3::new(-1.3, 0.7, 0.3);
        let b = DVec3::new(2.1, -0.9, 17.7);
        let cuts = |polygon: Polygon| polygon.vertices().to_vec();
        let aside = DVec3::new(3.0, 3.0, 5.0);
        let one = cuts(clip([a, b, b + aside, a + aside], &lens));
        let other = cuts(clip([b, a, a - aside, b - aside], &lens));
        assert_eq!(
            one.iter().filter(|vertex| other.contains(vertex)).count(),
            2,
            "{one:?} {other:?}"
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
