//! Writes the pixels of a square into a band, as displayed bytes or as levels.
//!
//! Only covered pixels in the rows of the band are written, and with a depth buffer only those that show this face.

use std::ops::Range;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, mask32x16, u32x16};

use crate::frame::{Band, Counts, OUTLINE, face};
use crate::shading::TileKind;
use crate::shading::face::Face;
use crate::shading::pixels::Pixels;
use crate::shading::rows::Rows;
use crate::shading::square::{MAX_SIDE, Spans, Square};
use crate::simd::three;

/// The pixels of a band that a piece covers.
pub struct Canvas<'a, 'b> {
    pub band: &'a mut Band<'b>,
    pub spans: Spans<'a>,
    /// The number of the face's first triangle.
    pub id: u32,
    /// The square that is drawn next, and the number of its pixels that are seen.
    pub square: Square,
    pub seen: usize,
    pub counts: &'a mut Counts,
}

impl Canvas<'_, '_> {
    /// The rows of the square that are covered and in the band.
    fn rows(&self) -> Range<usize> {
        self.band.held(self.square.covered_rows())
    }

    /// The number of pixels of a square that are drawn here: in this band, and not hidden.
    #[inline(always)]
    pub fn seen_pixels(&self, square: &Square) -> usize {
        let rows = self.band.held(square.covered_rows());
        let is_shown = self.band.depths.is_empty() && rows == square.covered_rows();
        if is_shown || square.pixels == 0 {
            return square.pixels;
        }
        let spans = self.spans.clipped(rows, square.columns);
        let seen = spans.map(|(row, span)| {
            if self.band.depths.is_empty() {
                return span.len();
            }
            let ids = self.band.triangles[self.band.indices(row, &span)].iter();
            let seen = ids.map(|id| u32::from(face(*id) == face(self.id)));
            seen.sum::<u32>() as usize
        });
        seen.sum()
    }

    /// Whether all pixels of the square are drawn, as bytes.
    pub fn is_whole(&self) -> bool {
        !self.band.pixels.is_empty() && self.seen == self.square.side * self.square.side
    }

    /// Lists the pixels of the square at which the piece is visible. Returns the number of strips that these pixels lie in.
    #[inline(always)]
    pub fn list<S: Simd>(&self, simd: S, pixels: &mut Pixels) -> u64 {
        pixels.count = 0;
        let [left, top] = self.square.first().map(|first| first as f32);
        let (mut strips, mut last) = (0, None);
        for (row, span) in self.spans.clipped(self.rows(), self.square.columns) {
            if span.is_empty() {
                continue;
            }
            let y = top + (row - self.square.corner[1]) as i32 as f32;
            let before = pixels.count;
            for first in span.clone().step_by(16) {
                let x = left + (first - self.square.corner[0]) as i32 as f32;
                let mut seen = self.seen_lanes(simd, first, row, first..span.end.min(first + 16));
                // Each run of seen pixels.
                while seen != 0 {
                    let start = seen.trailing_zeros();
                    let count = (seen >> start).trailing_ones();
                    let index = self.band.index(first, row) + start as usize;
                    pixels.extend(simd, [x + start as i32 as f32, y], index, count as usize);
                    seen &= u32::MAX << (start + count);
                }
            }
            if pixels.count > before && last.replace(row / MAX_SIDE) != Some(row / MAX_SIDE) {
                strips += 1;
            }
        }
        strips
    }

    /// Draws listed pixels.
    #[inline(always)]
    pub fn draw_pixels<S: Simd>(&mut self, simd: S, pixels: &Pixels) {
        self.counts.covered_pixels += pixels.count as u64;
        if self.band.pixels.is_empty() {
            for (index, levels) in pixels.levels() {
                self.band.levels[index] = levels;
            }
        } else {
            pixels.show(simd, self.band.pixels);
        }
    }

    /// Counts the square as `tiles` tiles of a kind. Records the kind and the visible triangles if the frame keeps them.
    pub fn finish(&mut self, kind: TileKind, tiles: u64, drawn: &Face) {
        self.counts.tiles[kind as usize] += tiles;
        if !self.band.kinds.is_empty() {
            self.mark(kind, drawn);
        }
    }

    #[inline(never)]
    fn mark(&mut self, kind: TileKind, drawn: &Face) {
        let Square {
            corner, columns, ..
        } = self.square;
        let origin = drawn.rays.lens.half;
        for (row, span) in self.spans.clipped(self.rows(), columns) {
            for column in span {
                let pixel = self.band.index(column, row);
                if face(self.band.triangles[pixel]) == face(self.id) {
                    let [x, y] = [0, 1].map(|axis| [column, row][axis] as f64 + 0.5 - origin[axis]);
                    let second = u32::from(drawn.diagonal.at(x, y) < 0.0);
                    self.band.triangles[pixel] = self.id + second;
                    let edge = row == corner[1] || column == corner[0];
                    self.band.kinds[pixel] = kind as u8 | if edge { OUTLINE } else { 0 };
                }
            }
        }
    }

    /// Writes all pixels of a square that nothing hides, as bytes.
    #[inline(always)]
    fn draw_whole<S: Simd>(&mut self, rows: &mut impl Rows<S>) {
        let Square {
            corner: [left, top],
            side,
            ..
        } = self.square;
        let start = self.band.index(0, top);
        for part in 0..side / 16 {
            rows.go_to(part);
            let first = left + 16 * part;
            let lines = self.band.pixels[start..].chunks_exact_mut(self.band.width);
            for (row, line) in lines.take(side).enumerate() {
                line[first..first + 16].copy_from_slice(rows.pixels(row).as_slice());
            }
        }
        self.counts.covered_pixels += self.square.pixels as u64;
    }

    /// A bit for each of the sixteen pixels from `first` in a row: whether `span` covers it and it shows this face.
    #[inline(always)]
    fn seen_lanes<S: Simd>(&self, simd: S, first: usize, row: usize, span: Range<usize>) -> u32 {
        let covered = (1 << (span.end - first)) - (1 << (span.start - first));
        if self.band.triangles.is_empty() {
            return covered;
        }
        let ids = &self.band.triangles[self.band.index(first, row)..];
        let seen = if let Some(ids) = ids.first_chunk::<16>() {
            let faces = u32x16::simd_from(simd, *ids) >> 1;
            let seen = faces.simd_eq(u32x16::splat(simd, face(self.id)));
            seen.to_bitmask() as u32
        } else {
            // The last row of the band ends before.
            ids.iter().enumerate().fold(0, |seen, (lane, id)| {
                seen | u32::from(face(*id) == face(self.id)) << lane
            })
        };
        seen & covered
    }

    /// Draws the seen pixels of the square with the colours of these rows.
    #[inline(always)]
    pub fn draw<S: Simd>(&mut self, simd: S, rows: &mut impl Rows<S>) {
        if self.is_whole() {
            return self.draw_whole(rows);
        }
        let held = self.rows();
        let [left, top] = self.square.corner;
        for part in self.square.parts() {
            rows.go_to(part);
            let first = left + 16 * part;
            for (row, span) in self.spans.clipped(held.clone(), [first, first + 16]) {
                if span.is_empty() {
                    continue;
                }
                let seen = self.seen_lanes(simd, first, row, span);
                self.counts.covered_pixels += u64::from(seen.count_ones());
                let start = self.band.index(first, row);
                let lanes = (0..16).filter(|lane| seen >> lane & 1 == 1);
                if self.band.pixels.is_empty() {
                    let levels = rows.levels(row - top);
                    for lane in lanes {
                        self.band.levels[start + lane] = three!(|channel| levels[channel][lane]);
                    }
                } else {
                    let new = rows.pixels(row - top);
                    if let Some(line) = self.band.pixels[start..].first_chunk_mut::<16>() {
                        let seen = mask32x16::from_bitmask(simd, seen.into());
                        *line = *seen.select(new, u32x16::simd_from(simd, *line));
                    } else {
                        // The last row of the band ends before.
                        for lane in lanes {
                            self.band.pixels[start + lane] = new[lane];
                        }
                    }
                }
            }
        }
    }
}
