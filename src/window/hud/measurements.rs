//! What is measured, or was -> lines for a board: how far it is, or the verdict and a row for every method.
//!
//! Rule: the words are those of `trade`, broken to the board's width.

use super::lines::Line;
use crate::canvas::wrapped;
use crate::trade::Report;
use crate::trade::export::stages;
use crate::trade::verdict::verdict;
use crate::trade::words::short;
use crate::window::session::Measuring;

/// What is shown, in lines of at most `letters`; empty where nothing is.
pub fn lines(measuring: &Measuring, letters: usize) -> Vec<Line> {
    match measuring {
        Measuring::Off => Vec::new(),
        Measuring::Running(step, share) => {
            let percent = (100.0 * share).floor();
            vec![Line::Text(format!(
                "measuring: {step}, {percent} % (Esc or M ends it)"
            ))]
        }
        Measuring::Done(report) => table(report, letters),
    }
}

/// The verdict, and a row for every method.
fn table(report: &Report, letters: usize) -> Vec<Line> {
    let [width, height] = report.subject.size;
    let words = |text: &str| wrapped(text, letters).into_iter().map(Line::Text);
    let mut lines = vec![Line::Title("measured", format!("{width}\u{d7}{height}"))];
    lines.extend(words(&verdict(report)));
    lines.push(Line::Rule);
    let row = |cells: [&str; 4]| {
        let [method, time, error, front] = cells;
        Line::Text(format!("{method:<18}{time:>7}{error:>7}{front:>6}"))
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
    lines.push(Line::Rule);
    lines.extend(words(&stages(report)));
    lines.extend(words(
        "max: largest error in levels against exact Phong. front *: nothing beats it in error and time both. Times are \
         of one thread. Esc or M closes this.",
    ));
    lines
}
