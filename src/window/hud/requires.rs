//! What the scene requires of the model -> lines for a board: a row for each part, the one that matters most first.
//!
//! Rule: a click on a row shows the picture without that part, another one the whole again.

use super::lines::{Command, Line, Mark};
use crate::trade::words::short;
use crate::window::bindings::Action;
use crate::window::session::Session;

/// No more rows than this are shown.
const ROWS: usize = 16;

/// What is shown; empty where nothing is.
pub fn lines(session: &Session) -> Vec<Line> {
    let Some(requires) = &session.requires else {
        return Vec::new();
    };
    let tolerance = session.tolerance;
    let mut lines = vec![Line::Title("required", format!("at tolerance {tolerance}"))];
    if requires.parts.is_empty() {
        let percent = (100.0 * requires.share).floor();
        lines.push(Line::Text(format!("leaving out part by part, {percent} %")));
        return lines;
    }
    let shown = requires.parts.iter().enumerate().take(ROWS);
    lines.extend(shown.map(|(index, part)| {
        let error = short(Some(part.change.most()));
        let required = if part.change.keeps(tolerance) {
            "no"
        } else {
            "yes"
        };
        Line::Command(Command {
            keys: vec![("-", Action::LeaveOut(index))],
            mark: Mark::Choice(requires.left_out == Some(index)),
            label: part.name.clone(),
            state: format!("{error:>7} {required:>3}"),
        })
    }));
    if requires.parts.len() > ROWS {
        let more = requires.parts.len() - ROWS;
        lines.push(Line::Text(format!("and {more} that matter less")));
    }
    lines.push(Line::Text("The largest error in levels without".to_owned()));
    lines.push(Line::Text("a part, and whether it is required.".to_owned()));
    lines
}
