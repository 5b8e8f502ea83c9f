//! Words in, letters on a canvas out: antialiased Noto Sans Mono in fixed sizes, and words cut or broken to fit.
//!
//! Rule: every letter of a face is equally wide, so that words can be measured by counting.

use noto_sans_mono_bitmap::{
    FontWeight, RasterHeight, RasterizedChar, get_raster, get_raster_width,
};

use super::{Canvas, Ink, Point};

/// Letters of one size; every letter is equally wide.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Face {
    raster: RasterHeight,
    scale: i32,
}

/// Every size of letters, from the smallest that is legible to one for a wall.
pub const FACES: [Face; 7] = [
    Face::new(RasterHeight::Size16, 1),
    Face::new(RasterHeight::Size20, 1),
    Face::new(RasterHeight::Size24, 1),
    Face::new(RasterHeight::Size32, 1),
    Face::new(RasterHeight::Size20, 2),
    Face::new(RasterHeight::Size24, 2),
    Face::new(RasterHeight::Size32, 2),
];

impl Face {
    const fn new(raster: RasterHeight, scale: i32) -> Self {
        Face { raster, scale }
    }

    /// Pixels from one letter to the next.
    pub fn advance(self) -> i32 {
        get_raster_width(FontWeight::Regular, self.raster) as i32 * self.scale
    }

    /// Pixels from the top of the tallest letter to the bottom of the deepest.
    pub fn height(self) -> i32 {
        self.raster.val() as i32 * self.scale
    }

    /// How wide so many letters are, in pixels.
    pub fn width(self, letters: usize) -> i32 {
        letters as i32 * self.advance()
    }
}

/// `text` in at most so many letters; one that is cut ends in two dots.
pub fn fit(text: &str, letters: usize) -> String {
    if text.chars().count() <= letters {
        return text.to_owned();
    }
    let dots = if letters > 4 { 2 } else { 0 };
    text.chars()
        .take(letters - dots)
        .chain("..".chars().take(dots))
        .collect()
}

/// `text` in lines of at most `letters`, broken between words where that is possible.
pub fn wrapped(text: &str, letters: usize) -> Vec<String> {
    let (mut lines, mut line, mut used) = (Vec::new(), String::new(), 0);
    for word in text.split_whitespace() {
        let length = word.chars().count();
        if used > 0 && used + length < letters {
            line.push(' ');
            used += 1;
        } else if used > 0 {
            lines.push(std::mem::take(&mut line));
            used = 0;
        }
        for letter in word.chars() {
            if used == letters {
                lines.push(std::mem::take(&mut line));
                used = 0;
            }
            line.push(letter);
            used += 1;
        }
    }
    lines.push(line);
    lines
}

impl Canvas<'_> {
    /// A line of text whose first letter's box has its upper left corner at `at`; returns where the next letter starts.
    ///
    /// A letter that the font lacks shows as a question mark rather than as nothing.
    pub fn text(&mut self, face: Face, at: Point, ink: Ink, text: &str) -> i32 {
        self.letters(face, FontWeight::Regular, at, ink, text)
    }

    /// The same in bold letters, which are as wide.
    pub fn bold(&mut self, face: Face, at: Point, ink: Ink, text: &str) -> i32 {
        self.letters(face, FontWeight::Bold, at, ink, text)
    }

    fn letters(
        &mut self,
        face: Face,
        weight: FontWeight,
        [mut x, y]: Point,
        ink: Ink,
        text: &str,
    ) -> i32 {
        let raster = |letter| get_raster(letter, weight, face.raster);
        for letter in text.chars() {
            if let Some(raster) = raster(letter).or_else(|| raster('?')) {
                self.letter(&raster, face.scale, [x, y], ink);
            }
            x += face.advance();
        }
        x
    }

    /// Every pixel of `raster` as a square of `scale` pixels.
    fn letter(&mut self, raster: &RasterizedChar, scale: i32, [x, y]: Point, ink: Ink) {
        for (row, line) in (0..).zip(raster.rows()) {
            for (column, coverage) in (0..).zip(line).filter(|(_, coverage)| **coverage > 0) {
                let [left, top] = [x + column * scale, y + row * scale];
                for dy in 0..scale {
                    for dx in 0..scale {
                        self.blend(left + dx, top + dy, ink, f32::from(*coverage) / 255.0);
                    }
                }
            }
        }
    }
}
