//! Light that is no polynomial of a whole tile in, what it costs out.
//!
//! Rule: either that is infinitely much, or every pixel of the tile gets what is missing.

use fearless_simd::Simd;

use super::outlook::Outlook;
use super::products::Vectors;
use super::{Phong, Pixels};
use crate::components::PointLight;
use crate::shading::number::{ABREAST, Number, Truth};
use crate::shading::patch::Squares;
use crate::shading::series::Quadratic;
use crate::shading::triangle::Triangle;
use crate::shading::{Scratch, TILE, U};
use crate::simd::apart;

/// Takes what a survey meets that is no polynomial; all costs in levels.
pub trait Remainder<N: Number> {
    /// Says the number of the first square that will be surveyed.
    fn begin(&mut self, first: usize);

    /// Takes a diffuse term that is cut off at zero somewhere on these squares.
    fn terminator(&mut self, squares: N::Truth, light: &PointLight, cosine: &Quadratic<N>) -> N;

    /// Takes a highlight that is no polynomial on these squares.
    fn highlight(
        &mut self,
        squares: N::Truth,
        light: &PointLight,
        vectors: &Vectors<N>,
        outlook: &Outlook<N>,
    ) -> N;
}

/// Gives the squares up.
pub struct GivenUp;

impl<N: Number> Remainder<N> for GivenUp {
    #[inline(always)]
    fn begin(&mut self, _first: usize) {}

    #[inline(always)]
    fn terminator(&mut self, _squares: N::Truth, _light: &PointLight, cosine: &Quadratic<N>) -> N {
        cosine.0[0].like(f64::INFINITY)
    }

    #[inline(always)]
    fn highlight(
        &mut self,
        _squares: N::Truth,
        _light: &PointLight,
        _vectors: &Vectors<N>,
        outlook: &Outlook<N>,
    ) -> N {
        outlook.lambda.like(f64::INFINITY)
    }
}

/// Adds what is missing to the pixels of tiles, in the scratch.
pub struct ByPixel<'a, 's, S: Simd> {
    phong: &'a Phong<'s, S>,
    triangle: &'a Triangle,
    tiles: &'a Squares<TILE>,
    scratch: &'a mut Scratch,
    /// The number of the first tile that is surveyed.
    first: usize,
    /// How many lights' terms were added, by tile.
    pub terminators: [u64; ABREAST],
    pub highlights: [u64; ABREAST],
}

impl<'a, 's, S: Simd> ByPixel<'a, 's, S> {
    /// Nothing is added yet.
    #[inline(always)]
    pub fn new(
        phong: &'a Phong<'s, S>,
        triangle: &'a Triangle,
        tiles: &'a Squares<TILE>,
        scratch: &'a mut Scratch,
    ) -> Self {
        ByPixel {
            phong,
            triangle,
            tiles,
            scratch,
            first: 0,
            terminators: [0; ABREAST],
            highlights: [0; ABREAST],
        }
    }

    /// The pixels of a tile.
    #[inline(always)]
    fn pixels(&mut self, index: usize) -> Pixels<'_> {
        let mut pixels = Pixels::new(self.tiles, index, self.scratch);
        pixels.blank = self.terminators[index] + self.highlights[index] == 0;
        pixels
    }
}

impl<N: Number, S: Simd> Remainder<N> for ByPixel<'_, '_, S> {
    #[inline(always)]
    fn begin(&mut self, first: usize) {
        self.first = first;
    }

    #[inline(always)]
    fn terminator(&mut self, squares: N::Truth, light: &PointLight, cosine: &Quadratic<N>) -> N {
        let (phong, tiles) = (self.phong, self.tiles);
        for index in 0..N::COUNT {
            if squares.one(index) {
                let tile = self.first + index;
                let mut pixels = self.pixels(tile);
                let cosine = cosine.one(index);
                apart(
                    phong.simd,
                    #[inline(always)]
                    || phong.add_terminator(light, &cosine, &tiles.patches[tile], &mut pixels),
                );
                self.terminators[tile] += 1;
            }
        }
        cosine.0[0].like(0.0)
    }

    #[inline(always)]
    fn highlight(
        &mut self,
        squares: N::Truth,
        light: &PointLight,
        vectors: &Vectors<N>,
        outlook: &Outlook<N>,
    ) -> N {
        let (phong, triangle, tiles) = (self.phong, self.triangle, self.tiles);
        // A power in few steps is nothing where it is fainter than that; product and sums in f32 are three more roundings.
        let cut = phong.squarings.map_or(0.0, |_| phong.faint);
        let bright = phong.surface.coefficients(light)[1].max_element();
        let mut costs = [cut + 3.0 * U * bright; ABREAST];
        for index in 0..N::COUNT {
            if squares.one(index) {
                let tile = self.first + index;
                let patch = &tiles.patches[tile];
                let mut pixels = self.pixels(tile);
                let vectors = vectors.one(index);
                let outlook = outlook.one(index);
                costs[index] += apart(
                    phong.simd,
                    #[inline(always)]
                    || {
                        if outlook.lit
                            && let Some(cost) =
                                phong.add_raised(light, &vectors, &outlook, patch, &mut pixels)
                        {
                            return cost;
                        }
                        phong.add_specular(light, &vectors, &outlook, triangle, patch, &mut pixels)
                    },
                );
                self.highlights[tile] += 1;
            }
        }
        outlook.lambda.each(
            #[inline(always)]
            |index| costs[index],
        )
    }
}
