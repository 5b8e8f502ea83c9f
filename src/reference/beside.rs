//! The points that a line of sight shows where it passes just outside a face, within [`edge::EDGE`] pixels of its edge.

use std::cmp::Ordering;

use super::edge;
use super::geometry::{CuboidGeometry, FacePoint, across, descent, face_axes, signed};
use super::real::{Real, RealVector};
use super::sight::Line;
use crate::components::Projection;

impl<R: Real> CuboidGeometry<R> {
    /// The points that a line just outside a face may show: its intersection with the plane, and that point clamped to
    /// the face. A line beyond the plane's horizon may show the far end of the face, or else any point of it.
    pub fn beside(&self, face: usize, line: &Line<R>) -> Vec<FacePoint<R>> {
        let turned = self.turned(face, line);
        let mut places = match descent(face, line).sign(0.0) {
            Some(Ordering::Greater) => {
                let place = self.place(face, line);
                vec![place, self.clamped(face, place.point)]
            }
            Some(_) if !turned.is_empty() => Vec::new(),
            _ => {
                let [from, to] = self.ends();
                vec![self.clamped(face, from.zip(to, R::either))]
            }
        };
        places.extend(turned);
        places
    }

    /// The far end of the face, if the line reaches it when turned towards the plane by at most [`edge::EDGE`] pixels.
    ///
    /// A line that turns towards the plane first hits it at infinity, then ever nearer. It reaches the face at the
    /// nearer of the two ends ahead.
    fn turned(&self, face: usize, line: &Line<R>) -> Vec<FacePoint<R>> {
        if self.projection == Projection::Orthographic {
            return Vec::new();
        }
        let (across, outwards) = across(face);
        let descent = descent(face, line);
        let step = edge::hypot([self.step[0].0[across], self.step[1].0[across]]);
        let end = |axis: usize| {
            let ahead = line.direction.0[axis];
            let end = self.end(
                axis,
                if ahead.sign(0.0)? == Ordering::Less {
                    -1.0
                } else {
                    1.0
                },
            );
            // 1 / t, where `direction * t` reaches the end.
            let pace = ahead / end;
            let turn = self.height(face) * pace - descent;
            let is_ahead = pace.sign(0.0)? == Ordering::Greater;
            let may_be = |number: R| number.sign(0.0) != Some(Ordering::Less);
            (is_ahead && may_be(turn) && may_be(R::of(edge::EDGE) * step - turn))
                .then_some((axis, end, pace))
        };
        let ends: Vec<_> = face_axes(across).into_iter().filter_map(end).collect();
        let is_first = |(_, _, pace): &&(usize, R, R)| {
            let mut others = ends.iter();
            others.all(|(_, _, other)| (*pace - *other).sign(0.0) != Some(Ordering::Less))
        };
        let place = |&(axis, end, pace): &(usize, R, R)| {
            let mut point = line.direction.zip(RealVector([pace; 3]), R::div);
            point.0[across] = self.end(across, outwards);
            point.0[axis] = end;
            self.clamped(face, point)
        };
        ends.iter().filter(is_first).map(place).collect()
    }

    /// The coordinates of the cuboid's lower and upper ends along all axes, relative to the eye.
    fn ends(&self) -> [RealVector<R>; 2] {
        let ends = |sign| RealVector([self.end(0, sign), self.end(1, sign), self.end(2, sign)]);
        [ends(-1.0), ends(1.0)]
    }

    /// A point clamped to the face.
    fn clamped(&self, face: usize, point: RealVector<R>) -> FacePoint<R> {
        let (axis, outwards) = across(face);
        let [from, to] = self.ends();
        let point = point.zip(from, R::max).zip(to, R::min);
        let share = self.share(face, point);
        let [u, v] = face_axes(axis);
        let order = signed(outwards, share.0[u] - share.0[v]).sign(0.0);
        FacePoint {
            point,
            share,
            to_eye: self.to_eye(point),
            is_on_first: order.map(|order| order != Ordering::Less),
        }
    }
}
