//! The number types of the reference: f64 and f32 hold one rounded value, an interval encloses the exact one.
//!
//! A comparison of an interval that holds values of both answers is undecided (`None`). No caller takes undecided for
//! no.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number type of the reference. The default methods are those of a type that holds one value.
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

    /// Whether the gate of a specular light with this n.l is open. For a tied gate the result is `tied`.
    fn gate(self, _tied: bool) -> Option<bool> {
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

    /// The number, in 0..=1, to the power of `exponent`, in 0..=1e6. 0^0 is 1.
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
