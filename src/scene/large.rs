//! Whole numbers of any size. The readers of TOML take at most 64 bits, so longer ones are written for them in another form.
//!
//! ```text
//! intensity = 100000000000000000000      as in the file
//! intensity = 10000000000000000e004      to be read: the same place and length
//! intensity = "?100000000000000000000"   to be edited, and back; "? is MARK
//! ```

use std::borrow::Cow;
use std::ops::Range;

use toml::Spanned;
use toml::de::{DeInteger, DeTable, DeValue};

/// The beginning of a text that stands for a number. The character is for private use.
const MARK: &str = "\"\u{e000}";

/// The text with its large whole numbers as floats of the same length, so that places in it are those in the text.
pub fn as_floats(text: &str) -> Cow<'_, str> {
    rewritten(text, |token, value| {
        let width = token.len();
        if value.is_infinite() {
            return format!("{value:<width$}");
        }
        // Seventeen digits are those of no other float.
        let scientific = format!("{value:.16e}").replace('.', "");
        let (digits, exponent) = scientific.split_once('e').unwrap_or_default();
        let exponent = exponent.parse().unwrap_or(0) - 16;
        let room = width.saturating_sub(digits.len() + 1);
        let float = format!("{digits}e{exponent:0room$}");
        // In base 16 a number of 64 bits is shorter, and read as it is.
        if float.len() > width {
            token.to_owned()
        } else {
            float
        }
    })
}

/// The text with its large whole numbers as texts.
pub fn as_texts(text: &str) -> Cow<'_, str> {
    rewritten(text, |token, _| format!("{MARK}{token}\""))
}

/// The text with the texts of [`as_texts`] as whole numbers again.
pub fn as_numbers(text: &str) -> String {
    let mut parts = text.split(MARK);
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |text, part| text + &part.replacen('"', "", 1))
}

/// The text with each large whole number as `write` gives it, which receives the number as written and its value.
fn rewritten(text: &str, write: impl Fn(&str, f64) -> String) -> Cow<'_, str> {
    let mut numbers = Vec::new();
    // A text that is no TOML has none.
    if let Ok(document) = DeTable::parse(text) {
        for (_, value) in document.get_ref() {
            collect(value, &mut numbers);
        }
    }
    if numbers.is_empty() {
        return Cow::Borrowed(text);
    }
    numbers.sort_unstable_by_key(|(place, _)| place.start);
    let (mut whole, mut end) = (String::new(), 0);
    for (place, value) in numbers {
        whole += &text[end..place.start];
        end = place.end;
        whole += &write(&text[place], value);
    }
    Cow::Owned(whole + &text[end..])
}

/// Collects the places and values of the whole numbers that do not fit in an `i64`.
fn collect(value: &Spanned<DeValue>, numbers: &mut Vec<(Range<usize>, f64)>) {
    match value.get_ref() {
        DeValue::Integer(integer)
            if i64::from_str_radix(integer.as_str(), integer.radix()).is_err() =>
        {
            numbers.push((value.span(), nearest(integer)));
        }
        DeValue::Array(array) => array.iter().for_each(|it| collect(it, numbers)),
        DeValue::Table(table) => table.values().for_each(|it| collect(it, numbers)),
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
