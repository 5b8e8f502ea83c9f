//! Vertex colours in, perspective-correct colours out (Gouraud 1971; Heckbert and Moreton 1991 for the division).
//!
//! Rule: with weights e_i the colour is sum(e_i C_i) / sum(e_i), both affine in the pixel. Where the tolerance allows it
//! that quotient is drawn as a certified polynomial; otherwise with one division a pixel, in f32 where its rounding stays
//! below the tolerance and in f64 elsewhere. Where snapping puts pixels beyond the face's diagonal, what the other triangle
//! has there is taken off the tolerance, and shown where that is too much.

use super::affine::{Affine, Scalar};
use super::certificate::quotient;
use super::display::Exact;
use super::patch::{Patch, Squares};
use super::polynomial::cheapest;
use super::triangle::Triangle;
use super::{
    BLOCK, Coverage, Evaluations, Scratch, Shader, Sink, TILE, TileKind, U, doubles, limit,
};

/// Draws what was lit at the vertices.
pub struct Gouraud {
    /// In levels.
    pub tolerance: f64,
}

impl Gouraud {
    #[inline(always)]
    fn certify<const SIDE: usize>(&self, triangle: &Triangle, squares: &mut Squares<SIDE>) {
        if self.tolerance > 0.0 {
            for (index, patch) in squares.patches.iter().enumerate() {
                if squares.wanted[index] {
                    let (colors, share) = patch.colors(triangle);
                    let (color, bound) = quotient(&colors, &share, patch.half);
                    let beyond = patch.beyond_diagonal(triangle, &squares.covered[index]);
                    squares.polynomials[index] = cheapest(
                        color,
                        patch.half,
                        self.tolerance - bound - beyond * triangle.crease,
                    );
                }
            }
        }
    }
}

impl Shader for Gouraud {
    #[inline(always)]
    fn certify_blocks(&self, triangle: &Triangle, blocks: &mut Squares<BLOCK>) {
        self.certify(triangle, blocks);
    }

    #[inline(always)]
    fn certify_tiles(
        &self,
        triangle: &Triangle,
        tiles: &mut Squares<TILE>,
        _scratch: &mut Scratch,
    ) {
        self.certify(triangle, tiles);
    }

    #[inline(always)]
    fn shade(
        &self,
        triangle: &Triangle,
        tiles: &Squares<TILE>,
        index: usize,
        _scratch: &mut Scratch,
        sink: &mut impl Sink,
    ) -> Evaluations {
        let (patch, coverage) = (&tiles.patches[index], &tiles.covered[index]);
        let (colors, share) = patch.colors(triangle);
        // Each affine value is rounded four times, numerator and denominator are divided: ten roundings of the largest
        // colour, over the smallest sum (at least half the middle's on a steady patch).
        let largest =
            colors.centre.abs() + colors.dx.abs() * patch.half[0] + colors.dy.abs() * patch.half[1];
        let rounding = 20.0 * U * largest.max_element();
        let beyond = patch.beyond_diagonal(triangle, coverage) * triangle.crease;
        if patch.steady && rounding + beyond <= limit(self.tolerance) {
            shade_lanes(&colors, &share, patch, coverage, sink);
            Evaluations::of(TileKind::Exact)
        } else {
            doubles::shade(triangle, patch, coverage, sink, |point| {
                Triangle::blend(point.weights, &point.vertices.levels)
            });
            Evaluations::of(TileKind::Double)
        }
    }
}

#[inline(always)]
fn shade_lanes(
    colors: &Affine,
    share: &Scalar,
    patch: &Patch,
    coverage: &Coverage,
    sink: &mut impl Sink,
) {
    let lanes = patch.lanes();
    let mut levels = [[0.0; TILE]; 3];
    for (row, &(from, to)) in coverage.spans.iter().enumerate() {
        if from < to {
            let y = row as f64 - patch.row;
            let color = colors.row(y);
            let (middle, step) = ((share.centre + share.dy * y) as f32, share.dx as f32);
            for lane in 0..TILE {
                let inverse = 1.0 / (middle + step * lanes[lane]);
                let [red, green, blue] = color.at(lanes[lane]);
                levels[0][lane] = red * inverse;
                levels[1][lane] = green * inverse;
                levels[2][lane] = blue * inverse;
            }
            sink.take(row, &Exact(&levels));
        }
    }
}
