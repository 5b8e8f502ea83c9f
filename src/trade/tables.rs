//! Cells and sentences in; a table or a paragraph for a terminal, or a table in Markdown, out.
//!
//! Rule: pure; on a terminal at most [`WIDTH`] columns as far as cells allow.

use comfy_table::{CellAlignment, Table, TableComponent, presets};

use crate::canvas;

/// Columns of the terminal.
pub const WIDTH: usize = 100;

/// Between two columns of a table.
const GAP: u16 = 2;

/// A table for a terminal, its first column to the left and the others to the right.
pub(crate) fn aligned(head: &[impl ToString], rows: &[Vec<String>]) -> String {
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

/// The same in Markdown.
pub(super) fn markdown(head: &[&str], rows: &[Vec<String>]) -> String {
    let row = |cells: &str| format!("| {cells} |\n");
    let rule = format!("|---{}|\n", "|---:".repeat(head.len() - 1));
    let rows: Vec<String> = rows.iter().map(|cells| row(&cells.join(" | "))).collect();
    row(&head.join(" | ")) + &rule + &rows.concat()
}

/// The same words in lines of at most [`WIDTH`] columns.
pub(crate) fn wrapped(text: &str) -> String {
    canvas::wrapped(text, WIDTH).join("\n")
}
