//! A bound on the error of the interpolant through nine samples, in closed form.
//!
//! On a square of half extents h_x and h_y, a function f is sampled at the nine Chebyshev nodes x, y in {-r, 0, r},
//! r = sqrt(3) / 2, in units of the half extents. The biquadratic through the samples errs by at most
//!
//! ```text
//!   (M_x + M_y + 2/3 min(M_x, M_y)) / 24        M_x >= |d^3 f / dx^3| all over the square, x in units of h_x; M_y alike
//! ```
//! In one direction a quadratic through three Chebyshev nodes errs by M / (3! 2^2), and interpolation in the other
//! direction multiplies an error by at most 5/3, the Lebesgue constant of three nodes (Trefethen, "Approximation Theory and
//! Approximation Practice", chapters 6 and 15). With I_x and I_y the interpolations in one direction, f - I_x I_y f = (f -
//! I_x f) + I_x (f - I_y f), so the error is at most (M_x + 5/3 M_y) / 24. x and y may be exchanged, because I_x I_y = I_y
//! I_x. The smaller of the two bounds is the one above, because 5/3 = 1 + 2/3.
//!
//! **Third derivatives.** Here N, L and O are the vectors n, l and o before they are normalised. w N, w L and w O are
//! affine in x and y, w > 0, and have the directions of N, L and O. Let V be one of them at any point of the square. A step
//! t along x gives V + t V_x, in the plane of V and V_x. Take this plane as the complex plane and V on its real axis. Then
//! V(t) = |V| (1 + z t) with z = V_x / V. Its angle is Im log(1 + z t), whose derivatives at t = 0 are Im(z), -Im(z^2) and
//! 2 Im(z^3). With p >= |Im z| and q >= |z|, the unit vector v = V / |V| has derivatives of length at most
//!
//! ```text
//!   |v'|   = |Im z|                                  <= p
//!   |v''|                                            <= min(2 p q, 2/sqrt(3) q^2)
//!   |v'''| = 3 |Im z| sqrt(4 Re(z)^4 + Im(z)^4)      <= min(6 p q^2, 3 q^3)
//! ```
//! The half-turn about n, R = 2 n n^T - 1, turns by twice the angle of n. With twice the angle in the derivation above, its
//! derivatives are at most 2 p, 4 p q and 12 p q^2. Leibniz' rule bounds the derivatives of the products n.l and r = R l,
//! whose factors have length one.
//!
//! **The highlight.** Let theta be the angle between o and r, s = cos(theta), and e = r - o, whose length is
//! c = 2 sin(theta/2). Then s = 1 - |e|^2 / 2, and
//!
//! ```text
//!   s' = -e.e'      s'' = -|e'|^2 - e.e''      s''' = -3 e'.e'' - e.e'''
//!   (s^rho)''' = rho s^(rho-1) s''' + 3 rho (rho-1) s^(rho-2) s' s'' + rho (rho-1) (rho-2) s^(rho-3) s'^3
//! ```
//! Let E_k bound the k-th derivative of e: the bound for o plus the bound for r = R l. A unit vector is perpendicular to its
//! derivative, so |s'| is at most E_1 sin(theta). s' |e'|^2 and s'^3 have the same sign, so from rho = 2 on
//! they enter with opposite signs, and only the larger of the two counts:
//!
//! ```text
//!   |(s^rho)'''| <= rho s^(rho-1) (3 E_1 E_2 + c E_3) + b c E_1 E_2 + max(b, d) E_1^3         for rho < 2: b + d
//!   b = 3 rho |rho-1| s^(rho-2) sin(theta)      d = rho |rho-1| |rho-2| s^(rho-3) sin(theta)^3
//! ```
//! s^(rho-k) is bounded at the largest s if rho >= 3, else by s_max^rho / s_min^k. The sine is at most its value at the
//! middle plus the turn of theta, because its slope is at most 1. c is the sine over cos(theta/2). Each product of a power
//! and a sine is also bounded by its largest value at any angle.
//!
//! Where s <= 0 the highlight is zero, and so are its derivatives. For rho >= 3 its second derivative is Lipschitz
//! continuous at s = 0, and the error bound of a quadratic needs only that. For smaller rho a square where s may reach 0
//! has no bound.
//!
//! **Its logarithm.** A highlight is nearly a Gaussian, and the logarithm of one is quadratic. So where s^rho bends too much,
//! rho ln s may be interpolated instead, and the power taken at each pixel. Where s > 0,
//!
//! ```text
//!   (ln s)''' = s''' / s - 3 s' s'' / s^2 + 2 s'^3 / s^3
//!   |(ln s)'''| <= (3 E_1 E_2 + c E_3) / s + b c E_1 E_2 + (b + d) E_1^3
//!   b = 3 sin(theta) / s^2      d = 2 sin(theta)^3 / s^3      at the least s
//! ```
//! An error x of rho ln s changes s^rho by at most s^rho (e^x - 1), which is at most s^rho x / (1 - x) for x < 1.
//!
//! `proofs/theorems` has Coq proofs of these theorems. `proofs/README.md` lists the steps that are done by hand.
//!
//! A square whose bound is NaN or infinite is not interpolated. `min` may return the operand that is a number: wherever it is used
//! here, each of the two operands alone is a bound.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, f64x4, mask64x4};

use super::U;
use super::affine::Affine;
use super::gloss::Gloss;
use super::interpolation::AMPLIFICATION;
use super::lanes::{cross, dot};
use super::moving::{MovingVector, positive};
use super::specular::{self, EXPONENT_ERROR};
use crate::shading::simd::{three, two};

/// The least s, and the largest error of rho ln s, of a highlight whose logarithm is interpolated. With such an s the error of
/// s itself is small beside it, and e to the power of such an error is below 1.3: [`super::interpolation::ROW_ERROR`] counts on that.
const LEAST_COSINE: f64 = 0.25;
const MAX_EXPONENT_ERROR: f64 = 0.25;

/// Bounds on the sizes of the first three derivatives along x or along y.
pub type Derivatives<S> = [f64x4<S>; 3];

/// Those of a unit vector whose p and q along that axis are given.
#[inline(always)]
pub fn direction<S: Simd>([p, q]: [f64x4<S>; 2]) -> Derivatives<S> {
    const HALF_SECOND: f64 = 0.577_350_269_189_625_8; // 1 / sqrt(3)
    let second = p.min(q * HALF_SECOND) * q * 2.0;
    let third = (p * 2.0).min(q) * q * q * 3.0;
    [p, second, third]
}

/// Those of the half-turn about it.
#[inline(always)]
pub fn half_turn<S: Simd>([p, q]: [f64x4<S>; 2]) -> Derivatives<S> {
    [p * 2.0, p * q * 4.0, p * q * q * 12.0]
}

/// Those of a product whose factors are at most one (Leibniz).
#[inline(always)]
pub fn product<S: Simd>(a: Derivatives<S>, b: Derivatives<S>) -> Derivatives<S> {
    [
        a[0] + b[0],
        a[1] + a[0] * b[0] * 2.0 + b[1],
        a[2] + (a[1] * b[0] + a[0] * b[1]) * 3.0 + b[2],
    ]
}

/// The error of the interpolant, for bounds on third derivatives along x and y.
#[inline(always)]
pub fn interpolation_error<S: Simd>(third: [f64x4<S>; 2]) -> f64x4<S> {
    let [x, y] = third;
    (x + y + x.min(y) * (2.0 / 3.0)) * (1.0 / 24.0)
}

/// A bound on the interpolation error of n.l.
#[inline(always)]
pub fn cosine_error<S: Simd>(normal: &MovingVector<S>, light: &MovingVector<S>) -> f64x4<S> {
    interpolation_error(two!(|axis| product(
        direction(normal.rates[axis]),
        direction(light.rates[axis])
    )[2]))
}

/// n.l at the middle; whether n.l > 0 all over the square; and whether n.l <= 0 all over it. `rounding` bounds
/// the error of n.l in f32, so both hold there, too.
///
/// n.l changes by at most the angle that n turns plus the angle that l turns.
#[inline(always)]
pub fn facing<S: Simd>(
    normal: &MovingVector<S>,
    light: &MovingVector<S>,
    rounding: f64x4<S>,
) -> (f64x4<S>, mask64x4<S>, mask64x4<S>) {
    let cosine = dot(&normal.vector.centre, &light.vector.centre);
    let most = normal.turn + light.turn + rounding;
    let bounded = normal.is_direction_bounded() & light.is_direction_bounded();
    let [lit, dark] = [cosine.simd_gt(most), cosine.simd_lt(-most)];
    (cosine, bounded & lit, bounded & dark)
}

/// Bounds on s = o.r and on the angle between o and r, over a square.
#[derive(Clone, Copy)]
pub struct Reflection<S: Simd> {
    /// The largest and the least s; at most 1.
    pub most: f64x4<S>,
    pub least: f64x4<S>,
    /// The largest sine of the angle; a bound only where all directions are bounded.
    pub sine: f64x4<S>,
}

/// The bounds for the vectors n, l and o; `cosine` is n.l at the middle. r turns by at most twice the turn
/// of n plus that of l.
#[inline(always)]
pub fn reflection<S: Simd>(
    [normal, light, eye]: [&MovingVector<S>; 3],
    cosine: f64x4<S>,
) -> Reflection<S> {
    let simd = cosine.token();
    let [n, l, o] = [normal, light, eye].map(|moving| &moving.vector.centre);
    let r = three!(|axis| n[axis] * cosine * 2.0 - l[axis]);
    let s = dot(o, &r);
    // |o x r| is the sine of the angle. The root of 1 - s^2 would lose its digits where s is near 1.
    let product = cross(o, &r);
    let sine = dot(&product, &product).sqrt();
    let turn = normal.turn * 2.0 + light.turn + eye.turn;
    // For t in 0..=pi/2: 1 - t^2 / 2 <= cos(t) <= 1 - t^2 / 2 + t^4 / 24, and t - t^3 / 6 <= sin(t) <= t. So, theta being the
    // angle at the middle,
    //   the largest s   1 if s > 0 and sin(theta) <= t - t^3 / 6: then theta may be less than t
    //                   else cos(theta - t) <= s - s t^2 / 2 + sin(theta) t, limited to 1:
    //                     for s > 0 as sin(theta) (t - sin(t)) > t^4 / 24, for s <= 0 as s cos(t) <= s (1 - t^2 / 2)
    //   the least s     cos(theta + t) >= s - |s| t^2 / 2 - sin(theta) t, at most -1 if theta + t > pi
    let turn2 = turn * turn;
    let one = f64x4::splat(simd, 1.0);
    let reached = sine.simd_le(turn * (1.0 - turn2 * (1.0 / 6.0))) & s.simd_gt(0.0);
    let beyond = s - s * turn2 * 0.5 + sine * turn;
    let most = reached.select(one, beyond.min(one));
    // The inequalities do not hold for turns of more than pi / 2.
    let bounded =
        normal.is_direction_bounded() & light.is_direction_bounded() & eye.is_direction_bounded();
    let narrow = bounded & turn.simd_lt(std::f64::consts::FRAC_PI_2);
    let least = s - s.abs() * turn2 * 0.5 - sine * turn;
    Reflection {
        most: narrow.select(most, one),
        least: narrow.select(least, -one),
        sine: (sine + turn).min(one),
    }
}

impl<S: Simd> Reflection<S> {
    /// The largest |r - o| where s >= 0.
    #[inline(always)]
    fn chord(&self) -> f64x4<S> {
        // cos(theta/2)^2 = (1 + s) / 2.
        self.sine * (2.0 / (positive(self.least) + 1.0)).sqrt()
    }
}

/// The interpolation error of a function of s, from the factors of 3 E_1 E_2 + c E_3, of c E_1 E_2 and of E_1^3 in its third
/// derivative. The vectors are n, l and o.
#[inline(always)]
fn error_from<S: Simd>(
    [normal, light, eye]: [&MovingVector<S>; 3],
    chord: f64x4<S>,
    [a, b, cubes]: [f64x4<S>; 3],
) -> f64x4<S> {
    interpolation_error(two!(|axis| {
        let o = direction(eye.rates[axis]);
        let r = product(direction(light.rates[axis]), half_turn(normal.rates[axis]));
        let [e1, e2, e3] = three!(|order| o[order] + r[order]);
        a * (e1 * e2 * 3.0 + chord * e3) + (b * chord * e2 + cubes * e1 * e1) * e1
    }))
}

/// A bound on the interpolation error of s^rho; `power` is that of the largest s. The vectors are n, l and o.
#[inline(always)]
pub fn highlight_error<S: Simd>(
    gloss: &Gloss,
    vectors: [&MovingVector<S>; 3],
    reflection: Reflection<S>,
    power: f64x4<S>,
) -> f64x4<S> {
    let simd = power.token();
    let Reflection { most, least, sine } = reflection;
    let [rho, second, third] = gloss.factors;
    // s^(rho-k) <= most^rho / base^k. The base is the largest s if no exponent is negative (rho >= 3), else the least.
    let base = if rho >= 3.0 { most } else { least };
    let over = 1.0 / base;
    let a = power * over * rho;
    let b = power * over * over * sine * (3.0 * second);
    let d = power * over * over * over * sine * sine * sine * third;
    // From rho = 2 on the two have opposite signs.
    let cubes = if rho >= 2.0 { b.max(d) } else { b + d };
    let errors = error_from(vectors, reflection.chord(), [a, b, cubes]);
    let bounded = base.simd_gt(0.0);
    bounded.select(errors, f64x4::splat(simd, f64::INFINITY))
}

/// A bound on the error of s^rho where its logarithm is interpolated, with the errors of samples in f32; `power` is that of
/// the largest s, and |r - o| of a sample has `rounding` roundings.
#[inline(always)]
pub fn logarithm_error<S: Simd>(
    gloss: &Gloss,
    vectors: [&MovingVector<S>; 3],
    reflection: Reflection<S>,
    power: f64x4<S>,
    rounding: f64x4<S>,
) -> f64x4<S> {
    let Reflection { least, sine, .. } = reflection;
    let over = 1.0 / least;
    let b = sine * over * over * 3.0;
    let cubes = b + sine * sine * sine * over * over * over * 2.0;
    let interpolated = error_from(vectors, reflection.chord(), [over, b, cubes]);
    let sample = logarithm_rounding(reflection.chord(), rounding, over) * U;
    let error = (interpolated + sample * AMPLIFICATION) * gloss.factors[0];
    let bounded = least.simd_gt(LEAST_COSINE) & error.simd_lt(MAX_EXPONENT_ERROR);
    let infinite = f64x4::splat(power.token(), f64::INFINITY);
    bounded.select(power * error / (1.0 - error), infinite)
}

/// The error of ln s of a sample, in roundings, for an |r - o| of at most `chord` that errs by `rounding`, and 1 / s of at
/// most `over`. 1 - s = |r - o|^2 / 2 has four roundings more, and its logarithm errs relatively; |ln s| is at most (1 - s) / s.
#[inline(always)]
fn logarithm_rounding<S: Simd>(chord: f64x4<S>, rounding: f64x4<S>, over: f64x4<S>) -> f64x4<S> {
    let chord = chord + rounding * U;
    (rounding + chord * (2.0 + EXPONENT_ERROR / 2.0)) * chord * over
}

/// An upper bound of s^rho for s of at most 1.
#[inline(always)]
pub fn power<S: Simd>(shininess: f32, most: f64x4<S>) -> f64x4<S> {
    let simd = most.token();
    // f32 may round 1 - s up, which would make the power smaller.
    let one_minus_cos = positive((1.0 - most) * (1.0 - 2.0 * U)).min(f64x4::splat(simd, 1.0));
    let repeated = f32x16::from_fn(simd, |lane| one_minus_cos[lane % 4] as f32);
    let power = specular::power(shininess, repeated);
    let power = f64x4::from_fn(simd, |square| f64::from(power[square]));
    // A power that is not clamped has an exponent of two of at least -126, so its relative error is at most 126 ln(2) times the
    // 10.2 U of its logarithm (`proofs/power.v`), 5.3e-5; one that is clamped is below 2^-126.
    power * 1.001 + 1e-30
}

/// A bound on the interpolation error of (a + b x + c y) / w for w = 1 + e x + g y.
///
/// Let A be the numerator at any point. Along x the quotient is a constant plus k / (w + e t) with |k| = |b w - A e| / |e|,
/// so its third derivative is 6 |b w - A e| e^2 / w^4. b w - A e = (b - a e) + y (b g - c e) does not change along x. Along
/// y alike.
#[inline(always)]
pub fn quotient_error<S: Simd>(numerator: Affine<f64x4<S>>, w: Affine<f64x4<S>>) -> f64x4<S> {
    let (a, b, c) = (numerator.centre, numerator.dx, numerator.dy);
    let (e, g) = (w.dx, w.dy);
    let least_w = 1.0 - e.abs() - g.abs();
    let fourth = 6.0 / (least_w * least_w * least_w * least_w);
    let both = (b * g - c * e).abs();
    let x = ((b - a * e).abs() + both) * e * e * fourth;
    let y = ((c - a * g).abs() + both) * g * g * fourth;
    least_w.simd_gt(0.0).select(
        interpolation_error([x, y]),
        f64x4::splat(a.token(), f64::INFINITY),
    )
}

#[cfg(test)]
mod tests;
