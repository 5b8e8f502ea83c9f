//! The shading methods behind one type: prepares squares of a face, and evaluates their pixels.

use fearless_simd::Simd;
use glam::DVec3;

use super::TileKind;
use super::display::Sink;
use super::face::Face;
use super::field::Places;
use super::gouraud::{Gouraud, TileColors};
use super::interpolation::Interpolant;
use super::lanes::LaneLayout;
use super::phong::{FaceLight, Phong, TileLights};
use super::pixels::Pixels;
use super::rows::Pointwise;
use super::square::{MIN_SIDE, Square};
use super::unit_vectors::UnitVectors;
use crate::simd::{inlined, outlined};

/// Shades the squares of a face by one of the definitions.
pub enum Shader<'a> {
    Gouraud(Gouraud<'a>),
    Phong(Phong<'a>),
    UnitVectors(UnitVectors<'a>),
}

impl Shader<'_> {
    /// Prepares four squares for being evaluated. Returns an interpolant, or None if `interpolate` is false or the bounds leave
    /// nothing of the tolerance; and a set of squares, a bit each, whose quarters are worth trying.
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
                let interpolant = outlined!(simd, gouraud.prepare(simd, places, true, colors));
                (interpolant, 0b1111)
            }
            Shader::Gouraud(gouraud) => {
                outlined!(simd, gouraud.prepare(simd, places, false, colors));
                (None, 0)
            }
            Shader::Phong(phong) if interpolate && phong.tolerance > 0.0 => {
                outlined!(simd, phong.prepare(simd, places, true, tile))
            }
            Shader::Phong(phong) => outlined!(simd, phong.prepare(simd, places, false, tile)),
            Shader::UnitVectors(_) => (None, 0),
        }
    }

    /// Evaluates the pixels in the scratch, of the square at `index` of those prepared last: in f32 where that keeps the
    /// tolerance, else in f64; None where that may be cheaper on the quarters of the square.
    pub fn evaluate<S: Simd>(
        &self,
        simd: S,
        square: &Square,
        picture: [f64; 2],
        index: usize,
        scratch: &mut Scratch,
    ) -> Option<Evaluations> {
        let single = self.single(index, scratch);
        let Scratch {
            pixels,
            tile,
            colors,
            ..
        } = scratch;
        match self {
            Shader::Gouraud(_) if single.is_some() => {
                let levels =
                    inlined!(|place| colors.levels(simd, LaneLayout::Pixels(index), place));
                outlined!(simd, pixels.evaluate(simd, square.half(), levels));
            }
            Shader::Phong(phong) if single.is_some() => {
                let levels = inlined!(|place| phong.pixel_levels(simd, tile, index, place));
                outlined!(simd, pixels.evaluate(simd, square.half(), levels));
            }
            _ if square.side > MIN_SIDE => return None,
            _ => pixels.forget(),
        }
        pixels.define(square.middle_from(picture), |x, y| self.define(x, y));
        Some(self.evaluations(single, pixels.count()))
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
        let Scratch { tile, colors, .. } = scratch;
        let highlights = self.single(index, scratch)?;
        match self {
            Shader::Gouraud(_) => {
                let levels =
                    inlined!(|place| colors.levels(simd, LaneLayout::Pixels(index), place));
                outlined!(simd, sink.draw(&mut Pointwise::new(simd, square, levels)));
            }
            Shader::Phong(phong) if phong.has_signs(tile, index) => {
                let levels = inlined!(|place| phong.pixel_levels(simd, tile, index, place));
                outlined!(simd, sink.draw(&mut Pointwise::new(simd, square, levels)));
            }
            _ => return None,
        }
        Some(self.evaluations(Some(highlights), square.pixels))
    }

    /// The number of highlights evaluated at a pixel of the square at `index`, if f32 keeps the tolerance there.
    fn single(&self, index: usize, scratch: &Scratch) -> Option<usize> {
        match self {
            Shader::Gouraud(gouraud) => gouraud.single(&scratch.colors, index),
            Shader::Phong(phong) => phong.single(&scratch.tile, index),
            Shader::UnitVectors(_) => None,
        }
    }

    /// The work of so many pixels with `single` highlights each in f32, or all of them in f64.
    fn evaluations(&self, single: Option<usize>, pixels: usize) -> Evaluations {
        let (model, powers) = match self {
            Shader::Gouraud(_) => (0, 0),
            Shader::Phong(phong) => (1, phong.surface.powers()),
            Shader::UnitVectors(vectors) => (1, vectors.surface.powers()),
        };
        Evaluations {
            kind: single.map_or(TileKind::Double, |_| TileKind::Exact),
            model: model * pixels as u64,
            specular: (pixels * single.unwrap_or(powers)) as u64,
        }
    }

    /// The definition, in f64, at the pixel `x` right and `y` down of the picture's middle, in levels.
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

impl Evaluations {
    /// None at pixels, on a square that is interpolated.
    pub fn none(kind: TileKind) -> Self {
        Evaluations {
            kind,
            model: 0,
            specular: 0,
        }
    }
}

/// Room for the lights of one face, for the pixels of one square, and for the lights that are evaluated there.
#[derive(Debug, Default)]
pub struct Scratch {
    pub pixels: Pixels,
    /// The lights that reach the face being drawn, and the unit vectors to all lights at its corners.
    pub lights: Vec<FaceLight>,
    pub to_lights: Vec<[DVec3; 4]>,
    tile: TileLights,
    colors: TileColors,
}
