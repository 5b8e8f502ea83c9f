//! Rows of a square in, pixels of a band out: the display step fused into the store, or the levels themselves.
//!
//! Rule: only covered pixels of rows that the band holds are written, and where there is a depth buffer only pixels that
//! show this face.

use std::ops::Range;

use fearless_simd::Simd;
use fearless_simd::prelude::*;

use crate::frame::{Band, OUTLINE, face};
use crate::shading::display::Rows;
use crate::shading::square::{Spans, Square};
use crate::shading::{Sink, TileKind};

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
    #[inline(always)]
    fn rows(&self) -> Range<usize> {
        self.band.held(self.square.covered_rows())
    }

    /// Notes how the square was drawn, where the frame keeps that; how many of its pixels were drawn.
    #[inline]
    pub fn finish(mut self, kind: TileKind) -> u64 {
        if !self.band.kinds.is_empty() {
            self.mark(kind);
        }
        if self.band.is_plain() && self.rows() == self.square.covered_rows() {
            self.square.pixels as u64
        } else {
            self.drawn
        }
    }

    #[inline(never)]
    fn mark(&mut self, kind: TileKind) {
        let Square { place, columns, .. } = *self.square;
        for (row, span) in self.spans.clipped(self.rows(), columns) {
            let first = self.band.index(0, row);
            for column in span {
                if face(self.band.triangles[first + column]) == face(self.id) {
                    let edge = row == place[1] || column == place[0];
                    self.band.kinds[first + column] = kind as u8 | if edge { OUTLINE } else { 0 };
                }
            }
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
        let lines = self.band.pixels[start..].chunks_exact_mut(self.band.width);
        for (row, line) in lines.take(side).enumerate() {
            rows.go_to(row);
            let parts = line[left..left + side].as_chunks_mut::<16>().0;
            for (part, pixels) in parts.iter_mut().enumerate() {
                *pixels = *rows.pixels(part);
            }
        }
    }

    /// The covered pixels, where nothing hides them and the band takes bytes.
    #[inline(always)]
    fn draw_spans<S: Simd>(&mut self, rows: &mut impl Rows<S>) {
        let [left, top] = self.square.place;
        let held = self.rows();
        let start = self.band.index(0, held.start);
        let lines = self.band.pixels[start..].chunks_mut(self.band.width);
        let spans = self.spans.clipped(held, self.square.columns);
        for ((row, span), line) in spans.zip(lines) {
            if span.is_empty() {
                continue;
            }
            rows.go_to(row - top);
            let from = span.start - left;
            let (mut part, skipped) = (from / 16, from % 16);
            self.drawn += span.len() as u64;
            let covered = &mut line[span];
            let (pixels, mut rest) = covered.split_at_mut(covered.len().min(16 - skipped));
            copy(&rows.pixels(part).as_array()[skipped..], pixels);
            while !rest.is_empty() {
                part += 1;
                let (pixels, others) = rest.split_at_mut(rest.len().min(16));
                copy(rows.pixels(part).as_array(), pixels);
                rest = others;
            }
        }
    }

    /// The covered pixels that show this face, as bytes or as levels.
    #[inline(always)]
    fn draw_seen<S: Simd>(&mut self, rows: &mut impl Rows<S>) {
        let [left, top] = self.square.place;
        let own = face(self.id);
        let bytes = !self.band.pixels.is_empty();
        for (row, span) in self.spans.clipped(self.rows(), self.square.columns) {
            if span.is_empty() {
                continue;
            }
            rows.go_to(row - top);
            let first = self.band.index(0, row);
            let (from, to) = (span.start - left, span.end - left);
            for part in from / 16..to.div_ceil(16) {
                let (pixels, levels) = if bytes {
                    (Some(rows.pixels(part)), None)
                } else {
                    (None, Some(rows.levels(part)))
                };
                for lane in from.max(16 * part)..to.min(16 * part + 16) {
                    let pixel = first + left + lane;
                    if face(self.band.triangles[pixel]) != own {
                        continue;
                    }
                    self.drawn += 1;
                    if let Some(pixels) = &pixels {
                        self.band.pixels[pixel] = pixels[lane % 16];
                    } else if let Some(levels) = &levels {
                        self.band.levels[pixel] =
                            [0, 1, 2].map(|channel| levels[channel][lane % 16]);
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

/// Copies up to sixteen pixels, in parts of fixed sizes, which need no call.
#[inline(always)]
fn copy(from: &[u32], to: &mut [u32]) {
    #[inline(always)]
    fn part<'a, const SIZE: usize>(
        (from, to): (&'a [u32], &'a mut [u32]),
    ) -> (&'a [u32], &'a mut [u32]) {
        match (from.split_first_chunk::<SIZE>(), to.len() < SIZE) {
            (Some((from, rest)), false) => {
                let (to, others) = to.split_at_mut(SIZE);
                to.copy_from_slice(from);
                (rest, others)
            }
            _ => (from, to),
        }
    }
    let left = part::<8>((from, to));
    let left = part::<8>(left);
    let left = part::<4>(left);
    let left = part::<2>(left);
    part::<1>(left);
}
