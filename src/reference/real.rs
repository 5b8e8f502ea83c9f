//! The numbers that the formula is evaluated in: f64 and f32 give one value, intervals enclose every value that exact
//! arithmetic could give.
//!
//! Rule: an interval that straddles a bound is undecided, and nothing takes "undecided" for "no".

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number of the formula; what is not said of a type is that of one that stands for one value.
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
    /// A number of the scene: exact, or in f32 the nearest.
    fn of(value: f64) -> Self;

    /// The least and the largest value that it can stand for.
    fn endpoints(self) -> [f64; 2];

    /// Its order to 0; `None` where that is undecided. An interval is also undecided unless all of it is farther than `margin`
    /// from 0; without a margin, 0 is decided too.
    fn sign(self, margin: f64) -> Option<Ordering>;

    /// Whether a specular light with this n.l is seen. An interval within 1e-6 of 0 is open if `tied` says so.
    fn gate(self, _tied: bool) -> Option<bool> {
        Some(self.sign(0.0) == Some(Ordering::Greater))
    }

    /// Whether the gate is tied.
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

    /// To the power of `exponent`, 0..=1e6; of a number in 0..=1. 0^0 is 1.
    fn power(self, exponent: f64) -> Self;

    /// A number that two expressions give: what both enclose.
    fn both(self, _other: Self) -> Self {
        self
    }

    /// A number that is one of two: what encloses either.
    fn either(self, _other: Self) -> Self {
        self
    }
}

/// Rounds every operation to the nearest number of the type.
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
