//! Vectors of three numbers of any type of the reference.

use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

use glam::DVec3;

use super::real::Real;

/// x, y and z, or red, green and blue.
#[derive(Clone, Copy, Debug)]
pub struct RealVector<R>(pub [R; 3]);

impl<R: Real> RealVector<R> {
    /// The vector of three exact numbers.
    pub fn exact(vector: DVec3) -> Self {
        RealVector(vector.to_array().map(R::of))
    }

    /// Applies `of` to each pair of components.
    pub fn zip(self, other: Self, of: impl Fn(R, R) -> R) -> Self {
        RealVector(std::array::from_fn(|i| of(self.0[i], other.0[i])))
    }

    pub fn dot(self, other: Self) -> R {
        let [x, y, z] = self.zip(other, R::mul).0;
        x + y + z
    }

    pub fn cross(self, other: Self) -> Self {
        let [a, b] = [self.0, other.0];
        RealVector([
            a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0],
        ])
    }

    pub fn length_squared(self) -> R {
        let [x, y, z] = self.0.map(R::square);
        x + y + z
    }

    /// The vector scaled to length 1; zero stays zero.
    ///
    /// The squares of very long and very short vectors overflow or underflow f64, so those vectors are scaled first.
    /// Each component is clamped to -1..=1, because an interval exceeds it where the length may be 0.
    pub fn unit(self) -> Self {
        let bounds = self.0.map(|x| x.endpoints().map(f64::abs)).concat();
        let largest = bounds.into_iter().fold(0.0, f64::max);
        let is_extreme = largest.is_finite() && !(1e-100..1e100).contains(&largest);
        let scaled = if is_extreme && largest > 0.0 {
            self * R::of(largest.recip().min(f64::MAX))
        } else {
            self
        };
        let length = scaled.length_squared().sqrt();
        if length.sign(0.0) == Some(Ordering::Equal) {
            return scaled;
        }
        let one = R::of(1.0);
        RealVector(scaled.0.map(|x| (x / length).max(-one).min(one)))
    }
}

impl RealVector<f64> {
    pub fn to_dvec3(self) -> DVec3 {
        DVec3::from_array(self.0)
    }
}

impl<R: Real> Add for RealVector<R> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.zip(other, R::add)
    }
}

impl<R: Real> Sub for RealVector<R> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.zip(other, R::sub)
    }
}

impl<R: Real> Neg for RealVector<R> {
    type Output = Self;
    fn neg(self) -> Self {
        RealVector(self.0.map(R::neg))
    }
}

impl<R: Real> Mul<R> for RealVector<R> {
    type Output = Self;
    fn mul(self, factor: R) -> Self {
        RealVector(self.0.map(|x| x * factor))
    }
}
