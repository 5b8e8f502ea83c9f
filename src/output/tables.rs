//! Tables and paragraphs for a terminal, and tables in Markdown.

use comfy_table::{CellAlignment, ContentArrangement, Row, Table, TableComponent, presets};

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
