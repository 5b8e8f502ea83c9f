//! One type for the three shading modes: it prepares squares of a face and evaluates their pixels.

use fearless_simd::{Simd, f32x16};
use glam::DVec3;

use super::face::Face;
use super::field::Extents;
use super::gouraud::{Gouraud, TileColors};
use super::interpolation::Interpolant;
use super::lanes::{LaneLayout, Squares, has};
use super::lights::TileLights;
use super::phong::{FaceLight, Phong};
use super::pixels::Pixels;
use super::rows::{Pointwise, Rows};
use super::square::Square;
use super::unit_vectors::UnitVectors;
use super::{Counts, TileKind};
use crate::simd::{inlined, outlined, two};

/// Shades a face in one of the modes.
pub enum Shader<'a> {
    Gouraud(Gouraud<'a>),
    Phong(Phong<'a>),
    UnitVectors(UnitVectors<'a>),
}

impl Shader<'_> {
    /// Prepares four squares for evaluation. Returns their interpolant, and the squares whose quarters are worth trying. There is
    /// no interpolant if `interpolate` is false, the method is exact, or the bounds of Phong exceed the tolerance on all four.
    #[inline(always)]
    pub fn prepare<S: Simd>(
        &self,
        simd: S,
        extents: &Extents<S>,
        interpolate: bool,
        scratch: &mut TileScratch,
    ) -> (Option<Interpolant<S>>, Squares) {
        let TileScratch { tile, colors, .. } = scratch;
        // The calls with a constant `false` are compiled without bounds and samples, which saves 5 % of the instructions of
        // many small faces.
        match self {
            Shader::Gouraud(gouraud) if interpolate && gouraud.tolerance > 0.0 => {
                outlined!(simd, gouraud.prepare(simd, extents, true, colors))
            }
            Shader::Gouraud(gouraud) => {
                outlined!(simd, gouraud.prepare(simd, extents, false, colors))
            }
            Shader::Phong(phong) if interpolate && phong.tolerance > 0.0 => {
                outlined!(simd, phong.prepare(simd, extents, true, tile))
            }
            Shader::Phong(phong) => outlined!(simd, phong.prepare(simd, extents, false, tile)),
            Shader::UnitVectors(_) => (None, 0),
        }
    }

    /// Evaluates the listed pixels of the square at `index` of those prepared last: in f32 where that keeps the tolerance, else
    /// in f64.
    pub fn evaluate<S: Simd>(
        &self,
        simd: S,
        square: &Square,
        index: usize,
        scratch: &mut TileScratch,
    ) {
        let in_f32 = self.in_f32(index, scratch);
        let (pixels, tile, colors) = (&mut scratch.pixels, &scratch.tile, &scratch.colors);
        if in_f32 {
            let levels = inlined!(|xy| self.levels(simd, (tile, colors), index, xy));
            outlined!(simd, pixels.evaluate(simd, square.half(), levels));
        }
        let (middle, origin) = (square.middle(), self.face().rays.lens.half);
        let middle = two!(|axis| middle[axis] - origin[axis]);
        pixels.evaluate_f64(middle, !in_f32, |x, y| self.levels_f64(x, y));
    }

    /// The rows of a square that is covered all over, if f32 suffices for all of its pixels. The levels are those of
    /// [`Self::evaluate`]. Without rows, frames at tolerance 0 take 20 to 40 % longer.
    #[inline(always)]
    pub fn rows<S: Simd>(
        &self,
        simd: S,
        square: &Square,
        index: usize,
        scratch: &TileScratch,
    ) -> Option<impl Rows<S>> {
        let (tile, colors) = (&scratch.tile, &scratch.colors);
        let has_signs = match self {
            Shader::Phong(phong) => phong.has_signs(tile, index),
            _ => true,
        };
        if !has_signs || !self.in_f32(index, scratch) {
            return None;
        }
        let levels = inlined!(move |xy| self.levels(simd, (tile, colors), index, xy));
        Some(Pointwise::new(simd, square, levels))
    }

    /// The levels in f32 at points of the square at `index`, x and y from -1 to 1.
    #[inline(always)]
    fn levels<S: Simd>(
        &self,
        simd: S,
        (tile, colors): (&TileLights, &TileColors),
        index: usize,
        xy: [f32x16<S>; 2],
    ) -> [f32x16<S>; 3] {
        let at = LaneLayout::Pixels(index);
        match self {
            Shader::Phong(phong) => {
                let [red, green, blue, _] = phong.levels(simd, tile, at, xy);
                [red, green, blue]
            }
            _ => colors.levels(simd, at, xy),
        }
    }

    /// Whether levels in f32 keep the tolerance on the square at `index`.
    pub fn in_f32(&self, index: usize, scratch: &TileScratch) -> bool {
        let squares = match self {
            Shader::Gouraud(_) => scratch.colors.in_f32,
            Shader::Phong(_) => scratch.tile.in_f32,
            Shader::UnitVectors(_) => 0,
        };
        has(squares, index)
    }

    /// Counts pixels that were evaluated on the square at `index`, and returns how.
    pub fn count(&self, index: usize, pixels: usize, scratch: &mut TileScratch) -> TileKind {
        let in_f32 = self.in_f32(index, scratch);
        let (model, powers) = match self {
            Shader::Gouraud(_) => (0, 0),
            Shader::Phong(_) if in_f32 => (1, scratch.tile.highlights(index).count()),
            Shader::Phong(phong) => (1, phong.surface.powers()),
            Shader::UnitVectors(vectors) => (1, vectors.surface.powers()),
        };
        scratch.counts.model_evaluations += model * pixels as u64;
        scratch.counts.specular_evaluations += (pixels * powers) as u64;
        if in_f32 {
            TileKind::PerPixel
        } else {
            TileKind::InF64
        }
    }

    /// The levels in f64, as the mode defines them, `x` pixels right and `y` pixels down of the picture's middle.
    pub fn levels_f64(&self, x: f64, y: f64) -> DVec3 {
        match self {
            Shader::Gouraud(gouraud) => gouraud.levels_f64(x, y),
            Shader::Phong(phong) => phong.levels_f64(x, y),
            Shader::UnitVectors(vectors) => vectors.levels_f64(x, y),
        }
    }

    /// The face that is drawn.
    pub fn face(&self) -> &Face<'_> {
        match self {
            Shader::Gouraud(gouraud) => gouraud.face,
            Shader::Phong(phong) => phong.face,
            Shader::UnitVectors(vectors) => vectors.face,
        }
    }
}

/// The memory of a thread, reused for each face and strip.
#[derive(Debug, Default)]
pub struct Scratch {
    /// The lights that reach the face; and the unit vectors to all lights at its corners, for unit vectors.
    pub lights: Vec<FaceLight>,
    pub to_lights: Vec<[DVec3; 4]>,
    pub tiles: TileScratch,
    /// Of a strip: a bit for each pixel that is covered, and the nearness of the visible pieces, stale where no id is set.
    pub covered: Vec<u64>,
    pub depths: Vec<f64>,
}

/// The memory for four squares of a face, and the counts of all work so far.
#[derive(Debug, Default)]
pub struct TileScratch {
    pub pixels: Pixels,
    tile: TileLights,
    colors: TileColors,
    pub counts: Counts,
}
