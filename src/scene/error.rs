//! Messages about scene files, with the place of the mistake.
//!
//! ```text
//! scene.toml:7:8: invalid value: -4.0, expected a number from 1e-100 to 1e100
//!   |
//! 7 | size = [-4.0, 3.0, 2.0]
//!   |        ^^^^^^^^^^^^^^^^
//! ```

use std::ops::Range;

/// In characters. Longer lines and messages are cut.
const WIDEST_LINE: usize = 100;
const WIDEST_MESSAGE: usize = 400;

/// The message about a mistake in these bytes of a text: the name `file` of the text, line and column from 1, the first line
/// of the mistake, and carets below it.
pub fn located(file: &str, text: &str, span: &Range<usize>, message: &str) -> String {
    let before = text.get(..span.start).unwrap_or(text);
    let line = before.matches('\n').count() + 1;
    let start = before.rfind('\n').map_or(0, |newline| newline + 1);
    let column = before[start..].chars().count() + 1;
    // A long line is cut around the mistake.
    let skipped = if column > WIDEST_LINE {
        column - WIDEST_LINE / 2
    } else {
        0
    };
    let first_line = |text: &str| {
        let line = text.lines().next().unwrap_or_default();
        line.replace('\t', " ")
    };
    let content = first_line(&text[start..]);
    let shown: String = content.chars().skip(skipped).take(WIDEST_LINE).collect();
    let marked = first_line(text.get(span.clone()).unwrap_or_default());
    let indent = column - 1 - skipped;
    let carets = marked.chars().count().clamp(1, WIDEST_LINE - indent);
    let message: String = message.chars().take(WIDEST_MESSAGE).collect();
    let gutter = " ".repeat(line.to_string().len());
    let (indent, carets) = (" ".repeat(indent), "^".repeat(carets));
    format!(
        "{file}:{line}:{column}: {message}\n{gutter} |\n{line} | {shown}\n{gutter} | {indent}{carets}"
    )
}
