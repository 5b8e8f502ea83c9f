//! Values that are affine in a pixel's place.
//!
//! Rule: x goes right and y down, in pixels from the middle of the picture or, where that is said, of a square.

use std::ops::{Add, Mul};

use glam::DVec3;

/// A vector or a number that is affine in the pixel's place: `centre + dx * x + dy * y`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Affine<T = DVec3> {
    /// At the middle.
    pub centre: T,
    /// Per pixel to the right.
    pub dx: T,
    /// Per pixel down.
    pub dy: T,
}

impl<T: Copy + Add<Output = T> + Mul<f64, Output = T>> Affine<T> {
    /// The value `x` pixels right and `y` pixels down of the middle.
    #[inline]
    pub fn at(&self, x: f64, y: f64) -> T {
        self.centre + self.dx * x + self.dy * y
    }

    /// Applies a linear map.
    #[must_use]
    pub fn map<U>(&self, map: impl Fn(T) -> U) -> Affine<U> {
        Affine {
            centre: map(self.centre),
            dx: map(self.dx),
            dy: map(self.dy),
        }
    }
}

impl Affine<f64> {
    /// The value at the middle, and its changes per pixel to the right and down.
    pub fn terms(&self) -> [f64; 3] {
        [self.centre, self.dx, self.dy]
    }
}

impl<T: Add<Output = T>> Add for Affine<T> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Affine {
            centre: self.centre + other.centre,
            dx: self.dx + other.dx,
            dy: self.dy + other.dy,
        }
    }
}
