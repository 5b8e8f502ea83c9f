//! Errors and times in, the methods worth choosing out.
//!
//! ```text
//! error |  o            o   on the front
//!       |     o    x    x   beaten: something is as good in one way and better in the other
//!       |        o      x
//!       +---------------- time
//! ```
//! Rule: a method is off the front if another errs less and its median time is no longer, or errs as much and is measurably
//! faster.

use super::live::Measurement;

/// Errors that differ by less than this, in levels, are one: the reference's own rounding in f64 stays well below it.
const RESOLUTION: f64 = 1e-6;

/// Which of the methods no other one beats. Where nothing is drawn nothing is traded: a method without an error is not on the
/// front.
pub fn on_front(methods: &[Measurement]) -> Vec<bool> {
    methods
        .iter()
        .map(|one| one.error.is_some() && !methods.iter().any(|other| beats(other, one)))
        .collect()
}

fn beats(one: &Measurement, other: &Measurement) -> bool {
    let [mine, theirs] = [one, other].map(|it| it.error.map(|error| (error / RESOLUTION).round()));
    mine <= theirs
        && one.timing.median <= other.timing.median
        && (mine < theirs || one.timing.is_measurably_less_than(&other.timing))
}
