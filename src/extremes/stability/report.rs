//! The curves as a table for a terminal.

use super::{Curve, EVALUATIONS};
use crate::prove::Verdict;
use crate::trade::tables::{aligned, wrapped};

/// What a terminal shows: for each number, the range in which each evaluation keeps its limit.
pub fn table(curves: &[Curve]) -> String {
    let ids = EVALUATIONS.map(|(id, _)| id);
    let head = [&["number", "swept"][..], &ids].concat();
    let rows = curves.chunks(EVALUATIONS.len()).map(|curves| {
        let start = [curves[0].number.to_owned(), span(curves[0].range())];
        start.into_iter().chain(curves.iter().map(kept)).collect()
    });
    let rows: Vec<Vec<String>> = rows.collect();
    format!("{}\n\n{}", aligned(&head, &rows), wrapped(LEGEND))
}

const LEGEND: &str = "The range in which the largest error of a picture is proven to be within 0.05 level of the exact \
    value, for phong-0.5 within 0.5. textbook-f32: the formula in f32 throughout; phong-0, phong-0.5: this renderer at \
    tolerance 0 and 0.5; reference-f64: the reference. A ? marks ranges outside of which nothing is refuted, but f64 does \
    not suffice to decide.";

/// The range in which a limit is kept.
fn kept(curve: &Curve) -> String {
    let has = |verdict| curve.points.iter().any(|point| point.verdict == verdict);
    match curve.keeps {
        None => "none".to_owned(),
        Some(ends) if has(Verdict::Refuted) => span(ends),
        Some(ends) if has(Verdict::Undecided) => span(ends) + " ?",
        Some(_) => "all".to_owned(),
    }
}

/// A range in as many digits as matter.
fn span(ends: [f64; 2]) -> String {
    let rounded = |value| match value {
        1.0..1e4 => format!("{value:.0}"),
        _ => format!("{value:.1e}").replace(".0e", "e"),
    };
    ends.map(rounded).join(" to ")
}
