//! The rows of a frame that one thread draws.
//!
//! Rule: bands meet where blocks of tiles do, so none is cut in two, and clearing touches only what was drawn and will not
//! be drawn over.

use std::ops::Range;

use glam::DVec3;

use super::{Counts, FARTHEST, NO_TRIANGLE, display_step};
use crate::shading::BLOCK;

/// What is drawn in one row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Drawn {
    /// The pixels from..to that may differ from the background.
    by_last: [u32; 2],
    /// The pixels from..to between which all lie that will be drawn.
    by_next: [u32; 2],
    /// The sums of to - from and of to^2 - from^2 of what will be drawn: the ends of spans that meet cancel in both, and a
    /// gap and an overlap make up for one another in neither or in one.
    sums: [u64; 2],
}

impl Drawn {
    /// A row of which nothing is known, in a picture so wide.
    pub fn anything(width: usize) -> Self {
        Drawn {
            by_last: [0, width as u32],
            by_next: [width as u32, 0],
            sums: [0; 2],
        }
    }
}

/// Some rows of a frame, owned by one thread; every slice holds those rows, or nothing where the frame keeps none.
pub(crate) struct Band<'a> {
    pub width: usize,
    /// Of the whole picture.
    pub height: usize,
    /// Which rows of the picture these are.
    pub rows: Range<usize>,
    pub background: DVec3,
    pub pixels: &'a mut [u32],
    pub levels: &'a mut [[f32; 3]],
    pub triangles: &'a mut [u32],
    /// Meaningless where no triangle is seen.
    pub kinds: &'a mut [u8],
    pub depths: &'a mut [f64],
    /// For each row.
    pub drawn: &'a mut [Drawn],
}

impl Band<'_> {
    /// Draws in parts of about `rows` rows, in parallel. Parts meet where blocks of tiles do, so none is cut in two.
    pub fn split_and(
        &mut self,
        rows: usize,
        draw: &(impl Fn(&mut Band) -> Counts + Sync),
    ) -> Counts {
        if self.rows.len() <= rows {
            return draw(self);
        }
        let middle = (self.rows.start + self.rows.len() / 2).next_multiple_of(BLOCK);
        if middle >= self.rows.end {
            return draw(self);
        }
        let (mut upper, mut lower) = self.split(middle);
        let (mut counts, more) = rayon::join(
            || upper.split_and(rows, draw),
            || lower.split_and(rows, draw),
        );
        counts += more;
        counts
    }

    /// The rows above `row` of the picture, and the others.
    fn split(&mut self, row: usize) -> (Band<'_>, Band<'_>) {
        let rows = row - self.rows.start;
        let pixels = rows * self.width;
        let (bytes, more_bytes) = split(self.pixels, pixels);
        let (levels, more_levels) = split(self.levels, pixels);
        let (triangles, more_triangles) = split(self.triangles, pixels);
        let (kinds, more_kinds) = split(self.kinds, pixels);
        let (depths, more_depths) = split(self.depths, pixels);
        let (drawn, more_drawn) = split(self.drawn, rows);
        let above = Band {
            width: self.width,
            height: self.height,
            rows: self.rows.start..row,
            background: self.background,
            pixels: bytes,
            levels,
            triangles,
            kinds,
            depths,
            drawn,
        };
        let below = Band {
            rows: row..self.rows.end,
            pixels: more_bytes,
            levels: more_levels,
            triangles: more_triangles,
            kinds: more_kinds,
            depths: more_depths,
            drawn: more_drawn,
            ..above
        };
        (above, below)
    }

    /// Puts the background back wherever the last frame drew, except in rows of which the next one is known to draw every
    /// pixel between the first and the last: two faces of a convex body meet without a gap.
    #[inline(always)]
    pub fn clear(&mut self) {
        let [red, green, blue] = self.background.to_array().map(display_step);
        let pixel = u32::from_be_bytes([0, red, green, blue]);
        let levels = self.background.as_vec3().to_array();
        for (row, drawn) in self.drawn.iter_mut().enumerate() {
            let Drawn {
                by_last: [from, to],
                by_next: [next_from, next_to],
                sums,
            } = *drawn;
            *drawn = Drawn {
                by_last: drawn.by_next,
                ..Drawn::anything(self.width)
            };
            let whole = next_from < next_to && sums == spanned(next_from, next_to);
            let beside = if whole {
                [from..to.min(next_from), from.max(next_to)..to]
            } else {
                [from..to, to..to]
            };
            let first = row * self.width;
            for part in beside {
                if part.is_empty() {
                    continue;
                }
                let part = first + part.start as usize..first + part.end as usize;
                fill(self.pixels, part.clone(), pixel);
                fill(self.levels, part.clone(), levels);
                fill(self.triangles, part.clone(), NO_TRIANGLE);
                fill(self.depths, part, FARTHEST);
            }
        }
    }

    /// Before clearing: notes that every pixel from..to of a row of the picture will be drawn.
    #[inline(always)]
    pub fn announce(&mut self, row: usize, from: usize, to: usize) {
        let drawn = &mut self.drawn[row - self.rows.start];
        drawn.by_next = joined(drawn.by_next, from, to);
        let more = spanned(from as u32, to as u32);
        drawn.sums = [drawn.sums[0] + more[0], drawn.sums[1] + more[1]];
    }

    /// After clearing: notes that some of the pixels from..to of a row of the picture may be drawn.
    #[inline(always)]
    pub fn touch(&mut self, row: usize, from: usize, to: usize) {
        let drawn = &mut self.drawn[row - self.rows.start];
        drawn.by_last = joined(drawn.by_last, from, to);
    }

    /// Whether these rows of the picture are all here.
    #[inline(always)]
    pub fn holds(&self, first: usize, rows: usize) -> bool {
        self.rows.start <= first && first + rows <= self.rows.end
    }

    /// Whether these rows are here and take bytes, and nothing hides them.
    #[inline(always)]
    pub fn takes_whole(&self, first: usize, rows: usize) -> bool {
        self.holds(first, rows) && self.depths.is_empty() && !self.pixels.is_empty()
    }

    /// Where the pixel `x` of a row of the picture stands in the slices.
    #[inline(always)]
    pub fn index(&self, x: usize, row: usize) -> usize {
        (row - self.rows.start) * self.width + x
    }
}

/// to - from and to^2 - from^2.
#[inline(always)]
fn spanned(from: u32, to: u32) -> [u64; 2] {
    let [from, to] = [from, to].map(u64::from);
    [to - from, to * to - from * from]
}

/// The least range that holds both.
#[inline(always)]
fn joined(range: [u32; 2], from: usize, to: usize) -> [u32; 2] {
    [range[0].min(from as u32), range[1].max(to as u32)]
}

/// At `index`, or at the end of a slice that holds nothing.
fn split<T>(slice: &mut [T], index: usize) -> (&mut [T], &mut [T]) {
    let index = index.min(slice.len());
    slice.split_at_mut(index)
}

#[inline(always)]
fn fill<T: Copy>(slice: &mut [T], range: Range<usize>, value: T) {
    if !slice.is_empty() {
        slice[range].fill(value);
    }
}
