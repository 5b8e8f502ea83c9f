//! What is wrong with a scene's text in, one located message for a person out.
//!
//! ```text
//! scene.toml:7:9: `cuboid.size`: invalid value: number `-4.0`, expected a number from 1e-100 to 1e100
//!   |
//! 7 | size = [-4.0, 3.0, 2.0]
//!   |         ^^^^
//! ```
//!
//! Rule: every message has this form, TOML's own syntax errors included, is a few lines long whatever the text, and
//! contains no control character of the text.

use std::io;
use std::ops::Range;
use std::string::FromUtf8Error;

use toml::de::DeTable;

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

/// Longer lines and messages are shown in part: in characters.
const WIDEST_LINE: usize = 100;
const WIDEST_MESSAGE: usize = 400;

/// What a scene has several of.
const KINDS: [&str; 3] = ["cuboid", "light", "camera"];

impl Fault {
    /// A fault at the bytes `span` of the text.
    pub fn new(span: Range<usize>, message: String) -> Self {
        Fault { span, message }
    }

    /// What TOML or serde refuse, in their words, after the key.
    pub fn of_toml(text: &str, mut error: toml::de::Error) -> Self {
        let Some(span) = error.span() else {
            let start = start_of_long_key(text);
            return Fault::new(start..start, "a key of more than 80 parts".to_owned());
        };
        // Without the text the error says the key instead of showing the line.
        error.set_input(None);
        let said = error.to_string();
        let found = text.get(span.clone()).unwrap_or_default();
        let message = match said.trim_end().rsplit_once("\nin ") {
            Some((message, key)) => format!("{key}: {message}"),
            None if error.message() == "duplicate key" && KINDS.contains(&found) => {
                format!("duplicate key; head each {found} with `[[{found}]]`, in double brackets")
            }
            None if error.message().starts_with("string values must be quoted")
                && found.is_empty() =>
            {
                "a value is missing".to_owned()
            }
            None => said
                .trim_end()
                .trim_end_matches(", expected nothing")
                .to_owned(),
        };
        Fault::new(span, message)
    }

    /// The fault as told to a person: `text` is what it is in, `file` what that is called.
    pub fn locate(self, file: &str, text: &str) -> SceneError {
        let (line, column) = line_and_column(text, self.span.start);
        SceneError::Invalid {
            file: printable(file),
            line,
            column,
            excerpt: excerpt(text, &self.span, line, column),
            message: shortened(self.message.chars(), WIDEST_MESSAGE),
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
pub fn line_and_column(text: &str, offset: usize) -> (usize, usize) {
    let before = text.get(..offset).unwrap_or(text);
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    let line = before.matches('\n').count() + 1;
    let column = before[line_start..].chars().count() + 1;
    (line, column)
}

/// Where the line starts that has a key of too many parts: the one error of TOML's parser without a place.
fn start_of_long_key(text: &str) -> usize {
    let lines: Vec<&str> = text.split_inclusive('\n').collect();
    let start = |line: usize| lines[..line].iter().map(|line| line.len()).sum();
    let has_long_key = |line: &usize| {
        let (_, errors) = DeTable::parse_recoverable(&text[..start(line + 1)]);
        errors.iter().any(|error| error.span().is_none())
    };
    let numbers: Vec<usize> = (0..lines.len()).collect();
    start(numbers.partition_point(|line| !has_long_key(line)))
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
    text.replace(['\t', '\n', '\r'], " ")
        .replace(char::is_control, "\u{fffd}")
}
