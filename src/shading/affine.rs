//! Values that are affine in a pixel's place.
//!
//! Rule: x goes right and y down, in pixels from the middle of the picture or, where that is said, of a square.

use glam::DVec3;

/// A vector that is affine in the pixel's place: `centre + dx * x + dy * y`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Affine {
    /// At the middle.
    pub centre: DVec3,
    /// Per pixel to the right.
    pub dx: DVec3,
    /// Per pixel down.
    pub dy: DVec3,
}

impl Affine {
    /// The value `x` pixels right and `y` pixels down of the middle.
    #[inline]
    pub fn at(&self, x: f64, y: f64) -> DVec3 {
        self.centre + self.dx * x + self.dy * y
    }

    /// Applies a linear form.
    pub fn measure(&self, form: impl Fn(DVec3) -> f64) -> Scalar {
        Scalar {
            centre: form(self.centre),
            dx: form(self.dx),
            dy: form(self.dy),
        }
    }

    /// Applies a linear map.
    #[must_use]
    pub fn map(&self, map: impl Fn(DVec3) -> DVec3) -> Affine {
        Affine {
            centre: map(self.centre),
            dx: map(self.dx),
            dy: map(self.dy),
        }
    }
}

/// A number that is affine in the pixel's place, as [`Affine`] is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Scalar {
    /// At the middle.
    pub centre: f64,
    /// Per pixel to the right.
    pub dx: f64,
    /// Per pixel down.
    pub dy: f64,
}

impl Scalar {
    /// The value `x` pixels right and `y` pixels down of the middle.
    #[inline]
    pub fn at(&self, x: f64, y: f64) -> f64 {
        self.centre + self.dx * x + self.dy * y
    }

    /// How far the value gets from that at the middle of a square of these half extents, in pixels.
    #[inline]
    pub fn reach(&self, [right, down]: [f64; 2]) -> f64 {
        self.dx.abs() * right + self.dy.abs() * down
    }

    /// Divided by a number.
    #[must_use]
    pub fn over(&self, divisor: f64) -> Self {
        Scalar {
            centre: self.centre / divisor,
            dx: self.dx / divisor,
            dy: self.dy / divisor,
        }
    }

    /// A vector times this.
    pub fn times(&self, vector: DVec3) -> Affine {
        Affine {
            centre: vector * self.centre,
            dx: vector * self.dx,
            dy: vector * self.dy,
        }
    }
}

impl std::ops::Add for Affine {
    type Output = Affine;

    fn add(self, other: Affine) -> Affine {
        Affine {
            centre: self.centre + other.centre,
            dx: self.dx + other.dx,
            dy: self.dy + other.dy,
        }
    }
}
