//! A line of text in, pixels out: antialiased Noto Sans Mono, mixed over what is there.
//!
//! Rule: nothing outside the buffer is touched, wherever the text lies; the part inside is drawn as if the buffer had
//! no edge.

use noto_sans_mono_bitmap::{FontWeight, RasterizedChar, get_raster, get_raster_width};

pub use noto_sans_mono_bitmap::RasterHeight;

/// Width and height in pixels of `string` set in lines of `height`.
pub fn measure(string: &str, height: RasterHeight) -> [usize; 2] {
    [
        string.chars().count() * get_raster_width(FontWeight::Regular, height),
        height.val(),
    ]
}

/// Draws `string` in `color` (0x00RRGGBB) with its top left corner at (`x`, `y`) of a picture `width` pixels wide.
///
/// A character the font lacks is drawn as `?`.
pub fn text(
    pixels: &mut [u32],
    width: usize,
    [x, y]: [i64; 2],
    string: &str,
    height: RasterHeight,
    color: u32,
) {
    let advance = get_raster_width(FontWeight::Regular, height) as i64;
    for (position, character) in string.chars().enumerate() {
        if let Some(raster) = raster(character, height) {
            glyph(
                pixels,
                width,
                [x + position as i64 * advance, y],
                &raster,
                color,
            );
        }
    }
}

fn raster(character: char, height: RasterHeight) -> Option<RasterizedChar> {
    let drawn = |character| get_raster(character, FontWeight::Regular, height);
    drawn(character).or_else(|| drawn('?'))
}

fn glyph(pixels: &mut [u32], width: usize, [x, y]: [i64; 2], raster: &RasterizedChar, color: u32) {
    for (line, coverages) in (y..).zip(raster.rows()) {
        let Ok(line) = usize::try_from(line) else {
            continue;
        };
        let Some(row) = pixels.chunks_exact_mut(width).nth(line) else {
            return;
        };
        for (column, &coverage) in (x..).zip(coverages) {
            if let Some(pixel) = usize::try_from(column)
                .ok()
                .and_then(|column| row.get_mut(column))
            {
                *pixel = mix(*pixel, color, coverage);
            }
        }
    }
}

/// `below` where `coverage` is 0, `above` where it is 255, and to the nearest level between; 0x00RRGGBB.
fn mix(below: u32, above: u32, coverage: u8) -> u32 {
    let share = u32::from(coverage);
    [16, 8, 0]
        .map(|shift| {
            let [below, above] = [below, above].map(|color| color >> shift & 0xff);
            ((below * (255 - share) + above * share + 127) / 255) << shift
        })
        .iter()
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    const WHITE: u32 = 0x00ff_ffff;

    fn drawn(at: [i64; 2], string: &str, [width, height]: [usize; 2]) -> Vec<u32> {
        let mut pixels = vec![0; width * height];
        text(&mut pixels, width, at, string, RasterHeight::Size16, WHITE);
        pixels
    }

    #[test]
    fn text_stays_within_its_measure() {
        let [width, height] = measure("Phong", RasterHeight::Size16);
        let pixels = drawn([0, 0], "Phong", [width + 20, height + 20]);
        let inside = |index: usize| index % (width + 20) < width && index / (width + 20) < height;
        assert!(
            pixels
                .iter()
                .enumerate()
                .all(|(index, &pixel)| pixel == 0 || inside(index))
        );
        assert!(
            pixels.contains(&WHITE),
            "a stroke is fully covered somewhere"
        );
    }

    #[test]
    fn text_over_an_edge_is_the_visible_part_of_the_whole() {
        let whole = drawn([40, 40], "Wide", [120, 96]);
        for (x, y) in [(-13, -5), (30, 20), (-200, 3), (5, 300)] {
            let part = drawn([x, y], "Wide", [40, 24]);
            for (index, &pixel) in part.iter().enumerate() {
                let [column, row] = [(index % 40) as i64 - x + 40, (index / 40) as i64 - y + 40];
                let inside = (0..120).contains(&column) && (0..96).contains(&row);
                let expected = if inside {
                    whole[(row * 120 + column) as usize]
                } else {
                    0
                };
                assert_eq!(pixel, expected, "text at ({x}, {y}), pixel {index}");
            }
        }
    }

    #[test]
    fn a_character_the_font_lacks_is_a_question_mark() {
        assert_eq!(
            drawn([0, 0], "\u{4e2d}", [20, 20]),
            drawn([0, 0], "?", [20, 20])
        );
    }

    #[test]
    fn mixing_ends_at_both_colours_and_rounds_between() {
        assert_eq!(mix(0x0012_3456, 0x00ab_cdef, 0), 0x0012_3456);
        assert_eq!(mix(0x0012_3456, 0x00ab_cdef, 255), 0x00ab_cdef);
        // 200 * 128 / 255 = 100.39 and 255 * 127 / 255 = 127.
        assert_eq!(mix(0x0000_00ff, 0x00c8_0000, 128), 0x0064_007f);
    }
}
