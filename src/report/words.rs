//! Numbers and nouns as text.

pub const CHANNELS: [&str; 3] = ["red", "green", "blue"];

/// A number with three significant digits or fewer; "-" for one that does not exist.
pub fn short(value: impl Into<Option<f64>>) -> String {
    match value.into() {
        None => "-".to_owned(),
        Some(0.0) => "0".to_owned(),
        Some(value) if value < 0.001 => "<0.001".to_owned(),
        Some(value) if value < 0.9995 => format!("{value:.3}"),
        Some(value) if value < 9.995 => format!("{value:.2}"),
        Some(value) if value < 99.95 => format!("{value:.1}"),
        Some(value) => format!("{value:.0}"),
    }
}

/// A number with this many digits after its first.
pub fn rounded(value: f64, digits: usize) -> f64 {
    format!("{value:.digits$e}").parse().unwrap_or(value)
}

/// A number with an exponent and two significant digits or fewer.
pub fn scientific(value: f64) -> String {
    format!("{value:.1e}").replace(".0e", "e")
}

/// An interval as text: a single number if both ends read the same.
pub fn interval(ends: [f64; 2], text: impl Fn(f64) -> String) -> String {
    let [least, most] = ends.map(text);
    // Below 0.001 the lower end is not told.
    if least == most || most == "<0.001" {
        most
    } else {
        format!("{least} to {most}")
    }
}

/// The text with a capital letter first.
pub fn capital(text: &str) -> String {
    let (first, rest) = text.split_at(text.chars().next().map_or(0, char::len_utf8));
    first.to_uppercase() + rest
}

/// A number with its noun, in the plural unless the number is 1.
pub fn counted(number: usize, noun: &str) -> String {
    format!("{number} {noun}{}", if number == 1 { "" } else { "s" })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_short_number_has_three_digits_at_most() {
        for (value, text) in [
            (0.0, "0"),
            (0.0004, "<0.001"),
            (0.9994, "0.999"),
            (0.9996, "1.00"),
            (9.996, "10.0"),
            (99.96, "100"),
            (165.4, "165"),
        ] {
            assert_eq!(short(value), text);
        }
    }
}
