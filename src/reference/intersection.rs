//! Lines of sight through pixel centres in; the triangle each meets, where on it and how far away, out.
//!
//! All of it happens in the camera's coordinates (right, up, depth). The ray of a pixel passes
//! `(offset + slope * depth, depth)`, so taking `offset + slope * depth` from every corner turns the ray into the axis
//! of depth, and whether the axis passes a triangle is a question in two dimensions (Woop, Benthin and Wald 2013,
//! "Watertight Ray/Triangle Intersection"):
//!
//! ```text
//!          c
//!         / \           areas  bc = b x c,  ca = c x a,  ab = a x b  of the triangles with the ray's point *
//!        / *  \         all >= 0: met, from the front;  bc : ca : ab are the weights of a, b, c at the hit
//!       a------b
//! ```
//!
//! Rule: two triangles compute the area at their common edge from the same numbers, with opposite sign, so a ray
//! passes between them nowhere and never meets both: one exactly on the edge belongs to the triangle to its right, or
//! below it if the edge is level (the top-left rule).

use std::ops::Range;

use glam::{DMat3, DVec2, DVec3};

use crate::components::{Mesh, Projection, TRIANGLES, Transform, View};

/// The lines of sight of a whole picture.
pub struct Rays {
    /// The eye, in world units.
    pub eye: DVec3,
    /// From world directions to right, up and depth.
    to_camera: DMat3,
    /// Distance of the near plane, in world units.
    near: f64,
    projection: Projection,
    /// Width and height in pixels.
    size: [usize; 2],
    /// From the picture's centre to its upper edge: as a slope in perspective, in world units if orthographic.
    half_height: f64,
}

/// One line of sight: the points `(offset + slope * depth, depth)` in camera coordinates.
pub struct Ray {
    /// World units.
    offset: DVec2,
    /// Dimensionless.
    slope: DVec2,
}

/// Where a ray meets a cuboid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The triangle's place in [`TRIANGLES`].
    pub triangle: usize,
    /// The weights of its corners at the point met: each 0..=1, together 1.
    pub weights: [f64; 3],
    /// Distance along the view direction, in world units.
    pub depth: f64,
}

/// A cuboid as rays meet it.
pub struct Solid {
    /// (right, up, depth) from the eye, in multiples of `scale`.
    corners: [DVec3; 8],
    /// A power of two near the cuboid's size, in world units; scaling by it is exact.
    scale: f64,
    /// Distance of the near plane, in multiples of `scale`.
    near: f64,
    projection: Projection,
    /// The only columns of the picture it can be met in.
    pub columns: Range<usize>,
    /// The only rows of the picture it can be met in.
    pub rows: Range<usize>,
}

impl Rays {
    /// The lines of sight that `view` asks for.
    pub fn of(view: &View) -> Self {
        let [right, up, forward] = view.viewpoint.axes();
        let camera = &view.viewpoint.camera;
        Rays {
            eye: view.viewpoint.position,
            to_camera: DMat3::from_cols(right, up, forward).transpose(),
            near: view.viewpoint.near(),
            projection: view.projection,
            size: view.size,
            half_height: match view.projection {
                Projection::Perspective => (camera.fov / 2.0).to_radians().tan(),
                Projection::Orthographic => camera.height / 2.0,
            },
        }
    }

    /// The view direction, a unit vector in world space.
    pub fn forward(&self) -> DVec3 {
        self.to_camera.row(2)
    }

    /// The line of sight through the centre of pixel (`x`, `y`).
    pub fn through(&self, x: usize, y: usize) -> Ray {
        let [width, height] = self.size.map(|pixels| pixels as f64);
        let from_centre = DVec2::new((2 * x + 1) as f64 - width, height - (2 * y + 1) as f64);
        let place = from_centre / height * self.half_height;
        match self.projection {
            Projection::Perspective => Ray {
                offset: DVec2::ZERO,
                slope: place,
            },
            Projection::Orthographic => Ray {
                offset: place,
                slope: DVec2::ZERO,
            },
        }
    }

    /// Where a point in camera coordinates is seen: pixels from the picture's top left corner.
    fn pixel(&self, point: DVec3) -> DVec2 {
        let [width, height] = self.size.map(|pixels| pixels as f64);
        let place = match self.projection {
            Projection::Perspective => point.truncate() / point.z,
            Projection::Orthographic => point.truncate(),
        };
        let from_centre = place / self.half_height * height;
        DVec2::new(width + from_centre.x, height - from_centre.y) / 2.0
    }

    /// The columns and rows that points in camera coordinates can be seen in.
    fn bounds(&self, corners: &[DVec3; 8]) -> [Range<usize>; 2] {
        let [width, height] = self.size;
        let before = corners.iter().filter(|corner| corner.z < self.near).count();
        if before == corners.len() {
            return [0..0, 0..0];
        }
        if before > 0 && self.projection == Projection::Perspective {
            return [0..width, 0..height];
        }
        let pixels = corners.map(|corner| self.pixel(corner));
        let least = pixels.iter().copied().fold(DVec2::INFINITY, DVec2::min);
        let most = pixels.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
        // One pixel more on each side is beyond any rounding; the conversion to integers saturates.
        let range = |least: f64, most: f64, end: usize| {
            (least - 1.0) as usize..((most + 2.0) as usize).min(end)
        };
        [
            range(least.x, most.x, width),
            range(least.y, most.y, height),
        ]
    }
}

impl Solid {
    /// The cuboid of this place and shape, before these rays.
    pub fn new(rays: &Rays, transform: &Transform, mesh: &Mesh) -> Self {
        let axes = transform.axes();
        let centre = transform.position - rays.eye;
        let corners = mesh
            .corners
            .map(|corner| rays.to_camera * (centre + axes * corner));
        let [columns, rows] = rays.bounds(&corners);
        let scale = power_of_two(mesh.corners[0].abs().max_element());
        Solid {
            corners: corners.map(|corner| corner / scale),
            scale,
            near: rays.near / scale,
            projection: rays.projection,
            columns,
            rows,
        }
    }

    /// Where the ray enters the cuboid, unless that is before the near plane.
    pub fn hit(&self, ray: &Ray) -> Option<Hit> {
        let offset = ray.offset / self.scale;
        let around = self
            .corners
            .map(|corner| corner.truncate() - offset - ray.slope * corner.z);
        TRIANGLES
            .iter()
            .enumerate()
            .find_map(|(triangle, corners)| {
                let [a, b, c] = corners.map(usize::from);
                let opposite = [[b, c], [c, a], [a, b]];
                let areas = opposite.map(|[from, to]| around[from].perp_dot(around[to]));
                let inside = |(area, edge): (&f64, _)| {
                    *area > 0.0 || *area == 0.0 && self.keeps_edge(&around, edge)
                };
                if !areas.iter().zip(opposite).all(inside) {
                    return None;
                }
                let whole: f64 = areas.iter().sum();
                let weights = areas.map(|area| area / whole);
                let depth = weights[0] * self.corners[a].z
                    + weights[1] * self.corners[b].z
                    + weights[2] * self.corners[c].z;
                // An area of nothing has no weights, and its depth is not a number: not met.
                (depth >= self.near).then_some(Hit {
                    triangle,
                    weights,
                    depth: depth * self.scale,
                })
            })
    }

    /// Whether a ray exactly on this edge meets the triangle: it does if a ray a little to the right of it would, or,
    /// where that makes no difference, one a little below.
    fn keeps_edge(&self, around: &[DVec2; 8], [from, to]: [usize; 2]) -> bool {
        // How fast a corner moves, seen from the ray, while the ray moves; nearer corners move less.
        let [from_speed, to_speed] = match self.projection {
            Projection::Perspective => [self.corners[from].z, self.corners[to].z],
            Projection::Orthographic => [1.0, 1.0],
        };
        let rightward = around[from].y * to_speed - from_speed * around[to].y;
        let downward = around[from].x * to_speed - from_speed * around[to].x;
        rightward > 0.0 || rightward == 0.0 && downward > 0.0
    }

    /// The corners' weights in linear interpolation on the screen instead of on the triangle.
    ///
    /// A triangle with a corner nearer than the near plane has no three places on the screen: its weights stay as they
    /// are on the triangle.
    pub fn screen_weights(&self, hit: &Hit) -> [f64; 3] {
        let depths = TRIANGLES[hit.triangle].map(|corner| self.corners[usize::from(corner)].z);
        if self.projection == Projection::Orthographic
            || depths.iter().any(|depth| *depth < self.near)
        {
            return hit.weights;
        }
        // Areas shrink with both depths of their edge: bc / (zb zc) : ca / (zc za) : ab / (za zb).
        let weighed: [f64; 3] = std::array::from_fn(|i| hit.weights[i] * depths[i]);
        weighed.map(|weight| weight / weighed.iter().sum::<f64>())
    }
}

/// The largest power of two that is not above `value`, a positive normal number.
fn power_of_two(value: f64) -> f64 {
    f64::from_bits(value.to_bits() & f64::INFINITY.to_bits())
}
