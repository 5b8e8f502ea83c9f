//! Reading a TOML file, and messages about it with the place of the mistake.
//!
//! ```text
//! scene.toml:7:8: invalid value: -4.0, expected a number from 1e-100 to 1e100
//!   |
//! 7 | size = [-4.0, 3.0, 2.0]
//!   |        ^^^^^^^^^^^^^^^^
//! ```

use std::ops::Range;

use serde::de::DeserializeOwned;
use serde_path_to_error::{Path, Segment};
use toml::de::{DeTable, DeValue};
use toml::{Spanned, Value};

use super::large;

/// The types in messages of serde, and what users call them.
const TYPES: [(&str, &str); 7] = [
    ("expected f64", "expected a number"),
    ("expected u32", "expected a whole number from 0"),
    ("expected usize", "expected a whole number from 0"),
    ("unit variant, expected string only", "expected a string"),
    ("expected a sequence", "expected an array"),
    ("type: floating point", "type: number"),
    ("type: map", "type: table"),
];

/// The minus of print, which is pasted from documents, and the words about it.
const MINUS: char = '\u{2212}';
const OF_MINUS: &str = "; \u{2212} is U+2212, write -";

/// In characters. Longer lines and messages are cut.
const WIDEST_LINE: usize = 100;
const WIDEST_MESSAGE: usize = 400;

/// Reads a text.
///
/// # Errors
/// The bytes of the mistake, and the message.
pub fn read<T: DeserializeOwned>(text: &str) -> Result<T, (Range<usize>, String)> {
    let located = |key: String, span: Range<usize>, why: String| {
        let found = text.get(span.clone()).unwrap_or_default();
        let message = match found {
            "[cuboid]" | "[light]" | "[camera]" | "[step]" => {
                format!("{found} is one of several tables, expected [{found}]")
            }
            date if date.starts_with(|it: char| it.is_ascii_digit()) => {
                key + &why.replace("type: table", "type: date")
            }
            _ => key + &why,
        };
        (span, message)
    };
    let document = DeTable::parse(text).map_err(|error| {
        let span = error.span().unwrap_or_else(|| deepest_key(text));
        located(String::new(), span, in_words(error.message()))
    })?;
    let document = Spanned::new(0..0, DeValue::Table(document.into_inner()));
    from_value(large::value(&document)).map_err(|(path, why)| {
        let key = match path.to_string() {
            root if root == "." => String::new(),
            key => format!("`{key}`: "),
        };
        located(key, span(&document, &path, &why), why)
    })
}

/// Reads a value.
///
/// # Errors
/// The path of the mistake, and the message.
pub fn from_value<T: DeserializeOwned>(value: Value) -> Result<T, (Path, String)> {
    serde_path_to_error::deserialize(value)
        .map_err(|error| (error.path().clone(), in_words(error.inner().message())))
}

/// The bytes of an unknown key, of the whole array that has an illegal element, or else of the value at the path.
fn span(document: &Spanned<DeValue>, path: &Path, why: &str) -> Range<usize> {
    let (mut key, mut value, mut element) = (0..0, document, document);
    for segment in path {
        match (segment, element.get_ref()) {
            (Segment::Map { key: name }, DeValue::Table(table)) => {
                if let Some((own, below)) = table.get_key_value(&**name) {
                    (key, value, element) = (own.span(), below, below);
                }
            }
            (Segment::Seq { index }, _) => {
                element = element.get_ref().get(*index).unwrap_or(element);
            }
            _ => {}
        }
    }
    match why.split(' ').collect::<Vec<_>>()[..] {
        ["unknown", "field", ..] => key,
        ["invalid", "value:", ..] => value.span(),
        _ => element.span(),
    }
}

/// The line with the most dots. The parser does not say where a key of too many parts is.
fn deepest_key(text: &str) -> Range<usize> {
    let deepest = text.lines().max_by_key(|line| line.matches('.').count());
    let line = deepest.unwrap_or_default().trim();
    let start = line.as_ptr().addr() - text.as_ptr().addr();
    start..start + line.len()
}

/// A message of serde in the words of users.
pub fn in_words(message: &str) -> String {
    let in_words = |message: String, (name, words)| message.replace(name, words);
    let message = TYPES.into_iter().fold(message.to_owned(), in_words);
    if message.contains(MINUS) {
        message + OF_MINUS
    } else {
        message
    }
}

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
    let mut message: String = message.chars().take(WIDEST_MESSAGE).collect();
    if marked.starts_with(MINUS) && !message.ends_with(OF_MINUS) {
        message += OF_MINUS;
    }
    let gutter = " ".repeat(line.to_string().len());
    let (indent, carets) = (" ".repeat(indent), "^".repeat(carets));
    let file = file.replace('\n', "\\n");
    format!(
        "{file}:{line}:{column}: {message}\n{gutter} |\n{line} | {shown}\n{gutter} | {indent}{carets}"
    )
}
