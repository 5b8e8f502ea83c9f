//! What the colours of an error map mean: title, scale with ticks in levels, and the two colours that are no errors.

use super::{EDGE, NOTHING, color, color_at, position};
use crate::lettering::{self, RasterHeight};

/// In pixels; the scale grows with the picture, up to [`WIDEST`].
pub const WIDTH: usize = 640;
/// In pixels.
pub const HEIGHT: usize = 104;
/// The longest scale, in pixels.
const WIDEST: usize = 1200;
/// 0x00RRGGBB.
pub const PAPER: u32 = 0x0014_1518;
const INK: u32 = 0x00e6_e6e6;
const MARGIN: usize = 20;
const TICKS: [f64; 11] = [0.0, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0, 255.0];

/// Draws the legend into [`HEIGHT`] rows of a picture at least [`WIDTH`] pixels wide.
pub fn draw(pixels: &mut [u32], width: usize, title: &str) {
    let bar = (width - 2 * MARGIN).min(WIDEST);
    write(pixels, width, [MARGIN, 8], title);
    for x in 0..bar {
        let color = color_at(x as f64 / (bar - 1) as f64);
        fill(pixels, width, [MARGIN + x, 30], [1, 14], color);
    }
    for tick in TICKS {
        let x = MARGIN + (position(tick) * (bar - 1) as f64).round() as usize;
        fill(pixels, width, [x, 44], [1, 5], INK);
        let label = tick.to_string();
        let [length, _] = lettering::measure(&label, RasterHeight::Size16);
        write(pixels, width, [x - length / 2, 50], &label);
    }
    let mut x = MARGIN;
    for (color, meaning) in [
        (color(0.0), "no error"),
        (EDGE, "another triangle: not compared"),
        (NOTHING, "nothing drawn"),
    ] {
        fill(pixels, width, [x, 78], [14, 14], INK);
        fill(pixels, width, [x + 1, 79], [12, 12], color);
        write(pixels, width, [x + 22, 77], meaning);
        x += 22 + lettering::measure(meaning, RasterHeight::Size16)[0] + 24;
    }
}

fn write(pixels: &mut [u32], width: usize, [x, y]: [usize; 2], text: &str) {
    let at = [x as i64, y as i64];
    lettering::text(pixels, width, at, text, RasterHeight::Size16, INK);
}

fn fill(
    pixels: &mut [u32],
    width: usize,
    [x, y]: [usize; 2],
    [columns, rows]: [usize; 2],
    color: u32,
) {
    for row in y..y + rows {
        pixels[row * width + x..][..columns].fill(color);
    }
}
