//! A band is a range of rows of a frame that one thread draws.
//!
//! Clearing touches only pixels that the last frame drew, and skips those that this frame certainly overwrites.

use std::ops::Range;

use glam::DVec3;

use crate::components::TriangleId;
use crate::shading::display::display_pixel;

/// The pixels that are drawn in one row, by the last frame and by the next.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Drawn {
    /// The range from..to of the pixels that may differ from the background.
    by_last: [u32; 2],
    /// The range from..to that holds every pixel of the next frame.
    by_next: [u32; 2],
    /// Up to two intervals of pixels that the next frame overwrites completely; `clear` skips the first. Two, because the
    /// middle one of three faces may come last.
    runs: [[u32; 2]; 2],
    /// See [`Band::overlaps`].
    pub overlaps: bool,
}

/// An empty run, which meets no span.
const NO_RUN: [u32; 2] = [u32::MAX; 2];

impl Drawn {
    /// A row of `width` pixels that may all differ from the background.
    pub fn anything(width: usize) -> Self {
        Drawn {
            by_last: [0, width as u32],
            by_next: [width as u32, 0],
            runs: [NO_RUN; 2],
            overlaps: false,
        }
    }

    /// Records, after clearing, that a span is drawn. Where pieces overlap, [`Band::will_draw`] has not met all of them.
    pub fn drew(&mut self, span: &Range<usize>) {
        self.by_last = joined(self.by_last, [span.start as u32, span.end as u32]);
    }
}

/// The buffers of some rows of a frame, for one thread. A buffer that the frame does not keep is empty.
pub(crate) struct Band<'a> {
    pub width: usize,
    /// The rows of the picture.
    pub rows: Range<usize>,
    pub background: DVec3,
    /// Displayed pixels, 0x00RRGGBB.
    pub bytes: &'a mut [u32],
    pub levels: &'a mut [[f32; 3]],
    pub triangles: &'a mut [TriangleId],
    /// Undefined where no triangle is visible.
    pub kinds: &'a mut [u8],
    /// One per row.
    pub drawn: &'a mut [Drawn],
}

impl<'a> Band<'a> {
    /// Splits off the rows above `row` of the picture.
    pub fn take(&mut self, row: usize) -> Band<'a> {
        let rows = row - self.rows.start;
        let pixels = rows * self.width;
        let above = Band {
            width: self.width,
            rows: self.rows.start..row,
            background: self.background,
            bytes: take(&mut self.bytes, pixels),
            levels: take(&mut self.levels, pixels),
            triangles: take(&mut self.triangles, pixels),
            kinds: take(&mut self.kinds, pixels),
            drawn: take(&mut self.drawn, rows),
        };
        self.rows.start = row;
        above
    }

    /// Restores the background of some rows where the last frame drew, except in one run of each row that this frame
    /// overwrites. The faces of a convex body meet without gaps, so for one cuboid that run is all that it covers of the
    /// row. `overlaps` says whether pieces overlap in these rows.
    pub fn clear(&mut self, rows: Range<usize>, overlaps: bool) {
        let pixel = display_pixel(self.background.to_array());
        let levels = self.background.as_vec3().to_array();
        let rows = rows.start - self.rows.start..rows.end - self.rows.start;
        for (row, drawn) in rows.clone().zip(&mut self.drawn[rows]) {
            let Drawn {
                by_last: [from, to],
                runs: [[run_from, run_to], ..],
                ..
            } = *drawn;
            *drawn = Drawn {
                by_last: drawn.by_next,
                overlaps,
                ..Drawn::anything(self.width)
            };
            let first = row * self.width;
            for part in [from..to.min(run_from), from.max(run_to)..to] {
                if part.is_empty() {
                    continue;
                }
                let part = first + part.start as usize..first + part.end as usize;
                fill(self.bytes, part.clone(), pixel);
                fill(self.levels, part.clone(), levels);
                fill(self.triangles, part, TriangleId::NONE);
            }
        }
    }

    /// Records, before clearing, that every pixel of a span in a row of the picture will be drawn. `in_runs` also joins spans to
    /// runs, which pays for the few spans of one cuboid.
    #[inline(always)]
    pub fn will_draw(&mut self, row: usize, span: &Range<usize>, in_runs: bool) {
        let drawn = &mut self.drawn[row - self.rows.start];
        let mut span = [span.start as u32, span.end as u32];
        drawn.by_next = joined(drawn.by_next, span);
        if !in_runs {
            return;
        }
        for run in &mut drawn.runs {
            if run[1] == span[0] || span[1] == run[0] {
                span = joined(*run, span);
                *run = NO_RUN;
            }
        }
        // Only two runs are kept. The pixels of a third are cleared and then overwritten.
        if let Some(place) = drawn.runs.iter_mut().find(|run| **run == NO_RUN) {
            *place = span;
        }
    }

    /// Whether pieces overlap in the strip of a row of the picture. If not, nothing is hidden, and ids need not be known.
    pub fn overlaps(&self, row: usize) -> bool {
        self.drawn[row - self.rows.start].overlaps
    }

    /// The part of `rows` of the picture that lies in this band.
    pub fn held(&self, rows: Range<usize>) -> Range<usize> {
        rows.start.max(self.rows.start)..rows.end.min(self.rows.end)
    }

    /// The indices in the buffers of some pixels in a row of the picture.
    pub fn indices(&self, row: usize, columns: &Range<usize>) -> Range<usize> {
        let first = self.index(0, row);
        first + columns.start..first + columns.end
    }

    /// The index in the buffers of pixel `x` in a row of the picture.
    pub fn index(&self, x: usize, row: usize) -> usize {
        (row - self.rows.start) * self.width + x
    }
}

/// The smallest range that holds both ranges.
fn joined(one: [u32; 2], other: [u32; 2]) -> [u32; 2] {
    [one[0].min(other[0]), one[1].max(other[1])]
}

/// Takes the first elements of a slice, if it has any.
#[expect(clippy::mut_mut, reason = "the slice itself is shortened")]
fn take<'a, T>(slice: &mut &'a mut [T], len: usize) -> &'a mut [T] {
    slice
        .split_off_mut(..len.min(slice.len()))
        .unwrap_or_default()
}

/// Overwrites a range of a buffer, if the frame keeps it.
pub(crate) fn fill<T: Copy>(slice: &mut [T], range: Range<usize>, value: T) {
    if !slice.is_empty() {
        slice[range].fill(value);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WIDTH: usize = 32;
    const STALE: u32 = 1;
    const BACKGROUND: u32 = 0;

    /// A row of stale pixels after clearing for a frame that will draw `spans`.
    fn cleared(spans: &[[usize; 2]]) -> [u32; WIDTH] {
        let mut pixels = [STALE; WIDTH];
        let mut band = Band {
            width: WIDTH,
            rows: 0..1,
            background: DVec3::ZERO,
            bytes: &mut pixels,
            levels: &mut [],
            triangles: &mut [],
            kinds: &mut [],
            drawn: &mut [Drawn::anything(WIDTH)],
        };
        for &[from, to] in spans {
            band.will_draw(0, &(from..to), true);
        }
        band.clear(0..1, false);
        pixels
    }

    fn is_drawn(spans: &[[usize; 2]], pixel: usize) -> bool {
        spans.iter().any(|[from, to]| (*from..*to).contains(&pixel))
    }

    #[test]
    fn a_gap_is_cleared_even_if_an_overlap_has_the_same_length_and_sum_of_places() {
        // Pixels 10 and 21 are missing, 15 and 16 are drawn twice: 10 + 21 = 15 + 16.
        let spans = [[0, 10], [11, 17], [15, 21], [22, 32]];
        let row = cleared(&spans);
        assert_eq!([row[10], row[21]], [BACKGROUND; 2]);
    }

    #[test]
    fn every_pixel_that_will_not_be_drawn_is_cleared() {
        // Every set of up to four spans between six places.
        let ends = [0, 3, 10, 17, 31, 32];
        let all: Vec<[usize; 2]> = (0..ends.len())
            .flat_map(|from| (from + 1..ends.len()).map(move |to| [ends[from], ends[to]]))
            .collect();
        let sets = (0..=4).flat_map(|count| (0..all.len().pow(count)).map(move |set| (count, set)));
        for (count, set) in sets {
            let spans: Vec<_> = (0..count)
                .map(|index| all[set / all.len().pow(index) % all.len()])
                .collect();
            let row = cleared(&spans);
            let left = (0..WIDTH).find(|&x| row[x] == STALE && !is_drawn(&spans, x));
            assert_eq!(left, None, "{spans:?}");
        }
    }

    #[test]
    fn adjacent_faces_in_any_order_need_no_clearing() {
        let faces = [[2, 9], [9, 17], [17, 30]];
        for order in [
            [0, 1, 2],
            [0, 2, 1],
            [1, 0, 2],
            [1, 2, 0],
            [2, 0, 1],
            [2, 1, 0],
        ] {
            let spans = order.map(|index: usize| faces[index]);
            let row = cleared(&spans);
            for (x, pixel) in row.into_iter().enumerate() {
                assert_eq!(pixel == STALE, is_drawn(&spans, x), "{x} of {spans:?}");
            }
        }
    }
}
