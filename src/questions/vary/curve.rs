//! The errors of a contender over the range of a variable, and the ranges in which it keeps the tolerance.

use serde::Serialize;

use super::export::number;
use super::picture::{Contender, Error};
use super::variable::Variable;
use crate::output::words::{interval, joined, short};

/// Ends are searched to this share of the range.
pub const RESOLUTION: f64 = 0.01;
/// Cuboids of these heights, in pixels, are small: the least zoom decides whether the centre of a pixel lies in a highlight.
const SMALL: [f64; 2] = [0.5, 8.0];
/// The longest step between two heights of small cuboids, as the logarithm of their ratio.
const STEP: f64 = 0.02;

/// The steps between two heights of small cuboids.
pub fn steps_between(heights: [Option<f64>; 2]) -> f64 {
    let [least, most] = SMALL;
    let [Some(one), Some(other)] = heights.map(|it| Some(it?.clamp(least, most))) else {
        return 0.0;
    };
    (one / other).ln().abs() / STEP
}

/// The errors at one value.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Point {
    pub value: f64,
    #[serde(flatten)]
    pub found: Error,
    /// The median time of a frame, if it was measured.
    pub milliseconds: Option<f64>,
}

impl Point {
    fn untimed(value: f64, found: Error) -> Self {
        Point {
            value,
            found,
            milliseconds: None,
        }
    }

    /// The largest error against exact Phong, by its upper bound in levels, if a cuboid is seen.
    pub fn error(&self) -> Option<f64> {
        (self.found.pixels > 0).then_some(self.found.error[1])
    }
}

/// The errors of a contender over the range.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Curve {
    pub method: &'static str,
    pub points: Vec<Point>,
    /// The ranges in which the error is proven to be within the tolerance, from the first value to the last. Each of their ends
    /// keeps it, and does not a hundredth of the range beyond.
    pub keeps: Vec<[f64; 2]>,
    /// The heights of the cuboids at the ends of `keeps`, in pixels, if the key is the zoom of the camera in use.
    pub heights: Option<Vec<[f64; 2]>>,
    /// The ranges in which no compared pixel shows a cuboid, with such ends.
    pub empty: Vec<[f64; 2]>,
}

impl Curve {
    /// Finds the ranges between points. `find` gives the errors at a value, where they can be known.
    ///
    /// # Errors
    /// The errors of `find`.
    pub fn new(
        contender: &Contender,
        variable: &Variable,
        points: Vec<Point>,
        limit: f64,
        is_zoom: bool,
        find: &mut impl FnMut(f64) -> anyhow::Result<Option<Error>>,
    ) -> anyhow::Result<Self> {
        let dense = if is_zoom {
            &dense(variable, &points, find)?
        } else {
            &points
        };
        let keeps = ranges(variable, dense, |found| found.keeps(limit), find)?;
        let empty = ranges(variable, dense, |found| found.pixels == 0, find)?;
        let height = |[from, to]: &[Point; 2]| Some([from.found.height?, to.found.height?]);
        let heights = if is_zoom {
            keeps.iter().map(height).collect()
        } else {
            None
        };
        let values = |ranges: Vec<[Point; 2]>| {
            let ranges = ranges.into_iter();
            ranges.map(|ends| ends.map(|end| end.value)).collect()
        };
        Ok(Curve {
            method: contender.id,
            heights,
            keeps: values(keeps),
            empty: values(empty),
            points,
        })
    }

    /// Ranges of it in words.
    pub fn places(&self, ranges: &[[f64; 2]]) -> String {
        let [Some(first), Some(last)] = [self.points.first(), self.points.last()] else {
            return "nowhere".to_owned();
        };
        let range = |[from, to]: &[f64; 2]| match [*from == first.value, *to == last.value] {
            [true, true] => "everywhere".to_owned(),
            [true, false] => format!("up to {}", number(*to)),
            [false, true] => format!("from {} on", number(*from)),
            [false, false] if from == to => format!("at {}", number(*from)),
            [false, false] => format!("from {} to {}", number(*from), number(*to)),
        };
        if ranges.is_empty() {
            return "nowhere".to_owned();
        }
        joined(ranges.iter().map(range), ", ")
    }

    /// The ranges that keep the tolerance, in words.
    pub fn kept(&self) -> String {
        let places = self.places(&self.keeps);
        let height = |[from, to]: &[f64; 2]| interval([from.min(*to), from.max(*to)], short);
        let heights = joined(self.heights.iter().flatten().map(height), " or ");
        if heights.is_empty() {
            return places;
        }
        format!("{places}, where the cuboids are {heights} pixels high")
    }

    /// The ranges without a cuboid in compared pixels, in words, if there are any.
    pub fn emptiness(&self) -> Option<String> {
        let places = self.places(&self.empty);
        (!self.empty.is_empty()).then(|| places.replace("everywhere", "anywhere"))
    }
}

/// The points, and those at the steps between small cuboids.
fn dense(
    variable: &Variable,
    points: &[Point],
    find: &mut impl FnMut(f64) -> anyhow::Result<Option<Error>>,
) -> anyhow::Result<Vec<Point>> {
    let mut dense: Vec<Point> = points.first().copied().into_iter().collect();
    for pair in points.windows(2) {
        let [from, to] = [pair[0], pair[1]].map(|it| variable.share(it.value));
        let steps = steps_between([pair[0], pair[1]].map(|it| it.found.height)).ceil();
        for step in 1..steps as u32 {
            let value = variable.at(from + (to - from) * f64::from(step) / steps);
            let found = find(value)?;
            dense.extend(found.map(|found| Point::untimed(value, found)));
        }
        dense.push(pair[1]);
    }
    Ok(dense)
}

/// The ranges in which errors are `sought`, from the first value to the last.
fn ranges(
    variable: &Variable,
    points: &[Point],
    sought: impl Fn(&Error) -> bool,
    find: &mut impl FnMut(f64) -> anyhow::Result<Option<Error>>,
) -> anyhow::Result<Vec<[Point; 2]>> {
    let is_in = |point: &Point| sought(&point.found);
    let inside = &mut |value| Ok(find(value)?.filter(&sought));
    let mut ranges: Vec<[Point; 2]> = Vec::new();
    for (place, point) in points.iter().enumerate().filter(|it| is_in(it.1)) {
        let before = place.checked_sub(1).map(|place| &points[place]);
        match (before, ranges.last_mut()) {
            (Some(before), Some(range)) if is_in(before) => range[1] = *point,
            (Some(before), _) => ranges.push([end(variable, [point, before], inside)?, *point]),
            (None, _) => ranges.push([*point; 2]),
        }
        if let Some(next) = points.get(place + 1).filter(|it| !is_in(it))
            && let Some(range) = ranges.last_mut()
        {
            range[1] = end(variable, [point, next], inside)?;
        }
    }
    Ok(ranges)
}

/// The last point of a range, on the way from one inside to one outside. `inside` gives the errors at a value inside.
fn end(
    variable: &Variable,
    [kept, lost]: [&Point; 2],
    inside: &mut impl FnMut(f64) -> anyhow::Result<Option<Error>>,
) -> anyhow::Result<Point> {
    let [mut near, mut far] = [kept, lost].map(|it| variable.share(it.value));
    let mut last = *kept;
    while (near - far).abs() > RESOLUTION {
        let share = f64::midpoint(near, far);
        let value = variable.at(share);
        if value == last.value || value == lost.value {
            break;
        }
        if let Some(found) = inside(value)? {
            (near, last) = (share, Point::untimed(value, found));
        } else {
            far = share;
        }
    }
    Ok(last)
}
