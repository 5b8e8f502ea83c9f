//! What is measured, or was -> lines for a board: how far it is, or the verdict and a row for every method.
//!
//! Rule: the words are those of `trade`, broken to the board's width.

use super::lines::Line;
use crate::canvas::wrapped;
use crate::trade::Report;
use crate::trade::verdict::verdict;
use crate::trade::words::short;
use crate::window::measuring::Measuring;

/// What is shown, in lines of at most `letters`; empty where nothing is.
pub fn lines(measuring: &Measuring, letters: usize) -> Vec<Line> {
    match measuring {
        Measuring::Off => Vec::new(),
        Measuring::Running(progress) => {
            let (step, share) = progress.map_or(("starting", 0.0), |told| (told.step, told.share));
            vec![
                Line::Title("measuring ...", String::new()),
                Line::Text(format!("{step:<20}{:>4.0} %", 100.0 * share)),
                Line::Text("Esc or M ends it".to_owned()),
            ]
        }
        Measuring::Done(report) => table(report, letters),
    }
}

/// The verdict, and a row for every method.
fn table(report: &Report, letters: usize) -> Vec<Line> {
    let [width, height] = report.subject.size;
    let mut lines = vec![Line::Title("measured", format!("{width}\u{d7}{height}"))];
    lines.extend(
        wrapped(&verdict(report), letters)
            .into_iter()
            .map(Line::Text),
    );
    lines.push(Line::Heading("methods"));
    let row = |cells: [&str; 4]| {
        let [method, time, error, front] = cells;
        Line::Text(format!("{method:<18}{time:>8}{error:>8}{front:>6}"))
    };
    lines.push(row(["", "ms", "max", "front"]));
    lines.extend(report.methods.iter().map(|one| {
        row([
            one.method.id,
            &short(Some(one.timing.median)),
            &short(one.max_error()),
            if one.on_front { "*" } else { "" },
        ])
    }));
    let notes = "max: largest error in levels against exact Phong. front *: nothing beats it in error and time both. \
                 Times are of one thread. Esc or M closes this.";
    lines.push(Line::Heading("what it says"));
    lines.extend(wrapped(notes, letters).into_iter().map(Line::Text));
    lines
}
