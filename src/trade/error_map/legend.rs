//! The meaning of an error map's colours: a title, the scale with ticks in levels, and the two colours that are no errors.

use egui::{Align2, Color32, FontId, Painter, Rect, StrokeKind, pos2, vec2};

use super::{EDGE, NOTHING, Pixel, Scale, color_at};
use crate::paint::{annotate, color};

/// In pixels; the scale grows with the picture, up to [`WIDEST`].
pub const WIDTH: usize = 640;
/// In pixels.
pub const HEIGHT: usize = 104;
/// The longest scale, in pixels.
const WIDEST: f32 = 1200.0;
/// 0x00RRGGBB.
pub const PAPER: u32 = 0x0014_1518;
const INK: Color32 = Color32::from_gray(230);
const MARGIN: f32 = 20.0;

/// Draws the legend into [`HEIGHT`] rows of a picture at least [`WIDTH`] pixels wide.
pub fn draw(pixels: &mut [u32], width: usize, title: &str) {
    annotate(pixels, [width, HEIGHT], |painter| {
        let write = |x: f32, y: f32, size: f32, text: &str| {
            let font = FontId::proportional(size);
            painter.text(pos2(x, y), Align2::LEFT_CENTER, text, font, INK)
        };
        write(MARGIN, 15.0, 16.0, title);
        let length = (width as f32 - 2.0 * MARGIN).min(WIDEST);
        let row = Rect::from_min_size(pos2(MARGIN, 30.0), vec2(length, 32.0));
        Scale::WIDEST.draw(painter, row, INK);
        let mut x = MARGIN;
        for (pixel, meaning) in [
            (Scale::WIDEST.color(Pixel::Error(0.0)), "no error"),
            (EDGE, "another face: not compared"),
            (NOTHING, "nothing drawn"),
        ] {
            let swatch = Rect::from_min_size(pos2(x, 78.0), vec2(14.0, 14.0));
            painter.rect(swatch, 0.0, color(pixel), (1.0, INK), StrokeKind::Inside);
            x = write(x + 22.0, 85.0, 15.0, meaning).right() + 24.0;
        }
    });
}

impl Scale {
    /// Draws its colours from the left, and below them the errors in levels that they stand for.
    pub fn draw(self, painter: &Painter, row: Rect, ink: Color32) {
        let (top, middle, half) = (row.top(), row.center().y, row.height() / 2.0);
        let column = |x: f32, top: f32| Rect::from_x_y_ranges(x..=x + 1.0, top..=middle);
        // Half of the last tick's letters stand right of it.
        let last = row.width() - row.height();
        for x in (0..=last as u16).map(f32::from) {
            let shade = color(color_at(f64::from(x / last)));
            painter.rect_filled(column(row.left() + x, top), 0.0, shade);
        }
        // Labels that would touch the one to their right are left out.
        let mut free = row.right();
        for tick in self.ticks().into_iter().rev() {
            let x = row.left() + (self.position(tick) as f32 * last).round();
            painter.rect_filled(column(x, middle - half / 4.0), 0.0, ink);
            let font = FontId::monospace(half * 0.8);
            let label = painter.layout_no_wrap(tick.to_string(), font, ink);
            let left = (x - label.size().x / 2.0).max(row.left());
            if left + label.size().x < free {
                painter.galley(pos2(left, middle), label, ink);
                free = left;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_has_its_colours_column_by_column_and_is_the_same_every_time() {
        let drawn = || {
            let mut pixels = vec![PAPER; WIDTH * HEIGHT];
            draw(&mut pixels, WIDTH, "title");
            pixels
        };
        let pixels = drawn();
        assert_eq!(pixels, drawn());
        let row = |y: usize| &pixels[y * WIDTH..][..WIDTH];
        let [first, last] = [20, 588];
        for (x, &pixel) in row(30).iter().enumerate() {
            let share = (x as f64 - first as f64) / (last - first) as f64;
            let inside = (first..=last).contains(&x);
            let expected = if inside { color_at(share) } else { PAPER };
            assert_eq!(pixel, expected, "column {x}");
        }
        assert!(row(29).iter().all(|pixel| *pixel == PAPER));
        // Ticks stand at the scale's ends, in the lowest rows of the colours.
        let ink = |x: usize| color(row(45)[x]) == INK;
        assert!(ink(first) && ink(last) && !ink(first + 1) && !ink(last - 1));
    }
}
