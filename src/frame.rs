//! Pixels: what one frame is drawn into, cut into bands for threads, and the display step.
//!
//! Rule: a warm frame of unchanged size allocates nothing (rayon's queue takes a block of memory every few dozen frames that
//! several threads draw), clears only what the last frame touched, and holds the same bits however many threads drew it.

mod aligned;
mod band;
mod draw_list;

use std::ops::{AddAssign, Range};
use std::sync::{Mutex, PoisonError};

use fearless_simd::Level;
use glam::DVec3;
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};

use self::aligned::Aligned;
pub(crate) use self::band::{Band, Drawn};
pub(crate) use self::draw_list::{DrawList, Object, Piece};
use crate::components::{Illumination, Lens};
use crate::memory::{self, OutOfMemory};
pub use crate::shading::display::{display_pixel, display_step};
use crate::shading::{Scratch, TileKind};

/// Who draws: the SIMD level and the threads.
pub struct Workers {
    level: Level,
    pool: Option<ThreadPool>,
}

impl Workers {
    /// `threads` 1 (or 0) is the calling thread alone.
    ///
    /// # Errors
    /// When the system gives no threads.
    pub fn new(threads: usize, level: Level) -> Result<Self, ThreadPoolBuildError> {
        let pool = if threads > 1 {
            Some(ThreadPoolBuilder::new().num_threads(threads).build()?)
        } else {
            None
        };
        Ok(Workers { level, pool })
    }

    /// The calling thread alone, which no system refuses.
    pub fn alone(level: Level) -> Self {
        Workers { level, pool: None }
    }

    /// The SIMD level in use.
    pub fn level(&self) -> Level {
        self.level
    }

    /// How many threads draw.
    pub fn threads(&self) -> usize {
        self.pool
            .as_ref()
            .map_or(1, ThreadPool::current_num_threads)
    }
}

/// What a frame keeps of every pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Keep {
    /// The display step's bytes, 0x00RRGGBB, as a window takes them.
    Display,
    /// Unclamped, unrounded levels, the triangle seen, and how its tile was drawn.
    Levels,
}

/// Set in the kind of pixels on the upper or left edge of their square.
pub const OUTLINE: u8 = 0x80;

/// The id of a pixel where nothing is drawn.
pub const NO_TRIANGLE: u32 = u32::MAX;

/// The face of a triangle (cuboid * 6 + its face): both triangles of a face have the same, and [`NO_TRIANGLE`] one that no
/// cuboid has.
pub fn face(triangle: u32) -> u32 {
    triangle / 2
}

/// Farther than any depth.
const FARTHEST: f64 = f64::MIN;

/// What was done for one frame; the same for any number of threads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Pixels covered by a triangle.
    pub covered_pixels: u64,
    /// Evaluations of the illumination model, at vertices or pixels.
    pub model_evaluations: u64,
    /// Powers evaluated.
    pub specular_evaluations: u64,
    /// Tiles drawn, by [`TileKind`] in the order of [`TileKind::ALL`]. A small face counts once in each strip of rows in which
    /// a pixel of it is seen, since the strips of a frame may belong to different threads.
    pub tiles: [u64; TileKind::ALL.len()],
}

impl AddAssign for Counts {
    fn add_assign(&mut self, other: Self) {
        self.covered_pixels += other.covered_pixels;
        self.model_evaluations += other.model_evaluations;
        self.specular_evaluations += other.specular_evaluations;
        for (tiles, more) in self.tiles.iter_mut().zip(other.tiles) {
            *tiles += more;
        }
    }
}

/// A picture being drawn, and what the systems derive for all cuboids together; its memory is kept for the next one.
pub struct Frame {
    /// What it is seen through.
    pub lens: Lens,
    /// What lights it.
    pub illumination: Illumination,
    keep: Keep,
    workers: Workers,
    size: [usize; 2],
    rows: Range<usize>,
    background: DVec3,
    pixels: Aligned<u32>,
    levels: Aligned<[f32; 3]>,
    triangles: Aligned<u32>,
    kinds: Aligned<u8>,
    depths: Aligned<f64>,
    drawn: Vec<Drawn>,
    list: DrawList,
    /// One for each thread.
    scratch: Vec<Mutex<Scratch>>,
    counts: Counts,
}

impl Frame {
    /// An empty frame.
    pub fn new(keep: Keep, workers: Workers) -> Self {
        Frame {
            lens: Lens::default(),
            illumination: Illumination::default(),
            keep,
            scratch: (0..workers.threads()).map(|_| Mutex::default()).collect(),
            workers,
            size: [0, 0],
            rows: 0..0,
            background: DVec3::ZERO,
            pixels: Aligned::default(),
            levels: Aligned::default(),
            triangles: Aligned::default(),
            kinds: Aligned::default(),
            depths: Aligned::default(),
            drawn: Vec::new(),
            list: DrawList::default(),
            counts: Counts::default(),
        }
    }

    /// What it keeps.
    pub fn keep(&self) -> Keep {
        self.keep
    }

    /// Who draws it.
    pub fn workers(&self) -> &Workers {
        &self.workers
    }

    /// Width and height of the whole picture, in pixels.
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// The rows of the picture held here: all of them unless a part was asked for.
    pub fn rows(&self) -> Range<usize> {
        self.rows.clone()
    }

    /// 0x00RRGGBB, row by row from the top; empty unless [`Keep::Display`].
    pub fn pixels(&self) -> &[u32] {
        self.pixels.as_slice()
    }

    /// Levels, row by row from the top; empty unless [`Keep::Levels`].
    pub fn levels(&self) -> &[[f32; 3]] {
        self.levels.as_slice()
    }

    /// Cuboid * 12 + triangle seen at each pixel, or [`NO_TRIANGLE`]; empty unless [`Keep::Levels`] or a depth buffer
    /// was needed. With [`Keep::Display`] it is the first triangle of the face that is seen.
    pub fn triangles(&self) -> &[u32] {
        self.triangles.as_slice()
    }

    /// For each pixel that shows a triangle, how its tile was drawn: the place in [`TileKind::ALL`]; empty unless
    /// [`Keep::Levels`].
    pub fn kinds(&self) -> &[u8] {
        self.kinds.as_slice()
    }

    /// What the last frame took.
    pub fn counts(&self) -> Counts {
        self.counts
    }

    /// Notes that the model was evaluated at the eight corners of a cuboid, `powers` specular powers each.
    pub(crate) fn count_vertices(&mut self, powers: usize) {
        self.counts.model_evaluations += 8;
        self.counts.specular_evaluations += 8 * powers as u64;
    }

    /// Makes room for these rows of a picture, and starts counting anew.
    ///
    /// # Errors
    /// When memory does not suffice; the frame is then empty.
    pub(crate) fn begin(
        &mut self,
        size: [usize; 2],
        rows: Range<usize>,
        deep: bool,
    ) -> Result<(), OutOfMemory> {
        self.counts = Counts::default();
        let pixels = size[0] * rows.len();
        let display = self.keep == Keep::Display;
        let wanted = |kept: bool| if kept { pixels } else { 0 };
        if self.size == size && self.rows == rows && self.depths.len() == wanted(deep) {
            return Ok(());
        }
        let Range { start, end } = rows;
        // Where memory does not suffice, nothing of the old picture may be taken for the new one.
        (self.size, self.rows) = ([0, 0], 0..0);
        self.release();
        let needed = wanted(display) * size_of::<u32>()
            + wanted(!display) * (size_of::<[f32; 3]>() + size_of::<u8>())
            + wanted(deep || !display) * size_of::<u32>()
            + wanted(deep) * size_of::<f64>();
        memory::check(size, needed)?;
        let cleared = Drawn::anything(size[0]);
        self.pixels
            .renew(wanted(display), 0)
            .and_then(|()| self.levels.renew(wanted(!display), [0.0; 3]))
            .and_then(|()| self.triangles.renew(wanted(deep || !display), NO_TRIANGLE))
            .and_then(|()| self.kinds.renew(wanted(!display), 0))
            .and_then(|()| self.depths.renew(wanted(deep), FARTHEST))
            .and_then(|()| self.drawn.try_reserve_exact(end - start))
            .map_err(memory::refused(size, needed))?;
        self.drawn.resize(end - start, cleared);
        (self.size, self.rows) = (size, start..end);
        Ok(())
    }

    /// Gives back the memory of the picture held.
    fn release(&mut self) {
        self.pixels = Aligned::default();
        self.levels = Aligned::default();
        self.triangles = Aligned::default();
        self.kinds = Aligned::default();
        self.depths = Aligned::default();
        self.drawn = Vec::new();
    }

    /// What is to be drawn, taken out while it is worked on.
    pub(crate) fn take_list(&mut self) -> DrawList {
        std::mem::take(&mut self.list)
    }

    /// Has `draw` fill the frame with what is listed, band by band, adds up what it counts, and keeps the list's memory.
    pub(crate) fn paint(
        &mut self,
        background: DVec3,
        mut list: DrawList,
        draw: impl Fn(&DrawList, &mut Band, &mut Scratch) -> Counts + Sync,
    ) {
        if self.background != background {
            self.background = background;
            self.drawn.fill(Drawn::anything(self.size[0]));
        }
        let mut band = Band {
            width: self.size[0],
            rows: self.rows.clone(),
            background,
            pixels: self.pixels.as_mut_slice(),
            levels: self.levels.as_mut_slice(),
            triangles: self.triangles.as_mut_slice(),
            kinds: self.kinds.as_mut_slice(),
            depths: self.depths.as_mut_slice(),
            drawn: &mut self.drawn,
        };
        let scratch = &self.scratch;
        let draw = |list: &DrawList, band: &mut Band| {
            let thread = rayon::current_thread_index().unwrap_or(0) % scratch.len();
            let mut scratch = scratch[thread]
                .lock()
                .unwrap_or_else(PoisonError::into_inner);
            draw(list, band, &mut scratch)
        };
        let pool = self.workers.pool.as_ref();
        self.counts += match pool {
            Some(pool) if list.weigh(&self.rows) >= WORTH_SHARING => {
                let parts = PARTS * pool.current_num_threads();
                pool.install(|| band.split_and(&list, parts, &draw))
            }
            _ => draw(&list, &mut band),
        };
        self.list = list;
    }
}

/// Below this many covered pixels a second thread costs more than it saves.
const WORTH_SHARING: usize = 50_000;

/// Bands for each thread, so that one that is done early helps the others.
const PARTS: usize = 4;
