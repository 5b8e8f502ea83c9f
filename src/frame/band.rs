//! The rows of a frame that one thread draws.
//!
//! Rule: bands meet where blocks of tiles do, so none is cut in two, and clearing touches only what was drawn.

use std::ops::Range;

use glam::DVec3;

use super::{Counts, FARTHEST, NO_TRIANGLE, display_step};
use crate::shading::BLOCK;

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
    /// For each row, the pixels from..to that may differ from the background.
    pub touched: &'a mut [[u32; 2]],
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
        let (touched, more_touched) = split(self.touched, rows);
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
            touched,
        };
        let below = Band {
            rows: row..self.rows.end,
            pixels: more_bytes,
            levels: more_levels,
            triangles: more_triangles,
            kinds: more_kinds,
            depths: more_depths,
            touched: more_touched,
            ..above
        };
        (above, below)
    }

    /// Puts the background back wherever the last frame drew.
    #[inline(always)]
    pub fn clear(&mut self) {
        let [red, green, blue] = self.background.to_array().map(display_step);
        let pixel = u32::from_be_bytes([0, red, green, blue]);
        let levels = self.background.as_vec3().to_array();
        for (row, touched) in self.touched.iter_mut().enumerate() {
            let first = row * self.width;
            let drawn = first + touched[0] as usize..first + touched[1] as usize;
            *touched = [self.width as u32, 0];
            if drawn.is_empty() {
                continue;
            }
            fill(self.pixels, drawn.clone(), pixel);
            fill(self.levels, drawn.clone(), levels);
            fill(self.triangles, drawn.clone(), NO_TRIANGLE);
            fill(self.depths, drawn, FARTHEST);
        }
    }

    /// Notes that pixels from..to of a row of the picture will be drawn.
    #[inline(always)]
    pub fn touch(&mut self, row: usize, from: usize, to: usize) {
        let touched = &mut self.touched[row - self.rows.start];
        touched[0] = touched[0].min(from as u32);
        touched[1] = touched[1].max(to as u32);
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
