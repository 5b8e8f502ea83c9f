//! Gouraud shading of a face: vertex colours, interpolated perspective-correctly (Gouraud 1971; Heckbert and Moreton 1991).
//!
//! The colour is (w C) / w; w C and w are affine in the pixel, and C comes from the corners of the pixel's own triangle
//! alone. The quotient is interpolated through nine samples where a bound keeps the tolerance, and divided at every pixel
//! elsewhere; nodes and pixels are evaluated by the same code. A face with several segments is drawn in the same way where a
//! square lies in one cell of its [`Grid`], or in several cells whose levels one linear function keeps within the tolerance.
//! Elsewhere each pixel finds its cell.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, f64x4, mask64x4};
use glam::DVec3;

use super::affine::Affine;
use super::bound;
use super::face::{Face, OVERSHOOT};
use super::grid::{Cells, Grid, LinearCells};
use super::interpolation::{AMPLIFICATION, Interpolant, sampled};
use super::lanes::{SquareSet, affine_at, has};
use super::moving::{Extents, single};
use super::{U, limit};
use crate::shading::simd::{four, inlined, outlined, three, two};

/// A face with levels at its vertices, and the squares of it that were prepared last.
pub struct Gouraud<'a> {
    pub face: &'a Face<'a>,
    /// In levels.
    pub tolerance: f64,
    source: Source<'a>,
    /// For one segment w times the levels on the first and on the second triangle, as functions of the pixel.
    colors_by_pixel: [Affine; 2],
    /// Affine numbers, over w at the middle of each square; the colours by triangle and channel.
    w_by_square: Affine<[f32; 4]>,
    diagonal_by_square: Affine<[f32; 4]>,
    colors_by_square: [[Affine<[f32; 4]>; 3]; 2],
    /// The squares that meet each triangle.
    meets: [SquareSet; 2],
    /// Where levels in f32 keep the tolerance.
    pub in_f32: SquareSet,
}

/// Levels at the vertices of a face.
#[derive(Debug)]
pub enum Source<'a> {
    /// At its corners.
    Corners(&'a [DVec3; 4]),
    /// At the points of a grid.
    Grid(Grid<'a>, &'a mut GridSquares),
}

/// The squares of a grid that were prepared last.
#[derive(Debug, Default)]
pub struct GridSquares {
    /// Those without a [`LinearCells`]: each of their pixels looks its cell up.
    looked_up: SquareSet,
    /// w times their places on the grid, over w at the middle of each square, counted from a point of the grid.
    places: [Affine<[f32; 4]>; 2],
    origins: [[f64; 2]; 4],
}

/// Affine numbers on four squares.
type OnSquares<S> = Affine<f64x4<S>>;

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
    /// Draws levels that are given at the vertices.
    pub fn new(face: &'a Face, source: Source<'a>, tolerance: f64) -> Self {
        let colors_by_pixel = match &source {
            Source::Corners(levels) => [0, 1].map(|triangle| {
                let color = face.interpolate(levels, triangle);
                face.uvw.map(|it| color.homogeneous(it.x, it.y, it.z))
            }),
            Source::Grid(..) => Default::default(),
        };
        Gouraud {
            face,
            tolerance,
            source,
            colors_by_pixel,
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
        let Source::Grid(grid, squares) = &mut self.source else {
            let on_face = LinearColors {
                diagonal: scaled(&self.face.diagonal),
                colors: two!(|triangle| three!(|channel| {
                    scaled(&self.colors_by_pixel[triangle].map(|color| color[channel]))
                })),
                error: splat(0.0),
                looked_up: 0,
            };
            return self.prepare_cells(simd, middle, w, &on_face, interpolate);
        };
        let tolerance = if interpolate { self.tolerance } else { 0.0 };
        let cells = outlined!(
            simd,
            squares.find_cells(simd, self.face, grid, extents, &w, inverse, tolerance)
        );
        outlined!(
            simd,
            self.prepare_cells(simd, middle, w, &cells, interpolate)
        )
    }

    /// Prepares squares with these colours. `w` is over its value at their middles, `middle`.
    #[inline(always)]
    fn prepare_cells<S: Simd>(
        &mut self,
        simd: S,
        middle: f64x4<S>,
        w: OnSquares<S>,
        cells: &LinearColors<S>,
        interpolate: bool,
    ) -> Option<Interpolant<S>> {
        let splat = inlined!(|number: f64| f64x4::splat(simd, number));
        let zero = splat(0.0);
        let LinearColors {
            diagonal, colors, ..
        } = *cells;
        let change = diagonal.dx.abs() + diagonal.dy.abs();
        let meets = [
            diagonal.centre.simd_gt(-change),
            diagonal.centre.simd_lt(change),
        ];
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
        self.in_f32 =
            (bounded & (rounding + cells.error).simd_le(limit(self.tolerance))).to_bitmask();
        if !interpolate {
            return None;
        }
        let is_cut = meets[0] & meets[1] | mask64x4::from_bitmask(simd, cells.looked_up);
        let rest = splat(self.tolerance) - error - cells.error - rounding * AMPLIFICATION;
        let rest = (bounded & !is_cut).select(rest, splat(-1.0));
        let sample = inlined!(|square, xy| {
            let [red, green, blue] = self.levels(simd, square, xy);
            [red, green, blue, f32x16::splat(simd, 0.0)]
        });
        let terms = sampled(simd, rest.simd_gt(0.0).to_bitmask(), sample);
        Some(Interpolant::new(terms, [[0.0; 3]; 4], 0, rest))
    }

    /// w C / w at points of a square, x and y from -1 to 1.
    #[inline(always)]
    pub fn levels<S: Simd>(&self, simd: S, square: usize, xy: [f32x16<S>; 2]) -> [f32x16<S>; 3] {
        let affine = inlined!(|of: &Affine<[f32; 4]>| affine_at(of, square, xy));
        let inverse = 1.0 / affine(&self.w_by_square);
        let [first, second] = &self.colors_by_square;
        if !has(self.meets[1], square) {
            return three!(|channel| affine(&first[channel]) * inverse);
        }
        if !has(self.meets[0], square) {
            return three!(|channel| affine(&second[channel]) * inverse);
        }
        let is_first = affine(&self.diagonal_by_square).simd_ge(f32x16::splat(simd, 0.0));
        three!(|channel| {
            is_first.select(affine(&first[channel]), affine(&second[channel])) * inverse
        })
    }

    /// The levels at points of a square, if it lies in several cells of a grid.
    #[inline(always)]
    pub fn look_up<S: Simd>(
        &self,
        simd: S,
        square: usize,
    ) -> Option<impl Fn([f32x16<S>; 2]) -> [f32x16<S>; 3]> {
        let Source::Grid(grid, squares) = &self.source else {
            return None;
        };
        let levels = inlined!(move |xy| {
            let inverse = 1.0 / affine_at(&self.w_by_square, square, xy);
            let places = two!(|axis| affine_at(&squares.places[axis], square, xy) * inverse);
            grid.levels(simd, squares.origins[square], places)
        });
        has(squares.looked_up, square).then_some(levels)
    }

    /// The evaluations of the model and of powers at a pixel.
    pub fn evaluations(&self) -> [usize; 2] {
        match &self.source {
            Source::Corners(_) => [0, 0],
            Source::Grid(grid, _) => grid.evaluations(),
        }
    }

    /// See [`super::Shader::levels_f64`].
    pub fn levels_f64(&self, x: f64, y: f64) -> DVec3 {
        let (uv, _) = self.face.uv_at(x, y);
        match &self.source {
            Source::Corners(levels) => self.face.blend(levels, uv),
            Source::Grid(grid, _) => grid.at(uv),
        }
    }
}

impl GridSquares {
    /// Finds the cells of squares on which `w` is 1 at the middle, and `inverse` is 1 / w there.
    #[inline(always)]
    fn find_cells<S: Simd>(
        &mut self,
        simd: S,
        face: &Face,
        grid: &Grid,
        extents: &Extents<S>,
        w: &OnSquares<S>,
        inverse: f64x4<S>,
        tolerance: f64,
    ) -> LinearColors<S> {
        let divided = inlined!(|term: f64x4<S>| term * inverse);
        let half = grid.face.segments as f64 / 2.0;
        // w times the place on the grid.
        let places = two!(|axis| {
            let place = face.uvw.map(|it| (it[axis] + it.z) * half);
            extents.affine(&place).map(divided)
        });
        // A quotient of affine functions is largest and least at corners.
        let corners = four!(|corner| {
            let [right, down] = [corner % 2, corner / 2].map(|it| 2.0 * it as f64 - 1.0);
            let at = inlined!(|it: &OnSquares<S>| it.centre + it.dx * right + it.dy * down);
            two!(|axis| at(&places[axis]) / at(w))
        });
        let [mut least, mut most] = [corners[0]; 2];
        for corner in &corners[1..] {
            least = two!(|axis| least[axis].min(corner[axis]));
            most = two!(|axis| most[axis].max(corner[axis]));
        }
        let patches = four!(|square| {
            let range = [least, most].map(|it| two!(|axis| it[axis][square]));
            grid.patch(range, &face.corners, tolerance * PATCHED)
        });
        let count = grid.face.segments as f64;
        let on_linear = |patch: Option<LinearCells>| {
            let Some(patch) = patch else {
                return Default::default();
            };
            // From -1 to 1 on the patch, times w.
            let uvw = face.uvw.map(|it| {
                let local = two!(|axis| {
                    let Cells { first, size } = patch.cells;
                    let start = (2 * first[axis] + size[axis]) as f64 - count;
                    (it[axis] * count - it.z * start) / size[axis] as f64
                });
                DVec3::new(local[0], local[1], it.z)
            });
            let colors = two!(|triangle| {
                let color = face.interpolate(&patch.levels, triangle);
                uvw.map(|it| color.homogeneous(it.x, it.y, it.z))
            });
            let diagonal = if patch.is_cut {
                uvw.map(|it| face.diagonal_at([it.x, it.y]))
            } else {
                // All of it counts as the first triangle.
                Affine::new(1.0, 0.0, 0.0)
            };
            (diagonal, colors)
        };
        let on_patches: [(Affine<f64>, [Affine; 2]); 4] = patches.map(on_linear);
        let looked_up = (0..4)
            .map(|it| u64::from(patches[it].is_none()) << it)
            .sum();
        self.looked_up = looked_up;
        self.origins = four!(|square| two!(|axis| {
            let middle = places[axis].centre[square].clamp(0.0, grid.face.segments as f64);
            middle.floor()
        }));
        let local = two!(|axis| {
            let origin = f64x4::from_fn(simd, |square| self.origins[square][axis]);
            let place = places[axis];
            Affine::new(
                place.centre - origin * w.centre,
                place.dx - origin * w.dx,
                place.dy - origin * w.dy,
            )
        });
        self.places = two!(|axis| single(local[axis]));
        let largest =
            two!(|axis| local[axis].centre.abs() + local[axis].dx.abs() + local[axis].dy.abs());
        // A pixel centre just outside of the face shows the nearest point of it; a function goes on.
        let outside = f64x4::splat(simd, count * face.least_steady() * OVERSHOOT) * inverse
            / (1.0 - w.dx.abs() - w.dy.abs());
        LinearColors {
            diagonal: extents
                .affine_each(&on_patches.map(|(diagonal, _)| diagonal))
                .map(divided),
            colors: two!(|triangle| three!(|channel| {
                let colors = on_patches.map(|(_, colors)| colors[triangle].map(|it| it[channel]));
                extents.affine_each(&colors).map(divided)
            })),
            error: f64x4::from_fn(simd, |square| match patches[square] {
                Some(patch) => patch.error + patch.slope * outside[square],
                None => grid.rounding(two!(|axis| largest[axis][square])),
            }),
            looked_up,
        }
    }
}

/// The share of the tolerance that a [`LinearCells`] may err by. The rest is left for the interpolation of the quotient.
const PATCHED: f64 = 0.75;

/// The colours of four squares: affine functions on the [`LinearCells`] of a square that has one, and the error of that or of
/// looking cells up.
struct LinearColors<S: Simd> {
    diagonal: OnSquares<S>,
    /// By triangle and channel.
    colors: [[OnSquares<S>; 3]; 2],
    /// In levels.
    error: f64x4<S>,
    /// See [`GridSquares`].
    looked_up: SquareSet,
}

#[cfg(test)]
mod tests {
    use super::super::running::{Rounded, at_corner, w_at_corner};
    use super::*;

    #[test]
    fn the_count_of_roundings_covers_what_a_running_error_analysis_finds() {
        let mut most = 0.0_f64;
        for step in 0..=1000 {
            let part = |factor: f64| (f64::from(step) * factor).sin();
            let w = w_at_corner(step);
            let [color, right, down] = [part(0.7), part(1.1), part(1.7)];
            let largest = color.abs() + right.abs() + down.abs();
            let level = at_corner([color, right, down]) * (Rounded::exact(1.0) / w);
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
