//! The errors of a contender over the range of a variable, and the ranges in which it keeps the tolerance.

use serde::Serialize;

use super::picture::Contender;
use super::variable::Variable;
use crate::questions::prove::Verdict;

/// Ends are searched to this share of the range.
pub const RESOLUTION: f64 = 0.01;

/// The errors at one value.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Point {
    pub value: f64,
    /// The bounds of the largest error against exact Phong, in levels.
    pub error: [f64; 2],
    /// The same against the contender's own definition.
    pub own_error: [f64; 2],
    /// The median time of a frame, if it was measured.
    pub milliseconds: Option<f64>,
}

/// The errors of a contender over the range.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Curve {
    pub method: &'static str,
    pub points: Vec<Point>,
    /// The ranges in which the error is proven to be within the tolerance, from the first value to the last. Each of their ends
    /// keeps it, and does not a hundredth of the range beyond.
    pub keeps: Vec<[f64; 2]>,
    /// Whether nothing is refuted outside of these ranges.
    pub is_undecided: bool,
}

impl Curve {
    /// Finds the ranges between points. `keeps` says whether a value keeps the limit.
    ///
    /// # Errors
    /// Those of `keeps`.
    pub fn new(
        contender: &Contender,
        variable: &Variable,
        points: Vec<Point>,
        limit: f64,
        keeps: &mut impl FnMut(f64) -> anyhow::Result<bool>,
    ) -> anyhow::Result<Self> {
        let verdict = |point: &Point| Verdict::of(point.error, limit);
        let is_kept = |point: &Point| verdict(point) == Verdict::Proven;
        let mut ranges: Vec<[f64; 2]> = Vec::new();
        for (place, point) in points.iter().enumerate().filter(|it| is_kept(it.1)) {
            let before = place.checked_sub(1).map(|place| &points[place]);
            match (before, ranges.last_mut()) {
                (Some(before), Some(range)) if is_kept(before) => range[1] = point.value,
                (Some(before), _) => {
                    let end = end(variable, [point.value, before.value], keeps)?;
                    ranges.push([end, point.value]);
                }
                (None, _) => ranges.push([point.value; 2]),
            }
            if let Some(next) = points.get(place + 1).filter(|it| !is_kept(it))
                && let Some(range) = ranges.last_mut()
            {
                range[1] = end(variable, [point.value, next.value], keeps)?;
            }
        }
        Ok(Curve {
            method: contender.id,
            is_undecided: points.iter().all(|it| verdict(it) != Verdict::Refuted),
            keeps: ranges,
            points,
        })
    }

    /// The ranges in words: where the tolerance is kept.
    pub fn kept(&self, text: impl Fn(f64) -> String) -> String {
        let [Some(first), Some(last)] = [self.points.first(), self.points.last()] else {
            return "nowhere".to_owned();
        };
        let range = |[from, to]: &[f64; 2]| match [*from == first.value, *to == last.value] {
            [true, true] => "everywhere".to_owned(),
            [true, false] => format!("up to {}", text(*to)),
            [false, true] => format!("from {} on", text(*from)),
            [false, false] if from == to => format!("at {}", text(*from)),
            [false, false] => format!("from {} to {}", text(*from), text(*to)),
        };
        let ranges: Vec<String> = self.keeps.iter().map(range).collect();
        if ranges.is_empty() {
            return "nowhere".to_owned();
        }
        ranges.join(", ")
    }
}

/// The last value that keeps the limit, on the way from one that does to one that does not.
fn end(
    variable: &Variable,
    [kept, lost]: [f64; 2],
    keeps: &mut impl FnMut(f64) -> anyhow::Result<bool>,
) -> anyhow::Result<f64> {
    let [mut inside, mut outside] = [kept, lost].map(|value| variable.share(value));
    let mut last = kept;
    while (inside - outside).abs() > RESOLUTION {
        let share = f64::midpoint(inside, outside);
        let value = variable.at(share);
        if value == last || value == lost {
            break;
        }
        if keeps(value)? {
            (inside, last) = (share, value);
        } else {
            outside = share;
        }
    }
    Ok(last)
}
