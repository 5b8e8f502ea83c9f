//! The numbers of the scene that are shown -> lines for a board: a row to go through them, and a row for each number.
//!
//! Rule: each row has the keys that a click does, and the chosen one is marked.

use super::lines::{Command, Line, Mark};
use crate::canvas::wrapped;
use crate::components::{Light, LightKind};
use crate::window::bindings::{Action, StepSize};
use crate::window::session::Session;

/// The width at which words are broken, in letters.
const LETTERS: usize = 34;

/// What is shown; empty where nothing is.
pub fn lines(session: &Session) -> Vec<Line> {
    let (Some(editor), Some(page)) = (&session.state.editor, session.page()) else {
        return Vec::new();
    };
    let row = |row: usize, label: String, state: String| {
        let step = |steps| Action::Step {
            row: Some(row),
            steps,
            size: StepSize::Usual,
        };
        Line::Command(Command {
            keys: vec![
                ("<", step(-1)),
                (">", step(1)),
                ("=", Action::ChooseRow(row)),
            ],
            mark: Mark::Choice(editor.row == row),
            label,
            state,
        })
    };
    let pages = format!("{} of {}", session.state.page + 1, session.scene.pages());
    let mut lines = vec![
        Line::Title("edit", session.name(page.entity)),
        row(0, page.kind.to_owned(), pages),
    ];
    for (index, parameter) in page.parameters.iter().enumerate() {
        let typed = editor.row == index + 1 && !editor.typed.is_empty();
        let value = if typed {
            format!("{}_", editor.typed)
        } else {
            short(session.scene.number(*parameter))
        };
        lines.push(row(index + 1, parameter.name(), value));
    }
    let mut say = |words: &str| lines.extend(wrapped(words, LETTERS).into_iter().map(Line::Text));
    if let Some(allowed) = &editor.error {
        say(&format!("Refused. Allowed is {allowed}."));
    }
    let light: Option<Light> = session.scene.get(page.entity);
    if light.is_some_and(|light| light.kind != LightKind::Ambient) {
        say(
            "Drag a light's disc to move it, with Shift in depth. Lights behind the eye are not seen: zoom out.",
        );
    }
    lines
}

/// A number in as many digits as it has, with a power of ten where it has too many.
fn short(number: f64) -> String {
    if number == 0.0 || (1e-4..1e7).contains(&number.abs()) {
        number.to_string()
    } else {
        format!("{number:e}")
    }
}
