//! A cuboid in; the columns and rows of the picture that it can be seen in out.
//!
//! Rule: its corners are projected in intervals, so no pixel that may show it is left out.

use std::cmp::Ordering;
use std::ops::Range;

use super::super::interval::Interval;
use super::super::real::Real;
use super::super::vector::Vector;
use super::{Sight, own_axes};
use crate::components::{Mesh, Projection, Transform};

impl Sight<Interval> {
    /// The columns and rows that a cuboid can be seen in.
    pub fn bounds(&self, transform: &Transform, mesh: &Mesh) -> [Range<usize>; 2] {
        let axes = own_axes(transform);
        let centre = Vector::exact(transform.position) - Vector::exact(self.eye);
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
            let places = seen.map(|point| {
                let place = if is_perspective {
                    point[axis] / point[2]
                } else {
                    point[axis]
                };
                (place / self.pitch).endpoints()
            });
            let [mut least, mut largest] = places[0];
            for [low, high] in places {
                (least, largest) = (least.min(low), largest.max(high));
            }
            if axis == 1 {
                (least, largest) = (-largest, -least);
            }
            let middle = self.size[axis] as f64 / 2.0;
            // One pixel more for edges; the conversion to integers saturates.
            let end = ((middle + largest + 2.0) as usize).min(self.size[axis]);
            ((middle + least - 1.0) as usize).min(end)..end
        })
    }
}
