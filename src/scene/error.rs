//! Why there is no scene: one located message for a person.
//!
//! ```text
//! scene.toml:7:9: `cuboid.size`: invalid value: number `-4.0`, expected a number from 1e-100 to 1e100
//!   |
//! 7 | size = [-4.0, 3.0, 2.0]
//!   |         ^^^^
//! ```
//!
//! Every message has this form, is a few lines long whatever the text, and contains no control character of the text.

use std::fmt::Debug;
use std::io;
use std::ops::{Range, RangeInclusive};
use std::string::FromUtf8Error;

use glam::DVec3;

use super::range::words;

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

/// A table of a scene: what it is, and which of its kind; or one number of the background.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    kind: &'static str,
    index: usize,
    /// Which number of the key.
    element: Option<usize>,
}

impl Place {
    pub fn new(kind: &'static str, index: usize) -> Self {
        Place {
            kind,
            index,
            element: None,
        }
    }

    /// Whether the value `found` at a key is legal.
    pub fn is(
        &self,
        key: &'static str,
        found: impl Debug,
        is_legal: bool,
        expected: &str,
    ) -> Result<(), Mistake> {
        if is_legal {
            return Ok(());
        }
        let message = format!("invalid value: {found:?}, expected {expected}");
        Err(self.mistake(key, message))
    }

    /// Whether the number at a key is within its range.
    pub fn number(
        &self,
        key: &'static str,
        number: f64,
        range: &RangeInclusive<f64>,
    ) -> Result<(), Mistake> {
        if range.contains(&number) {
            return Ok(());
        }
        self.is(key, number, false, &words(range))
    }

    /// Whether the three numbers at a key are within their range.
    pub fn three(
        &self,
        key: &'static str,
        numbers: DVec3,
        range: &RangeInclusive<f64>,
    ) -> Result<(), Mistake> {
        (0..3).try_for_each(|axis| {
            let element = Some(axis);
            Place { element, ..*self }.number(key, numbers[axis], range)
        })
    }

    /// The mistake at a key.
    pub fn mistake(&self, key: &'static str, message: String) -> Mistake {
        Mistake {
            place: *self,
            key,
            message,
        }
    }
}

/// What a scene may not say, and at which key.
#[derive(Debug, thiserror::Error)]
#[error("`{}{}{key}`: {message}", place.kind, if key.is_empty() { "" } else { "." })]
pub struct Mistake {
    place: Place,
    /// With points between its parts; empty is the whole table.
    key: &'static str,
    message: String,
}

impl Mistake {
    /// The bytes of the text that say it, or the table that does not.
    pub(super) fn span(&self, text: &str) -> Range<usize> {
        let span = toml_edit::Document::parse(text).ok().and_then(|document| {
            let all = document.get(self.place.kind)?;
            let mut said = all.get(self.place.index).unwrap_or(all);
            for key in self.key.split('.') {
                said = said.get(key).unwrap_or(said);
            }
            let element = self.place.element.and_then(|element| said.get(element));
            element.unwrap_or(said).span()
        });
        span.unwrap_or(0..0)
    }
}

/// The bytes that toml's error is about, and its key and message.
pub fn told(mut error: toml::de::Error) -> (Range<usize>, String) {
    let span = error.span().unwrap_or(0..0);
    // Without the text the error says the key instead of showing the line.
    error.set_input(None);
    let said = error.to_string();
    let message = match said.trim_end().rsplit_once("\nin ") {
        Some((message, key)) => format!("{key}: {message}"),
        None => said.trim_end().to_owned(),
    };
    (span, message)
}

/// The error for the bytes of a text that are wrong; `file` is what the text is called.
pub fn located(file: &str, text: &str, span: &Range<usize>, message: &str) -> SceneError {
    let (line, column) = line_and_column(text, span.start);
    SceneError::Invalid {
        file: printable(file),
        line,
        column,
        excerpt: excerpt(text, span, line, column),
        message: shortened(message.chars(), WIDEST_MESSAGE),
    }
}

/// The error for a file that is not text.
pub fn not_utf8(path: &str, error: &FromUtf8Error) -> SceneError {
    let start = error.utf8_error().valid_up_to();
    let byte = error.as_bytes()[start];
    let message = format!("a scene must be UTF-8 text; found the byte {byte:#04x}");
    let text = String::from_utf8_lossy(error.as_bytes());
    located(path, &text, &(start..start), &message)
}

/// Line and column of the byte `offset`, counted from 1; the end of the text where `offset` is inside no character.
fn line_and_column(text: &str, offset: usize) -> (usize, usize) {
    let before = text.get(..offset).unwrap_or(text);
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    let line = before.matches('\n').count() + 1;
    let column = before[line_start..].chars().count() + 1;
    (line, column)
}

/// Longer lines and messages are shown in part: in characters.
const WIDEST_LINE: usize = 100;
const WIDEST_MESSAGE: usize = 400;

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
    text.replace(['\t', '\n', '\r'], " ")
        .replace(char::is_control, "\u{fffd}")
}
