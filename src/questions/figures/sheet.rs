//! A sheet of labelled pictures: cells of equal size in rows under a title.
//!
//! ```text
//! title
//! +---------+   +---------+
//! | picture |   | picture |
//! +---------+   +---------+
//! label         label           in several lines if it is long
//! ```

use std::sync::Arc;

use egui::{Align2, FontId, Galley, Painter, Rect, StrokeKind, pos2, vec2};

use crate::output::paint::{annotate, color};

const PAPER: u32 = 0x0024_2429;
const FRAME: u32 = 0x003c_3c44;
const BRIGHT: u32 = 0x00f0_f0f2;

/// The empty border of a sheet, in pixels.
const MARGIN: usize = 40;
/// Between two cells.
const GAP: usize = 32;
/// From a picture to its label, and from the title to the pictures.
const LABEL_GAP: usize = 10;
const TITLE_GAP: usize = 24;

/// The least heights of texts in pixels, and their fonts.
const TITLE_HEIGHT: usize = 32;
const LABEL_HEIGHT: usize = 24;
const TITLE: FontId = FontId::proportional(28.0);
const LABEL: FontId = FontId::proportional(19.0);

/// The pixels of a picture of a sheet, row by row from the top, and its label.
pub type Cell = (Vec<u32>, String);

/// Cells whose pictures have this width and height, in rows of `columns` under a `title`. Returns pixels, width and height.
pub fn sheet(
    title: &str,
    columns: usize,
    cells: &[Cell],
    [cell_width, cell_height]: [usize; 2],
) -> (Vec<u32>, [usize; 2]) {
    let top = MARGIN + TITLE_HEIGHT + TITLE_GAP;
    let mut label_height = LABEL_HEIGHT;
    annotate(&mut [PAPER], [1, 1], |ui| {
        let labels = cells.iter().map(|it| label(ui.painter(), it, cell_width));
        let heights = labels.map(|it| it.size().y.ceil() as usize);
        label_height = heights.fold(label_height, usize::max);
    });
    let row_height = cell_height + LABEL_GAP + label_height;
    let rows = cells.len().div_ceil(columns);
    let width = 2 * MARGIN + columns * cell_width + (columns - 1) * GAP;
    let height = top + rows * row_height + rows.saturating_sub(1) * GAP + MARGIN;
    let place = |index: usize| {
        let x = MARGIN + index % columns * (cell_width + GAP);
        [x, top + index / columns * (row_height + GAP)]
    };

    let size = [width, height];
    let mut pixels = vec![PAPER; width * height];
    for (index, (picture, _)) in cells.iter().enumerate() {
        let [x, y] = place(index);
        for (row, line) in (y..).zip(picture.chunks_exact(cell_width)) {
            pixels[row * width + x..][..cell_width].copy_from_slice(line);
        }
    }
    annotate(&mut pixels, size, |ui| {
        let painter = ui.painter();
        let corner = pos2(MARGIN as f32, MARGIN as f32);
        painter.text(corner, Align2::LEFT_TOP, title, TITLE, color(BRIGHT));
        for (index, cell) in cells.iter().enumerate() {
            let [x, y] = place(index).map(|at| at as f32);
            let size = vec2(cell_width as f32, cell_height as f32);
            let picture = Rect::from_min_size(pos2(x, y), size);
            let frame = (1.0, color(FRAME));
            painter.rect_stroke(picture, 0.0, frame, StrokeKind::Outside);
            let below = picture.left_bottom() + vec2(0.0, LABEL_GAP as f32);
            painter.galley(below, label(painter, cell, cell_width), color(BRIGHT));
        }
    });
    (pixels, size)
}

/// The label of a cell, no wider than its picture.
fn label(painter: &Painter, (_, label): &Cell, width: usize) -> Arc<Galley> {
    painter.layout(label.clone(), LABEL, color(BRIGHT), width as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sheet_shows_every_picture_completely_and_leaves_its_margin_empty() {
        let colors = [
            0x0010_0000,
            0x0020_0000,
            0x0030_0000,
            0x0040_0000,
            0x0050_0000,
        ];
        let cells = colors.map(|color| (vec![color; 60 * 40], "A b".to_owned()));
        let (pixels, [width, height]) = sheet("Title", 3, &cells, [60, 40]);
        for color in colors {
            assert_eq!(
                pixels.iter().filter(|&&pixel| pixel == color).count(),
                60 * 40
            );
        }
        assert_eq!(pixels.len(), width * height);
        let title = &pixels[..(MARGIN + TITLE_HEIGHT) * width];
        assert!(title.iter().any(|&pixel| pixel != PAPER));
        assert!(!title.iter().any(|pixel| colors.contains(pixel)));
        for (index, &pixel) in pixels.iter().enumerate() {
            let [x, y] = [index % width, index / width];
            let inside = (MARGIN - 1..=width - MARGIN).contains(&x)
                && (MARGIN - 1..=height - MARGIN).contains(&y);
            assert!(inside || pixel == PAPER, "ink in the margin at ({x}, {y})");
        }
    }
}
