//! Rows of a square in, pixels of a band out: the display step fused into the store, or the levels themselves.
//!
//! Rule: only covered pixels of rows that the band holds are written, and where there is a depth buffer only pixels that
//! show this face.

use std::ops::Range;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, i32x16, u32x16};

use crate::frame::{Band, OUTLINE, face};
use crate::shading::display::Rows;
use crate::shading::face::Face;
use crate::shading::pixels::Pixels;
use crate::shading::square::{Spans, Square};
use crate::shading::{Shader, Sink, TileKind};
use crate::simd::three;

/// Stores the pixels of one square.
pub struct Store<'a, 'b> {
    band: &'a mut Band<'b>,
    spans: &'a Spans<'a>,
    square: &'a Square,
    /// Of the face's first triangle.
    id: u32,
    /// How many pixels were drawn; not counted where all are.
    drawn: u64,
}

impl<'a, 'b> Store<'a, 'b> {
    /// For a square of a face.
    pub fn new(band: &'a mut Band<'b>, spans: &'a Spans<'a>, square: &'a Square, id: u32) -> Self {
        Store {
            band,
            spans,
            square,
            id,
            drawn: 0,
        }
    }

    /// The rows of the square that are covered and in the band.
    fn rows(&self) -> Range<usize> {
        self.band.held(self.square.covered_rows())
    }

    /// Notes how the square was drawn, and the triangles seen there, where the frame keeps that; how many of its pixels were
    /// drawn. `picture` is its middle, in pixels from its corner.
    #[inline]
    pub fn finish(mut self, kind: TileKind, shader: &Shader, picture: [f64; 2]) -> u64 {
        if !self.band.kinds.is_empty() {
            self.mark(kind, shader.face(), picture);
        }
        if self.band.is_plain() && self.rows() == self.square.covered_rows() {
            self.square.pixels as u64
        } else {
            self.drawn
        }
    }

    #[inline(never)]
    fn mark(&mut self, kind: TileKind, shown: &Face, picture: [f64; 2]) {
        let Square { place, columns, .. } = *self.square;
        for (row, span) in self.spans.clipped(self.rows(), columns) {
            let first = self.band.index(0, row);
            for column in span {
                if face(self.band.triangles[first + column]) == face(self.id) {
                    let [x, y] =
                        [0, 1].map(|axis| [column, row][axis] as f64 + 0.5 - picture[axis]);
                    let second = u32::from(shown.diagonal.at(x, y) < 0.0);
                    self.band.triangles[first + column] = self.id + second;
                    let edge = row == place[1] || column == place[0];
                    self.band.kinds[first + column] = kind as u8 | if edge { OUTLINE } else { 0 };
                }
            }
        }
    }

    /// Pixels one by one.
    #[inline(always)]
    pub fn draw_pixels<S: Simd>(&mut self, simd: S, pixels: &Pixels) {
        self.drawn = pixels.count() as u64;
        if self.band.pixels.is_empty() {
            for (index, levels) in pixels.levels() {
                self.band.levels[index] = levels;
            }
        } else {
            pixels.show(simd, self.band.pixels);
        }
    }

    /// All pixels, where nothing hides them and the band takes bytes.
    #[inline(always)]
    fn draw_whole<S: Simd>(&mut self, rows: &mut impl Rows<S>) {
        let Square {
            place: [left, top],
            side,
            ..
        } = *self.square;
        let start = self.band.index(0, top);
        for part in 0..side / 16 {
            rows.go_to(part);
            let first = left + 16 * part;
            let lines = self.band.pixels[start..].chunks_exact_mut(self.band.width);
            for (row, line) in lines.take(side).enumerate() {
                line[first..first + 16].copy_from_slice(rows.pixels(row).as_slice());
            }
        }
    }

    /// The covered pixels, where nothing hides them and the band takes bytes.
    #[inline(always)]
    fn draw_spans<S: Simd>(&mut self, rows: &mut impl Rows<S>) {
        const LANES: [i32; 16] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];
        let [left, top] = self.square.place;
        let held = self.rows();
        let (stride, start) = (self.band.width, self.band.index(0, held.start));
        let pixels = &mut *self.band.pixels;
        for part in self.square.parts() {
            rows.go_to(part);
            let first = left + 16 * part;
            let width = (stride - first).min(16);
            let spans = self.spans.clipped(held.clone(), [first, first + 15]);
            for ((row, span), line) in spans.zip((start + first..).step_by(stride)) {
                if span.is_empty() {
                    continue;
                }
                self.drawn += span.len() as u64;
                let new = rows.pixels(row - top);
                let (from, to) = (span.start - first, span.end - first);
                let line = &mut pixels[line..][..width];
                if let Ok(line) = <&mut [u32; 16]>::try_from(&mut *line) {
                    let lanes = i32x16::simd_from(new.token(), LANES);
                    let covered = lanes.simd_ge(from as i32) & lanes.simd_lt(to as i32);
                    *line = *covered.select(new, u32x16::simd_from(new.token(), *line));
                } else {
                    line[from..to].copy_from_slice(&new.as_array()[from..to]);
                }
            }
        }
    }

    /// The covered pixels that show this face, as bytes or as levels.
    #[inline(always)]
    fn draw_seen<S: Simd>(&mut self, rows: &mut impl Rows<S>) {
        let [left, top] = self.square.place;
        let own = face(self.id);
        let bytes = !self.band.pixels.is_empty();
        for part in self.square.parts() {
            rows.go_to(part);
            let column = left + 16 * part;
            for (row, span) in self.spans.clipped(self.rows(), [column, column + 15]) {
                if span.is_empty() {
                    continue;
                }
                let (pixels, levels) = if bytes {
                    (Some(rows.pixels(row - top)), None)
                } else {
                    (None, Some(rows.levels(row - top)))
                };
                let first = self.band.index(0, row);
                for x in span {
                    let (pixel, lane) = (first + x, x - column);
                    if face(self.band.triangles[pixel]) != own {
                        continue;
                    }
                    self.drawn += 1;
                    if let Some(pixels) = &pixels {
                        self.band.pixels[pixel] = pixels[lane];
                    } else if let Some(levels) = &levels {
                        self.band.levels[pixel] = three!(|channel| levels[channel][lane]);
                    }
                }
            }
        }
    }
}

impl<S: Simd> Sink<S> for Store<'_, '_> {
    #[inline(always)]
    fn draw(&mut self, rows: &mut impl Rows<S>) {
        if !self.band.is_plain() {
            self.draw_seen(rows);
        } else if self.square.is_whole() && self.rows().len() == self.square.side {
            self.draw_whole(rows);
        } else {
            self.draw_spans(rows);
        }
    }
}
