//! The errors of an evaluation over the range of a number, and their table for a terminal.

use serde::Serialize;

use super::sweeps::Sweep;
use crate::prove::Verdict;
use crate::report::tables::{aligned, wrapped};
use crate::report::words::scientific;
use crate::shading::LIMIT_0;

/// The evaluations of Phong's model that are compared, and the error in levels that each is to keep.
pub const EVALUATIONS: [(&str, f64); 4] = [
    ("textbook-f32", LIMIT_0),
    ("phong-0", LIMIT_0),
    ("phong-0.5", 0.5),
    ("reference-f64", LIMIT_0),
];

/// The errors of an evaluation over the range of a number.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ErrorCurve {
    pub number: &'static str,
    pub unit: &'static str,
    pub evaluation: &'static str,
    pub limit: f64,
    /// The ends of the longest run of points that are proven to keep the limit.
    pub keeps: Option<[f64; 2]>,
    pub points: Vec<CurvePoint>,
}

/// The error of an evaluation at one value.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct CurvePoint {
    pub value: f64,
    /// The lower and the upper bound of the largest error of a small picture, in levels.
    pub error: [f64; 2],
    /// Whether the limit is kept.
    pub verdict: Verdict,
}

/// The bounds of the largest error of one picture, by evaluation.
pub type Errors = [[f64; 2]; EVALUATIONS.len()];

impl ErrorCurve {
    /// The curve of the evaluation with this index.
    pub fn new(sweep: &Sweep, evaluation: usize, errors: &[(f64, Errors)]) -> Self {
        let (id, limit) = EVALUATIONS[evaluation];
        let point = |(value, errors): &(f64, Errors)| CurvePoint {
            value: *value,
            error: errors[evaluation],
            verdict: Verdict::of(errors[evaluation], limit),
        };
        let points: Vec<CurvePoint> = errors.iter().map(point).collect();
        let runs = points.split(|point| point.verdict != Verdict::Proven);
        let longest = runs.max_by_key(|run| run.len()).unwrap_or_default();
        ErrorCurve {
            number: sweep.number,
            unit: sweep.unit,
            evaluation: id,
            limit,
            keeps: ends(longest),
            points,
        }
    }

    /// The least and the largest value.
    pub fn range(&self) -> [f64; 2] {
        ends(&self.points).unwrap_or([1.0; 2])
    }

    /// The range in which the limit is kept, as text.
    fn kept(&self) -> String {
        let worst = self.points.iter().map(|point| point.verdict).max();
        match (self.keeps, worst) {
            (None, _) => "none".to_owned(),
            (Some(ends), Some(Verdict::Refuted)) => span(ends),
            (Some(ends), Some(Verdict::Undecided)) => span(ends) + " ?",
            (Some(_), _) => "all".to_owned(),
        }
    }
}

fn ends(points: &[CurvePoint]) -> Option<[f64; 2]> {
    Some([points.first()?.value, points.last()?.value])
}

/// The table for a terminal: for each number, the range in which each evaluation keeps its limit.
pub fn table(curves: &[ErrorCurve]) -> String {
    let ids = EVALUATIONS.map(|(id, _)| id);
    let head = [&["number", "swept"][..], &ids].concat();
    let rows = curves.chunks(EVALUATIONS.len()).map(|curves| {
        let start = [curves[0].number.to_owned(), span(curves[0].range())];
        start.into_iter().chain(curves.iter().map(ErrorCurve::kept))
    });
    format!("{}\n\n{}", aligned(&head, rows), wrapped(LEGEND))
}

const LEGEND: &str = "The range in which the largest error of a picture is proven to be within 0.05 level of the exact \
    value, for phong-0.5 within 0.5. textbook-f32: the reference in f32 throughout; phong-0, phong-0.5: this renderer at \
    tolerance 0 and 0.5; reference-f64: the reference in f64. A ? marks ranges outside of which nothing is refuted, but f64 does \
    not suffice to decide.";

/// A range as text.
fn span(ends: [f64; 2]) -> String {
    let rounded = |value| match value {
        1.0..1e4 => format!("{value:.0}"),
        _ => scientific(value),
    };
    ends.map(rounded).join(" to ")
}
