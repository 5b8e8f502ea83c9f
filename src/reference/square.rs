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
//! multiplies their errors by at most (5/3)^2, the square of the Lebesgue constant of three Chebyshev nodes. The biquadratic errs
//! by (M_x + M_y + 2/3 min(M_x, M_y)) / 24, with bounds M on the third derivatives along x and y (Trefethen, "Approximation Theory
//! and Approximation Practice", chapters 6 and 15).
//!
//! **Third derivatives.** Up to a positive factor each of n, l and o is a vector V that is affine in x and y. Along x its angle in
//! the plane of V and V_x is arg(1 + z t), |Im z| = |V x V_x| / |V|^2 <= p and |z| = |V_x| / |V| <= q. So the derivatives of
//! the unit vector are at most p, min(2 p q, 2/sqrt(3) q^2) and min(6 p q^2, 3 q^3), and those of the half-turn about it, which
//! takes l to r, 2 p, 4 p q and 12 p q^2. Leibniz' rule gives those of n.l and of r. For the highlight s^rho, s = o.r and
//! e = r - o: s' = -e.e', s'' = -|e'|^2 - e.e'', s''' = -3 e'.e'' - e.e''', and |s'| <= E_1 sin(theta) with theta the angle
//! between o and r, and bounds E_k on the k-th derivatives of e. From the chain rule, with c >= |e|,
//!
//! ```text
//!   |(s^rho)'''| <= rho s^(rho-1) (3 E_1 E_2 + c E_3) + b c E_1 E_2 + (b + d) E_1^3
//!   b = 3 rho |rho-1| s^(rho-2) sin(theta)      d = rho |rho-1| |rho-2| s^(rho-3) sin(theta)^3
//! ```
//! Theorems of the same content stand in `proofs/theorems`. Every bound is evaluated in intervals, from the scene's numbers on,
//! and shares no code with the renderer's.

use std::cmp::Ordering;
use std::ops::Range;

use glam::DVec3;

use super::edge::EDGE;
use super::geometry::{Shown, descent};
use super::illumination::reflection;
use super::interval::Interval;
use super::picture::{Reference, ReferenceCuboid};
use super::real::{Real, RealVector};
use super::sight::Place;
use crate::components::{LightKind, ShadingMode, TriangleId};

/// The sides of squares, in pixels. A square whose error is too large is cut into quarters.
pub const MAX_SIDE: usize = 16;
const MIN_SIDE: usize = 4;

/// sqrt(3) / 2, rounded. The polynomial x (x^2 - NODE^2) / 6 of the error, and the Lebesgue constant, change by less than a
/// relative [`ROUNDING`].
const NODE: f64 = 0.866_025_403_784_438_6;

/// The nodes along an axis.
const NODES: [f64; 3] = [-NODE, 0.0, NODE];

/// The errors of samples grow by at most this: the square of the Lebesgue constant.
const AMPLIFICATION: f64 = 25.0 / 9.0;

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

/// Bounds on the sizes of the first three derivatives of a function along an axis of the square.
type Derivatives = [Interval; 3];

/// A vector that is affine on the square up to a positive factor.
struct MovingVector {
    /// Its unit vector at the middle.
    direction: RealVector<Interval>,
    /// The largest angle between it and that, in radians.
    turn: Interval,
    /// p and q along x and y.
    rates: [[Interval; 2]; 2],
}

impl MovingVector {
    /// The vector with these values at the middle, and half the square to the right and down. `None` if it may vanish.
    fn new(
        direction: RealVector<Interval>,
        [middle, right, down]: [RealVector<Interval>; 3],
    ) -> Option<Self> {
        let changes = [right - middle, down - middle];
        let [x, y] = changes.map(length);
        let shortest = length(middle) - x - y;
        if shortest.sign(0.0) != Some(Ordering::Greater) {
            return None;
        }
        // V x V_x at any place is (V + y V_y) x V_x with V at the middle.
        let twist = length(changes[0].cross(changes[1]));
        let across = changes.map(|change| length(middle.cross(change)));
        let rate = |axis: usize| {
            let q = [x, y][axis] / shortest;
            let p = (across[axis] + twist) / shortest.square();
            [p.min(q), q]
        };
        Some(MovingVector {
            direction,
            // The tangent of the angle: the largest part across the middle vector over the least part along it.
            turn: (across[0] + across[1]) / (length(middle) * shortest),
            rates: [rate(0), rate(1)],
        })
    }

    /// A vector that does not move.
    fn constant(direction: RealVector<Interval>) -> Self {
        MovingVector {
            direction,
            turn: exact(0.0),
            rates: [[exact(0.0); 2]; 2],
        }
    }

    /// Those of the unit vector.
    fn derivatives(&self, axis: usize) -> Derivatives {
        let [p, q] = self.rates[axis];
        let twice = p + p;
        [
            p,
            twice.min(q * exact(2.0) / exact(3.0).sqrt()) * q,
            twice.min(q) * q.square() * exact(3.0),
        ]
    }

    /// Those of the half-turn about it.
    fn half_turn(&self, axis: usize) -> Derivatives {
        let [p, q] = self.rates[axis];
        let product = p * q;
        [p + p, exact(4.0) * product, exact(12.0) * product * q]
    }
}

/// Those of a product of vectors or turns of length one (Leibniz).
fn product(a: Derivatives, b: Derivatives) -> Derivatives {
    let mixed = a[0] * b[0];
    [
        a[0] + b[0],
        a[1] + mixed + mixed + b[1],
        a[2] + (a[1] * b[0] + a[0] * b[1]) * exact(3.0) + b[2],
    ]
}

/// The error of the biquadratic for bounds on the third derivatives along x and y.
fn interpolation_error([x, y]: [Interval; 2]) -> Interval {
    (x + y + x.min(y) * exact(2.0) / exact(3.0)) / exact(24.0)
}

/// A bound on the distance of a function of at most this size from the biquadratic through its samples.
fn any_error(largest: Interval) -> Interval {
    largest * exact(1.0 + AMPLIFICATION)
}

/// n, l and o on a square.
struct Directions<'a> {
    normal: &'a MovingVector,
    to_light: &'a MovingVector,
    to_eye: &'a MovingVector,
}

impl Directions<'_> {
    /// n.l all over the square.
    fn cosine(&self) -> Interval {
        let turn = self.normal.turn + self.to_light.turn;
        self.normal.direction.dot(self.to_light.direction) + turn.either(-turn)
    }

    /// A bound on the interpolation error of max(0, n.l); `is_lit` as in [`Directions::highlight_error`].
    fn cosine_error(&self, is_lit: bool) -> Interval {
        if !is_lit {
            // It has a kink.
            return any_error(self.cosine().max(exact(0.0)));
        }
        let third = |axis| {
            let [normal, to_light] = [self.normal, self.to_light].map(|it| it.derivatives(axis));
            product(normal, to_light)[2]
        };
        interpolation_error([third(0), third(1)])
    }

    /// A bound on the interpolation error of the highlight, where n.l > 0 all over the square; with `is_lit` false, where n.l may
    /// change its sign, on which the highlight jumps.
    fn highlight_error(&self, shininess: f64, is_lit: bool) -> Interval {
        let (zero, one) = (exact(0.0), exact(1.0));
        let reflected = reflection(self.normal.direction, self.to_light.direction);
        let middle = self.to_eye.direction.dot(reflected);
        let turn = self.normal.turn + self.normal.turn + self.to_light.turn + self.to_eye.turn;
        let sine = (length(self.to_eye.direction.cross(reflected)) + turn).min(one);
        // The slope of the cosine is at most the largest sine.
        let step = turn * sine;
        let [least, largest] = [middle - step, middle + step].map(|s| s.max(zero).min(one));
        let highest = any_error(largest.power(shininess));
        if !is_lit {
            return highest;
        }
        // s^(rho-k) is largest at the largest s, or for a negative exponent at the least s. From rho = 3 on the second derivative
        // is Lipschitz continuous at s = 0, which suffices.
        let power = |less: f64| {
            let exponent = shininess - less;
            if exponent >= 0.0 {
                largest.power(exponent)
            } else {
                one / least.power(-exponent)
            }
        };
        let rho = exact(shininess);
        let [before, twice_before] = [1.0, 2.0].map(|less| {
            let factor = rho - exact(less);
            factor.max(-factor)
        });
        let chord = sine * (exact(2.0) / (one + least)).sqrt();
        let slope = rho * power(1.0);
        let b = exact(3.0) * rho * before * power(2.0) * sine;
        let d = rho * before * twice_before * power(3.0) * sine.square() * sine;
        let third = |axis| {
            let turned = product(self.to_light.derivatives(axis), self.normal.half_turn(axis));
            let eye = self.to_eye.derivatives(axis);
            let [e1, e2, e3] = [0, 1, 2].map(|order| eye[order] + turned[order]);
            slope * (exact(3.0) * e1 * e2 + chord * e3)
                + (b * chord * e2 + (b + d) * e1.square()) * e1
        };
        interpolation_error([third(0), third(1)]).min(highest)
    }
}

impl ReferenceCuboid<Interval> {
    /// Bounds on the error of the biquadratic, by channel, in levels, on the square whose middle, middle of the right side and
    /// middle of the lower side these are. `None` if a vector may vanish there.
    fn interpolation_errors(
        &self,
        face: usize,
        places: [Place; 3],
    ) -> Option<RealVector<Interval>> {
        let lines = places.map(|place| self.solid.line(place));
        let points = lines.each_ref().map(|line| self.solid.place(face, line));
        // Times w, vectors from and to a point of the face's plane are affine in the picture.
        let w = lines.each_ref().map(|line| descent(face, line));
        let middle = &points[0];
        let normal = self.surface.normal(face, middle);
        let normal = &if self.surface.has_shared_normals() {
            MovingVector::new(normal, [0, 1, 2].map(|i| points[i].share * w[i]))?
        } else {
            MovingVector::constant(normal)
        };
        let to_eye = &MovingVector::new(middle.to_eye, lines.map(|line| -line.direction))?;
        let mut sum = RealVector::exact(DVec3::ZERO);
        for (index, lights) in self.surface.lights_by_place() {
            let ways = [0, 1, 2].map(|i| self.surface.way_to_light(index, &points[i]) * w[i]);
            let to_light = &MovingVector::new(self.surface.to_light(index, middle), ways)?;
            let directions = Directions {
                normal,
                to_light,
                to_eye,
            };
            let sign = directions.cosine().sign(0.0);
            if sign == Some(Ordering::Less) {
                continue;
            }
            let is_lit = sign.is_some();
            let of_kind = |kind| {
                let lights = lights.iter().filter(move |light| light.kind == kind);
                let levels = lights.map(|light| light.levels);
                levels.reduce(|one, other| one + other)
            };
            if let Some(levels) = of_kind(LightKind::Diffuse) {
                sum = sum + levels * directions.cosine_error(is_lit);
            }
            if let Some(levels) = of_kind(LightKind::Specular) {
                let error = directions.highlight_error(self.surface.shininess, is_lit);
                sum = sum + levels * error;
            }
        }
        Some(sum)
    }
}

impl Reference<Interval> {
    /// Squares of these rows, at most [`MAX_SIDE`] of them, in which every pixel is enclosed within about `error` levels.
    pub fn squares(&self, rows: &Range<usize>, error: f64) -> Vec<EnclosedSquare> {
        let mut squares = Vec::new();
        if self.without.is_none() {
            for start in (0..self.sight.size[0]).step_by(MAX_SIDE) {
                let columns = start..(start + MAX_SIDE).min(self.sight.size[0]);
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
        let mut shown = None;
        for other in &self.cuboids {
            let bounds = [&other.solid.columns, &other.solid.rows];
            let is_beside = (bounds.iter().zip(pixels))
                .any(|(bound, pixels)| bound.end <= pixels.start || pixels.end <= bound.start);
            if is_beside {
                continue;
            }
            match (other.solid.shown(&corners), shown) {
                (Shown::Face(face), None) => shown = Some((other, face)),
                (Shown::Nothing, _) => {}
                (Shown::Face(_) | Shown::Undecided, _) => return None,
            }
        }
        let mut square = EnclosedSquare {
            columns: pixels[0].clone(),
            rows: pixels[1].clone(),
            triangle: TriangleId::NONE,
            coefficients: [[[0.0; 3]; 3]; 3],
            error: [0.0; 3],
        };
        let Some((cuboid, face)) = shown else {
            for (channel, level) in square.coefficients.iter_mut().zip(self.background.0) {
                let [least, largest] = level.endpoints();
                channel[0][0] = least;
                debug_assert_eq!(least, largest, "a number of the scene");
            }
            return Some(square);
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
fn polynomial(samples: [[[f64; 2]; 3]; 3]) -> ([[f64; 3]; 3], f64) {
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

fn exact(value: f64) -> Interval {
    Interval::of(value)
}

fn length(vector: RealVector<Interval>) -> Interval {
    vector.length_squared().sqrt()
}

#[cfg(test)]
mod tests;
