//! A highlight as one certified polynomial of a whole tile.
//!
//! ```text
//!   s = (2 N.L N.O / N.N - L.O) (L.L)^(-1/2) (O.O)^(-1/2)   a series to third order, p = s / s_0 - 1
//!   s^rho = s_0^rho (1 + rho p + rho (rho - 1) / 2 p^2 + rho (rho - 1) (rho - 2) / 6 p^3 + ...)
//! ```
//! Of the series' cubic terms the nearest quadratic is kept.
//!
//! The bound on what that costs has five parts. The tail of s is at most that of its majorant (see [`Majorant`]), with A,
//! B, C those of N, L and O
//! ```text
//!   2 A^2 B C + B C
//! ```
//! The products of p that are beyond third order; the binomial series' tail after the third term, in Lagrange's form; the
//! cubic terms that the quadratic leaves; and rounding.
//!
//! Rule: only where n.l is positive all over, and only where the bound is below what may be spent.

use fearless_simd::Simd;

use super::Phong;
use super::outlook::{Outlook, Vectors};
use crate::shading::certificate::{MOST_SWING, Majorant};
use crate::shading::patch::Patch;
use crate::shading::series::{Cubic, Quadratic};
use crate::shading::specular::power_exact;

/// What the cubic terms of a highlight are worth: below this part of its brightness times the cube of its swing over its
/// width a quadratic is worth a try.
const CUBIC: f64 = 0.02;

/// What f64 makes of s, relative to it, with room to spare.
const ROUNDING: f64 = 1e-12;

/// The least s that the binomial series is tried around.
const LEAST: f64 = 0.25;

impl<S: Simd> Phong<'_, S> {
    /// s^rho on the tile, and a bound on what that errs by; none where that is above `most`.
    #[inline(always)]
    pub(super) fn highlight(
        &self,
        vectors: &Vectors,
        outlook: &Outlook,
        patch: &Patch,
        most: f64,
    ) -> Option<(Quadratic, f64)> {
        let rho = self.surface.material.shininess;
        let swings = [vectors.swing_normal, outlook.swing, vectors.swing_eye];
        let turns = 2.0 * swings[0] + swings[1] + swings[2];
        let bright = (-rho * outlook.lambda).exp();
        let expected = CUBIC * bright * turns * turns * turns * rho * rho.sqrt();
        if expected > most || swings.iter().any(|&swing| swing >= MOST_SWING) {
            return None;
        }

        let facing = Cubic::from(outlook.facing);
        let along = facing
            .times(&vectors.normal_eye().into())
            .times(&Cubic::from(vectors.normal_square).inverse())
            .scaled(2.0)
            .minus(&outlook.light_eye(vectors).into());
        let roots = Cubic::from(outlook.light_square)
            .inverse_root()
            .times(&Cubic::from(vectors.eye_square()).inverse_root());
        let cosine = along.times(&roots);
        let middle = cosine.0[0];
        if middle.is_nan() || middle < LEAST {
            return None;
        }
        let shape = cosine.scaled(1.0 / middle);
        let [first, second, third] = shape.reaches(patch.half);
        let tail = tail(swings) / middle;
        let stray = first + second + third + tail;
        if stray.is_nan() || stray >= MOST_SWING {
            return None;
        }

        let k2 = 0.5 * rho * (rho - 1.0);
        let k3 = k2 * (rho - 2.0) / 3.0;
        let k4 = 0.25 * k3 * (rho - 3.0);
        // A bound on s_0^rho (1 + x)^(rho - 4) and (1 + x)^(rho - 1) wherever s_0 (1 + x) is between s_0 and the s of a
        // pixel: there s^rho is no brighter than on the tile, and |x| <= stray.
        let height = power_exact(rho, 1.0 - middle);
        let swell = bright.min(height * (rho * stray).exp()) * (rho * tail / (1.0 - stray)).exp()
            / (1.0 - stray).powi(4);
        let (strength, left) = shape.composed([rho, k2, k3]).economized(patch.half);
        let cut = k2.abs() * (second * second + third * (2.0 * (first + second) + third))
            + k3.abs() * ((first + second + third).powi(3) - first.powi(3));
        let beyond = swell * (rho * tail + k4.abs() * stray.powi(4));
        let error = height * (cut + left) + beyond + ROUNDING * (1.0 + rho);
        (error <= most).then(|| (strength.scaled(height), error))
    }
}

/// What the majorant of s is at t = 1 beyond its third order, for the swings of N, L and O.
#[inline(always)]
fn tail(swings: [f64; 3]) -> f64 {
    let [normal, light, eye] = swings.map(Majorant::of_swing);
    let sides = light.times(&eye);
    let mirrored = normal.times(&normal).times(&sides);
    2.0 * mirrored.tail() + sides.tail()
}
