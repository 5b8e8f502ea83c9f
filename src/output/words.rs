//! Numbers, paragraphs and tables as text.

use comfy_table::{CellAlignment, ContentArrangement, Row, Table, TableComponent, presets};

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

/// The speed of one thing against another, from the ranges of their times: "2.1 to 2.3 times as fast as". Ranges that overlap,
/// or come as near as half a percent, are no measurable difference.
pub fn pace(one: [f64; 2], other: [f64; 2]) -> String {
    let (fast, slow, word) = if one[1] < other[0] {
        (one, other, "fast")
    } else {
        (other, one, "slow")
    };
    let [least, most] = [slow[0] / fast[1], slow[1] / fast[0]];
    // Just above 1, three digits.
    let text = |ratio| rounded(ratio, if ratio < 1.1 { 2 } else { 1 }).to_string();
    if least.is_nan() || least < 1.005 {
        "no measurable difference in time from".to_owned()
    } else if most.is_finite() {
        format!("{} times as {word} as", interval([least, most], text))
    } else {
        // The smaller time is too short for the clock.
        format!("{word}er than")
    }
}

/// The largest range of a ratio that is told, as the ratio of its ends.
const NARROW: f64 = 1.5;

/// Whether the ratio of two times is known well, from their ranges. A time that is too short for the clock has none.
pub fn is_narrow(one: [f64; 2], other: [f64; 2]) -> bool {
    let range = one[1] / one[0] * (other[1] / other[0]);
    range <= NARROW || !range.is_finite()
}

/// As [`pace`], where the ratio is known well.
pub fn sure_pace(one: [f64; 2], other: [f64; 2]) -> String {
    if is_narrow(one, other) {
        pace(one, other)
    } else {
        "not sure yet how fast against".to_owned()
    }
}

/// Texts in a row, with a separator between.
pub fn joined(texts: impl IntoIterator<Item = String>, separator: &str) -> String {
    texts.into_iter().collect::<Vec<_>>().join(separator)
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

/// The width of a paragraph, in columns of the terminal.
const WIDTH: usize = 80;

/// Columns of the terminal between two columns of a table.
const GAP: u16 = 2;

/// A table for a terminal. Its first column is aligned to the left, the others to the right.
pub fn aligned(head: &[impl ToString], rows: impl IntoIterator<Item: Into<Row>>) -> String {
    let mut table = Table::new();
    table.load_preset(presets::NOTHING);
    table.set_style(TableComponent::HeaderLines, '\u{2500}');
    table.set_style(TableComponent::MiddleHeaderIntersections, '\u{2500}');
    table.set_header(head.iter().map(ToString::to_string));
    table.add_rows(rows);
    for (index, column) in table.column_iter_mut().enumerate() {
        let gap = if index == 0 { 0 } else { GAP };
        column.set_padding((gap, 0));
        if index > 0 {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    table.trim_fmt()
}

/// The same table in Markdown.
pub fn markdown(head: &[&str], rows: impl IntoIterator<Item: AsRef<[String]>>) -> String {
    let row = |cells: &str| format!("| {cells} |\n");
    let rule = format!("|---{}|\n", "|---:".repeat(head.len() - 1));
    let mut text = row(&head.join(" | ")) + &rule;
    text.extend(
        rows.into_iter()
            .map(|cells| row(&cells.as_ref().join(" | "))),
    );
    text
}

/// The words of a text in lines of at most `WIDTH` columns.
pub fn wrapped(text: &str) -> String {
    let mut table = Table::new();
    table.load_preset(presets::NOTHING).add_row([text]);
    table.set_content_arrangement(ContentArrangement::Dynamic);
    table.set_width(WIDTH as u16);
    for column in table.column_iter_mut() {
        column.set_padding((0, 0));
    }
    table.trim_fmt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pace_is_the_range_of_the_ratios_of_two_times() {
        for (one, other, text) in [
            ([1.0, 1.1], [2.2, 4.4], "2 to 4.4 times as fast as"),
            ([2.2, 4.4], [1.0, 1.1], "2 to 4.4 times as slow as"),
            ([0.162, 0.164], [0.339, 0.343], "2.1 times as fast as"),
            ([1.0, 1.0], [1.04, 1.2], "1.04 to 1.2 times as fast as"),
            (
                [1.0, 2.0],
                [1.9, 9.0],
                "no measurable difference in time from",
            ),
            (
                [1.0, 1.0],
                [1.004, 1.1],
                "no measurable difference in time from",
            ),
            (
                [0.0, 0.0],
                [0.0, 0.0],
                "no measurable difference in time from",
            ),
            ([0.0, 0.0], [0.1, 0.2], "faster than"),
        ] {
            assert_eq!(pace(one, other), text);
        }
    }

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

    #[test]
    fn numbers_end_where_their_heading_ends() {
        let table = aligned(&["id", "ms"], [["gouraud", "1"]]);
        let lines: Vec<&str> = table.lines().collect();
        assert_eq!([lines[0], lines[2]], ["id        ms", "gouraud    1"]);
    }

    #[test]
    fn a_paragraph_keeps_its_words_in_lines_of_at_most_the_width() {
        let words = "levels of 255, \u{b5}s ".repeat(40);
        let paragraph = wrapped(&words);
        assert!(paragraph.split_whitespace().eq(words.split_whitespace()));
        let width = |text: &str| text.chars().count();
        let lines: Vec<&str> = paragraph.lines().collect();
        for pair in lines.windows(2) {
            let next = pair[1].split(' ').next().unwrap_or_default();
            assert!(width(pair[0]) <= WIDTH);
            assert!(width(pair[0]) + 1 + width(next) > WIDTH);
        }
    }
}
