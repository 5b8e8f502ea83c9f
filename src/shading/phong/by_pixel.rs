//! Light that is no polynomial of a whole tile in, levels of its pixels out, and what that costs.
//!
//! Rule: every covered pixel of the tile gets what is missing.

use fearless_simd::Simd;

use super::outlook::Outlook;
use super::products::Vectors;
use super::{Phong, Pixels};
use crate::components::PointLight;
use crate::shading::number::{ABREAST, Number, Truth};
use crate::shading::patch::Patch;
use crate::shading::series::Quadratic;
use crate::shading::triangle::Triangle;
use crate::shading::{Coverage, Scratch};
use crate::simd::apart;

/// Adds what is missing to the pixels of tiles, in the scratch.
pub struct ByPixel<'a, 's, S: Simd> {
    phong: &'a Phong<'s, S>,
    triangle: &'a Triangle,
    patches: &'a [Patch; ABREAST],
    covered: &'a [Coverage; ABREAST],
    scratch: &'a mut Scratch,
    /// The number of the first tile that is surveyed.
    pub first: usize,
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
        patches: &'a [Patch; ABREAST],
        covered: &'a [Coverage; ABREAST],
        scratch: &'a mut Scratch,
    ) -> Self {
        ByPixel {
            phong,
            triangle,
            patches,
            covered,
            scratch,
            first: 0,
            terminators: [0; ABREAST],
            highlights: [0; ABREAST],
        }
    }

    /// The pixels of a tile.
    #[inline(always)]
    fn pixels(&mut self, index: usize) -> Pixels<'_> {
        let mut pixels = Pixels::new(&self.covered[index], index, self.scratch);
        pixels.blank = self.terminators[index] + self.highlights[index] == 0;
        pixels
    }

    /// Adds a diffuse term that is cut off at zero somewhere on these tiles. It errs by no more than the cosine does.
    #[inline(always)]
    pub fn terminator<N: Number>(
        &mut self,
        squares: N::Truth,
        light: &PointLight,
        cosine: &Quadratic<N>,
    ) {
        let (phong, patches) = (self.phong, self.patches);
        for index in 0..N::COUNT {
            if squares.one(index) {
                let tile = self.first + index;
                let mut pixels = self.pixels(tile);
                let cosine = cosine.one(index);
                apart(
                    phong.simd,
                    #[inline(always)]
                    || phong.add_terminator(light, &cosine, &patches[tile], &mut pixels),
                );
                self.terminators[tile] += 1;
            }
        }
    }

    /// Adds a highlight that is no polynomial on these tiles; what that costs, in levels.
    #[inline(always)]
    pub fn highlight<N: Number>(
        &mut self,
        squares: N::Truth,
        light: &PointLight,
        vectors: &Vectors<N>,
        outlook: &Outlook<N>,
    ) -> N {
        let (phong, triangle, patches) = (self.phong, self.triangle, self.patches);
        // A power in few steps is nothing where it is fainter than that; the product and sums in f32 round too.
        let cut = phong.squarings.map_or(0.0, |_| phong.faint);
        let bright = phong.surface.coefficients(light)[1].max_element();
        let mut costs = [cut + phong.rounding * bright; ABREAST];
        for index in 0..N::COUNT {
            if squares.one(index) {
                let tile = self.first + index;
                let patch = &patches[tile];
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
