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
pub struct Candidate {
    /// Its largest error in levels; `None` where there is nothing to err on.
    pub error: Option<f64>,
    /// Its time.
    pub timing: Timing,
}

impl Candidate {
    fn beats(&self, other: &Candidate) -> bool {
        let [mine, theirs] = [self, other].map(|one| one.error.map(|e| (e / RESOLUTION).round()));
        mine <= theirs
            && self.timing.median <= other.timing.median
            && (mine < theirs || self.timing.is_measurably_less_than(&other.timing))
    }
}

/// Which of them no other one beats. Where nothing is drawn nothing is traded: a candidate without an error is not on it.
pub fn on_front(candidates: &[Candidate]) -> Vec<bool> {
    candidates
        .iter()
        .map(|one| one.error.is_some() && !candidates.iter().any(|other| other.beats(one)))
        .collect()
}

/// The largest groups of two or more in which no time is measurably less than another, each in order of its medians and
/// the groups in order of their first.
pub fn indistinguishable(timings: &[Timing]) -> Vec<Vec<usize>> {
    let mut by_time: Vec<usize> = (0..timings.len()).collect();
    by_time.sort_by(|a, b| timings[*a].median.total_cmp(&timings[*b].median));
    // Intervals that overlap each other have a point in common, and the lower end of one of them is such a point.
    let group = |&lowest: &usize| -> Vec<usize> {
        let point = timings[lowest].interval()[0];
        let holds = |timing: &Timing| {
            let [low, high] = timing.interval();
            low <= point && point <= high
        };
        let holding = by_time.iter().copied();
        holding.filter(|&method| holds(&timings[method])).collect()
    };
    let groups: Vec<Vec<usize>> = by_time.iter().map(group).collect();
    let within =
        |small: &[usize], large: &[usize]| small.iter().all(|method| large.contains(method));
    let mut largest: Vec<Vec<usize>> = Vec::new();
    for group in groups.iter().filter(|group| group.len() > 1) {
        let larger = |other: &Vec<usize>| other.len() > group.len() && within(group, other);
        if !groups.iter().any(larger) && !largest.contains(group) {
            largest.push(group.clone());
        }
    }
    largest
}
