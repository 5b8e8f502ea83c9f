//! What was measured in; numbers, names and clauses for people out.
//!
//! Rule: pure, no more digits than say something, and "-" for what does not exist.

/// Three digits that matter, or fewer; "-" for what does not exist.
pub(crate) fn short(value: Option<f64>) -> String {
    match value {
        None => "-".to_owned(),
        Some(0.0) => "0".to_owned(),
        Some(value) if value < 0.001 => "<0.001".to_owned(),
        Some(value) if value < 1.0 => format!("{value:.3}"),
        Some(value) if value < 10.0 => format!("{value:.2}"),
        Some(value) if value < 100.0 => format!("{value:.1}"),
        Some(value) => format!("{value:.0}"),
    }
}

/// An error in words.
pub(super) fn levels(error: f64) -> String {
    let number = if error < 10.0 {
        short(Some(error))
    } else {
        format!("{error:.0}")
    };
    format!("{number} levels")
}

/// "a", "a and b", "a, b and c".
pub(super) fn listed(clauses: &[String]) -> String {
    match clauses {
        [start @ .., last] if !start.is_empty() => format!("{} and {last}", start.join(", ")),
        _ => clauses.concat(),
    }
}

/// How many times `base` goes into `value`, as text; `None` where it has no end.
pub(super) fn ratio(value: f64, base: f64) -> Option<String> {
    let ratio = value / base;
    ratio.is_finite().then(|| {
        if (0.9..1.1).contains(&ratio) {
            format!("{ratio:.2}")
        } else {
            format!("{ratio:.1}")
        }
    })
}

/// A number with its noun, which an s makes a plural.
pub(crate) fn counted(number: usize, noun: &str) -> String {
    format!("{number} {noun}{}", if number == 1 { "" } else { "s" })
}
