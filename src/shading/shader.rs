//! One type for the three shading modes: it prepares squares of a face and evaluates their pixels.

use fearless_simd::{Simd, f32x16};
use glam::DVec3;

use super::TileKind;
use super::display::Sink;
use super::face::Face;
use super::field::Places;
use super::gouraud::{Gouraud, TileColors};
use super::interpolation::Interpolant;
use super::lanes::LaneLayout;
use super::lights::TileLights;
use super::phong::{FaceLight, Phong};
use super::pixels::Pixels;
use super::rows::Pointwise;
use super::square::{MIN_SIDE, Square};
use super::unit_vectors::UnitVectors;
use crate::simd::{inlined, outlined};

/// Shades a face in one of the modes.
pub enum Shader<'a> {
    Gouraud(Gouraud<'a>),
    Phong(Phong<'a>),
    UnitVectors(UnitVectors<'a>),
}

impl Shader<'_> {
    /// Prepares four squares for evaluation. Returns an interpolant, or None if `interpolate` is false, the method is exact or
    /// the bounds of Phong exceed the tolerance on all of them; and the set of squares, a bit each, whose quarters are worth trying.
    #[inline(always)]
    pub fn prepare<S: Simd>(
        &self,
        simd: S,
        places: &Places<S>,
        interpolate: bool,
        scratch: &mut Scratch,
    ) -> (Option<Interpolant<S>>, u64) {
        let Scratch { tile, colors, .. } = scratch;
        // Compiled apart without bounds and samples: 5 % of the instructions of a crowd of small faces.
        match self {
            Shader::Gouraud(gouraud) if interpolate && gouraud.tolerance > 0.0 => {
                outlined!(simd, gouraud.prepare(simd, places, true, colors))
            }
            Shader::Gouraud(gouraud) => {
                outlined!(simd, gouraud.prepare(simd, places, false, colors))
            }
            Shader::Phong(phong) if interpolate && phong.tolerance > 0.0 => {
                outlined!(simd, phong.prepare(simd, places, true, tile))
            }
            Shader::Phong(phong) => outlined!(simd, phong.prepare(simd, places, false, tile)),
            Shader::UnitVectors(_) => (None, 0),
        }
    }

    /// Evaluates the pixels in the scratch, which are of the square at `index` of those prepared last: in f32 where that keeps
    /// the tolerance, else in f64. Returns None where that may be cheaper on the quarters of the square.
    pub fn evaluate<S: Simd>(
        &self,
        simd: S,
        square: &Square,
        picture: [f64; 2],
        index: usize,
        scratch: &mut Scratch,
    ) -> Option<Evaluations> {
        let highlights = self.highlights(index, scratch);
        let (pixels, tile, colors) = (&mut scratch.pixels, &scratch.tile, &scratch.colors);
        if highlights.is_some() {
            let levels = inlined!(|place| self.levels(simd, (tile, colors), index, place));
            outlined!(simd, pixels.evaluate(simd, square.half(), levels));
        } else if square.side > MIN_SIDE {
            return None;
        }
        let middle = square.middle_from(picture);
        pixels.define(middle, highlights.is_none(), |x, y| self.define(x, y));
        Some(self.evaluations(highlights, pixels.count()))
    }

    /// Draws a square that is seen all over, as [`Self::evaluate`] does but by rows, if f32 suffices for all of its pixels.
    /// Without rows, frames at tolerance 0 take 20 to 40 % longer.
    pub fn fill<S: Simd>(
        &self,
        simd: S,
        square: &Square,
        index: usize,
        scratch: &Scratch,
        sink: &mut impl Sink<S>,
    ) -> Option<Evaluations> {
        let highlights = self.highlights(index, scratch)?;
        let (tile, colors) = (&scratch.tile, &scratch.colors);
        if let Shader::Phong(phong) = self
            && !phong.has_signs(tile, index)
        {
            return None;
        }
        let levels = inlined!(|place| self.levels(simd, (tile, colors), index, place));
        outlined!(simd, sink.draw(&mut Pointwise::new(simd, square, levels)));
        Some(self.evaluations(Some(highlights), square.pixels))
    }

    /// The levels in f32 at places on the square at `index`, x and y from -1 to 1.
    #[inline(always)]
    fn levels<S: Simd>(
        &self,
        simd: S,
        (tile, colors): (&TileLights, &TileColors),
        index: usize,
        place: [f32x16<S>; 2],
    ) -> [f32x16<S>; 3] {
        let at = LaneLayout::Pixels(index);
        match self {
            Shader::Phong(phong) => {
                let [red, green, blue, _] = phong.levels(simd, tile, at, place);
                [red, green, blue]
            }
            _ => colors.levels(simd, at, place),
        }
    }

    /// The number of highlights evaluated at a pixel of the square at `index` in f32, if f32 keeps the tolerance there.
    fn highlights(&self, index: usize, scratch: &Scratch) -> Option<usize> {
        match self {
            Shader::Gouraud(_) => (scratch.colors.in_f32 >> index & 1 == 1).then_some(0),
            Shader::Phong(_) => scratch.tile.highlights(index),
            Shader::UnitVectors(_) => None,
        }
    }

    /// The work of some pixels with so many highlights each in f32, or with all of them in f64 if that is None.
    fn evaluations(&self, highlights: Option<usize>, pixels: usize) -> Evaluations {
        let (model, powers) = match self {
            Shader::Gouraud(_) => (0, 0),
            Shader::Phong(phong) => (1, phong.surface.powers()),
            Shader::UnitVectors(vectors) => (1, vectors.surface.powers()),
        };
        Evaluations {
            kind: highlights.map_or(TileKind::Double, |_| TileKind::Exact),
            model: model * pixels as u64,
            specular: (pixels * highlights.unwrap_or(powers)) as u64,
        }
    }

    /// The levels that the mode defines, in f64, `x` pixels right and `y` pixels down of the picture's middle.
    pub fn define(&self, x: f64, y: f64) -> DVec3 {
        match self {
            Shader::Gouraud(gouraud) => gouraud.define(x, y),
            Shader::Phong(phong) => phong.define(x, y),
            Shader::UnitVectors(vectors) => vectors.define(x, y),
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

/// The work done on a square.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Evaluations {
    /// How it was drawn.
    pub kind: TileKind,
    /// Evaluations of the illumination model.
    pub model: u64,
    /// Evaluations of the specular power.
    pub specular: u64,
}

/// The memory of one face and its squares, reused for the next.
#[derive(Debug, Default)]
pub struct Scratch {
    pub pixels: Pixels,
    /// The lights that reach the face; and the unit vectors to all lights at its corners, for unit vectors.
    pub lights: Vec<FaceLight>,
    pub to_lights: Vec<[DVec3; 4]>,
    tile: TileLights,
    colors: TileColors,
}
