//! The exact levels of a whole square of pixels under Phong, enclosed at once: a polynomial through nine enclosed samples, and a
//! bound on the distance of the exact levels from it.
//!
//! ```text
//!      o . . o . . o        o  a node: the model is evaluated there in intervals
//!      .           .        x, y: -1..=1 over the square, nodes at 0 and ±sqrt(3)/2
//!      o     o     o
//!      .           .        exact level = biquadratic through the nodes ± error, at every real position of the square
//!      o . . o . . o
//! ```
//! The square lies inside one face, which nothing hides. Its error has two parts. The samples are intervals, and interpolation
//! multiplies their errors by at most (5/3)^2, the square of the Lebesgue constant of three Chebyshev nodes. `interpolation`
//! bounds the other part, the error of the biquadratic through exact samples.

use std::ops::Range;

use super::edge::EDGE;
use super::geometry::Shown;
use super::interpolation::{AMPLIFICATION, exact};
use super::interval::Interval;
use super::picture::{Reference, ReferenceCuboid};
use super::real::Real;
use super::sight::Place;
use crate::components::{ShadingMode, TriangleId};

/// The sides of squares, in pixels. A square whose error is too large is cut into quarters.
pub const MAX_ENCLOSED_SIDE: usize = 16;
const MIN_SIDE: usize = 4;

/// sqrt(3) / 2, rounded. That changes the node polynomial x (x^2 - NODE^2) / 6 of the error, and the Lebesgue constant, by a
/// relative error below [`ROUNDING`].
const NODE: f64 = 0.866_025_403_784_438_6;

/// The nodes along an axis.
const NODES: [f64; 3] = [-NODE, 0.0, NODE];

/// The relative error of a polynomial whose coefficients and sums are rounded: far more than its fifty operations of f64 on
/// numbers of at most 20 times the largest sample make.
const ROUNDING: f64 = 1e-12;

/// The levels of a square of pixels that shows one face.
pub struct EnclosedSquare {
    /// The columns and rows of the picture.
    pub columns: Range<usize>,
    pub rows: Range<usize>,
    /// A triangle of the face, or [`TriangleId::NONE`].
    pub triangle: TriangleId,
    /// By channel, power of y and power of x, in levels.
    coefficients: [[[f64; 3]; 3]; 3],
    /// The largest distance of an exact level from the polynomial, by channel.
    pub error: [f64; 3],
}

/// The middle of a range of pixels, and the distance from there to its last centre, at least half a pixel.
fn middle_and_half(pixels: &Range<usize>) -> [f64; 2] {
    let [from, to] = [pixels.start, pixels.end].map(|it| it as f64);
    [from.midpoint(to), ((to - from - 1.0) / 2.0).max(0.5)]
}

impl EnclosedSquare {
    /// The polynomial at the pixels of a row, from left to right. It is at most `error` away from the exact levels.
    pub fn row(&self, row: usize) -> impl Iterator<Item = [f64; 3]> {
        let [x, y] = [&self.columns, &self.rows].map(middle_and_half);
        let place = |pixel: usize, [middle, half]: [f64; 2]| (pixel as f64 + 0.5 - middle) / half;
        let y = place(row, y);
        let along = self.coefficients.map(|rows| {
            [0, 1, 2].map(|power| rows[0][power] + (rows[1][power] + rows[2][power] * y) * y)
        });
        let level = |[a, b, c]: [f64; 3], x: f64| a + (b + c * x) * x;
        let columns = self.columns.clone().map(move |column| place(column, x));
        columns.map(move |x| along.map(|along| level(along, x)))
    }
}

impl Reference<Interval> {
    /// Squares of these rows, at most [`MAX_ENCLOSED_SIDE`] of them, in which every pixel is enclosed within about `error` levels.
    pub fn squares(&self, rows: &Range<usize>, error: f64) -> Vec<EnclosedSquare> {
        let mut squares = Vec::new();
        if self.without.is_none() {
            for start in (0..self.sight.size[0]).step_by(MAX_ENCLOSED_SIDE) {
                let columns = start..(start + MAX_ENCLOSED_SIDE).min(self.sight.size[0]);
                self.add_squares([columns, rows.clone()], error, &mut squares);
            }
        }
        squares
    }

    /// Adds the square, or its quarters if it is not enclosed within `error` levels.
    fn add_squares(
        &self,
        [columns, rows]: [Range<usize>; 2],
        error: f64,
        squares: &mut Vec<EnclosedSquare>,
    ) {
        if let Some(square) = self.square([&columns, &rows], error) {
            squares.push(square);
            return;
        }
        if columns.len().max(rows.len()) <= MIN_SIDE {
            return;
        }
        let halves = |pixels: &Range<usize>| {
            let middle = pixels.start + pixels.len().div_ceil(2);
            [pixels.start..middle, middle..pixels.end]
        };
        for rows in halves(&rows) {
            for columns in halves(&columns) {
                if !columns.is_empty() && !rows.is_empty() {
                    self.add_squares([columns, rows.clone()], error, squares);
                }
            }
        }
    }

    /// The faces that all of these columns and rows show if nothing else hides them. `None` if an edge may pass through.
    fn faces(
        &self,
        pixels: [&Range<usize>; 2],
        corners: &[Place; 4],
    ) -> Option<Vec<(&ReferenceCuboid<Interval>, usize)>> {
        let mut faces = Vec::new();
        for cuboid in &self.cuboids {
            let bounds = [&cuboid.solid.columns, &cuboid.solid.rows];
            let is_beside = (bounds.iter().zip(pixels))
                .any(|(bound, pixels)| bound.end <= pixels.start || pixels.end <= bound.start);
            if is_beside {
                continue;
            }
            match cuboid.solid.shown(corners) {
                Shown::Face(face) => faces.push((cuboid, face)),
                Shown::Nothing => {}
                Shown::Undecided => return None,
            }
        }
        Some(faces)
    }

    /// The square of these columns and rows, if it shows one face under Phong that nothing hides, or the background, and is
    /// enclosed within `error` levels.
    fn square(&self, pixels: [&Range<usize>; 2], error: f64) -> Option<EnclosedSquare> {
        let extents = pixels.map(middle_and_half);
        let centre = [0, 1].map(|axis| self.sight.size[axis] as f64 / 2.0);
        let place = |at: [f64; 2]| Place {
            offset: [0, 1].map(|axis| {
                let [middle, half] = extents[axis];
                middle - centre[axis] + at[axis] * half
            }),
            margin: EDGE,
        };
        let corners = [[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]].map(place);
        let faces = self.faces(pixels, &corners)?;
        let mut square = EnclosedSquare {
            columns: pixels[0].clone(),
            rows: pixels[1].clone(),
            triangle: TriangleId::NONE,
            coefficients: [[[0.0; 3]; 3]; 3],
            error: [0.0; 3],
        };
        if faces.is_empty() {
            for (channel, level) in square.coefficients.iter_mut().zip(self.background.0) {
                let [least, largest] = level.endpoints();
                channel[0][0] = least;
                debug_assert_eq!(least, largest, "a number of the scene");
            }
            return Some(square);
        }
        let [(cuboid, face)] = faces[..] else {
            return None;
        };
        if cuboid.mode != ShadingMode::Phong {
            return None;
        }
        let places = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(place);
        let interpolation = cuboid.interpolation_errors(face, places)?;
        let largest = |number: Interval| number.endpoints()[1];
        // Most squares that are too large are refused here, before they are sampled.
        if interpolation.0.iter().any(|bound| largest(*bound) > error) {
            return None;
        }
        let mut samples = [[[Interval::ALL; 3]; 3]; 3];
        for (row, y) in samples.iter_mut().zip(NODES) {
            for (sample, x) in row.iter_mut().zip(NODES) {
                let point = cuboid.solid.place(face, &cuboid.solid.line(place([x, y])));
                let lit = cuboid.surface.phong(face, &point, 0);
                if lit.ties > 0 {
                    return None;
                }
                *sample = lit.levels.0;
            }
        }
        for channel in 0..3 {
            let of_channel = samples.map(|row| row.map(|sample| sample[channel].endpoints()));
            let (coefficients, of_samples) = polynomial(of_channel);
            square.coefficients[channel] = coefficients;
            let bound = largest(interpolation.0[channel] + exact(of_samples));
            square.error[channel] = bound * (1.0 + ROUNDING);
        }
        square.triangle = TriangleId::new(cuboid.number as u32, 2 * face);
        square.error.iter().all(|it| *it <= error).then_some(square)
    }
}

/// The biquadratic through the middles of nine samples, by power of y and of x, and its largest distance from a biquadratic
/// through any values of the samples. Samples are given by their ends, by row and column of the nodes.
pub(super) fn polynomial(samples: [[[f64; 2]; 3]; 3]) -> ([[f64; 3]; 3], f64) {
    let quadratic = |[before, middle, after]: [f64; 3]| {
        let bend = before.midpoint(after) - middle;
        [
            middle,
            (after - before) / (2.0 * NODE),
            bend / (NODE * NODE),
        ]
    };
    let ends = samples.as_flattened();
    let radius = ends.iter().map(|[least, largest]| (largest - least) / 2.0);
    let size = ends.iter().flatten().map(|end| end.abs());
    let error = AMPLIFICATION * radius.fold(0.0, f64::max) + ROUNDING * size.fold(0.0, f64::max);
    let rows = samples.map(|row| quadratic(row.map(|[least, largest]| least.midpoint(largest))));
    let mut coefficients = [[0.0; 3]; 3];
    for x in 0..3 {
        let by_y = quadratic(rows.map(|row| row[x]));
        for y in 0..3 {
            coefficients[y][x] = by_y[y];
        }
    }
    (coefficients, error)
}
