//! What rounding costs the illumination model: precision and extent of the vectors in, levels out.
//!
//! Rule: every rounding is counted once, per light and per term of the sum.

use fearless_simd::Simd;
use fearless_simd::prelude::*;

use super::U;
use super::field::{Field, MAX_RADIUS};
use super::specular::Power;

/// What rounding costs the model at one pixel, in levels. Rows of polynomials are counted in [`super::interpolation`].
///
/// A vector of length one at the middle is formed as (c + a x) + b y: c, a and b are rounded, then both products and both
/// sums, each by at most u times its size. So its direction errs by
///
/// ```text
///   delta = u (3 + 4 radius) / shortest
/// ```
/// A vector is brought to length one by five roundings: half of three for its square, a root, a quotient, a product. n.l
/// errs by the delta of n and of l, and by twelve roundings: those of n, three of the product, three of the length of l,
/// one more. |r - o| errs by twice the delta of n, those of l and o, and 50 roundings: 2 n.l n, of size two, by twice
/// those of n.l, n and a product; l and o by five each; and two differences of size at most three. s^rho errs by what that
/// and four roundings of 1 - s make of it, and by the power's own error.
///
/// The vectors at the middle are taken as exact: f64 forms them for the whole square alike, so that no row and no
/// column sees another vector.
#[derive(Clone, Copy, Debug)]
pub struct Rounding {
    /// Unit round-off.
    unit: f64,
    /// Direction errors of n and o.
    normal: f64,
    eye: f64,
    /// Levels that err so far, and the terms that were summed.
    error: f64,
    largest: f64,
    terms: f64,
}

impl Rounding {
    /// For numbers of a unit round-off, the normal's and the eye's [`Extent`], and a sum that starts with `ambient` levels.
    pub fn new(unit: f64, [normal, eye]: [Extent; 2], ambient: f64) -> Self {
        Rounding {
            unit,
            normal: direction(unit, normal),
            eye: direction(unit, eye),
            error: 0.0,
            largest: ambient,
            terms: 1.0,
        }
    }

    /// Adds a light's diffuse term of at most so many levels.
    pub fn diffuse(&mut self, light: Extent, levels: f64) {
        self.error += levels * self.cosine(light);
        self.count(levels);
    }

    /// What n.l errs by.
    pub fn cosine(&self, light: Extent) -> f64 {
        self.normal + direction(self.unit, light) + 12.0 * self.unit
    }

    /// Adds a light's specular term of at most so many levels.
    pub fn specular(&mut self, light: Extent, levels: f64, power: &Power) {
        let apart = 2.0 * self.normal + direction(self.unit, light) + self.eye + 50.0 * self.unit;
        self.error += levels * (power.moved(apart, self.unit) + power.error);
        self.count(levels);
    }

    fn count(&mut self, levels: f64) {
        self.largest += levels;
        self.terms += 1.0;
    }

    /// A bound, in levels: each term's coefficient, product and sum are rounded at the size of the largest sum there can
    /// be; the result once to f32, whose display may be that of the next float.
    pub fn levels(&self) -> f64 {
        self.error + self.largest * (self.unit * (2.0 + self.terms) + 3.0 * U)
    }
}

/// How far a vector of length one at the middle of a square gets from there, and how short it gets.
#[derive(Clone, Copy, Debug)]
pub struct Extent {
    pub radius: f64,
    pub shortest: f64,
}

impl Extent {
    /// That of any vector that nodes are sampled of.
    pub const CALM: Self = Extent {
        radius: MAX_RADIUS,
        shortest: 1.0 - MAX_RADIUS,
    };
}

impl<S: Simd> From<&Field<S>> for Extent {
    fn from(field: &Field<S>) -> Self {
        Extent {
            radius: field.radius.as_array()[0],
            shortest: field.shortest.as_array()[0],
        }
    }
}

/// Direction error of an interpolated vector.
fn direction(unit: f64, Extent { radius, shortest }: Extent) -> f64 {
    if shortest > 0.0 {
        unit * (3.0 + 4.0 * radius) / shortest
    } else {
        f64::INFINITY
    }
}
