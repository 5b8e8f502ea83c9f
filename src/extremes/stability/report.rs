//! Curves in; a table, JSON and CSV out.
//!
//! Rule: pure; every figure is one of the curves'.

use super::{Curve, EVALUATIONS};
use crate::prove::Verdict;
use crate::trade::tables::{aligned, wrapped};

/// What a terminal shows: for each number, the range in which each evaluation keeps its limit.
pub fn table(curves: &[Curve]) -> String {
    let ids = EVALUATIONS.map(|evaluation| evaluation.id.to_owned());
    let head = [
        &["number".to_owned(), "from".to_owned(), "to".to_owned()],
        &ids[..],
    ]
    .concat();
    let rows = curves.chunks(EVALUATIONS.len()).map(|curves| {
        let ends = curves[0].range().map(rounded);
        let cells = curves.iter().map(kept);
        let start = [vec![curves[0].number.to_owned()], ends.into()].concat();
        start.into_iter().chain(cells).collect()
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
        None => "nowhere".to_owned(),
        Some(_) if verdicts().all(|verdict| verdict == Verdict::Proven) => "all".to_owned(),
        Some(ends) => {
            let [from, to] = ends.map(rounded);
            let is_refuted = verdicts().any(|verdict| verdict == Verdict::Refuted);
            format!("{from} to {to}{}", if is_refuted { "" } else { " ?" })
        }
    }
}

/// A number with two digits that matter.
pub(super) fn rounded(value: f64) -> String {
    if (0.01..1e4).contains(&value) {
        let text = format!("{value:.2}");
        let digits = text.trim_end_matches('0').trim_end_matches('.');
        digits.to_owned()
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
