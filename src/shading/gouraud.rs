//! Gouraud shading of a face: vertex colours, interpolated perspective-correctly (Gouraud 1971; Heckbert and Moreton 1991).
//!
//! The colour is (w C) / w; w C and w are affine in the pixel, and C comes from the corners of the pixel's own triangle
//! alone. The quotient is interpolated through nine samples where a bound keeps the tolerance, and divided at every pixel
//! elsewhere; nodes and pixels are evaluated by the same code.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, f64x4};
use glam::DVec3;

use super::affine::Affine;
use super::bound;
use super::face::Face;
use super::field::{Extents, single};
use super::interpolation::{AMPLIFICATION, Interpolant, sampled};
use super::lanes::{LaneLayout, Squares};
use super::{U, limit};
use crate::simd::{inlined, three, two};

/// A face with levels at its vertices, and the squares of it that were prepared last.
pub struct Gouraud<'a> {
    pub face: &'a Face<'a>,
    /// In levels.
    pub tolerance: f64,
    /// The levels at the face's corners; and w times those on the first and on the second triangle, as functions of the
    /// pixel.
    vertex_levels: &'a [DVec3; 4],
    colors_by_pixel: [Affine; 2],
    /// Affine numbers, over w at the middle of each square; the colours by triangle and channel.
    w_by_square: Affine<[f32; 4]>,
    diagonal_by_square: Affine<[f32; 4]>,
    colors_by_square: [[Affine<[f32; 4]>; 3]; 2],
    /// The squares that meet each triangle.
    meets: [Squares; 2],
    /// Where levels in f32 keep the tolerance.
    pub in_f32: Squares,
}

/// The rounding error of a colour in f32, relative to the largest on the square:
///
/// ```text
///   operation                        count   why
///   numerator                          6     a term: stored, 2 for x or y, product, 2 sums
///   w                              3 x 6     6 roundings of w, which is at most 1.5, over the smallest w, 1/2
///   division                           2     a reciprocal and a product
///   wrong triangle                 2 x 6     six roundings of `diagonal`, near which the triangles differ by up to 2
///   all that over the smallest w     x 2     1/2
///   display                            4     two at the size of a level; the next larger float is rounded
/// ```
/// Near the diagonal f32 may take the colour of the other triangle. The two w C differ by |[`Face::diagonal`]| times a constant:
/// where that is largest, by at most twice the largest colour.
const COLOR_ERROR: f64 = 80.0 * U;

impl<'a> Gouraud<'a> {
    /// Draws levels that are given at the face's corners.
    pub fn new(face: &'a Face, vertex_levels: &'a [DVec3; 4], tolerance: f64) -> Self {
        Gouraud {
            face,
            tolerance,
            vertex_levels,
            colors_by_pixel: [0, 1].map(|triangle| {
                let color = face.interpolate(vertex_levels, triangle);
                face.uvw.map(|it| color.homogeneous(it.x, it.y, it.z))
            }),
            w_by_square: Affine::default(),
            diagonal_by_square: Affine::default(),
            colors_by_square: Default::default(),
            meets: [0; 2],
            in_f32: 0,
        }
    }

    /// See [`super::Shader::prepare`].
    #[inline(always)]
    pub fn prepare<S: Simd>(
        &mut self,
        simd: S,
        extents: &Extents<S>,
        interpolate: bool,
    ) -> Option<Interpolant<S>> {
        let splat = inlined!(|number: f64| f64x4::splat(simd, number));
        let middle = extents.affine(&self.face.plane.w).centre;
        let inverse = 1.0 / middle;
        let divided = inlined!(|term: f64x4<S>| term * inverse);
        let scaled = inlined!(|number: &Affine<f64>| extents.affine(number).map(divided));
        let w = Affine {
            centre: splat(1.0),
            ..scaled(&self.face.plane.w)
        };
        let diagonal = scaled(&self.face.diagonal);
        let change = diagonal.dx.abs() + diagonal.dy.abs();
        let meets = [
            diagonal.centre.simd_gt(-change),
            diagonal.centre.simd_lt(change),
        ];
        let colors = two!(|triangle| three!(|channel| {
            scaled(&self.colors_by_pixel[triangle].map(|color| color[channel]))
        }));
        let zero = splat(0.0);
        let [mut largest, mut error] = [zero; 2];
        for triangle in 0..2 {
            for color in colors[triangle] {
                let most = color.centre.abs() + color.dx.abs() + color.dy.abs();
                largest = largest.max(meets[triangle].select(most, zero));
                if interpolate {
                    let quotient = bound::quotient_error(color, w);
                    error = error.max(meets[triangle].select(quotient, zero));
                }
            }
        }
        let shortest = 1.0 - w.dx.abs() - w.dy.abs();
        // A square with pixels that may be clamped to the face is not interpolated.
        let steady = (middle * shortest).simd_gt(self.face.least_steady().max(0.0));
        let bounded = steady & shortest.simd_gt(0.5);
        let rounding = largest * COLOR_ERROR;
        self.w_by_square = single(w);
        self.diagonal_by_square = single(diagonal);
        self.colors_by_square =
            two!(|triangle| three!(|channel| single(colors[triangle][channel])));
        self.meets = [meets[0].to_bitmask(), meets[1].to_bitmask()];
        self.in_f32 = (bounded & rounding.simd_le(limit(self.tolerance))).to_bitmask();
        if !interpolate {
            return None;
        }
        let is_cut = meets[0] & meets[1];
        let rest = splat(self.tolerance) - error - rounding * AMPLIFICATION;
        let rest = (bounded & !is_cut).select(rest, splat(-1.0));
        let sample = inlined!(|xy| {
            let [red, green, blue] = self.levels(simd, LaneLayout::Nodes, xy);
            [red, green, blue, f32x16::splat(simd, 0.0)]
        });
        let terms = sampled(simd, sample);
        Some(Interpolant::new(terms, [[0.0; 3]; 4], 0, rest))
    }

    /// w C / w at points of squares, x and y from -1 to 1.
    #[inline(always)]
    pub fn levels<S: Simd>(&self, simd: S, at: LaneLayout, xy: [f32x16<S>; 2]) -> [f32x16<S>; 3] {
        let affine = inlined!(|of: &Affine<[f32; 4]>| at.affine(of, xy));
        let inverse = 1.0 / affine(&self.w_by_square);
        let [first, second] = &self.colors_by_square;
        if !at.any(self.meets[1]) {
            return three!(|channel| affine(&first[channel]) * inverse);
        }
        if !at.any(self.meets[0]) {
            return three!(|channel| affine(&second[channel]) * inverse);
        }
        let is_first = affine(&self.diagonal_by_square).simd_ge(f32x16::splat(simd, 0.0));
        three!(|channel| {
            is_first.select(affine(&first[channel]), affine(&second[channel])) * inverse
        })
    }

    /// See [`super::Shader::levels_f64`].
    pub fn levels_f64(&self, x: f64, y: f64) -> DVec3 {
        let (uv, _) = self.face.uv_at(x, y);
        self.face.blend(self.vertex_levels, uv)
    }
}

#[cfg(test)]
mod tests {
    use super::super::running::Rounded;
    use super::*;

    #[test]
    fn the_count_of_roundings_covers_what_a_running_error_analysis_finds() {
        // At a corner, where x = y = 1.
        let at = |terms: [f64; 3]| {
            let [middle, right, down] = terms.map(Rounded::stored);
            // The position is a product with the stored inverse of the half extent.
            let end = Rounded::stored(1.0) * Rounded::exact(1.0);
            end * right + (middle + down * end)
        };
        let mut most = 0.0_f64;
        for step in 0..=1000 {
            let part = |factor: f64| (f64::from(step) * factor).sin();
            // w falls to half of its value at the middle; colours fall with it, or not.
            let slope = 0.249 * (1.0 + part(0.3)) / 2.0;
            let w = at([1.0, slope - 0.498, -slope]);
            let [color, right, down] = [part(0.7), part(1.1), part(1.7)];
            let largest = color.abs() + right.abs() + down.abs();
            let level = at([color, right, down]) * (Rounded::exact(1.0) / w);
            // Over the smallest w.
            let wrong_side = 2.0 * 12.0 * largest;
            let error = level.error + 2.0 * level.value.abs() + wrong_side;
            most = most.max(error * U / (COLOR_ERROR * largest));
        }
        println!("{most:.3} of the count");
        assert!(most <= 1.0, "the count is {most} times too small");
        assert!(most > 0.5, "the count is loose: {most}");
    }
}
