//! Affine functions of a position: of a pixel (x to the right and y down, in pixels from the middle of the picture), of a
//! point of a face (u and v), or of a point of a square (x and y from -1 to 1 over the centres of its covered pixels).

use std::ops::{Add, Mul};

use glam::DVec3;

/// A vector or a number that is an affine function of the position: `centre + dx * x + dy * y`. On squares, `T`
/// holds the values of several.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Affine<T = DVec3> {
    /// The value at the middle.
    pub centre: T,
    /// The change per unit of x.
    pub dx: T,
    /// The change per unit of y.
    pub dy: T,
}

impl<T: Copy + Add<Output = T> + Mul<f64, Output = T>> Affine<T> {
    /// The value at a position.
    #[inline]
    pub fn at(&self, x: f64, y: f64) -> T {
        self.centre + self.dx * x + self.dy * y
    }

    /// The value at `x / w` and `y / w`, times w.
    pub fn homogeneous(&self, x: f64, y: f64, w: f64) -> T {
        self.centre * w + self.dx * x + self.dy * y
    }
}

impl<T> Affine<T> {
    /// The function with these coefficients.
    pub fn new(centre: T, dx: T, dy: T) -> Self {
        Affine { centre, dx, dy }
    }

    /// Applies a linear map.
    #[inline(always)]
    #[must_use]
    pub fn map<U>(self, map: impl Fn(T) -> U) -> Affine<U> {
        Affine::new(map(self.centre), map(self.dx), map(self.dy))
    }
}
