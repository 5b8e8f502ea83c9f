//! The side of an edge on the screen that a pixel centre is on.
//!
//! In f64 a centre exactly on the edge belongs to the side on the right, or below if the edge is horizontal (the
//! top-left rule). An interval near the edge is undecided.

use std::cmp::Ordering;

use super::real::Real;
use super::sight::Place;

/// A pixel centre within this distance of an edge, in pixels, may show either side: snapping moves corners by up to
/// 0.003 pixel.
pub const EDGE: f64 = 0.01;

/// Faces touch if there is less room than this between them, in pixels. Rounding of positions in f64 leaves far less.
const ROOM: f64 = 1e-4;

/// The places along an edge, in shares of their range. They are not symmetrical, because another edge may cross in the
/// middle.
const ALONG: [f64; 5] = [-0.9, -0.5, -0.1, 0.3, 0.7];

/// An edge function: affine in the pixel's offset from the picture's centre, right and down, and 0 on the edge.
pub struct EdgeFunction<R> {
    at_centre: R,
    right: R,
    down: R,
    /// The length of the gradient, per pixel. Nothing is divided by it, because it may be 0: a face parallel to the picture
    /// has the same distance from the near plane at every pixel.
    gradient: R,
}

impl<R: Real> EdgeFunction<R> {
    /// The function with this value at the picture's centre and these changes per pixel right and down.
    pub fn new(at_centre: R, [right, down]: [R; 2]) -> Self {
        EdgeFunction {
            at_centre,
            right,
            down,
            gradient: hypot([right, down]),
        }
    }

    /// The function at a place.
    fn at(&self, [right, down]: [f64; 2]) -> R {
        self.at_centre + self.right * R::of(right) + self.down * R::of(down)
    }

    /// Places within about [`EDGE`] pixels of `centre`, if the edge is that near: [`ROOM`] pixels from the edge on both sides,
    /// and as far from the parallel through the centre.
    pub fn places(&self, centre: Place) -> impl Iterator<Item = Place> {
        let middle = |number: R| {
            let [least, largest] = number.endpoints();
            least.midpoint(largest)
        };
        let gradient = middle(self.gradient);
        let [distance, right, down] =
            [self.at(centre.offset), self.right, self.down].map(|it| middle(it) / gradient);
        let count = if self.side(centre).is_none() { 4 } else { 0 };
        let steps = [ROOM, ROOM - distance, -ROOM, -ROOM - distance];
        steps.into_iter().take(count).flat_map(move |across| {
            let reach = (EDGE * EDGE - across * across).max(0.0).sqrt();
            ALONG.map(|share| {
                let [x, y] = centre.offset;
                let along = share * reach;
                let offset = [
                    x + across * right - along * down,
                    y + across * down + along * right,
                ];
                Place {
                    offset,
                    margin: 0.0,
                }
            })
        })
    }

    /// Whether a place is on the positive side.
    ///
    /// A place on the edge belongs to the side on the right, or below if the edge is horizontal.
    pub fn side(&self, place: Place) -> Option<bool> {
        let [_, gradient] = self.gradient.endpoints();
        let order = self.at(place.offset).sign(place.margin * gradient)?;
        if order != Ordering::Equal {
            return Some(order == Ordering::Greater);
        }
        match self.right.sign(0.0)? {
            Ordering::Equal => Some(self.down.sign(0.0)? != Ordering::Less),
            order => Some(order == Ordering::Greater),
        }
    }
}

/// The length of a vector in a plane.
pub fn hypot<R: Real>([x, y]: [R; 2]) -> R {
    (x.square() + y.square()).sqrt()
}

/// Whether a place is on the positive side of all edges.
pub fn inside<'a, R: Real + 'a>(
    edges: impl Iterator<Item = &'a EdgeFunction<R>>,
    place: Place,
) -> Option<bool> {
    let mut inside = Some(true);
    for edge in edges {
        match edge.side(place) {
            Some(true) => {}
            Some(false) => return Some(false),
            None => inside = None,
        }
    }
    inside
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::interval::Interval;

    #[test]
    fn places_lie_beside_a_near_edge_and_beside_the_centre_on_both_sides() {
        let centre = Place {
            offset: [0.0; 2],
            margin: EDGE,
        };
        for distance in [-0.0099, -0.005, 0.0, 0.005, 0.0099, 0.0101] {
            // The line 4 x + 3 y = 5 distance.
            let [at_centre, right, down] = [-5.0 * distance, 4.0, 3.0].map(Interval::of);
            let edge = EdgeFunction::new(at_centre, [right, down]);
            let mut sides = [0; 4];
            for Place { offset, .. } in edge.places(centre) {
                let [x, y] = offset;
                assert!(x.hypot(y) <= EDGE + ROOM, "{distance}: {offset:?}");
                let across = (4.0 * x + 3.0 * y) / 5.0;
                let beside = [distance + ROOM, distance - ROOM, ROOM, -ROOM]
                    .map(|it| (across - it).abs() < 1e-9);
                assert!(beside.contains(&true), "{distance}: {offset:?}");
                for (side, is_beside) in sides.iter_mut().zip(beside) {
                    *side += u32::from(is_beside);
                }
            }
            assert_eq!(!sides.contains(&0), distance.abs() < EDGE, "{distance}");
        }
    }
}
