//! Running error analysis (Wilkinson 1963; Higham, "Accuracy and Stability of Numerical Algorithms", 3.3): numbers that carry
//! a bound on their rounding error.
//!
//! Every operation rounds once; errors of second order are neglected. Tests evaluate a formula with these numbers, in the
//! order of the code, and compare the bound with the count of roundings in the code.

use std::ops::{Add, Div, Mul, Sub};

/// A number, and a bound on its rounding error in unit round-offs.
#[derive(Clone, Copy, Debug)]
pub struct Rounded {
    pub value: f64,
    pub error: f64,
}

impl Rounded {
    /// A number without error.
    pub fn exact(value: f64) -> Self {
        Rounded { value, error: 0.0 }
    }

    /// A number that is rounded when it is stored.
    pub fn stored(value: f64) -> Self {
        Rounded::new(value, 0.0)
    }

    /// The result of an operation: `error` comes from its operands, the result is rounded once.
    fn new(value: f64, error: f64) -> Self {
        let error = error + value.abs();
        Rounded { value, error }
    }

    pub fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        Rounded::new(root, self.error / (2.0 * root))
    }
}

impl Add for Rounded {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Rounded::new(self.value + other.value, self.error + other.error)
    }
}

impl Sub for Rounded {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Rounded::new(self.value - other.value, self.error + other.error)
    }
}

impl Mul for Rounded {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let error = self.error * other.value.abs() + other.error * self.value.abs();
        Rounded::new(self.value * other.value, error)
    }
}

impl Div for Rounded {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        let error = (self.error + other.error * value.abs()) / other.value.abs();
        Rounded::new(value, error)
    }
}

/// A vector of them.
pub type Vector = [Rounded; 3];

pub fn dot(a: &Vector, b: &Vector) -> Rounded {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Scaled to length one.
pub fn unit(vector: &Vector) -> Vector {
    let inverse = Rounded::exact(1.0) / dot(vector, vector).sqrt();
    vector.map(|component| component * inverse)
}

/// The lengths of a vector and of its error.
pub fn lengths(vector: &Vector) -> [f64; 2] {
    let length = |of: fn(&Rounded) -> f64| vector.iter().map(|c| of(c).powi(2)).sum::<f64>().sqrt();
    [
        length(|component| component.value),
        length(|component| component.error),
    ]
}

/// At a corner of a square, where x = y = 1, an affine number with these terms.
pub fn at_corner(terms: [f64; 3]) -> Rounded {
    let [middle, right, down] = terms.map(Rounded::stored);
    // The position is a product with the stored inverse of the half extent.
    let end = Rounded::stored(1.0) * Rounded::exact(1.0);
    end * right + (middle + down * end)
}

/// There w, which falls to half of its value at the middle in each of a thousand steps.
pub fn w_at_corner(step: u32) -> Rounded {
    let slope = 0.249 * (1.0 + (f64::from(step) * 0.3).sin()) / 2.0;
    at_corner([1.0, slope - 0.498, -slope])
}
