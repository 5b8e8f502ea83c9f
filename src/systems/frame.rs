//! The buffers of one frame, which threads draw in bands of rows.
//!
//! A frame of unchanged size reuses its memory and clears only pixels that the last frame drew. Its bits do not depend on the
//! number of threads.

mod aligned;
mod band;
mod draw_list;

use std::ops::Range;
use std::sync::{Mutex, PoisonError};
use std::{iter, mem};

use fearless_simd::Level;
use glam::DVec3;
use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};

use self::aligned::Aligned;
pub(crate) use self::band::{Band, Drawn, fill};
pub(crate) use self::draw_list::{DrawList, Object, Piece};
use crate::components::{Illumination, Lens, TriangleId};
use crate::output::memory::{self, OutOfMemory};
pub use crate::shading::Counts;
use crate::shading::Scratch;
pub use crate::shading::display::{display_pixel, display_step};

/// The SIMD level and the threads that draw.
pub struct Workers {
    level: Level,
    pool: Option<ThreadPool>,
}

impl Workers {
    /// Starts `threads` threads; for 1 (or 0) the calling thread draws.
    ///
    /// # Errors
    /// If the threads cannot be started.
    pub fn new(threads: usize, level: Level) -> Result<Self, ThreadPoolBuildError> {
        let pool = ThreadPoolBuilder::new().num_threads(threads);
        Ok(Workers {
            level,
            pool: (threads > 1).then(|| pool.build()).transpose()?,
        })
    }

    /// The calling thread alone, which cannot fail.
    pub fn alone(level: Level) -> Self {
        Workers { level, pool: None }
    }

    /// The SIMD level in use.
    pub fn level(&self) -> Level {
        self.level
    }

    /// The number of threads that draw.
    pub fn threads(&self) -> usize {
        self.pool
            .as_ref()
            .map_or(1, ThreadPool::current_num_threads)
    }
}

/// The buffers of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Keep {
    /// Displayed pixels, 0x00RRGGBB, in the format of the window.
    Display,
    /// The unclamped, unrounded levels of each pixel, its visible triangle and the kind of its square.
    Levels,
}

/// Bit set in the kind of pixels on the upper or left edge of their square.
pub const SQUARE_EDGE: u8 = 0x80;

/// A picture, and the data that the systems derive for all cuboids together. Its memory is reused for the next picture.
pub struct Frame {
    keep: Keep,
    workers: Workers,
    buffers: Buffers,
    pub(crate) list: DrawList,
    /// One per thread.
    scratch: Vec<Scratch>,
    pub(crate) counts: Counts,
}

/// The buffers of some rows of a picture. One that the frame does not keep is empty.
#[derive(Default)]
struct Buffers {
    size: [usize; 2],
    rows: Range<usize>,
    background: DVec3,
    pixels: Aligned<u32>,
    levels: Aligned<[f32; 3]>,
    triangles: Aligned<TriangleId>,
    kinds: Aligned<u8>,
    /// One per row.
    drawn: Aligned<Drawn>,
}

impl Frame {
    /// An empty frame.
    pub fn new(keep: Keep, workers: Workers) -> Self {
        Frame {
            keep,
            scratch: iter::repeat_with(Default::default)
                .take(workers.threads())
                .collect(),
            workers,
            buffers: Buffers::default(),
            list: DrawList::default(),
            counts: Counts::default(),
        }
    }

    /// The camera and projection of this frame.
    pub fn lens(&self) -> &Lens {
        &self.list.rays.lens
    }

    /// The lights of this frame.
    pub fn illumination(&self) -> &Illumination {
        &self.list.illumination
    }

    /// The threads and the SIMD level that draw it.
    pub fn workers(&self) -> &Workers {
        &self.workers
    }

    /// Width and height of the whole picture, in pixels.
    pub fn size(&self) -> [usize; 2] {
        self.buffers.size
    }

    /// Displayed pixels, 0x00RRGGBB, row by row from the top; empty unless [`Keep::Display`].
    pub fn pixels(&self) -> &[u32] {
        self.buffers.pixels.as_slice()
    }

    /// Unclamped levels of 255, row by row from the top; empty unless [`Keep::Levels`].
    pub fn levels(&self) -> &[[f32; 3]] {
        self.buffers.levels.as_slice()
    }

    /// The visible triangle of each pixel, or [`TriangleId::NONE`]; empty unless [`Keep::Levels`].
    pub fn triangles(&self) -> &[TriangleId] {
        match self.keep {
            Keep::Levels => self.buffers.triangles.as_slice(),
            Keep::Display => &[],
        }
    }

    /// The kind of each pixel's square: its index in [`SquareKind::ALL`](crate::shading::SquareKind::ALL), and [`SQUARE_EDGE`].
    /// Undefined where no triangle is visible; empty unless [`Keep::Levels`].
    pub fn kinds(&self) -> &[u8] {
        self.buffers.kinds.as_slice()
    }

    /// The counts of the last frame.
    pub fn counts(&self) -> Counts {
        self.counts
    }

    /// Allocates the buffers for these rows of a picture, unless they fit, and memory for `grids`: the number of cuboids that
    /// have them, and that of their points. Resets the counts. With `many_cuboids` the visible triangles are kept, too.
    ///
    /// # Errors
    /// If there is too little memory. The frame is then empty.
    pub(crate) fn begin(
        &mut self,
        size: [usize; 2],
        rows: Range<usize>,
        many_cuboids: bool,
        grids: [usize; 2],
    ) -> Result<(), OutOfMemory> {
        self.counts = Counts::default();
        // If there is too little memory, the old picture must not be taken for the new one.
        let old = mem::take(&mut self.buffers);
        self.list.grids.reserve(grids)?;
        let shown = self.keep == Keep::Display;
        let wanted = |kept: bool| if kept { size[0] * rows.len() } else { 0 };
        let [pixels, levels, triangles] = [shown, !shown, many_cuboids || !shown].map(wanted);
        if old.size == size && old.rows == rows && old.triangles.as_slice().len() == triangles {
            self.buffers = old;
            return Ok(());
        }
        // The old buffers are given back before new ones are asked for.
        drop(old);
        let needed = (pixels + triangles) * size_of::<u32>()
            + levels * (size_of::<[f32; 3]>() + size_of::<u8>());
        memory::check(size, needed)?;
        let allocate = || {
            Ok(Buffers {
                size,
                background: DVec3::ZERO,
                pixels: Aligned::new(pixels, 0)?,
                levels: Aligned::new(levels, [0.0; 3])?,
                triangles: Aligned::new(triangles, TriangleId::NONE)?,
                kinds: Aligned::new(levels, 0)?,
                drawn: Aligned::new(rows.len(), Drawn::anything(size[0]))?,
                rows,
            })
        };
        self.buffers = allocate().map_err(memory::refused(size, needed))?;
        Ok(())
    }

    /// Draws the list with `draw`, in bands on all threads if there are several, and adds up the counts.
    pub(crate) fn paint(
        &mut self,
        background: DVec3,
        draw: impl Fn(&DrawList, &mut Band, &mut Scratch) + Sync,
    ) {
        let (buffers, list) = (&mut self.buffers, &mut self.list);
        if buffers.background != background {
            buffers.background = background;
            let anything = Drawn::anything(buffers.size[0]);
            buffers.drawn.as_mut_slice().fill(anything);
        }
        list.cut(&buffers.rows, self.workers.pool.is_some());
        let band = Band {
            width: buffers.size[0],
            rows: buffers.rows.clone(),
            background,
            bytes: buffers.pixels.as_mut_slice(),
            levels: buffers.levels.as_mut_slice(),
            triangles: buffers.triangles.as_mut_slice(),
            kinds: buffers.kinds.as_mut_slice(),
            drawn: buffers.drawn.as_mut_slice(),
        };
        let list = &self.list;
        let rest = Mutex::new((band, list.cuts.iter()));
        let next = || {
            let (band, cuts) = &mut *rest.lock().unwrap_or_else(PoisonError::into_inner);
            cuts.next().map(|row| band.take(*row))
        };
        let work = |scratch: &mut Scratch| {
            while let Some(mut band) = next() {
                draw(list, &mut band, scratch);
            }
        };
        match &self.workers.pool {
            Some(pool) if list.cuts.len() >= WORTH_SHARING => {
                // Joins, of which this is made, allocate nothing, unlike jobs of a scope.
                pool.install(|| self.scratch.par_iter_mut().for_each(work));
            }
            _ => work(&mut self.scratch[0]),
        }
        for scratch in &mut self.scratch {
            self.counts += mem::take(&mut scratch.counts);
        }
    }
}

/// Frames of fewer bands are drawn by the calling thread: another one costs more than it saves.
const WORTH_SHARING: usize = 3;
