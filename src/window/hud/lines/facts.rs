//! What the session knows of its picture -> facts, a line each.
//!
//! Rule: "..." for what is being found out, "-" for what there is not.

use super::Line;
use crate::trade::words::short;
use crate::window::examiner::{Errors, Findings};
use crate::window::session::Session;

/// Everything: what drawing took, and how far the picture errs.
pub fn all(session: &Session) -> [Line; 6] {
    let statistics = session.statistics();
    let [width, height] = statistics.size();
    let columns = |max: &str, mean: &str| format!("{max:>6}{mean:>7}");
    let both = |errors: Errors| columns(&short_error(errors.max), &short_error(errors.mean));
    [
        Line::Fact("frame", frame_time(session)),
        proven(session),
        Line::Fact("window", format!("{width}\u{d7}{height}")),
        Line::Fact("error", columns("max", "mean")),
        Line::Fact("vs Phong", errors(session, |it| it.errors, both)),
        Line::Fact("vs own mode", errors(session, |it| it.own_errors, both)),
    ]
}

/// The most important of it.
pub fn brief(session: &Session) -> [Line; 2] {
    let max = |errors: Errors| short_error(errors.max);
    [
        Line::Fact("frame", frame_time(session)),
        Line::Fact("max error", errors(session, |it| it.errors, max)),
    ]
}

/// How many of the pixels that show a cuboid are proven, or what is missing.
fn proven(session: &Session) -> Line {
    let name = "proven";
    let shaded = grouped(session.statistics().shaded_pixels());
    let Some(proof) = session.findings().and_then(|it| it.proof.as_ref()) else {
        return Line::Fact(name, format!("... of {shaded}"));
    };
    match (proof.refuted, proof.undecided) {
        (0, 0) => Line::Fact(name, format!("{} of {shaded}", grouped(proof.covered))),
        (0, undecided) => Line::Alarm(name, format!("not {} px", grouped(undecided))),
        (refuted, _) => Line::Alarm(name, format!("{} px refuted", grouped(refuted))),
    }
}

fn frame_time(session: &Session) -> String {
    session.statistics().frame_time().map_or_else(
        || "-".to_owned(),
        |time| format!("{:.2} ms", time.as_secs_f64() * 1e3),
    )
}

/// Errors in levels as `told`, or why there are none.
fn errors(
    session: &Session,
    of: fn(&Findings) -> Option<Errors>,
    told: impl Fn(Errors) -> String,
) -> String {
    match session.findings().map(of) {
        None => "...".to_owned(),
        Some(None) => "-".to_owned(),
        Some(Some(errors)) => told(errors),
    }
}

fn short_error(levels: f64) -> String {
    short(Some(levels))
}

/// A number with its digits in threes.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (place, digit) in digits.chars().enumerate() {
        if place > 0 && (digits.len() - place).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}
