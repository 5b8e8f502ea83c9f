//! What the colours of an error map mean: title, scale with ticks in levels, and the two colours that are no errors.

use super::{EDGE, NOTHING, color, color_at, position};
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
const TICKS: [f64; 11] = [0.0, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0, 255.0];

/// Draws the legend into [`HEIGHT`] rows of a picture at least [`WIDTH`] pixels wide.
pub fn draw(pixels: &mut [u32], width: usize, title: &str) {
    let canvas = &mut Canvas::new(pixels, [width, HEIGHT]);
    let bar = (width as i32 - 2 * MARGIN).min(WIDEST);
    canvas.text(FACE, [MARGIN, 8], INK, title);
    draw_scale(
        canvas,
        FACE,
        Rect::new(MARGIN, 30, bar, 2 * FACE.height()),
        INK,
    );
    let mut x = MARGIN;
    for (color, meaning) in [
        (color(0.0), "no error"),
        (EDGE, "another face: not compared"),
        (NOTHING, "nothing drawn"),
    ] {
        let swatch = Rect::new(x, 78, 14, 14);
        canvas.fill(swatch, INK);
        canvas.fill(swatch.inset(1), Ink::solid(color));
        x = canvas.text(FACE, [x + 22, 77], INK, meaning) + 24;
    }
}

/// The colours of the scale from the left, and below them the errors in levels that they stand for.
pub fn draw_scale(canvas: &mut Canvas, face: Face, row: Rect, ink: Ink) {
    let half = row.height / 2;
    // Half of the last tick's letters stand right of it.
    let length = row.width - face.width(2);
    for x in 0..length {
        let share = f64::from(x) / f64::from((length - 1).max(1));
        let color = Ink::solid(color_at(share));
        canvas.fill(Rect::new(row.x + x, row.y, 1, half), color);
    }
    for tick in TICKS {
        let x = row.x + (position(tick) * f64::from(length - 1)).round() as i32;
        canvas.fill(Rect::new(x, row.y + half * 3 / 4, 1, half / 4), ink);
        let label = tick.to_string();
        let left = (x - face.width(label.len()) / 2).max(row.x);
        canvas.text(face, [left, row.y + half], ink, &label);
    }
}
