//! The columns and rows of the picture in which a cuboid may be visible.
//!
//! Its corners are projected in intervals, so the bounds hold every pixel that may show it.

use std::cmp::Ordering;
use std::ops::Range;

use super::interval::Interval;
use super::real::Real;
use super::sight::{Sight, own_axes};
use super::vector::RealVector;
use crate::components::{Mesh, Projection, Transform};

impl Sight<Interval> {
    /// The columns and rows in which a cuboid may be visible; all of them if a corner may be behind the eye in
    /// perspective.
    pub fn bounds(&self, transform: &Transform, mesh: &Mesh) -> [Range<usize>; 2] {
        let axes = own_axes(transform);
        let centre = RealVector::exact(transform.position) - RealVector::exact(self.eye);
        let seen = mesh.corners.map(|corner| {
            let [x, y, z] = corner.to_array().map(Interval::of);
            let from_eye = centre + axes[0] * x + axes[1] * y + axes[2] * z;
            self.axes.map(|axis| axis.dot(from_eye))
        });
        let depths = seen.map(|[_, _, depth]| depth);
        let is_before = |depth: &Interval| (*depth - self.near).sign(0.0) == Some(Ordering::Less);
        if depths.iter().all(is_before) {
            return [0..0, 0..0];
        }
        let is_behind = |depth: &Interval| depth.sign(0.0) != Some(Ordering::Greater);
        let is_perspective = self.projection == Projection::Perspective;
        if is_perspective && depths.iter().any(is_behind) {
            return self.size.map(|side| 0..side);
        }
        [0, 1].map(|axis| {
            let place = |[x, y, depth]: [Interval; 3]| {
                let place = if axis == 0 { x } else { -y };
                let place = if is_perspective { place / depth } else { place };
                place / self.pitch
            };
            let places = seen.map(place).into_iter().reduce(Interval::either);
            let [least, largest] = places.unwrap_or(Interval::ALL).endpoints();
            let middle = self.size[axis] as f64 / 2.0;
            // One more pixel on each side, for edges. The conversion to integers saturates.
            let end = ((middle + largest + 2.0) as usize).min(self.size[axis]);
            ((middle + least - 1.0) as usize).min(end)..end
        })
    }
}
