//! Pixels: what one frame is drawn into.

use std::ops::Range;

use fearless_simd::Level;

/// Who draws: the SIMD level and the threads.
pub struct Workers {
    level: Level,
    pool: Option<rayon::ThreadPool>,
}

impl Workers {
    /// `threads` 1 is the calling thread alone.
    pub fn new(_threads: usize, _level: Level) -> Self {
        unimplemented!()
    }
    /// The SIMD level in use.
    pub fn level(&self) -> Level {
        self.level
    }
    /// How many threads draw.
    pub fn threads(&self) -> usize {
        self.pool.as_ref().map_or(1, rayon::ThreadPool::current_num_threads)
    }
}

/// What a frame keeps of every pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Keep {
    /// The display step's bytes, 0x00RRGGBB, as a window takes them.
    Display,
    /// Unclamped, unrounded levels and the triangle seen.
    Levels,
}

/// The id of a pixel where nothing is drawn.
pub const NO_TRIANGLE: u32 = u32::MAX;

/// What was done for one frame; the same on every machine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Pixels covered by a triangle.
    pub covered_pixels: u64,
    /// Evaluations of the illumination model, at vertices or pixels.
    pub model_evaluations: u64,
    /// Powers evaluated.
    pub specular_evaluations: u64,
}

/// The picture does not fit in memory.
#[derive(Debug, thiserror::Error)]
#[error("a picture of {width}x{height} needs {bytes} bytes, more than this machine has free")]
pub struct OutOfMemory {
    /// Pixels.
    pub width: usize,
    /// Pixels.
    pub height: usize,
    /// What was asked for.
    pub bytes: u64,
}

/// A picture being drawn, and what the systems keep between frames so that a warm frame allocates nothing.
pub struct Frame {
    keep: Keep,
}

impl Frame {
    /// An empty frame.
    pub fn new(keep: Keep, _workers: Workers) -> Self {
        Frame { keep }
    }
    /// What it keeps.
    pub fn keep(&self) -> Keep {
        self.keep
    }
    /// Width and height of the whole picture, in pixels.
    pub fn size(&self) -> [usize; 2] {
        unimplemented!()
    }
    /// The rows of the picture held here: all of them unless a part was asked for.
    pub fn rows(&self) -> Range<usize> {
        unimplemented!()
    }
    /// 0x00RRGGBB, row by row from the top; empty unless [`Keep::Display`].
    pub fn pixels(&self) -> &[u32] {
        unimplemented!()
    }
    /// Levels, row by row from the top; empty unless [`Keep::Levels`].
    pub fn levels(&self) -> &[[f32; 3]] {
        unimplemented!()
    }
    /// Cuboid * 12 + triangle seen at each pixel, or [`NO_TRIANGLE`]; empty unless [`Keep::Levels`].
    pub fn triangles(&self) -> &[u32] {
        unimplemented!()
    }
    /// What the last frame took.
    pub fn counts(&self) -> Counts {
        unimplemented!()
    }
}

/// The contract's display step: `floor(clamp(level, 0, 255) + 0.5)`, NaN gives 0.
pub fn display_step(_level: f64) -> u8 {
    unimplemented!()
}
