//! Reading a TOML file, and messages about it with the place of the mistake.
//!
//! ```text
//! scene.toml:7:8: `cuboid[0].size[0]`: invalid value: -4.0, expected a number from 1e-100 to 1e100
//!   |
//! 7 | size = [-4.0, 3.0, 2.0]
//!   |        ^^^^^^^^^^^^^^^^
//! ```
//! A whole number of more than 64 bits, which TOML does not have, is read as a float.

use std::collections::HashMap;
use std::ops::Range;

use anyhow::anyhow;
use serde::de::DeserializeOwned;
use serde_path_to_error::Segment;
use toml::de::{DeInteger, DeString, DeTable, DeValue};
use toml::{Spanned, Value};

use crate::components::numbers::number_of;

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

/// An illegal value: the parts of its key from the top of the file on, with the index of an entity or of an element, and what
/// is wrong.
#[derive(Debug, thiserror::Error)]
#[error("{}{why}", quoted(path))]
pub struct Mistake {
    pub path: Vec<String>,
    pub why: String,
}

/// The key before its message: "`light[0].color[2]`: ".
fn quoted(path: &[String]) -> String {
    let part = |part: &String| match part.parse::<usize>() {
        Ok(index) => format!("[{index}]"),
        Err(_) => format!(".{part}"),
    };
    let key = path.iter().map(part).collect::<String>();
    match key.strip_prefix('.') {
        Some(key) => format!("`{key}`: "),
        None => String::new(),
    }
}

impl Mistake {
    /// A mistake at a key, whose parts are separated by dots; the empty key is the whole table.
    pub fn new(key: &str, why: impl Into<String>) -> Self {
        let parts = key.split('.').filter(|part| !part.is_empty());
        Mistake {
            path: parts.map(str::to_owned).collect(),
            why: why.into(),
        }
    }

    /// The mistake in a table or an array that holds the value at `part`.
    pub fn within(mut self, part: &str) -> Self {
        self.path.insert(0, part.to_owned());
        self
    }

    /// The message about the mistake in a text of this name.
    pub fn located(&self, name: &str, text: &str) -> anyhow::Error {
        let span = self.span(text);
        match text.get(span.clone()) {
            Some(found @ ("[cuboid]" | "[light]" | "[camera]" | "[step]")) => {
                let message = format!("{found} is one of several tables, expected [{found}]");
                located(name, text, &span, &message)
            }
            _ => located(name, text, &span, &self.to_string()),
        }
    }

    /// The bytes of an unknown key, of the whole array that has an illegal element, or else of the value; of a key that is
    /// missing, those of its table.
    pub fn span(&self, text: &str) -> Range<usize> {
        let table = DeTable::parse(text).map(Spanned::into_inner);
        let document = Spanned::new(0..0, DeValue::Table(table.unwrap_or_default()));
        let (mut key, mut value, mut element) = (0..0, &document, &document);
        for part in &self.path {
            match element.get_ref() {
                DeValue::Table(table) => {
                    if let Some((own, below)) = table.get_key_value(&**part) {
                        (key, value, element) = (own.span(), below, below);
                    }
                }
                DeValue::Array(all) => {
                    let index = part.parse::<usize>().ok();
                    element = index.and_then(|index| all.get(index)).unwrap_or(element);
                }
                _ => {}
            }
        }
        match self.why.split(' ').collect::<Vec<_>>()[..] {
            ["unknown", "field", ..] => key,
            ["invalid", "value:", ..] => value.span(),
            _ => element.span(),
        }
    }
}

/// Whether a table of a text has a key.
pub fn has(text: &str, table: &str, key: &str) -> bool {
    let document = DeTable::parse(text).ok();
    let table = document.as_ref().and_then(|it| it.get_ref().get(table));
    table.is_some_and(|it| it.get_ref().get(key).is_some())
}

/// Reads a text. Errors carry `name`.
///
/// # Errors
/// The first mistake, with its place.
pub fn read<T: DeserializeOwned>(name: &str, text: &str) -> anyhow::Result<T> {
    let document = DeTable::parse(text).map_err(|error| {
        let span = error.span().unwrap_or_default();
        located(name, text, &span, &in_words(error.message()))
    })?;
    let document = Spanned::new(0..0, DeValue::Table(document.into_inner()));
    from_value(value(&document)).map_err(|mistake| mistake.located(name, text))
}

/// Reads a value.
///
/// # Errors
/// The first number out of its range, or else the first mistake.
pub fn from_value<T: DeserializeOwned>(mut value: Value) -> Result<T, Mistake> {
    check_numbers("", &mut value)?;
    serde_path_to_error::deserialize(value).map_err(|error| Mistake {
        path: error.path().iter().map(part).collect(),
        why: in_words(error.inner().message()),
    })
}

/// The part of a path: the name of a key, or the index of an element.
fn part(segment: &Segment) -> String {
    match segment {
        Segment::Seq { index } => index.to_string(),
        name => name.to_string(),
    }
}

/// Checks the numbers in the value at a key, and makes 0 of -0: pictures are compared bit by bit.
fn check_numbers(key: &str, value: &mut Value) -> Result<(), Mistake> {
    let number = match value {
        Value::Table(table) => {
            return table.iter_mut().try_for_each(|(key, value)| {
                check_numbers(key, value).map_err(|mistake| mistake.within(key))
            });
        }
        Value::Array(all) => {
            return all.iter_mut().enumerate().try_for_each(|(index, value)| {
                check_numbers(key, value).map_err(|mistake| mistake.within(&index.to_string()))
            });
        }
        Value::Integer(whole) => *whole as f64,
        Value::Float(number) => {
            *number += 0.0;
            *number
        }
        _ => return Ok(()),
    };
    match number_of(key) {
        Some(known) if !known.is_legal(number) => {
            let why = format!("invalid value: {number:?}, expected {}", known.words());
            Err(Mistake::new("", why))
        }
        _ => Ok(()),
    }
}

/// A message of serde in the words of users.
fn in_words(message: &str) -> String {
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
pub fn located(file: &str, text: &str, span: &Range<usize>, message: &str) -> anyhow::Error {
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
    anyhow!(
        "{file}:{line}:{column}: {message}\n{gutter} |\n{line} | {shown}\n{gutter} | {indent}{carets}"
    )
}

/// A value as read from a text. No key has a date, which is a table here: every type refuses it.
fn value(read: &Spanned<DeValue>) -> Value {
    match read.get_ref() {
        DeValue::String(text) => Value::from(&**text),
        DeValue::Integer(integer) => {
            whole(integer).map_or_else(|| Value::Float(nearest(integer)), Value::Integer)
        }
        DeValue::Float(float) => Value::Float(float.as_str().parse().unwrap_or(f64::NAN)),
        DeValue::Boolean(is) => Value::Boolean(*is),
        DeValue::Datetime(date) => HashMap::from([(date.to_string(), true)]).into(),
        DeValue::Array(all) => Value::Array(all.iter().map(value).collect()),
        DeValue::Table(table) => {
            let entry = |(key, it): (&Spanned<DeString>, _)| (key.get_ref().to_string(), value(it));
            Value::Table(table.iter().map(entry).collect())
        }
    }
}

/// The number, if it fits in 64 bits.
fn whole(integer: &DeInteger) -> Option<i64> {
    i64::from_str_radix(integer.as_str(), integer.radix()).ok()
}

/// The nearest float.
fn nearest(integer: &DeInteger) -> f64 {
    let radix = integer.radix();
    if radix == 10 {
        return integer.as_str().parse().unwrap_or(f64::NAN);
    }
    // The last bit stays set once a lower one was, so that only the last conversion rounds.
    let digits = integer.as_str().chars().filter_map(|it| it.to_digit(radix));
    let (head, more) = digits.fold((0_u128, 0), |(head, more), digit| {
        if head >> 120 == 0 {
            (head * u128::from(radix) + u128::from(digit), more)
        } else {
            (head | u128::from(digit > 0), more + 1)
        }
    });
    head as f64 * f64::from(radix).powi(more)
}

/// The text with each whole number of more than 64 bits as a float: the editor of TOML reads no other.
pub fn with_floats(text: &str) -> String {
    let (mut large, mut edited) = (Vec::new(), text.to_owned());
    // A text that is no TOML has none.
    if let Ok(document) = DeTable::parse(text) {
        let values = document.get_ref().values();
        values.for_each(|it| add_large(it, &mut large));
    }
    large.sort_unstable_by_key(|(place, _)| place.start);
    for (place, number) in large.into_iter().rev() {
        edited.replace_range(place, &format!("{number:?}"));
    }
    edited
}

/// Adds the places and the values of the whole numbers that do not fit in 64 bits.
fn add_large(value: &Spanned<DeValue>, large: &mut Vec<(Range<usize>, f64)>) {
    match value.get_ref() {
        DeValue::Integer(integer) if whole(integer).is_none() => {
            large.push((value.span(), nearest(integer)));
        }
        DeValue::Array(array) => array.iter().for_each(|it| add_large(it, large)),
        DeValue::Table(table) => table.values().for_each(|it| add_large(it, large)),
        _ => {}
    }
}
