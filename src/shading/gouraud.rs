//! Vertex colours in, perspective-correct colours out (Gouraud 1971; Heckbert and Moreton 1991 for the division).
//!
//! Rule: the colour is w C / w, both affine in the pixel, and C comes from the corners of the triangle alone that the pixel
//! is on. The quotient is interpolated through nine samples where a bound keeps the tolerance, and divided at every pixel
//! elsewhere.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, mask64x4};
use glam::DVec3;

use super::affine::Affine;
use super::bound;
use super::face::{Face, Linear, Plane};
use super::field::{self, Lanes, Places};
use super::interpolation::{Colors, Interpolant, NODE, Nine, biquadratic};
use super::square::Square;
use super::{Evaluations, Scratch, TileKind, U, limit};
use crate::simd::{inlined, outlined, three};

/// Draws what was lit at the vertices.
pub struct Gouraud<'a> {
    /// What is interpolated over.
    pub face: &'a Face<'a>,
    /// In levels.
    pub tolerance: f64,
    /// Levels on the first and on the second triangle, and the same times w.
    levels: [Linear; 2],
    colors: [Affine; 2],
}

/// The rounding error of a colour in f32, relative to the largest on the square:
///
/// ```text
///   numerator, an affine value                                      4 U
///   w, another, up to 1.5 times the middle's: by dividing by it    10 U
///   the division, as a reciprocal and a product                     2 U
///   diagonal, another: pixels on its wrong side, 4 times 2          8 U
///   all that over the smallest w, half the middle's               x 2
///   the display step may be that of the next float                  2 U
/// ```
const ROUNDING: f64 = 50.0 * U;

/// What f64 makes of a sample and of the biquadratic, relative to the colours: less than this. At the nodes w is at least 0.134
/// of the middle's, which makes 30 epsilon of the roundings of numerator and w; interpolation enlarges that 25/9 times.
const SAMPLING: f64 = 128.0 * f64::EPSILON;

impl<'a> Gouraud<'a> {
    /// Draws levels that are given at a cuboid's corners.
    pub fn new(face: &'a Face, levels: &[DVec3; 8], tolerance: f64) -> Self {
        let levels = [0, 1].map(|triangle| face.linear(levels, triangle));
        Gouraud {
            face,
            tolerance,
            levels,
            colors: levels.map(|levels| face.place.map(|place| levels.scaled(place))),
        }
    }

    /// Colours of four squares.
    #[inline(always)]
    pub fn interpolate<S: Simd>(&self, simd: S, places: &Places<S>) -> Interpolant<S> {
        let Face {
            plane: Plane { w, .. },
            diagonal,
            ..
        } = self.face;
        let [middle, e, g] = field::relative(w, places);
        let inverse = 1.0 / middle;
        // All three relative to w at the middle.
        let scaled = inlined!(|[centre, dx, dy]: [Lanes<S>; 3]| {
            let [x, y] = places.middle;
            [
                (x * dx + y * dy + centre) * inverse,
                places.half[0] * inverse * dx,
                places.half[1] * inverse * dy,
            ]
        });
        let splat = inlined!(|values: [f64; 3]| three!(|term| Lanes::splat(simd, values[term])));
        let across = scaled(splat([diagonal.centre, diagonal.dx, diagonal.dy]));
        let change = across[1].abs() + across[2].abs();
        let (first, second) = (across[0].simd_ge(change), across[0].simd_le(-change));
        let zero = Lanes::splat(simd, 0.0);
        let node = |index: usize| NODE * (index as f64 - 1.0);
        let inverses: Nine<S> =
            three!(|row| three!(|column| 1.0 / (e * node(column) + g * node(row) + 1.0)));
        let mut error = zero;
        let (any_second, all_second) = (second.any_true(), second.all_true());
        let colors = three!(|channel| {
            let of = inlined!(|triangle: usize| {
                let Affine { centre, dx, dy } = &self.colors[triangle];
                scaled(splat([centre[channel], dx[channel], dy[channel]]))
            });
            let color = if all_second {
                of(1)
            } else if any_second {
                let [one, other] = [of(0), of(1)];
                three!(|term| second.select(other[term], one[term]))
            } else {
                of(0)
            };
            let bound = bound::quotient_error(color, [e, g]);
            let size = color[0].abs() + color[1].abs() + color[2].abs();
            error = error.max(bound + size * SAMPLING);
            let samples = three!(|row| {
                three!(|column| {
                    let moved = color[1] * node(column) + color[2] * node(row);
                    (color[0] + moved) * inverses[row][column]
                })
            });
            biquadratic(&samples)
        });
        // What pixels show of a sliver is clamped to the face, one by one.
        let least = middle * (1.0 - e.abs() - g.abs());
        let steady = least.simd_gt(self.face.least_steady().max(0.0));
        let budget = (steady & (first | second)).select(
            self.tolerance - error,
            Lanes::splat(simd, f64::NEG_INFINITY),
        );
        let [red, green, blue] = colors;
        Interpolant::new(Colors {
            terms: [red, green, blue, [[zero; 3]; 3]],
            crossing: [zero; 3],
            crosses: mask64x4::splat(simd, false),
            budget,
        })
    }

    /// See [`super::Shader::evaluate`].
    pub fn evaluate<S: Simd>(
        &self,
        simd: S,
        square: &Square,
        picture: [f64; 2],
        scratch: &mut Scratch,
    ) -> Option<Evaluations> {
        let Face {
            plane: Plane { w, .. },
            diagonal,
            ..
        } = self.face;
        let ([x, y], half) = (square.middle_from(picture), square.half());
        let scale = 1.0 / w.at(x, y);
        let change = |dx: f64, dy: f64| (dx.abs() * half[0] + dy.abs() * half[1]) * scale;
        let before = diagonal.at(x, y);
        let reach = diagonal.reach(half);
        let is_met = [before > -reach, before < reach];
        let mut largest = 0.0_f64;
        for triangle in (0..2).filter(|triangle| is_met[*triangle]) {
            let colors = &self.colors[triangle];
            let middle = colors.at(x, y);
            for channel in 0..3 {
                let moved = change(colors.dx[channel], colors.dy[channel]);
                // The other way round what is not a number would be lost.
                let most = (middle[channel] * scale).abs() + moved;
                largest = if most <= largest { largest } else { most };
            }
        }
        let rounding = ROUNDING * largest;
        if !(self.face.is_steady_on([x, y], half)
            && change(w.dx, w.dy) < 0.5
            && rounding <= limit(self.tolerance))
        {
            return None;
        }
        let affine =
            |centre: f64, dx: f64, dy: f64| [centre, dx, dy].map(|term| (term * scale) as f32);
        let colors = self.colors.map(|colors| {
            let middle = colors.at(x, y);
            [0, 1, 2].map(|channel| affine(middle[channel], colors.dx[channel], colors.dy[channel]))
        });
        let quotient = Quotient {
            simd,
            colors: if is_met[0] { colors[0] } else { colors[1] },
            beyond: colors[1],
            before: affine(before, diagonal.dx, diagonal.dy),
            is_cut: is_met == [true; 2],
            w: affine(w.at(x, y), w.dx, w.dy),
        };
        let evaluate = inlined!(|place: [f32x16<S>; 2]| quotient.at(place));
        outlined!(simd, scratch.pixels.evaluate(simd, evaluate));
        Some(Evaluations {
            kind: TileKind::Exact,
            model: 0,
            specular: 0,
        })
    }

    /// See [`super::Shader::define`].
    pub fn define(&self, x: f64, y: f64) -> DVec3 {
        let place = self.face.point(x, y).place;
        self.levels[usize::from(self.face.across(place) < 0.0)].at(place)
    }
}

/// w C / w. Its affine functions are given by their values at the square's middle and what a pixel to the right and one
/// down add.
struct Quotient<S: Simd> {
    simd: S,
    colors: [[f32; 3]; 3],
    /// Whether the diagonal cuts the square; how far before it a pixel is, times w, and the colours beyond it.
    is_cut: bool,
    before: [f32; 3],
    beyond: [[f32; 3]; 3],
    w: [f32; 3],
}

impl<S: Simd> Quotient<S> {
    /// w C / w at places from the square's middle, in pixels.
    #[inline(always)]
    fn at(&self, [x, y]: [f32x16<S>; 2]) -> [f32x16<S>; 3] {
        let at = inlined!(|[middle, right, down]: [f32; 3]| x * right + (y * down + middle));
        let inverse = 1.0 / at(self.w);
        let mut levels = three!(|channel| at(self.colors[channel]));
        if self.is_cut {
            let is_before = at(self.before).simd_ge(f32x16::splat(self.simd, 0.0));
            for channel in 0..3 {
                levels[channel] = is_before.select(levels[channel], at(self.beyond[channel]));
            }
        }
        three!(|channel| levels[channel] * inverse)
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
            let one = Rounded::exact(1.0);
            one * right + (middle + down * one)
        };
        let mut most = 0.0_f64;
        for step in 0..=1000 {
            let part = |factor: f64| (f64::from(step) * factor).sin();
            // w falls to half of what it is at the middle; colours fall with it, or not.
            let slope = 0.249 * (1.0 + part(0.3)) / 2.0;
            let w = at([1.0, slope - 0.498, -slope]);
            let [color, right, down] = [part(0.7), part(1.1), part(1.7)];
            let largest = color.abs() + right.abs() + down.abs();
            let level = at([color, right, down]) * (Rounded::exact(1.0) / w);
            // Over the smallest w.
            let wrong_side = 2.0 * 8.0 * largest;
            let error = level.error + 2.0 * level.value.abs() + wrong_side;
            most = most.max(error * U / (ROUNDING * largest));
        }
        println!("{most:.3} of the count");
        assert!(most <= 1.0, "the count is {most} times too small");
        assert!(most > 0.5, "the count is loose: {most}");
    }
}
