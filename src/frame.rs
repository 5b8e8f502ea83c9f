//! Pixels: what one frame is drawn into, cut into bands for threads, and the display step.
//!
//! Rule: a warm frame of unchanged size allocates nothing, clears only what the last frame touched, and holds the same
//! bits however many threads drew it.

use std::ops::{AddAssign, Range};

use fearless_simd::Level;
use glam::DVec3;
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};

use crate::shading::{BLOCK, TileKind};

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
    /// Unclamped, unrounded levels and the triangle seen.
    Levels,
}

/// The id of a pixel where nothing is drawn.
pub const NO_TRIANGLE: u32 = u32::MAX;

/// Farther than any depth.
const FARTHEST: f64 = f64::MIN;

/// What was done for one frame; the same on every machine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Pixels covered by a triangle.
    pub covered_pixels: u64,
    /// Evaluations of the illumination model, at vertices or pixels.
    pub model_evaluations: u64,
    /// Powers evaluated.
    pub specular_evaluations: u64,
    /// Tiles drawn, by [`TileKind`] in the order of [`TileKind::ALL`].
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

/// The picture does not fit in memory.
#[derive(Debug, thiserror::Error)]
#[error("a picture of {width}x{height} pixels does not fit in this machine's memory")]
pub struct OutOfMemory {
    /// Pixels.
    pub width: usize,
    /// Pixels.
    pub height: usize,
}

/// A picture being drawn, and what the systems keep between frames.
pub struct Frame {
    keep: Keep,
    workers: Workers,
    size: [usize; 2],
    rows: Range<usize>,
    background: DVec3,
    pixels: Vec<u32>,
    levels: Vec<[f32; 3]>,
    triangles: Vec<u32>,
    depths: Vec<f64>,
    touched: Vec<[u32; 2]>,
    counts: Counts,
}

impl Frame {
    /// An empty frame.
    pub fn new(keep: Keep, workers: Workers) -> Self {
        Frame {
            keep,
            workers,
            size: [0, 0],
            rows: 0..0,
            background: DVec3::ZERO,
            pixels: Vec::new(),
            levels: Vec::new(),
            triangles: Vec::new(),
            depths: Vec::new(),
            touched: Vec::new(),
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
        &self.pixels
    }

    /// Levels, row by row from the top; empty unless [`Keep::Levels`].
    pub fn levels(&self) -> &[[f32; 3]] {
        &self.levels
    }

    /// Cuboid * 12 + triangle seen at each pixel, or [`NO_TRIANGLE`]; empty unless [`Keep::Levels`] or a depth buffer
    /// was needed.
    pub fn triangles(&self) -> &[u32] {
        &self.triangles
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
        let wanted = |kept: bool| if kept { pixels } else { 0 };
        let display = self.keep == Keep::Display;
        let lengths = [
            wanted(display),
            wanted(!display),
            wanted(deep || !display),
            wanted(deep),
        ];
        let present = [
            self.pixels.len(),
            self.levels.len(),
            self.triangles.len(),
            self.depths.len(),
        ];
        if self.size == size && self.rows == rows && lengths == present {
            return Ok(());
        }
        // What was there is of another picture: all of it is to be cleared, and a smaller window gives memory back.
        self.pixels = Vec::new();
        self.levels = Vec::new();
        self.triangles = Vec::new();
        self.depths = Vec::new();
        self.touched.clear();
        (self.size, self.rows) = ([0, 0], 0..0);
        let out_of_memory = |_| OutOfMemory {
            width: size[0],
            height: size[1],
        };
        self.pixels
            .try_reserve_exact(lengths[0])
            .map_err(out_of_memory)?;
        self.levels
            .try_reserve_exact(lengths[1])
            .map_err(out_of_memory)?;
        self.triangles
            .try_reserve_exact(lengths[2])
            .map_err(out_of_memory)?;
        self.depths
            .try_reserve_exact(lengths[3])
            .map_err(out_of_memory)?;
        self.touched
            .try_reserve_exact(rows.len())
            .map_err(out_of_memory)?;
        self.pixels.resize(lengths[0], 0);
        self.levels.resize(lengths[1], [0.0; 3]);
        self.triangles.resize(lengths[2], NO_TRIANGLE);
        self.depths.resize(lengths[3], FARTHEST);
        self.touched.resize(rows.len(), [0, size[0] as u32]);
        (self.size, self.rows) = (size, rows);
        Ok(())
    }

    /// Has `draw` fill the frame, band by band, and adds up what it counts. `alone`: on the calling thread.
    pub(crate) fn paint(
        &mut self,
        background: DVec3,
        alone: bool,
        draw: impl Fn(&mut Band) -> Counts + Sync,
    ) {
        if self.background != background {
            self.background = background;
            self.touched.fill([0, self.size[0] as u32]);
        }
        let mut band = Band {
            width: self.size[0],
            height: self.size[1],
            rows: self.rows.clone(),
            background,
            pixels: &mut self.pixels,
            levels: &mut self.levels,
            triangles: &mut self.triangles,
            depths: &mut self.depths,
            touched: &mut self.touched,
        };
        self.counts += match &self.workers.pool {
            Some(pool) if !alone => {
                let rows = self
                    .rows
                    .len()
                    .div_ceil(4 * pool.current_num_threads())
                    .next_multiple_of(BLOCK);
                pool.install(|| band.split_and(rows, &draw))
            }
            _ => draw(&mut band),
        };
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
    pub depths: &'a mut [f64],
    /// For each row, the pixels from..to that may differ from the background.
    pub touched: &'a mut [[u32; 2]],
}

impl Band<'_> {
    /// Draws in parts of about `rows` rows, in parallel. Parts meet where blocks of tiles do, so none is cut in two.
    fn split_and(&mut self, rows: usize, draw: &(impl Fn(&mut Band) -> Counts + Sync)) -> Counts {
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

    fn split(&mut self, row: usize) -> (Band<'_>, Band<'_>) {
        fn at<T>(slice: &mut [T], index: usize) -> (&mut [T], &mut [T]) {
            let index = index.min(slice.len());
            slice.split_at_mut(index)
        }
        let rows = row - self.rows.start;
        let pixels = at(self.pixels, rows * self.width);
        let levels = at(self.levels, rows * self.width);
        let triangles = at(self.triangles, rows * self.width);
        let depths = at(self.depths, rows * self.width);
        let touched = at(self.touched, rows);
        let (width, height, background) = (self.width, self.height, self.background);
        (
            Band {
                width,
                height,
                background,
                rows: self.rows.start..row,
                pixels: pixels.0,
                levels: levels.0,
                triangles: triangles.0,
                depths: depths.0,
                touched: touched.0,
            },
            Band {
                width,
                height,
                background,
                rows: row..self.rows.end,
                pixels: pixels.1,
                levels: levels.1,
                triangles: triangles.1,
                depths: depths.1,
                touched: touched.1,
            },
        )
    }

    /// Puts the background back wherever the last frame drew.
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

fn fill<T: Copy>(slice: &mut [T], range: Range<usize>, value: T) {
    if !slice.is_empty() {
        slice[range].fill(value);
    }
}

/// The contract's display step: `floor(clamp(level, 0, 255) + 0.5)`, NaN gives 0.
pub fn display_step(level: f64) -> u8 {
    let positive = if level > 0.0 { level } else { 0.0 };
    (positive.min(255.0) + 0.5).floor() as u8
}

/// 2^23: adding it to a float of 0..=255 leaves the nearest integer, halves to even, in the low bits.
const INTEGERS: f32 = 8_388_608.0;

#[inline(always)]
fn clamped(level: f32) -> f32 {
    let positive = if level > 0.0 { level } else { 0.0 };
    if positive < 255.0 { positive } else { 255.0 }
}

/// The display step of f32 levels, the byte in the low bits and the rest as in [`INTEGERS`]: for every float
/// `floor(clamp(level) + 0.5)` in real arithmetic, without the saturating casts that keep loops from vectorising.
#[inline(always)]
pub(crate) fn display_bits(level: f32) -> u32 {
    let level = clamped(level);
    let nearest = level + INTEGERS;
    // The subtraction is exact; a half that went down to even is put right.
    let half = level - (nearest - INTEGERS) == 0.5;
    nearest.to_bits() + u32::from(half)
}

/// The same where levels are approximations anyway: halves go up, and so does the one float below an odd half.
#[inline(always)]
pub(crate) fn display_bits_within(level: f32) -> u32 {
    (f32::from_bits(clamped(level).to_bits() + 1) + INTEGERS).to_bits()
}

/// Three display bits as 0x00RRGGBB; shifting drops what is not the byte.
#[inline(always)]
pub(crate) fn pack([red, green, blue]: [u32; 3]) -> u32 {
    red << 16 | green << 8 | blue & 0xff
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_display_step_rounds_halves_up_and_survives_anything() {
        for (level, byte) in [
            (f64::NAN, 0),
            (f64::NEG_INFINITY, 0),
            (f64::INFINITY, 255),
            (-0.0, 0),
            (-3.0, 0),
            (0.499_999_99, 0),
            (0.5, 1),
            (1.5, 2),
            (2.5, 3),
            (254.499, 254),
            (254.5, 255),
            (255.0, 255),
            (1e30, 255),
        ] {
            assert_eq!(display_step(level), byte, "{level}");
            let byte = u32::from(display_step(f64::from(level as f32)));
            let level = level as f32;
            assert_eq!(
                pack([display_bits(level); 3]),
                byte * 0x0001_0101,
                "{level} in f32"
            );
            assert_eq!(
                pack([display_bits_within(level); 3]),
                byte * 0x0001_0101,
                "{level} in f32, within"
            );
        }
    }

    #[test]
    fn the_fast_display_steps_are_the_plain_one_on_every_kind_of_float() {
        // Every 257th of all floats, and all those next to a half.
        let everywhere = (0..=u32::MAX / 257).map(|step| f32::from_bits(step * 257));
        let halves = (0..=255).flat_map(|level| {
            let half = (level as f32 + 0.5).to_bits();
            (half - 3..=half + 3).map(f32::from_bits)
        });
        for level in everywhere.chain(halves) {
            let byte = u32::from(display_step(f64::from(level)));
            assert_eq!(display_bits(level) & 0xff, byte, "{level}");
            let early = u32::from(display_step(f64::from(f32::from_bits(
                level.to_bits().wrapping_add(1),
            ))));
            let within = display_bits_within(level) & 0xff;
            assert!(
                within == byte || within == early,
                "{level}: {within}, not {byte}"
            );
        }
    }
}
