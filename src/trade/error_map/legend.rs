//! What the colours of an error map mean: title, scale with ticks in levels, and the two colours that are no errors.

use super::{EDGE, NOTHING, Pixel, Scale, color_at};
use crate::canvas::{Canvas, FACES, Face, Ink, Rect};

/// In pixels; the scale grows with the picture, up to [`WIDEST`].
pub const WIDTH: usize = 640;
/// In pixels.
pub const HEIGHT: usize = 104;
/// The longest scale, in pixels.
const WIDEST: i32 = 1200;
/// 0x00RRGGBB.
pub const PAPER: u32 = 0x0014_1518;
const INK: Ink = Ink::solid(0x00e6_e6e6);
const FACE: Face = FACES[0];
const MARGIN: i32 = 20;

/// Draws the legend into [`HEIGHT`] rows of a picture at least [`WIDTH`] pixels wide.
pub fn draw(pixels: &mut [u32], width: usize, title: &str) {
    let canvas = &mut Canvas::new(pixels, [width, HEIGHT]);
    let bar = (width as i32 - 2 * MARGIN).min(WIDEST);
    canvas.text(FACE, [MARGIN, 8], INK, title);
    let row = Rect::new(MARGIN, 30, bar, 2 * FACE.height());
    Scale::WIDEST.draw(canvas, FACE, row, INK);
    let mut x = MARGIN;
    for (color, meaning) in [
        (Scale::WIDEST.color(Pixel::Error(0.0)), "no error"),
        (EDGE, "another face: not compared"),
        (NOTHING, "nothing drawn"),
    ] {
        let swatch = Rect::new(x, 78, 14, 14);
        canvas.fill(swatch, INK);
        canvas.fill(swatch.inset(1), Ink::solid(color));
        x = canvas.text(FACE, [x + 22, 77], INK, meaning) + 24;
    }
}

impl Scale {
    /// Draws its colours from the left, and below them the errors in levels that they stand for.
    pub(crate) fn draw(self, canvas: &mut Canvas, face: Face, row: Rect, ink: Ink) {
        let half = row.height / 2;
        // Half of the last tick's letters stand right of it.
        let length = row.width - face.width(3);
        for x in 0..length {
            let share = f64::from(x) / f64::from((length - 1).max(1));
            let color = Ink::solid(color_at(share));
            canvas.fill(Rect::new(row.x + x, row.y, 1, half), color);
        }
        // Labels that would touch the one to their right are left out.
        let mut free = row.right();
        for tick in self.ticks().into_iter().rev() {
            let x = row.x + (self.position(tick) * f64::from(length - 1)).round() as i32;
            canvas.fill(Rect::new(x, row.y + half * 3 / 4, 1, half / 4), ink);
            let label = tick.to_string();
            let left = (x - face.width(label.len()) / 2).max(row.x);
            if left + face.width(label.len()) < free {
                canvas.text(face, [left, row.y + half], ink, &label);
                free = left;
            }
        }
    }
}
