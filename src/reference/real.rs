//! The numbers that the formula is evaluated in: f64 gives one value, intervals enclose every value that exact
//! arithmetic could give.
//!
//! Rule: an interval that straddles a bound is undecided, and nothing takes "undecided" for "no". Intervals round
//! outwards (IEEE 1788.1, crate maryada), so the exact value of every expression lies in its interval. An operation
//! that is undefined somewhere gives no narrower interval for it: see [`Real::endpoints`].

use std::cmp::Ordering;
use std::f64::consts::PI;
use std::ops::{Add, Div, Mul, Neg, Sub};

use maryada::{EnclosureOps, Interval, IntervalOps};

/// Where |n.l| is smaller, the gate of a specular light may fall either way.
pub const GATE_TIE: f64 = 1e-6;

/// A number of the formula.
pub trait Real:
    Copy
    + Send
    + Sync
    + From<f64>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The least and the largest value that it can stand for.
    fn endpoints(self) -> [f64; 2];

    /// Its order to 0; `None` where that is undecided. An interval is also undecided unless all of it is at least `margin`
    /// from 0, or it is 0 exactly.
    fn sign(self, margin: f64) -> Option<Ordering>;

    /// Whether a specular light with this n.l is seen. An interval within [`GATE_TIE`] of 0 is open if `tied` says so.
    fn gate(self, tied: bool) -> Option<bool>;

    /// Whether the gate is tied.
    fn is_tied(self) -> bool;

    /// The square, at least 0.
    fn square(self) -> Self;

    /// The square root.
    fn sqrt(self) -> Self;

    /// The larger of two numbers.
    fn max(self, other: Self) -> Self;

    /// The smaller of two numbers.
    fn min(self, other: Self) -> Self;

    /// Radians of an angle in degrees, -90..=90.
    fn radians(degrees: f64) -> Self;

    /// The sine of an angle in radians.
    fn sin(self) -> Self;

    /// The tangent of an angle in radians.
    fn tan(self) -> Self;

    /// To the power of `exponent`, 0..=1e6; of a number in 0..=1. 0^0 is 1.
    fn power(self, exponent: f64) -> Self;

    /// A number that two expressions give: what both enclose.
    fn both(self, other: Self) -> Self;

    /// A number that is one of two: what encloses either.
    fn either(self, other: Self) -> Self;
}

impl Real for f64 {
    fn endpoints(self) -> [f64; 2] {
        [self; 2]
    }

    fn sign(self, _margin: f64) -> Option<Ordering> {
        self.partial_cmp(&0.0)
    }

    fn gate(self, _tied: bool) -> Option<bool> {
        Some(self > 0.0)
    }

    fn is_tied(self) -> bool {
        false
    }

    fn square(self) -> Self {
        self * self
    }

    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }

    fn max(self, other: Self) -> Self {
        f64::max(self, other)
    }

    fn min(self, other: Self) -> Self {
        f64::min(self, other)
    }

    fn radians(degrees: f64) -> Self {
        degrees.to_radians()
    }

    fn sin(self) -> Self {
        f64::sin(self)
    }

    fn tan(self) -> Self {
        f64::tan(self)
    }

    fn power(self, exponent: f64) -> Self {
        self.powf(exponent)
    }

    fn both(self, _other: Self) -> Self {
        self
    }

    fn either(self, _other: Self) -> Self {
        self
    }
}

impl Real for Interval {
    /// The empty interval, which 0 / 0 gives, bounds nothing: every number is possible.
    fn endpoints(self) -> [f64; 2] {
        if self.is_empty() {
            [f64::NEG_INFINITY, f64::INFINITY]
        } else {
            [self.inf(), self.sup()]
        }
    }

    fn sign(self, margin: f64) -> Option<Ordering> {
        match self.endpoints() {
            [0.0, 0.0] => Some(Ordering::Equal),
            [least, _] if least > margin => Some(Ordering::Greater),
            [_, largest] if largest < -margin => Some(Ordering::Less),
            _ => None,
        }
    }

    fn gate(self, tied: bool) -> Option<bool> {
        match self.endpoints() {
            _ if self.is_tied() => Some(tied),
            [least, _] if least > 0.0 => Some(true),
            [_, largest] if largest <= 0.0 => Some(false),
            _ => None,
        }
    }

    fn is_tied(self) -> bool {
        self.endpoints().iter().all(|bound| bound.abs() <= GATE_TIE)
    }

    fn square(self) -> Self {
        self.sqr()
    }

    fn sqrt(self) -> Self {
        EnclosureOps::sqrt(self)
    }

    fn max(self, other: Self) -> Self {
        IntervalOps::max(self, other)
    }

    fn min(self, other: Self) -> Self {
        IntervalOps::min(self, other)
    }

    fn radians(degrees: f64) -> Self {
        // The f64 is below pi.
        Interval::from(degrees) * Interval::new(PI, PI.next_up()) / 180.0
    }

    fn sin(self) -> Self {
        EnclosureOps::sin(self)
    }

    fn tan(self) -> Self {
        EnclosureOps::tan(self)
    }

    fn power(self, exponent: f64) -> Self {
        match self.endpoints() {
            _ if exponent == 0.0 => Interval::ONE,
            [_, largest] if largest <= 0.0 => Interval::ZERO,
            _ => (self.log() * exponent).exp(),
        }
    }

    fn both(self, other: Self) -> Self {
        self.intersection(other)
    }

    fn either(self, other: Self) -> Self {
        self.convex_hull(other)
    }
}
