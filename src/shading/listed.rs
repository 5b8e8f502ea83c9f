//! A list of the pixels of a square at which the model is evaluated. Sixteen of them at a time fill the lanes, whatever rows
//! they are in.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, mask32x16, u32x16};
use glam::DVec3;

use super::display::display;
use super::rows::counted;
use super::square::MAX_SIDE;
use crate::shading::simd::{three, two};

/// The most pixels of a square, and room for the lanes beyond the last.
const MOST: usize = MAX_SIDE * MAX_SIDE + 16;

/// Pixels of one square in a band.
#[derive(Debug)]
pub struct ListedPixels {
    pub count: usize,
    /// Right and down from the square's middle, in pixels.
    offsets: [[f32; MOST]; 2],
    /// The indices in the buffers of the band.
    pub indices: [u32; MOST],
    /// A red level that is not a number marks a pixel that f32 does not suffice for.
    levels: [[f32; MOST]; 3],
    /// Whether any pixel is marked.
    marked: bool,
}

impl Default for ListedPixels {
    fn default() -> Self {
        ListedPixels {
            count: 0,
            offsets: [[0.0; MOST]; 2],
            indices: [0; MOST],
            levels: [[0.0; MOST]; 3],
            marked: false,
        }
    }
}

impl ListedPixels {
    /// Adds at most sixteen pixels side by side. The first is at `x`, `y` from the square's middle, and has this index. If
    /// pixels were added one by one, frames at tolerance 0 would take 15 to 25 % more instructions, and 10,000 small
    /// cuboids 7 % more time.
    #[inline(always)]
    pub fn extend<S: Simd>(&mut self, simd: S, [x, y]: [f32; 2], index: usize, count: usize) {
        // Lanes beyond the last pixel are overwritten by the next.
        let new = self.count..self.count + 16;
        let right = counted(simd, 0) + x;
        self.offsets[0][new.clone()].copy_from_slice(right.as_slice());
        self.offsets[1][new.clone()].fill(y);
        let indices = u32x16::from_fn(simd, |lane| lane as u32) + index as u32;
        self.indices[new].copy_from_slice(indices.as_slice());
        self.count += count;
    }

    /// Evaluates all pixels; the arguments of `evaluate` are x and y from -1 to 1 over the square of these half extents.
    #[inline(always)]
    pub fn evaluate<S: Simd>(
        &mut self,
        simd: S,
        half: [f64; 2],
        evaluate: impl Fn([f32x16<S>; 2]) -> [f32x16<S>; 3],
    ) {
        let scale = half.map(|half| (1.0 / half) as f32);
        let mut marked = mask32x16::splat(simd, false);
        for first in (0..self.count).step_by(16) {
            let lanes = first..first + 16;
            let levels = evaluate(two!(|axis| {
                f32x16::from_slice(simd, &self.offsets[axis][lanes.clone()]) * scale[axis]
            }));
            marked |= !levels[0].simd_eq(levels[0]);
            for channel in 0..3 {
                self.levels[channel][lanes.clone()].copy_from_slice(levels[channel].as_slice());
            }
        }
        self.marked = marked.any_true();
    }

    /// Evaluates all pixels, or only those that are marked, in f64 one by one. The square's middle and the
    /// arguments of `evaluate` are in pixels right and down from the picture's middle.
    pub fn evaluate_f64(
        &mut self,
        [right, down]: [f64; 2],
        all: bool,
        evaluate: impl Fn(f64, f64) -> DVec3,
    ) {
        if !all && !self.marked {
            return;
        }
        for pixel in 0..self.count {
            if all || self.levels[0][pixel].is_nan() {
                let [x, y] = two!(|axis| f64::from(self.offsets[axis][pixel]));
                let levels = evaluate(x + right, y + down).as_vec3();
                for channel in 0..3 {
                    self.levels[channel][pixel] = levels[channel];
                }
            }
        }
    }

    /// The indices of the pixels and their levels.
    pub fn levels(&self) -> impl Iterator<Item = (usize, [f32; 3])> {
        let levels = |pixel: usize| three!(|channel| self.levels[channel][pixel]);
        (0..self.count).map(move |pixel| (self.indices[pixel] as usize, levels(pixel)))
    }

    /// Writes the display step of the levels to the buffer of a band.
    #[inline(always)]
    pub fn show<S: Simd>(&self, simd: S, buffer: &mut [u32]) {
        for first in (0..self.count).step_by(16) {
            let pixels = display(three!(|channel| {
                let levels = &self.levels[channel][first..first + 16];
                f32x16::from_slice(simd, levels)
            }));
            let indices = &self.indices[first..self.count.min(first + 16)];
            let start = indices[0] as usize;
            if indices.len() == 16 && indices[15] as usize == start + 15 {
                buffer[start..start + 16].copy_from_slice(pixels.as_slice());
            } else {
                for (index, pixel) in indices.iter().zip(pixels.as_array()) {
                    buffer[*index as usize] = *pixel;
                }
            }
        }
    }
}
