//! The side of an edge on the screen that a pixel centre is on.
//!
//! In f64 a centre exactly on the edge belongs to the side on the right, or below if the edge is horizontal (the
//! top-left rule). An interval near the edge is undecided.

use std::cmp::Ordering;

use super::real::Real;

/// A pixel centre within this distance of an edge, in pixels, may show either side: snapping moves corners by up to
/// 0.003 pixel.
pub const EDGE: f64 = 0.01;

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

    /// Whether a pixel centre is on the positive side; an interval is undecided within `margin` pixels of the edge.
    ///
    /// A centre on the edge belongs to the side on the right, or below if the edge is horizontal.
    pub fn side(&self, [right, down]: [f64; 2], margin: f64) -> Option<bool> {
        let distance = self.at_centre + self.right * R::of(right) + self.down * R::of(down);
        let [_, gradient] = self.gradient.endpoints();
        let order = distance.sign(margin * gradient)?;
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

/// Whether a pixel centre is on the positive side of all edges; an interval is undecided within [`EDGE`] pixels of one.
pub fn inside<'a, R: Real + 'a>(
    edges: impl Iterator<Item = &'a EdgeFunction<R>>,
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
