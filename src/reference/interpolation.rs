//! A bound on the distance of the exact levels of a square from the biquadratic through nine samples of them.
//!
//! The biquadratic errs by (M_x + M_y + 2/3 min(M_x, M_y)) / 24, with bounds M on the third derivatives along x and y, which are
//! -1..=1 over the square (Trefethen, "Approximation Theory and Approximation Practice", chapters 6 and 15).
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

use glam::DVec3;

use super::geometry::descent;
use super::illumination::reflection;
use super::interval::Interval;
use super::picture::ReferenceCuboid;
use super::real::{Real, RealVector};
use super::sight::Place;
use crate::components::LightKind;

/// The errors of samples grow by at most this: the square of the Lebesgue constant.
pub const AMPLIFICATION: f64 = 25.0 / 9.0;

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

    /// The derivatives of the unit vector.
    fn derivatives(&self, axis: usize) -> Derivatives {
        let [p, q] = self.rates[axis];
        let twice = p + p;
        [
            p,
            twice.min(q * exact(2.0) / exact(3.0).sqrt()) * q,
            twice.min(q) * q.square() * exact(3.0),
        ]
    }

    /// The derivatives of the half-turn about it.
    fn half_turn(&self, axis: usize) -> Derivatives {
        let [p, q] = self.rates[axis];
        let product = p * q;
        [p + p, exact(4.0) * product, exact(12.0) * product * q]
    }
}

/// The derivatives of a product of vectors or turns of length one (Leibniz).
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
    pub fn interpolation_errors(
        &self,
        face: usize,
        places: [Place; 3],
    ) -> Option<RealVector<Interval>> {
        let lines = places.map(|place| self.solid.line(place));
        let points = lines.each_ref().map(|line| self.solid.place(face, line));
        // Times w, vectors from and to a point of the face's plane are affine in the picture.
        let w = lines.each_ref().map(|line| descent(face, line));
        let middle = &points[0];
        let direction = self.surface.normal(face, middle);
        let normal = &if self.surface.has_shared_normals() {
            MovingVector::new(direction, [0, 1, 2].map(|i| points[i].share * w[i]))?
        } else {
            MovingVector::constant(direction)
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

pub fn exact(value: f64) -> Interval {
    Interval::of(value)
}

fn length(vector: RealVector<Interval>) -> Interval {
    vector.length_squared().sqrt()
}

#[cfg(test)]
mod tests;
