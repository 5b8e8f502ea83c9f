//! Values that are affine in a pixel's place, and their rows in f32.
//!
//! Rule: whoever makes one says where it is anchored: at the picture's middle or at a tile's.

use glam::DVec3;

/// A vector that is affine in the pixel's place: `centre + dx * x + dy * y`, x and y in pixels from where it is anchored.
#[derive(Clone, Copy, Debug, Default)]
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
    #[inline(always)]
    pub fn at(&self, x: f64, y: f64) -> DVec3 {
        self.centre + self.dx * x + self.dy * y
    }

    /// Applies a linear form.
    pub(super) fn measure(&self, form: impl Fn(DVec3) -> f64) -> Scalar {
        Scalar {
            centre: form(self.centre),
            dx: form(self.dx),
            dy: form(self.dy),
        }
    }

    /// Applies a linear map.
    #[inline(always)]
    #[must_use]
    pub fn map(&self, f: impl Fn(DVec3) -> DVec3) -> Affine {
        Affine {
            centre: f(self.centre),
            dx: f(self.dx),
            dy: f(self.dy),
        }
    }

    /// How far the value moves within `half` pixels of the middle at most: to one of the corners.
    #[inline(always)]
    pub fn reach(&self, half: [f64; 2]) -> f64 {
        let (right, down) = (self.dx * half[0], self.dy * half[1]);
        (right.length_squared() + down.length_squared() + 2.0 * right.dot(down).abs()).sqrt()
    }

    /// One row in f32, `y` pixels below the middle: what stands at the middle column, and the step to the right.
    #[inline(always)]
    pub fn row(&self, y: f64) -> Ramp {
        Ramp {
            middle: (self.centre + self.dy * y).as_vec3().to_array(),
            step: self.dx.as_vec3().to_array(),
        }
    }
}

/// A number that is affine in the pixel's place, as [`Affine`] is.
#[derive(Clone, Copy, Debug)]
pub struct Scalar {
    /// At the middle.
    pub centre: f64,
    /// Per pixel to the right.
    pub dx: f64,
    /// Per pixel down.
    pub dy: f64,
}

impl Scalar {
    pub(super) fn over(&self, divisor: f64) -> Self {
        Scalar {
            centre: self.centre / divisor,
            dx: self.dx / divisor,
            dy: self.dy / divisor,
        }
    }
}

/// One row of an [`Affine`] in f32.
#[derive(Clone, Copy, Debug)]
pub struct Ramp {
    middle: [f32; 3],
    step: [f32; 3],
}

impl Ramp {
    /// The value `x` pixels right of the middle column.
    #[inline(always)]
    pub fn at(&self, x: f32) -> [f32; 3] {
        [0, 1, 2].map(|axis| self.middle[axis] + self.step[axis] * x)
    }
}
