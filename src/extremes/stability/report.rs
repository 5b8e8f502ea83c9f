//! Curves in; a table, JSON and CSV out.
//!
//! Rule: pure; every figure is one of the curves'.

use super::{Curve, EVALUATIONS};
use crate::prove::Verdict;
use crate::trade::tables::{aligned, wrapped};

/// What a terminal shows: for each number, the range in which each evaluation keeps its limit.
pub fn table(curves: &[Curve]) -> String {
    let ids = EVALUATIONS.map(|evaluation| evaluation.id.to_owned());
    let head = [vec!["number".to_owned(), "swept".to_owned()], ids.into()].concat();
    let rows = curves.chunks(EVALUATIONS.len()).map(|curves| {
        let start = [curves[0].number.to_owned(), span(curves[0].range())];
        start.into_iter().chain(curves.iter().map(kept)).collect()
    });
    let rows: Vec<Vec<String>> = rows.collect();
    format!("{}\n\n{}\n", aligned(&head, &rows), wrapped(LEGEND))
}

const LEGEND: &str = "The range in which the largest error of a picture is proven to be within 0.05 level of the exact \
    value, for phong-0.5 within 0.5. textbook-f32: the formula in f32 throughout; phong-0, phong-0.5: this renderer at \
    tolerance 0 and 0.5; reference-f64: the reference. A ? marks ranges outside of which nothing is refuted, but f64 does \
    not suffice to decide.";

/// The range in which a limit is kept.
fn kept(curve: &Curve) -> String {
    let verdicts = || curve.points.iter().map(|point| point.verdict);
    match curve.keeps {
        None => "none".to_owned(),
        Some(_) if verdicts().all(|verdict| verdict == Verdict::Proven) => "all".to_owned(),
        Some(ends) => {
            let is_refuted = verdicts().any(|verdict| verdict == Verdict::Refuted);
            span(ends) + if is_refuted { "" } else { " ?" }
        }
    }
}

fn span(ends: [f64; 2]) -> String {
    ends.map(rounded).join(" to ")
}

/// A number with as many digits as matter.
fn rounded(value: f64) -> String {
    if (1.0..1e4).contains(&value) {
        format!("{value:.0}")
    } else {
        format!("{value:.1e}").replace(".0e", "e")
    }
}

/// An array with an object for each number and evaluation.
///
/// # Errors
/// None that `serde_json` has a reason for.
pub fn json(curves: &[Curve]) -> serde_json::Result<String> {
    Ok(serde_json::to_string_pretty(curves)? + "\n")
}

/// CSV (RFC 4180), a line for each value and evaluation; the first line names the columns.
pub fn csv(curves: &[Curve]) -> String {
    let mut text =
        String::from("number,unit,value,evaluation,limit,least_error,largest_error,verdict\n");
    for curve in curves {
        for point in &curve.points {
            let [least, largest] = point.error;
            let verdict = match point.verdict {
                Verdict::Proven => "proven",
                Verdict::Undecided => "undecided",
                Verdict::Refuted => "refuted",
            };
            let cells = [
                curve.number,
                curve.unit,
                &format!("{:e}", point.value),
                curve.evaluation,
                &curve.limit.to_string(),
                &format!("{least:e}"),
                &format!("{largest:e}"),
                verdict,
            ];
            text += &(cells.join(",") + "\n");
        }
    }
    text
}
