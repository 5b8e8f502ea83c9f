//! The points that a line of sight shows where it passes just outside a face, within [`edge::EDGE`] pixels of its edge.

use std::cmp::Ordering;

use super::edge;
use super::geometry::{CuboidGeometry, FacePoint, across, along, descent, signed};
use super::real::Real;
use super::sight::Line;
use super::vector::RealVector;
use crate::components::Projection;

impl<R: Real> CuboidGeometry<R> {
    /// The points that a line just outside a face may show: its intersection with the plane, and that point clamped to
    /// the face. A line beyond the plane's horizon may show the far end of the face, or else any point of it.
    pub fn beside(&self, face: usize, line: &Line<R>) -> Vec<FacePoint<R>> {
        let far_end = self.far_end(face, line);
        let mut places = match descent(face, line).sign(0.0) {
            Some(Ordering::Greater) => {
                let place = self.place(face, line);
                vec![place, self.held(face, place.point)]
            }
            Some(_) if far_end.is_some() => Vec::new(),
            _ => {
                let [from, to] = self.ends();
                vec![self.held(face, from.zip(to, R::either))]
            }
        };
        places.extend(far_end);
        places
    }

    /// The far end of the face, if the line reaches it when turned towards the plane by at most [`edge::EDGE`] pixels.
    ///
    /// A line that turns towards the plane first hits it at infinity, then ever nearer. It reaches the face where it
    /// leaves it along one of its two axes, whichever is nearer.
    fn far_end(&self, face: usize, line: &Line<R>) -> Option<FacePoint<R>> {
        if self.projection == Projection::Orthographic {
            return None;
        }
        let (across, outwards) = across(face);
        // 1 / t, where `along * t` leaves the face along an axis.
        let paces = along(across).map(|axis| {
            let ahead = line.along.0[axis];
            let [from, to] = [-1.0, 1.0].map(|sign| ahead / self.end(axis, sign));
            match ahead.sign(0.0) {
                Some(Ordering::Less) => from,
                Some(Ordering::Equal) => ahead,
                Some(Ordering::Greater) => to,
                None => from.either(to),
            }
        });
        let pace = paces[0].max(paces[1]);
        let turn = self.height(face) * pace - descent(face, line);
        let steps = self.step.map(|step| step.0[across]);
        let near = RealVector([steps[0], steps[1], R::of(0.0)])
            .length_squared()
            .sqrt();
        let may_be = |number: R| number.sign(0.0) != Some(Ordering::Less);
        let is_reached = pace.sign(0.0) == Some(Ordering::Greater)
            && may_be(turn)
            && may_be(R::of(edge::EDGE) * near - turn);
        let mut point = line.along.zip(RealVector([pace; 3]), R::div);
        point.0[across] = self.end(across, outwards);
        is_reached.then(|| self.held(face, point))
    }

    /// The coordinates of the cuboid's lower and upper ends along all axes, relative to the eye.
    fn ends(&self) -> [RealVector<R>; 2] {
        [-1.0, 1.0].map(|sign| RealVector([0, 1, 2].map(|axis| self.end(axis, sign))))
    }

    /// A point clamped to the face.
    fn held(&self, face: usize, point: RealVector<R>) -> FacePoint<R> {
        let (axis, outwards) = across(face);
        let [from, to] = self.ends();
        let point = point.zip(from, R::max).zip(to, R::min);
        let share = self.share(face, point);
        let [u, v] = along(axis).map(|axis| share.0[axis]);
        let order = signed(outwards, u - v).sign(0.0);
        FacePoint {
            point,
            share,
            to_eye: self.to_eye(point),
            is_on_first: order.map(|order| order != Ordering::Less),
        }
    }
}
