//! One type for Gouraud and Phong shading: it prepares squares of a face and evaluates their pixels.

use fearless_simd::{Simd, f32x16};
use glam::DVec3;

use super::face::Face;
use super::gouraud::{Gouraud, GridSquares};
use super::interpolation::Interpolant;
use super::lanes::has;
use super::listed::ListedPixels;
use super::moving::Extents;
use super::phong::{FaceLight, Phong};
use super::rows::{EvaluatedRows, Rows};
use super::square::Square;
use super::{Counts, SquareKind};
use crate::shading::simd::{inlined, outlined, two};

/// Shades a face in one of the modes.
pub enum Shader<'a> {
    Gouraud(Gouraud<'a>),
    Phong(Phong<'a>),
}

impl Shader<'_> {
    /// Prepares four squares for evaluation. There is no interpolant if `interpolate` is false, or the bounds of Phong exceed the
    /// tolerance on all four.
    #[inline(always)]
    pub fn prepare<S: Simd>(
        &mut self,
        simd: S,
        extents: &Extents<S>,
        interpolate: bool,
    ) -> Option<Interpolant<S>> {
        match self {
            Shader::Gouraud(gouraud) => gouraud.prepare(simd, extents, interpolate),
            Shader::Phong(phong) => phong.prepare(simd, extents, interpolate),
        }
    }

    /// Prepares four squares for evaluation at their pixels; compiled without bounds and samples.
    pub fn prepare_pixels<S: Simd>(&mut self, simd: S, extents: &Extents<S>) {
        outlined!(simd, self.prepare(simd, extents, false));
    }

    /// Evaluates the listed pixels of the square at `index` of those prepared last: in f32 where that keeps the tolerance,
    /// else in f64.
    pub fn evaluate<S: Simd>(
        &self,
        simd: S,
        square: &Square,
        index: usize,
        pixels: &mut ListedPixels,
    ) {
        let in_f32 = self.in_f32(index);
        if in_f32 && let Some(levels) = self.look_up(simd, index) {
            outlined!(simd, pixels.evaluate(simd, square.half(), levels));
        } else if in_f32 {
            let levels = inlined!(|xy| self.levels(simd, index, xy));
            outlined!(simd, pixels.evaluate(simd, square.half(), levels));
        }
        let (middle, picture) = (square.middle(), self.face().rays.lens.middle);
        let middle = two!(|axis| middle[axis] - picture[axis]);
        pixels.evaluate_f64(middle, !in_f32, |x, y| self.levels_f64(x, y));
    }

    /// The rows of a square that is covered all over, if f32 suffices for all of its pixels. The levels are those of
    /// [`Self::evaluate`]. Without rows, frames at tolerance 0 take 20 to 40 % longer.
    #[inline(always)]
    pub fn rows<S: Simd>(&self, simd: S, square: &Square, index: usize) -> Option<impl Rows<S>> {
        let has_signs = match self {
            Shader::Phong(phong) => phong.has_signs(index),
            Shader::Gouraud(_) => true,
        };
        if !has_signs || !self.in_f32(index) || self.look_up(simd, index).is_some() {
            return None;
        }
        let levels = inlined!(move |xy| self.levels(simd, index, xy));
        Some(EvaluatedRows::new(simd, square, levels))
    }

    /// The rows of a square that is covered all over and lies in several cells of a grid, if f32 suffices. In one function with
    /// [`Self::rows`] frames without grids take 2 to 6 % more instructions at tolerance 0.
    #[inline(always)]
    pub fn grid_rows<S: Simd>(
        &self,
        simd: S,
        square: &Square,
        index: usize,
    ) -> Option<impl Rows<S>> {
        let levels = self.look_up(simd, index)?;
        let rows = EvaluatedRows::new(simd, square, levels);
        self.in_f32(index).then_some(rows)
    }

    /// See [`Gouraud::look_up`].
    #[inline(always)]
    fn look_up<S: Simd>(
        &self,
        simd: S,
        index: usize,
    ) -> Option<impl Fn([f32x16<S>; 2]) -> [f32x16<S>; 3]> {
        match self {
            Shader::Gouraud(gouraud) => gouraud.look_up(simd, index),
            Shader::Phong(_) => None,
        }
    }

    /// The levels in f32 at points of the square at `index`, x and y from -1 to 1.
    #[inline(always)]
    fn levels<S: Simd>(&self, simd: S, index: usize, xy: [f32x16<S>; 2]) -> [f32x16<S>; 3] {
        match self {
            Shader::Gouraud(gouraud) => gouraud.levels(simd, index, xy),
            Shader::Phong(phong) => {
                let [red, green, blue, _] = phong.levels(simd, index, false, xy);
                [red, green, blue]
            }
        }
    }

    /// Whether levels in f32 keep the tolerance on the square at `index`.
    pub fn in_f32(&self, index: usize) -> bool {
        let squares = match self {
            Shader::Gouraud(gouraud) => gouraud.in_f32,
            Shader::Phong(phong) => phong.in_f32,
        };
        has(squares, index)
    }

    /// Counts pixels that were evaluated on the square at `index`, and returns how.
    pub fn count(&self, index: usize, pixels: usize, counts: &mut Counts) -> SquareKind {
        let in_f32 = self.in_f32(index);
        let [model, powers] = match self {
            Shader::Gouraud(gouraud) => gouraud.evaluations(),
            Shader::Phong(phong) if in_f32 => [1, phong.highlights(index).count()],
            Shader::Phong(phong) => [1, phong.surface.powers()],
        };
        counts.model_evaluations += (pixels * model) as u64;
        counts.specular_evaluations += (pixels * powers) as u64;
        if in_f32 {
            SquareKind::PerPixel
        } else {
            SquareKind::InF64
        }
    }

    /// The levels in f64, as the mode defines them, `x` pixels right and `y` pixels down of the picture's middle.
    pub fn levels_f64(&self, x: f64, y: f64) -> DVec3 {
        match self {
            Shader::Gouraud(gouraud) => gouraud.levels_f64(x, y),
            Shader::Phong(phong) => phong.levels_f64(x, y),
        }
    }

    /// The face that is drawn.
    pub fn face(&self) -> &Face<'_> {
        match self {
            Shader::Gouraud(gouraud) => gouraud.face,
            Shader::Phong(phong) => phong.face,
        }
    }
}

/// The memory of a thread, reused for each face and strip, and the counts of all its work.
#[derive(Debug, Default)]
pub struct Scratch {
    /// The lights that reach the face.
    pub lights: Vec<FaceLight>,
    /// For [`Gouraud`] with several segments.
    pub cells: GridSquares,
    pub pixels: ListedPixels,
    pub counts: Counts,
    /// One bit a pixel of a strip: covered so far.
    pub covered: Vec<u64>,
    /// Nearness of the visible piece at each pixel of a strip; meaningless where the id is [`TriangleId::NONE`].
    ///
    /// [`TriangleId::NONE`]: crate::components::TriangleId::NONE
    pub depths: Vec<f64>,
}
