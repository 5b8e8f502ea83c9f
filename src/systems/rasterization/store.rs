//! Rows of levels in, pixels of a band out: the display step fused into the store, or the levels themselves.
//!
//! Rule: only covered lanes of rows that the band holds are written, and where there is a depth buffer only pixels that
//! show this triangle.

use crate::frame::Band;
use crate::shading::display::Row;
use crate::shading::rows::{Rows, Source};
use crate::shading::{Coverage, Sink, TileKind};

/// Stores the rows of a square that is covered, held and seen all over, as bytes.
struct Whole<'a, const SIDE: usize> {
    pixels: &'a mut [u32],
    /// Where the first pixel of the first row stands among them.
    first: usize,
    /// From row to row.
    width: usize,
}

impl<const SIDE: usize> Rows for Whole<'_, SIDE> {
    #[inline(always)]
    fn take(&mut self, row: usize, levels: &impl Row) {
        let start = self.first + row * self.width;
        let pixels = &mut self.pixels[start..start + SIDE];
        for lane in 0..SIDE {
            pixels[lane] = levels.pixel(lane);
        }
    }
}

/// Stores the rows of one tile or block.
pub struct Store<'a, 'b, const SIDE: usize> {
    band: &'a mut Band<'b>,
    coverage: &'a Coverage<SIDE>,
    id: u32,
    /// The picture's row of the square's first.
    row: usize,
    /// Where the square's first pixel stands in the band's slices, had the band no first row.
    first: usize,
    /// Whether the band has all of the square's rows.
    whole: bool,
    /// Whether, besides, it takes bytes and nothing hides them.
    plain: bool,
    /// How many pixels were stored so far; not counted where `plain`, for then all that are covered are.
    seen: u64,
}

impl<'a, 'b, const SIDE: usize> Store<'a, 'b, SIDE> {
    /// For the square at `[column, row]` of the picture; `id` is its triangle's.
    #[inline(always)]
    pub fn new(
        band: &'a mut Band<'b>,
        [column, row]: [usize; 2],
        coverage: &'a Coverage<SIDE>,
        id: u32,
    ) -> Self {
        let first = (row * band.width + column).wrapping_sub(band.rows.start * band.width);
        let whole = band.holds(row, SIDE);
        let plain = band.takes_whole(row, SIDE);
        Store {
            band,
            coverage,
            id,
            row,
            first,
            whole,
            plain,
            seen: 0,
        }
    }

    /// How many pixels were stored, once all were.
    #[inline(always)]
    pub fn stored(&self) -> u64 {
        if self.plain {
            u64::from(self.coverage.pixels)
        } else {
            self.seen
        }
    }

    /// The place of the first lane of a row of the tile, if the band has that row.
    #[inline(always)]
    fn place(&self, row: usize) -> Option<usize> {
        let held = self.whole || self.band.rows.contains(&(self.row + row));
        held.then(|| self.first.wrapping_add(row * self.band.width))
    }

    /// Notes how the tile was drawn, where the frame keeps that.
    pub fn mark(&mut self, kind: TileKind) {
        if self.band.kinds.is_empty() {
            return;
        }
        for (row, &(from, to)) in self.coverage.spans.iter().enumerate() {
            let Some(first) = self.place(row) else {
                continue;
            };
            for lane in usize::from(from)..usize::from(to) {
                if self.band.triangles[first + lane] == self.id {
                    self.band.kinds[first + lane] = kind as u8;
                }
            }
        }
    }

    /// Whether any pixel of the tile is drawn here: in this band, and not hidden.
    #[inline(always)]
    pub fn is_seen(&self) -> bool {
        if self.whole && self.band.depths.is_empty() {
            return true;
        }
        self.coverage
            .spans
            .iter()
            .enumerate()
            .any(|(row, &(from, to))| {
                from < to
                    && self.place(row).is_some_and(|first| {
                        let covered = first + usize::from(from)..first + usize::from(to);
                        self.band.depths.is_empty()
                            || self.band.triangles[covered].contains(&self.id)
                    })
            })
    }
}

impl<const SIDE: usize> Sink<SIDE> for Store<'_, '_, SIDE> {
    #[inline(always)]
    fn draw(&mut self, source: &impl Source<SIDE>, coverage: &Coverage<SIDE>) {
        if self.plain && coverage.pixels == Coverage::<SIDE>::WHOLE.pixels {
            let target = &mut Whole::<SIDE> {
                pixels: self.band.pixels,
                first: self.first,
                width: self.band.width,
            };
            source.for_rows(0..SIDE, target);
        } else {
            source.send(coverage, self);
        }
    }

    #[inline(always)]
    fn take(&mut self, row: usize, levels: &impl Row) {
        let (from, to) = self.coverage.spans[row];
        if !self.plain {
            return self.take_seen(row, levels);
        }
        let first = self.first.wrapping_add(row * self.band.width);
        if to - from == SIDE as u8 {
            let pixels = &mut self.band.pixels[first..first + SIDE];
            for lane in 0..SIDE {
                pixels[lane] = levels.pixel(lane);
            }
        } else {
            let lanes = usize::from(from)..usize::from(to);
            let mut pixels = [0_u32; SIDE];
            for lane in 0..SIDE {
                pixels[lane] = levels.pixel(lane);
            }
            self.band.pixels[first + lanes.start..first + lanes.end]
                .copy_from_slice(&pixels[lanes]);
        }
    }
}

impl<const SIDE: usize> Store<'_, '_, SIDE> {
    /// Stores what of a row is in the band and seen.
    #[inline(always)]
    fn take_seen(&mut self, row: usize, levels: &impl Row) {
        let (from, to) = self.coverage.spans[row];
        let Some(first) = self.place(row) else { return };
        let deep = !self.band.depths.is_empty();
        if self.band.pixels.is_empty() {
            for lane in usize::from(from)..usize::from(to) {
                let pixel = first + lane;
                if !deep {
                    self.band.triangles[pixel] = self.id;
                }
                if self.band.triangles[pixel] == self.id {
                    self.band.levels[pixel] = levels.levels(lane);
                    self.seen += 1;
                }
            }
            return;
        }
        let mut pixels = [0_u32; SIDE];
        for lane in 0..SIDE {
            pixels[lane] = levels.pixel(lane);
        }
        for lane in usize::from(from)..usize::from(to) {
            if !deep || self.band.triangles[first + lane] == self.id {
                self.band.pixels[first + lane] = pixels[lane];
                self.seen += 1;
            }
        }
    }
}
