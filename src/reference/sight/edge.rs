//! A line on the screen and a pixel in; the side of it that the pixel's centre is on out.
//!
//! Rule: in f64 a centre exactly on the line is on the side of what lies to the right of it, or below it if it is level
//! (the top-left rule); an interval near the line is undecided.

use std::cmp::Ordering;

use super::super::real::Real;
use super::super::vector::Vector;

/// How near to an edge, in pixels, a pixel's centre may show either side: snapping moves corners by up to 0.003 pixel.
pub const EDGE: f64 = 0.01;

/// An affine function of the pixel, from the picture's centre rightwards and downwards: 0 on a line.
pub struct Edge<R> {
    at_centre: R,
    right: R,
    down: R,
    /// What a pixel away from the line adds. It is not divided by: a face that is parallel to the picture has one
    /// distance from the near plane, infinitely many pixels from it.
    pixel: R,
}

impl<R: Real> Edge<R> {
    /// A function of the pixel by its value at the picture's centre and what a pixel right and down add to it.
    pub fn new(at_centre: R, [right, down]: [R; 2]) -> Self {
        Edge {
            at_centre,
            right,
            down,
            pixel: Vector([right, down, R::of(0.0)]).length_squared().sqrt(),
        }
    }

    /// Whether a pixel's centre is on the positive side; an interval is undecided within `margin` pixels of the line.
    ///
    /// A centre on the line is on the side of what lies to the right, or below if the line is level.
    pub fn side(&self, [right, down]: [f64; 2], margin: f64) -> Option<bool> {
        let distance = self.at_centre + self.right * R::of(right) + self.down * R::of(down);
        let is_equal = |sign| sign == Some(Ordering::Equal);
        let [_, pixel] = self.pixel.endpoints();
        match distance.sign(margin * pixel)? {
            Ordering::Greater => Some(true),
            Ordering::Less => Some(false),
            Ordering::Equal if is_equal(self.right.sign(0.0)) => {
                Some(self.down.sign(0.0)? != Ordering::Less)
            }
            Ordering::Equal => Some(self.right.sign(0.0)? == Ordering::Greater),
        }
    }
}

/// Whether a pixel's centre is on the positive side of all edges; an interval is undecided within [`EDGE`] pixels of one.
pub fn inside<'a, R: Real + 'a>(
    edges: impl Iterator<Item = &'a Edge<R>>,
    pixel: [f64; 2],
) -> Option<bool> {
    let mut inside = Some(true);
    for edge in edges {
        match edge.side(pixel, EDGE) {
            Some(true) => {}
            Some(false) => return Some(false),
            None => inside = None,
        }
    }
    inside
}
