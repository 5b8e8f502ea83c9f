//! The number types of the reference, and vectors of three numbers. f64 and f32 hold one rounded value, an interval
//! encloses the exact one.
//!
//! A comparison of an interval that holds values of both answers is undecided (`None`).

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use glam::DVec3;

/// A number type of the reference. The default methods suit a type that holds one value.
pub trait Real:
    Copy
    + Send
    + Sync
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// A number of the scene; f32 rounds it to nearest.
    fn of(value: f64) -> Self;

    /// The least and the largest value enclosed; a float is both.
    fn endpoints(self) -> [f64; 2];

    /// The order of the number to 0, or `None` if it is undecided. An interval is decided if all of it is farther than
    /// `margin` from 0, or if `margin` is 0 and it is exactly 0. A float ignores the margin.
    fn sign(self, margin: f64) -> Option<Ordering>;

    /// Whether the gate of a specular light with this n.l is open. For a tied gate the result is `if_tied`.
    fn gate(self, _if_tied: bool) -> Option<bool> {
        Some(self.sign(0.0) == Some(Ordering::Greater))
    }

    /// Whether a gate with this n.l is tied: an interval within 1e-6 of 0. A float never is.
    fn is_tied(self) -> bool {
        false
    }

    /// The square, at least 0.
    fn square(self) -> Self {
        self * self
    }

    /// The square root.
    fn sqrt(self) -> Self;

    /// The larger of two numbers.
    fn max(self, other: Self) -> Self;

    /// The smaller of two numbers.
    fn min(self, other: Self) -> Self;

    /// Sine and cosine of an angle in degrees, -90..=90.
    fn sin_cos(degrees: f64) -> [Self; 2];

    /// The number, in 0..=1, to the power of `exponent`, in 0..=4e6. 0^0 is 1.
    fn power(self, exponent: f64) -> Self;

    /// The common value of two expressions: the intersection of their enclosures; of floats the first.
    fn both(self, _other: Self) -> Self {
        self
    }

    /// One of two values: the hull of their enclosures; of floats the first.
    fn either(self, _other: Self) -> Self {
        self
    }
}

/// Implements [`Real`] for a float type, whose operations round to nearest.
macro_rules! float {
    ($float:ident) => {
        impl Real for $float {
            fn of(value: f64) -> Self {
                value as $float
            }

            fn endpoints(self) -> [f64; 2] {
                [self.into(); 2]
            }

            fn sign(self, _margin: f64) -> Option<Ordering> {
                self.partial_cmp(&0.0)
            }

            fn sqrt(self) -> Self {
                $float::sqrt(self)
            }

            fn max(self, other: Self) -> Self {
                $float::max(self, other)
            }

            fn min(self, other: Self) -> Self {
                $float::min(self, other)
            }

            fn sin_cos(degrees: f64) -> [Self; 2] {
                (degrees as $float).to_radians().sin_cos().into()
            }

            fn power(self, exponent: f64) -> Self {
                self.powf(exponent as $float)
            }
        }
    };
}

float!(f64);
float!(f32);

/// x, y and z, or red, green and blue.
#[derive(Clone, Copy, Debug)]
pub struct RealVector<R>(pub [R; 3]);

impl<R: Real> RealVector<R> {
    /// The vector of three exact numbers.
    pub fn exact(vector: DVec3) -> Self {
        RealVector([R::of(vector.x), R::of(vector.y), R::of(vector.z)])
    }

    /// Applies `of` to each pair of components.
    pub fn zip(self, other: Self, of: impl Fn(R, R) -> R) -> Self {
        let ([x, y, z], [a, b, c]) = (self.0, other.0);
        RealVector([of(x, a), of(y, b), of(z, c)])
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
        let [x, y, z] = self.0;
        x.square() + y.square() + z.square()
    }

    /// The vector scaled to length 1; zero stays zero.
    ///
    /// The squares of very long and very short vectors overflow or underflow f64, so those vectors are scaled first.
    /// Each component is clamped to -1..=1, because an interval exceeds it where the length may be 0.
    pub fn unit(self) -> Self {
        let mut largest = 0.0_f64;
        for component in &self.0 {
            let [low, high] = component.endpoints();
            largest = largest.max(low.abs()).max(high.abs());
        }
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
        let [x, y, z] = scaled.0;
        let part = |x: R| (x / length).max(-one).min(one);
        RealVector([part(x), part(y), part(z)])
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
        let [x, y, z] = self.0;
        RealVector([-x, -y, -z])
    }
}

impl<R: Real> Mul<R> for RealVector<R> {
    type Output = Self;
    fn mul(self, factor: R) -> Self {
        let [x, y, z] = self.0;
        RealVector([x * factor, y * factor, z * factor])
    }
}

#[cfg(test)]
mod tests {
    use super::super::interval::Interval;
    use super::*;

    #[test]
    fn a_unit_vector_is_as_exact_at_any_length() {
        for size in [1e-300, 1e-200, 1.0, 1e200, 1e300] {
            let vector = DVec3::new(2.0, -1.0, 2.0) * size;
            let float = RealVector::<f64>::exact(vector).unit();
            let interval = RealVector::<Interval>::exact(vector).unit();
            for (axis, expected) in [2.0, -1.0, 2.0].map(|it| it / 3.0).into_iter().enumerate() {
                let ends = interval.0[axis].endpoints();
                for found in [float.0[axis], ends[0], ends[1]] {
                    assert!((found - expected).abs() < 1e-15, "{found} at {size}");
                }
            }
        }
        // A vector of any direction.
        let around = Interval::of(-1.0).either(Interval::of(1.0));
        assert_eq!(
            RealVector([around; 3]).unit().0.map(Real::endpoints),
            [[-1.0, 1.0]; 3]
        );
    }
}
