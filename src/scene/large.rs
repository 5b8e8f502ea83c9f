//! Whole numbers of any size. TOML's have at most 64 bits: longer ones are read as floats, and written as they were.
//!
//! ```text
//! intensity = 100000000000000000000      as in the file
//! intensity = "?100000000000000000000"   to be edited, and back; "? is MARK
//! ```

use std::collections::HashMap;
use std::ops::Range;

use toml::de::{DeInteger, DeString, DeTable, DeValue};
use toml::{Spanned, Value};

/// The beginning of a text that stands for a number. The character is for private use.
const MARK: &str = "\"\u{e000}";

/// A value as read from a text. No key has a date, which is a table here: every type refuses it.
pub fn value(read: &Spanned<DeValue>) -> Value {
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

/// The text with its large whole numbers as texts.
pub fn as_texts(text: &str) -> String {
    let mut places = Vec::new();
    // A text that is no TOML has none.
    if let Ok(document) = DeTable::parse(text) {
        let values = document.get_ref().values();
        values.for_each(|it| collect(it, &mut places));
    }
    places.sort_unstable_by_key(|place| place.start);
    let (mut marked, mut end) = (String::new(), 0);
    for place in places {
        marked.extend([&text[end..place.start], MARK, &text[place.clone()], "\""]);
        end = place.end;
    }
    marked + &text[end..]
}

/// The text with the texts of [`as_texts`] as whole numbers again.
pub fn as_numbers(text: &str) -> String {
    let mut parts = text.split(MARK);
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |text, part| text + &part.replacen('"', "", 1))
}

/// Collects the places of the whole numbers that do not fit in 64 bits.
fn collect(value: &Spanned<DeValue>, places: &mut Vec<Range<usize>>) {
    match value.get_ref() {
        DeValue::Integer(integer) if whole(integer).is_none() => places.push(value.span()),
        DeValue::Array(array) => array.iter().for_each(|it| collect(it, places)),
        DeValue::Table(table) => table.values().for_each(|it| collect(it, places)),
        _ => {}
    }
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
