//! Errors and times in, the methods worth choosing out.
//!
//! ```text
//! error |  o            o   on the front
//!       |     o    x    x   beaten: something is as good in one way and better in the other
//!       |        o      x
//!       +---------------- time
//! ```
//! Rule: noise takes no method off the front. It takes another that errs no more and is measurably faster, or one that
//! takes no longer and errs less.

use super::timing::Timing;

/// Errors that differ by less than this, in levels, are one: the reference's own rounding in f64 stays well below it.
const RESOLUTION: f64 = 1e-6;

/// A method as the front sees it.
#[derive(Clone, Copy, Debug)]
pub struct Candidate<'a> {
    /// Its largest error in levels; `None` where there is nothing to err on.
    pub error: Option<f64>,
    /// Its time.
    pub timing: &'a Timing,
}

impl Candidate<'_> {
    fn beats(&self, other: &Candidate) -> bool {
        let [mine, theirs] = [self, other].map(|one| one.error.map(|e| (e / RESOLUTION).round()));
        mine <= theirs
            && self.timing.median <= other.timing.median
            && (mine < theirs || self.timing.is_measurably_less_than(other.timing))
    }
}

/// Which of them no other one beats. Where nothing is drawn nothing is traded: a candidate without an error is not on it.
pub fn on_front(candidates: &[Candidate]) -> Vec<bool> {
    candidates
        .iter()
        .map(|one| one.error.is_some() && !candidates.iter().any(|other| other.beats(one)))
        .collect()
}
