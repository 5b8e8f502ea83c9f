//! What is wrong with a scene's text in, one located message for a person out.
//!
//! ```text
//! scene.toml:7:9: `cuboid.size` must be three numbers, each from 1e-100 to 1e100; found `-4.0`
//!   |
//! 7 | size = [-4.0, 3.0, 2.0]
//!   |         ^^^^
//! ```
//!
//! Rule: every message has this form, TOML's own syntax errors included, is a few lines long whatever the text, and
//! brings no control character of the text to the terminal.

use std::io;
use std::ops::Range;
use std::string::FromUtf8Error;

/// Why there is no scene. The display of either kind is the whole message, without a line break at its end.
#[derive(Debug, thiserror::Error)]
pub enum SceneError {
    /// The file could not be read.
    #[error("cannot read the scene {path:?}: {cause}{hint}")]
    Unreadable {
        /// As given.
        path: String,
        /// What the system says.
        cause: io::Error,
        /// What else may have been meant, or nothing.
        hint: String,
    },
    /// The text is no valid scene.
    #[error("{file}:{line}:{column}: {message}\n{excerpt}")]
    Invalid {
        /// The scene's name, or the path as given.
        file: String,
        /// Counted from 1.
        line: usize,
        /// In characters, counted from 1.
        column: usize,
        /// The key, what was found and what is allowed.
        message: String,
        /// The line, and carets below what is wrong.
        excerpt: String,
    },
}

/// What is wrong, and the bytes of the text that say so.
#[derive(Debug)]
pub struct Fault {
    span: Range<usize>,
    message: String,
}

/// Longer lines are shown in part, and so are longer values: in characters.
const WIDEST_LINE: usize = 100;
const WIDEST_VALUE: usize = 40;

impl Fault {
    /// A fault at the bytes `span` of the text.
    pub fn new(span: Range<usize>, message: String) -> Self {
        Fault { span, message }
    }

    /// What TOML itself refuses, in the words of the other messages.
    pub fn syntax(text: &str, error: &toml::de::Error) -> Self {
        let Some(span) = error.span() else {
            // The one error without a place is a dotted key of more than 80 parts.
            let start = text
                .split_inclusive('\n')
                .take_while(|line| line.matches('.').count() < 80)
                .map(str::len)
                .sum();
            return Fault::new(start..start, "a key of more than 80 parts".to_owned());
        };
        let found = found(text, &span);
        let message = match error.message() {
            "duplicate key" if ["`cuboid`", "`light`", "`camera`"].contains(&&*found) => {
                let kind = found.trim_matches('`');
                format!(
                    "{found} is here twice; each {kind} is to be headed `[[{kind}]]`, in double brackets"
                )
            }
            "duplicate key" => format!("the key {found} is here twice"),
            "string values must be quoted, expected literal string" => {
                format!(
                    "not a value; allowed are a number, true, false, \"text\" and [an array]; found {found}"
                )
            }
            message => format!(
                "{}; found {found}",
                message.trim_end_matches(", expected nothing")
            ),
        };
        Fault::new(span, message)
    }

    /// The fault as told to a person: `text` is what it is in, `file` what that is called.
    pub fn locate(self, file: &str, text: &str) -> SceneError {
        let (line, column) = position(text, self.span.start);
        SceneError::Invalid {
            file: printable(file),
            line,
            column,
            excerpt: excerpt(text, &self.span, line, column),
            message: self.message,
        }
    }
}

/// The error for a file that is not text.
pub fn not_utf8(path: &str, error: &FromUtf8Error) -> SceneError {
    let start = error.utf8_error().valid_up_to();
    let byte = error.as_bytes()[start];
    let message = format!("a scene must be UTF-8 text; found the byte {byte:#04x}");
    Fault::new(start..start, message).locate(path, &String::from_utf8_lossy(error.as_bytes()))
}

/// Line and column of the byte `offset`, counted from 1; the end of the text where `offset` is inside no character.
pub fn position(text: &str, offset: usize) -> (usize, usize) {
    let before = text.get(..offset).unwrap_or(text);
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    (
        before.matches('\n').count() + 1,
        before[line_start..].chars().count() + 1,
    )
}

/// What stands at `span`, for a message: quoted, in one line, cut where it is long.
pub fn found(text: &str, span: &Range<usize>) -> String {
    let mut rest = text.get(span.start..).unwrap_or_default().chars();
    if span.is_empty() {
        return match rest.next() {
            None => "the end of the file".to_owned(),
            Some('\n' | '\r') => "the end of the line".to_owned(),
            Some(next) => format!("`{}`", printable(next.encode_utf8(&mut [0; 4]))),
        };
    }
    let value = text.get(span.clone()).unwrap_or_default();
    format!("`{}`", shortened(value.chars(), WIDEST_VALUE))
}

/// The line the span starts in, with carets below the part of the span that is in it.
fn excerpt(text: &str, span: &Range<usize>, line: usize, column: usize) -> String {
    let content = text.split('\n').nth(line - 1).unwrap_or_default();
    let content = content.strip_suffix('\r').unwrap_or(content);
    // Of a long line, the part around the column is shown.
    let (skipped, ellipsis) = if column > WIDEST_LINE {
        (column - WIDEST_LINE / 2, "…")
    } else {
        (0, "")
    };
    let shown = shortened(content.chars().skip(skipped), WIDEST_LINE);

    let indent = column - 1 - skipped;
    let value = text.get(span.clone()).unwrap_or_default();
    let first_line = value.lines().next().unwrap_or_default();
    let carets = first_line.chars().count().clamp(1, WIDEST_LINE - indent);

    let gutter = " ".repeat(line.to_string().len());
    let indent = " ".repeat(indent + ellipsis.chars().count());
    let carets = "^".repeat(carets);
    format!("{gutter} |\n{line} | {ellipsis}{shown}\n{gutter} | {indent}{carets}")
}

/// The first `widest` characters, printable, and whether there are more.
fn shortened(mut characters: impl Iterator<Item = char>, widest: usize) -> String {
    let start: String = characters.by_ref().take(widest).collect();
    let more = characters.next().map_or("", |_| "…");
    printable(&start) + more
}

/// `text` without what would move the cursor or worse: one column for every character.
fn printable(text: &str) -> String {
    text.chars()
        .map(|character| match character {
            '\t' | '\n' | '\r' => ' ',
            control if control.is_control() => char::REPLACEMENT_CHARACTER,
            other => other,
        })
        .collect()
}
