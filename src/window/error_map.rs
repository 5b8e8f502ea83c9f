//! The errors of a picture in colours, and the legend of the colours.
//!
//! The scale runs from 0 to 255 levels, evenly in log(1 + 4 error), so small errors are visible beside large ones. All
//! pictures have this scale, so their colours can be compared.

use egui::{Color32, FontId, Painter, Rect, pos2};

use crate::output::paint::color;
use crate::questions::metrics::Pixel;
use crate::systems::frame::display_pixel;

/// The colour of a pixel at which neither picture shows a cuboid, 0x00RRGGBB.
pub const NOTHING: u32 = 0x005c_6166;

/// The colour of a pixel at which the pictures show different faces, 0x00RRGGBB.
pub const EDGE: u32 = 0x0035_c28a;

/// Coefficients of 1, t, t^2, ... for red, green and blue, 0..=1.
///
/// Fitted by least squares to every eighth colour of magma (van der Walt and Smith 2015, matplotlib, CC0). The difference to
/// magma is less than 6 of 255.
const MAGMA: [[f64; 7]; 3] = [
    [
        -0.0011, 0.2559, 8.0863, -26.0652, 48.3106, -46.6983, 17.1074,
    ],
    [0.0014, 0.6091, -2.692, 10.3584, -20.0632, 21.5885, -8.8214],
    [0.0023, 2.207, 2.4994, -20.8892, 24.8291, -5.2793, -2.6193],
];

/// The errors with a label, in levels.
const TICKS: [f64; 11] = [0.0, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0, 255.0];

/// The position of an error in levels on the scale, 0..=1.
pub fn position(error: f64) -> f64 {
    ((4.0 * error).ln_1p() / 1020.0_f64.ln_1p()).clamp(0.0, 1.0)
}

/// The colour of a pixel, 0x00RRGGBB.
pub fn color_of(pixel: Pixel) -> u32 {
    match pixel {
        Pixel::Error(error) => color_at(position(error)),
        Pixel::Edge => EDGE,
        Pixel::Nothing => NOTHING,
    }
}

/// Draws the colours from left to right, and the errors of the ticks below them.
pub fn draw_scale(painter: &Painter, row: Rect, ink: Color32) {
    let (top, middle, half) = (row.top(), row.center().y, row.height() / 2.0);
    let column = |x: f32, top: f32| Rect::from_x_y_ranges(x..=x + 1.0, top..=middle);
    // Half of the last label is to the right of its tick.
    let last = row.width() - row.height();
    for x in (0..=last as u16).map(f32::from) {
        let shade = color(color_at(f64::from(x / last)));
        painter.rect_filled(column(row.left() + x, top), 0.0, shade);
    }
    // A label that would touch the one to its right is left out.
    let mut free = row.right();
    for tick in TICKS.into_iter().rev() {
        let x = row.left() + (position(tick) as f32 * last).round();
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

fn color_at(position: f64) -> u32 {
    display_pixel(MAGMA.map(|coefficients| {
        let powers = coefficients.iter().rev();
        255.0 * powers.fold(0.0, |sum, c| sum * position + c)
    }))
}

#[cfg(test)]
mod tests {
    use egui::vec2;

    use super::*;
    use crate::components::TriangleId;
    use crate::output::paint::annotate;
    use crate::questions::metrics::{Picture, compared};

    const WIDTH: usize = 640;
    const PAPER: u32 = 0x0014_1518;

    /// A scale from column 20 to column 588, and below its colours, from row 16 on, its labels.
    fn scale() -> Vec<u32> {
        let mut pixels = vec![PAPER; WIDTH * 32];
        annotate(&mut pixels, [WIDTH, 32], |ui| {
            let row = Rect::from_min_size(pos2(20.0, 0.0), vec2(600.0, 32.0));
            draw_scale(ui.painter(), row, Color32::WHITE);
        });
        pixels
    }

    #[test]
    fn labels_are_centred_below_the_scale_and_apart() {
        let pixels = scale();
        let rows: Vec<&[u32]> = pixels.chunks_exact(WIDTH).skip(16).collect();
        let is_inked = |column: &usize| rows.iter().any(|row| row[*column] != PAPER);
        let inked: Vec<usize> = (0..WIDTH).filter(is_inked).collect();
        let gaps = inked.windows(2).filter(|pair| pair[1] - pair[0] > 4);
        assert_eq!(gaps.count() + 1, TICKS.len());
        let [first, last] = [inked[0], inked[inked.len() - 1]];
        assert!(
            (20..24).contains(&first) && (592..604).contains(&last),
            "{first} {last}"
        );
    }

    #[test]
    fn a_column_of_the_scale_has_the_colour_of_its_share_and_the_ends_have_ticks() {
        let pixels = scale();
        let [first, last] = [20, 588];
        for (x, &pixel) in pixels[..WIDTH].iter().enumerate() {
            let share = (x as f64 - first as f64) / (last - first) as f64;
            let is_inside = (first..=last).contains(&x);
            let expected = if is_inside { color_at(share) } else { PAPER };
            assert_eq!(pixel, expected, "column {x}");
        }
        let is_ink = |x: usize| color(pixels[15 * WIDTH + x]) == Color32::WHITE;
        assert!(is_ink(first) && is_ink(last) && !is_ink(first + 1) && !is_ink(last - 1));
    }

    #[test]
    fn the_colours_are_magma() {
        // matplotlib's magma at 0, 128/255 and 1, times 255.
        for (at, expected) in [
            (0.0, [0, 0, 4]),
            (128.0 / 255.0, [183, 55, 121]),
            (1.0, [252, 253, 191]),
        ] {
            let [_, found @ ..] = color_at(at).to_be_bytes();
            let near = found.iter().zip(expected).all(|(a, b)| a.abs_diff(b) <= 6);
            assert!(near, "{found:?} is not {expected:?}");
        }
    }

    #[test]
    fn the_scale_runs_from_none_to_all() {
        assert_eq!([0.0, 255.0].map(position), [0.0, 1.0]);
        // ln(1 + 4 * 0.5) / ln(1 + 4 * 255) = ln 3 / ln 1021.
        assert!((position(0.5) - 3.0_f64.ln() / 1021.0_f64.ln()).abs() < 1e-12);
    }

    #[test]
    fn background_edges_and_errors_are_told_apart() {
        let left = Picture {
            width: 2,
            levels: &[[0.0; 3], [0.0; 3], [9.0; 3], [300.0; 3]],
            triangles: &[
                TriangleId::NONE,
                TriangleId(0),
                TriangleId(1),
                TriangleId(1),
            ],
        };
        let right = Picture {
            levels: &[[0.0; 3]; 4],
            triangles: &[
                TriangleId::NONE,
                TriangleId(2),
                TriangleId(1),
                TriangleId(0),
            ],
            ..left
        };
        let found: Vec<Pixel> = compared(left, right).collect();
        let errors = [9.0, 255.0].map(Pixel::Error);
        assert_eq!(found, [Pixel::Nothing, Pixel::Edge, errors[0], errors[1]]);
        let colors = found.into_iter().map(color_of);
        let expected = [NOTHING, EDGE, color_at(0.506_5), color_at(1.0)];
        for (color, expected) in colors.zip(expected) {
            let [color, expected] = [color, expected].map(u32::to_be_bytes);
            let near = color.iter().zip(expected).all(|(a, b)| a.abs_diff(b) <= 8);
            assert!(near, "{color:?} is not {expected:?}");
        }
    }
}
