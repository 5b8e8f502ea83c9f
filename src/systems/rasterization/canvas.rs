//! Writes the pixels of a square into a band, as displayed bytes or as levels.
//!
//! Only covered pixels in the rows of the band are written, and where pieces overlap only those that show this face.

use std::ops::Range;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, mask32x16, u32x16};
use glam::DVec3;

use crate::components::TriangleId;
use crate::shading::display::display_pixel;
use crate::shading::face::Face;
use crate::shading::listed::ListedPixels;
use crate::shading::rows::Rows;
use crate::shading::simd::three;
use crate::shading::square::{MAX_SIDE, Spans, Square};
use crate::shading::{Counts, SquareKind};
use crate::systems::frame::{Band, SQUARE_EDGE, fill};

/// The pixels of a band that a piece covers.
pub struct Canvas<'a, 'b> {
    pub band: &'a mut Band<'b>,
    pub spans: Spans<'a>,
    /// See [`TriangleId::face_id`].
    pub face_id: u32,
    /// In levels.
    pub tolerance: f64,
    /// The pixels of a square that are evaluated one by one.
    pub listed: &'a mut ListedPixels,
    /// The counts of the thread.
    pub counts: &'a mut Counts,
}

impl Canvas<'_, '_> {
    /// The rows of a square that are covered and in the band.
    fn rows(&self, square: &Square) -> Range<usize> {
        self.band.held(square.covered_rows())
    }

    /// The number of pixels of a square that are drawn here: in this band, and not hidden.
    pub fn seen_pixels(&self, square: &Square) -> usize {
        let rows = self.rows(square);
        if rows.is_empty() {
            return 0;
        }
        // A square lies in one strip.
        let overlaps = self.band.overlaps(rows.start);
        if !overlaps && rows == square.covered_rows() {
            return square.covered;
        }
        let spans = self.spans.clipped(rows, square.columns);
        let seen = spans.map(|(row, span)| {
            if !overlaps {
                return span.len();
            }
            let ids = self.band.triangles[self.band.indices(row, &span)].iter();
            let seen = ids.map(|id| u32::from(id.face_id() == self.face_id));
            seen.sum::<u32>() as usize
        });
        seen.sum()
    }

    /// Whether bytes are drawn, and of the whole square; `seen` is the number of pixels drawn.
    pub fn is_whole(&self, square: &Square, seen: usize) -> bool {
        !self.band.bytes.is_empty() && seen == square.side * square.side
    }

    /// Lists the pixels of a square at which the piece is visible.
    #[inline(always)]
    pub fn list<S: Simd>(&mut self, simd: S, square: &Square) {
        self.listed.count = 0;
        let [left, top] = square.first().map(|first| first as f32);
        for (row, span) in self.spans.clipped(self.rows(square), square.columns) {
            let y = top + (row - square.corner[1]) as i32 as f32;
            for first in span.clone().step_by(16) {
                let x = left + (first - square.corner[0]) as i32 as f32;
                let mut seen = self.seen_lanes(simd, first, row, first..span.end.min(first + 16));
                // Each run of seen pixels.
                while seen != 0 {
                    let start = seen.trailing_zeros();
                    let count = (seen >> start).trailing_ones();
                    let index = self.band.index(first, row) + start as usize;
                    let place = [x + start as i32 as f32, y];
                    self.listed.extend(simd, place, index, count as usize);
                    seen &= u32::MAX << (start + count);
                }
            }
        }
    }

    /// The number of strips with listed pixels of a square of [`MIN_SIDE`](crate::shading::square::MIN_SIDE): one or two.
    pub fn strips(&self) -> u64 {
        let row = |index: u32| self.band.rows.start + index as usize / self.band.width;
        let [first, last] = [0, self.listed.count - 1].map(|it| row(self.listed.indices[it]));
        (last / MAX_SIDE - first / MAX_SIDE + 1) as u64
    }

    /// Writes the listed pixels.
    #[inline(always)]
    pub fn write_listed<S: Simd>(&mut self, simd: S) {
        if self.band.bytes.is_empty() {
            for (index, levels) in self.listed.levels() {
                self.band.levels[index] = levels;
            }
        } else {
            self.listed.show(simd, self.band.bytes);
        }
    }

    /// Records the kind of a square and the visible triangles, if the frame keeps them.
    #[inline(never)]
    pub fn mark(&mut self, square: &Square, kind: SquareKind, drawn: &Face) {
        if self.band.kinds.is_empty() {
            return;
        }
        let middle = drawn.rays.lens.middle;
        for (row, span) in self.spans.clipped(self.rows(square), square.columns) {
            for column in span {
                let pixel = self.band.index(column, row);
                if self.band.triangles[pixel].face_id() == self.face_id {
                    let [x, y] = [0, 1].map(|axis| [column, row][axis] as f64 + 0.5 - middle[axis]);
                    let is_second = drawn.diagonal.at(x, y) < 0.0;
                    self.band.triangles[pixel] = TriangleId::of_face(self.face_id, is_second);
                    let edge = row == square.corner[1] || column == square.corner[0];
                    self.band.kinds[pixel] = kind as u8 | if edge { SQUARE_EDGE } else { 0 };
                }
            }
        }
    }

    /// Writes all pixels of a square that nothing hides, as bytes.
    #[inline(always)]
    pub fn draw_whole<S: Simd>(&mut self, square: &Square, rows: &mut impl Rows<S>) {
        let [left, top] = square.corner;
        let start = self.band.index(0, top);
        for part in 0..square.side / 16 {
            rows.go_to(part);
            let first = left + 16 * part;
            let lines = self.band.bytes[start..].chunks_exact_mut(self.band.width);
            for (row, line) in (0..square.side).zip(lines) {
                line[first..first + 16].copy_from_slice(rows.pixels(row).as_slice());
            }
        }
    }

    /// Fills all pixels of the piece that are seen with one colour, in levels.
    pub fn fill(&mut self, levels: DVec3, face: &Face) {
        let levels = levels.as_vec3().to_array();
        let pixel = display_pixel(levels.map(f64::from));
        let rows = self.band.held(self.spans.rows());
        for row in (rows.start / MAX_SIDE * MAX_SIDE..rows.end).step_by(MAX_SIDE) {
            let (extent, _) = self.spans.columns(row..row + MAX_SIDE);
            for column in (extent.start / MAX_SIDE * MAX_SIDE..extent.end).step_by(MAX_SIDE) {
                let square = Square::new(&self.spans, [column, row], MAX_SIDE);
                let seen = self.seen_pixels(&square);
                if seen == 0 {
                    continue;
                }
                let rows = self.rows(&square);
                for (row, span) in self.spans.clipped(rows, square.columns) {
                    let pixels = self.band.indices(row, &span);
                    if !self.band.overlaps(row) {
                        fill(self.band.bytes, pixels.clone(), pixel);
                        fill(self.band.levels, pixels, levels);
                        continue;
                    }
                    for index in pixels {
                        if self.band.triangles[index].face_id() == self.face_id {
                            fill(self.band.bytes, index..index + 1, pixel);
                            fill(self.band.levels, index..index + 1, levels);
                        }
                    }
                }
                self.counts.add(SquareKind::Linear, 1, seen);
                self.mark(&square, SquareKind::Linear, face);
            }
        }
    }

    /// A bit for each of the sixteen pixels from `first` in a row: whether `span` covers it and it shows this face.
    #[inline(always)]
    fn seen_lanes<S: Simd>(&self, simd: S, first: usize, row: usize, span: Range<usize>) -> u32 {
        let covered = (1 << (span.end - first)) - (1 << (span.start - first));
        if !self.band.overlaps(row) {
            return covered;
        }
        let ids = &self.band.triangles[self.band.index(first, row)..];
        let ids = ids.first_chunk().copied().unwrap_or_else(|| {
            // The last row of the band ends before.
            let mut sixteen = [TriangleId::NONE; 16];
            sixteen[..ids.len()].copy_from_slice(ids);
            sixteen
        });
        let faces = u32x16::simd_from(simd, ids.map(TriangleId::face_id));
        let seen = faces.simd_eq(u32x16::splat(simd, self.face_id));
        seen.to_bitmask() as u32 & covered
    }

    /// Draws the pixels of a square that are seen, `seen` in number, with the colours of these rows.
    #[inline(always)]
    pub fn draw<S: Simd>(
        &mut self,
        simd: S,
        square: &Square,
        seen: usize,
        rows: &mut impl Rows<S>,
    ) {
        if self.is_whole(square, seen) {
            return self.draw_whole(square, rows);
        }
        let held = self.rows(square);
        let [left, top] = square.corner;
        for part in square.parts() {
            rows.go_to(part);
            let first = left + 16 * part;
            for (row, span) in self.spans.clipped(held.clone(), [first, first + 16]) {
                let seen = self.seen_lanes(simd, first, row, span);
                let start = self.band.index(first, row);
                let lanes = (0..16).filter(|lane| seen >> lane & 1 == 1);
                if self.band.bytes.is_empty() {
                    let levels = rows.levels(row - top);
                    for lane in lanes {
                        self.band.levels[start + lane] = three!(|channel| levels[channel][lane]);
                    }
                } else {
                    let new = rows.pixels(row - top);
                    if let Some(line) = self.band.bytes[start..].first_chunk_mut::<16>() {
                        let seen = mask32x16::from_bitmask(simd, seen.into());
                        *line = *seen.select(new, u32x16::simd_from(simd, *line));
                    } else {
                        // The last row of the band ends before.
                        for lane in lanes {
                            self.band.bytes[start + lane] = new[lane];
                        }
                    }
                }
            }
        }
    }
}
