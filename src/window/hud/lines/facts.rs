//! What the session knows of its picture -> facts, a line each.
//!
//! Rule: "..." for what is being computed, "-" for what does not exist.

use std::time::Duration;

use super::{Line, tolerance};
use crate::trade::words::{counted, short};
use crate::window::examination::{Errors, ReferenceResult};
use crate::window::session::Session;
use crate::window::views::{ViewMode, mode_label};

/// What frames took, how much is proven, and how far the picture errs; always as many lines.
pub fn all(session: &Session) -> [Line; 6] {
    let times = &session.times;
    let [left, right] = &times.sides;
    let wipe = session.state.mode == ViewMode::GouraudPhong;
    let frames = counted(left.len(), "frame");
    let threads = counted(times.threads, "thread");
    [
        Line::Fact(if wipe { "Gouraud" } else { "frame" }, milliseconds(left)),
        if wipe {
            Line::Fact("Phong", milliseconds(right))
        } else {
            Line::Text(String::new())
        },
        Line::Fact("median of", format!("{frames}, {threads}")),
        proven(session),
        Line::Fact("max vs Phong", errors(session, |it| it.errors)),
        Line::Fact("max vs own", errors(session, |it| it.own_errors)),
    ]
}

/// The method that draws the picture, in words.
pub fn shaded_by(session: &Session) -> String {
    let mode = session.shading().map_or("mixed", mode_label);
    format!("{mode}, {}", tolerance(session.tolerance))
}

/// A median with its quartiles.
fn milliseconds(times: &[Duration]) -> String {
    let text = |time: Duration| short(Some(time.as_secs_f64() * 1e3));
    match quartiles(times).map(|all| all.map(text)) {
        None => "-".to_owned(),
        Some([_, median, _]) if times.len() == 1 => format!("{median} ms"),
        Some([lower, median, upper]) => format!("{median} ({lower} to {upper}) ms"),
    }
}

/// The median and the quartiles around it, in order, by nearest rank; `None` where there are no times.
pub fn quartiles(times: &[Duration]) -> Option<[Duration; 3]> {
    let mut times = times.to_vec();
    times.sort_unstable();
    let rank = |quarter: usize| times.get((times.len() * quarter).div_ceil(4).max(1) - 1);
    Some([*rank(1)?, *rank(2)?, *rank(3)?])
}

/// How many of the pixels that show a cuboid are proven, or what is missing.
fn proven(session: &Session) -> Line {
    let name = "proven";
    let covered = grouped(session.times.counts.covered_pixels);
    let Some(proof) = session.reference.as_ref().and_then(|it| it.proof.as_ref()) else {
        return Line::Fact(name, format!("... of {covered}"));
    };
    match (proof.refuted, proof.undecided) {
        (0, 0) => Line::Fact(name, format!("{} of {covered}", grouped(proof.covered))),
        (0, undecided) => Line::Alarm(name, format!("not {} px", grouped(undecided))),
        (refuted, _) => Line::Alarm(name, format!("{} px refuted", grouped(refuted))),
    }
}

/// Errors in levels, or why there are none.
fn errors(session: &Session, of: fn(&ReferenceResult) -> Option<Errors>) -> String {
    match session.reference.as_ref().map(of) {
        None => "...".to_owned(),
        Some(None) => "-".to_owned(),
        Some(Some(errors)) => {
            let [max, mean] = [errors.max, errors.mean].map(|it| short(Some(it)));
            format!("{max} (mean {mean})")
        }
    }
}

/// A number with its digits in threes.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let threes = digits.as_bytes().rchunks(3).rev();
    let threes: Vec<_> = threes.map(String::from_utf8_lossy).collect();
    threes.join(" ")
}
