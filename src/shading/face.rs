//! A face of a cuboid on the screen: everything that is interpolated over it, as affine functions of the pixel.
//!
//! A line of sight O + t d meets the plane m.P = h of a face where t = H / w, with H = m.O - h, how far the eye is in
//! front of the plane, and w = -m.d > 0. Times w, everything that is linear on the face is affine on the screen:
//!
//! ```text
//!   w (L - P) = w (L - O) - H d        w (O - P), a multiple of -d        w u, w v, where P = C + g m + u a + v b
//! ```
//! In perspective d moves from pixel to pixel and O stays, in orthographic projection O moves and d stays. Normals are
//! linear in u and v over the whole face; colours that were lit at the corners are linear over each of its triangles.
//! Both triangles have the same n, L - P and O - P.
//!
//! Everything is computed in f64 relative to the eye, so precision does not depend on the size of the cuboid. Nothing depends
//! on where the face ends, so clipping changes no value.

use glam::DVec3;

use super::affine::Affine;
use super::simd::{four, three, two};
use crate::components::{
    FACES, Lens, Polygon, Projection, WorldTransform, axes_along, length, outward_sign,
};

/// The lines of sight of a frame, anchored at the picture's middle.
#[derive(Clone, Copy, Debug, Default)]
pub struct Rays {
    pub lens: Lens,
    /// Their start from the eye, and their direction.
    start: Affine,
    direction: Affine,
    /// Towards the eye, of positive length.
    pub to_eye: Affine,
}

impl Rays {
    /// Those of a lens.
    pub fn new(lens: &Lens) -> Self {
        let [right, up, forward] = lens.axes;
        let [dx, dy] = [right * lens.pitch, up * -lens.pitch];
        let moving = |centre| Affine { centre, dx, dy };
        let still = |centre| Affine::new(centre, DVec3::ZERO, DVec3::ZERO);
        let (start, direction) = match lens.projection {
            Projection::Perspective => (still(DVec3::ZERO), moving(forward)),
            Projection::Orthographic => (moving(DVec3::ZERO), still(forward)),
        };
        Rays {
            lens: *lens,
            start,
            direction,
            to_eye: direction.map(|d| -d),
        }
    }
}

/// The plane of a face, as the lines of sight of a picture meet it.
#[derive(Clone, Copy, Debug, Default)]
pub struct Plane {
    /// The index of the face, as [`FACES`] counts.
    face: usize,
    /// The unit normal, on the side that is seen.
    outwards: DVec3,
    /// -m.d and m.O - h; see above.
    pub w: Affine<f64>,
    height: Affine<f64>,
    /// Its distance from the cuboid's centre.
    from_centre: f64,
}

impl Plane {
    /// The plane of face `index` of a cuboid, as [`FACES`] counts. `half` are half the cuboid's edges, in world units.
    pub fn new(index: usize, transform: &WorldTransform, half: DVec3, rays: &Rays) -> Self {
        let axis = index / 2;
        let outwards = transform.axes.col(axis) * outward_sign(index);
        Plane {
            face: index,
            outwards,
            w: rays.direction.map(|d| -outwards.dot(d)),
            height: Affine {
                centre: outwards.dot(-(transform.position - rays.lens.eye)) - half[axis],
                ..rays.start.map(|o| outwards.dot(o))
            },
            from_centre: half[axis],
        }
    }

    /// The height of a point over the plane; the point is counted from the cuboid's centre.
    pub fn height_of(&self, point: DVec3) -> f64 {
        self.outwards.dot(point) - self.from_centre
    }

    /// 1 / depth in perspective, minus the depth in orthographic projection: affine on the screen, and grows towards the eye.
    /// Depth is in world units along the view direction.
    pub fn depth_key(&self, projection: Projection) -> Affine<f64> {
        match projection {
            Projection::Perspective => self.w.map(|w| w / self.height.centre),
            Projection::Orthographic => self.height.map(|h| h / -self.w.centre),
        }
    }
}

/// A point that may lie outside its face by more than this share of it is clamped to it. Snapping moves the vertices that
/// decide coverage, so slivers have such points.
pub const OVERSHOOT: f64 = 1.0 / 128.0;

/// A face that is seen. Its functions are anchored at the picture's middle.
#[derive(Clone, Copy, Debug)]
pub struct Face<'a> {
    pub rays: &'a Rays,
    pub plane: Plane,
    /// u, v and 1, times w: from -1 to 1 along the face's axes.
    pub uvw: Affine,
    /// w times [`Self::diagonal_at`].
    pub diagonal: Affine<f64>,
    /// w |grad u| and w |grad v| are at most this on the face and within [`OVERSHOOT`] of it, per pixel.
    uv_gradient: f64,
    /// The face's middle from the eye, and half its edges.
    middle: DVec3,
    half_edges: [DVec3; 2],
    /// (u, v) of its corners in the order of [`FACES`].
    pub corners: [[f64; 2]; 4],
}

impl<'a> Face<'a> {
    /// The face of a cuboid in this plane. `half` are half the cuboid's edges, in world units.
    pub fn new(plane: &Plane, transform: &WorldTransform, half: DVec3, rays: &'a Rays) -> Self {
        let axis = plane.face / 2;
        let along = axes_along(plane.face);
        let centre = transform.position - rays.lens.eye;
        let face = Face {
            rays,
            plane: *plane,
            uvw: Affine::default(),
            diagonal: Affine::default(),
            uv_gradient: 0.0,
            middle: centre + plane.outwards * half[axis],
            half_edges: two!(|it| transform.axes.col(along[it]) * half[along[it]]),
            corners: four!(|corner| {
                let bits = FACES[plane.face][corner];
                two!(|it| 2.0 * f64::from(bits >> along[it] & 1) - 1.0)
            }),
        };
        let to_centre = face.towards(centre, DVec3::ZERO);
        let [u, v] = two!(|it| {
            let (direction, half_edge) = (transform.axes.col(along[it]), half[along[it]]);
            to_centre.map(|c| -direction.dot(c) / half_edge)
        });
        let w = &plane.w;
        let uvw = Affine {
            centre: DVec3::new(u.centre, v.centre, w.centre),
            dx: DVec3::new(u.dx, v.dx, w.dx),
            dy: DVec3::new(u.dy, v.dy, w.dy),
        };
        let moved =
            |u: f64, v: f64, w: f64| u.abs().max(v.abs()) + (1.0 + 2.0 * OVERSHOOT) * w.abs();
        Face {
            uvw,
            diagonal: uvw.map(|it| face.diagonal_at([it.x, it.y])),
            uv_gradient: moved(u.dx, v.dx, w.dx) + moved(u.dy, v.dy, w.dy),
            ..face
        }
    }

    /// The affine function of u and v with the given values at the corners of triangle 0 or 1; `values` are those of the
    /// face's corners. The fourth corner is not used: its value may be so large that the others would be rounded away.
    pub fn interpolate(&self, values: &[DVec3; 4], triangle: usize) -> Affine {
        let corners = three!(|corner| (2 * triangle + corner) % 4);
        let [a, b, c] = three!(|corner| values[corners[corner]]);
        let half = |axis: usize| {
            let [from, middle, to] = three!(|corner| self.corners[corners[corner]][axis]);
            (b - a) / 2.0 * ((middle - from) / 2.0) + (c - b) / 2.0 * ((to - middle) / 2.0)
        };
        Affine::new((a + c) / 2.0, half(0), half(1))
    }

    /// The value at a point of what has these values at the face's corners and is linear on each of its triangles.
    ///
    /// On an edge the weight of the corner opposite is exactly 0, so a very large value there does not round the others away.
    pub fn blend(&self, values: &[DVec3; 4], [u, v]: [f64; 2]) -> DVec3 {
        let [a, b, c, d] = *values;
        let third = if self.diagonal_at([u, v]) < 0.0 { d } else { b };
        let (least, most) = (u.min(v), u.max(v));
        (a * (1.0 - most) + third * (most - least) + c * (1.0 + least)) / 2.0
    }

    /// w times the vector to a light, in world units.
    ///
    /// The affine part of w (L - O) - H d. In perspective O and H are constant, in orthographic projection w and d are, so
    /// there are no terms of second order. Its component along the normal is w times the light's height above the face. The
    /// height is computed from the nearer of the two positions, so that a light one ulp above the face has a positive
    /// height.
    pub fn towards(&self, light_from_eye: DVec3, light_from_centre: DVec3) -> Affine {
        // The rays start at the eye, or on the plane through it, so the centre of `from` is 0.
        let (from, d) = (&self.rays.start, &self.rays.direction);
        let (outwards, w, h) = (self.plane.outwards, &self.plane.w, &self.plane.height);
        let towards = Affine {
            centre: light_from_eye * w.centre - d.centre * h.centre,
            dx: light_from_eye * w.dx - from.dx * w.centre - d.dx * h.centre - d.centre * h.dx,
            dy: light_from_eye * w.dy - from.dy * w.centre - d.dy * h.centre - d.centre * h.dy,
        };
        if length(light_from_eye) < length(light_from_centre) {
            return towards;
        }
        let above = self.plane.height_of(light_from_centre);
        let lifted = |v: DVec3, w: f64| v - outwards * outwards.dot(v) + outwards * above * w;
        Affine {
            centre: lifted(towards.centre, w.centre),
            dx: lifted(towards.dx, w.dx),
            dy: lifted(towards.dy, w.dy),
        }
    }

    /// Where w is larger than this the face is steady, that is, not a sliver: no centre of a covered pixel lies further
    /// outside it than by [`OVERSHOOT`].
    pub fn least_steady(&self) -> f64 {
        // A face is 2 wide in u and in v.
        self.uv_gradient * Polygon::SNAP / (2.0 * OVERSHOOT)
    }

    /// Whether it is steady where w is at least `least`.
    pub fn is_steady(&self, least: f64) -> bool {
        least > self.least_steady()
    }

    /// The least and the largest u and v that the pixels of a rectangle show, which is given by its least and largest x and y. All
    /// of the face if some of them may be clamped to it.
    pub fn shown_in(&self, [least, most]: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
        let mut shown = [[1.0_f64; 2], [-1.0_f64; 2]];
        // A quotient of affine functions is largest and least at corners.
        for [x, y] in [least, [most[0], least[1]], most, [least[0], most[1]]] {
            let DVec3 { x: u, y: v, z: w } = self.uvw.at(x, y);
            if !self.is_steady(w) {
                return [[-1.0; 2], [1.0; 2]];
            }
            for (axis, place) in [u / w, v / w].into_iter().enumerate() {
                shown[0][axis] = shown[0][axis].min(place).max(-1.0);
                shown[1][axis] = shown[1][axis].max(place).min(1.0);
            }
        }
        shown
    }

    /// The point (u, v) that the pixel at `x`, `y` shows, and whether it was clamped to the face. Only points beside a sliver
    /// are clamped.
    pub fn uv_at(&self, x: f64, y: f64) -> ([f64; 2], bool) {
        let DVec3 { x: u, y: v, z: w } = self.uvw.at(x, y);
        let uv = [u / w, v / w];
        let is_on = w > 0.0 && uv.iter().all(|u| u.abs() <= 1.0);
        if is_on || self.is_steady(w) {
            (uv, false)
        } else {
            (self.clamp(x, y), true)
        }
    }

    /// The point of the face that a line of sight beside it shows.
    ///
    /// In perspective u w is `foot` w + `step`, where `foot` is u of the point of the plane nearest to the eye. As the line
    /// of sight turns towards the plane, w grows and the point moves from infinity to the foot. Snapping may show a pixel
    /// whose line of sight passes beyond the far end of the face, or misses the plane (w <= 0). Such a pixel gets the far
    /// end.
    fn clamp(&self, x: f64, y: f64) -> [f64; 2] {
        let (uvw, w) = (self.uvw.at(x, y), &self.plane.w);
        let along = self.rays.direction.at(x, y) * self.plane.height.at(x, y);
        let [u, v] = self.half_edges.map(|half| {
            let [foot, step] = [-self.middle, along].map(|v| v.dot(half) / half.length_squared());
            // w at the far end.
            (foot, step, step.abs() / (1.0 - foot * step.signum()))
        });
        let end = f64::max(u.2, v.2);
        // An edge moves by less than twice as much as a coordinate of its ends.
        let turned = 2.0 * Polygon::SNAP * w.dx.hypot(w.dy);
        // Beyond the horizon every point is infinitely far.
        let ahead = if uvw.z > 0.0 { uvw.z } else { 0.0 };
        // Never in orthographic projection: w is the same everywhere, so `turned` is 0.
        if end > ahead && end - uvw.z <= turned {
            return [u, v].map(|(foot, step, _)| (foot + step / end).clamp(-1.0, 1.0));
        }
        let on = |u: f64| if u.is_nan() { 0.0 } else { u.clamp(-1.0, 1.0) };
        [on(uvw.x / ahead), on(uvw.y / ahead)]
    }

    /// A point of the face, from the eye, in world units.
    pub fn from_eye(&self, [u, v]: [f64; 2]) -> DVec3 {
        self.middle + self.half_edges[0] * u + self.half_edges[1] * v
    }

    /// Twice the weight of the first triangle's corner that is not on the diagonal: zero on the diagonal, and below zero on
    /// the second triangle.
    pub fn diagonal_at(&self, [u, v]: [f64; 2]) -> f64 {
        let [x, y] = self.corners[1];
        x * u + y * v
    }
}
