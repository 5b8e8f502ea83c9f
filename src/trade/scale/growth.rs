//! Times against a quantity in, the exponent with which they grow and its standard error out.
//!
//! Rule: exponents are fitted to the upper half of the points, where what a frame costs without any of the quantity no longer
//! counts.

use serde::Serialize;

use super::{Point, Times};

/// How the time of a method grows: time = c number^exponent.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fit {
    /// The method's.
    pub id: &'static str,
    /// `None` where fewer than two numbers differ, or a time is not positive.
    pub exponent: Option<f64>,
    /// `None` where two points, which a line always meets, or fewer were fitted. It knows the scatter of the points about a power
    /// law, not whether the law is one.
    pub standard_error: Option<f64>,
    /// The first number that was fitted.
    pub from: usize,
}

/// The fits of all methods.
pub fn fits(points: &[Point]) -> Vec<Fit> {
    let upper = &points[points.len() / 2..];
    let Some(first) = upper.first() else {
        return Vec::new();
    };
    let fit = |(method, times): (usize, &Times)| {
        let at = |point: &Point| [point.number as f64, point.methods[method].ms()];
        let times_by_number: Vec<[f64; 2]> = upper.iter().map(at).collect();
        let [exponent, standard_error] = power(&times_by_number);
        Fit {
            id: times.id,
            exponent,
            standard_error,
            from: first.number,
        }
    };
    first.methods.iter().enumerate().map(fit).collect()
}

/// The exponent e of y = c x^e by least squares on the logarithms, and its standard error sqrt(SSE / (n - 2) / Sxx).
pub fn power(points: &[[f64; 2]]) -> [Option<f64>; 2] {
    if points.iter().flatten().any(|value| *value <= 0.0) {
        return [None; 2];
    }
    let logs: Vec<[f64; 2]> = points.iter().map(|point| point.map(f64::ln)).collect();
    let count = logs.len() as f64;
    let mean = |axis: usize| logs.iter().map(|log| log[axis]).sum::<f64>() / count;
    let means = [mean(0), mean(1)];
    let sum = |of: &dyn Fn(f64, f64) -> f64| -> f64 {
        let distances = logs.iter().map(|[x, y]| of(x - means[0], y - means[1]));
        distances.sum()
    };
    let squares = sum(&|x, _| x * x);
    let slope = sum(&|x, y| x * y) / squares;
    let rest = sum(&|x, y| (y - slope * x).powi(2));
    let error = (rest / (count - 2.0) / squares).sqrt();
    [
        slope.is_finite().then_some(slope),
        (count > 2.0 && error.is_finite()).then_some(error),
    ]
}
