//! A highlight on a tile in, certified polynomials out: of the whole of it, or of the cosine that is raised.
//!
//! ```text
//!   s = (2 N.L N.O / N.N - L.O) (L.L)^(-1/2) (O.O)^(-1/2)   a series to third order, p = s / s_0 - 1
//!   s^rho = s_0^rho (1 + rho p + rho (rho - 1) / 2 p^2 + rho (rho - 1) (rho - 2) / 6 p^3 + ...)
//! ```
//! The tail of s is at most that of its majorant, the product of those of the mirror across N and of the directions of L
//! and O (see [`Majorant`]).
//! Of the whole highlight's cubic terms the nearest quadratic is kept. The bound on what that costs has four parts
//! more: the products of p that are beyond third order; the binomial series' tail after the third term, in Lagrange's
//! form; the cubic terms that the quadratic leaves; and rounding.
//!
//! Where that is too much, each pixel raises the series of s itself. If it errs by d, s^rho errs by
//! rho d (1 + d)^(rho - 1) at most, since neither s nor its series exceeds 1 + d.
//!
//! Rule: only where n.l is positive all over, and only where the bound is below what may be spent.

use fearless_simd::Simd;

use super::outlook::Outlook;
use super::products::Vectors;
use super::{Phong, Pixels, ROUNDED};
use crate::components::PointLight;
use crate::shading::certificate::{Majorant, exponential, moderate};
use crate::shading::number::{Number, Truth};
use crate::shading::patch::Patch;
use crate::shading::series::{Cubic, Quadratic};
use crate::shading::specular::power_exact;
use crate::shading::{TILE, U};

/// What the cubic terms of a highlight are worth: below this part of its brightness times the cube of its swing over its
/// width a quadratic is worth a try.
const CUBIC: f64 = 0.02;

/// What f64 makes of s, relative to it, with room to spare, besides what its six products err by.
const ROUNDING: f64 = 1e-12;

/// What s errs by at most, over what its six products do.
const PRODUCTS: f64 = 32.0;

/// The least s that the binomial series is tried around.
const LEAST: f64 = 0.25;

impl<S: Simd> Phong<'_, S> {
    /// s^rho on the tile, and a bound on what that errs by: infinite where it is above `most` anyway.
    #[inline(always)]
    pub(super) fn highlight<N: Number>(
        &self,
        vectors: &Vectors<N>,
        outlook: &Outlook<N>,
        most: f64,
    ) -> (Quadratic<N>, N) {
        let rho = self.surface.material.shininess;
        let swings = swings(vectors, outlook);
        let [turn, swing, sway] = swings;
        let bright = exponential(outlook.lambda * -rho);
        let turns = turn + turn + swing + sway;
        let expected = bright * turns * turns * turns * (CUBIC * rho * rho.sqrt());
        let none = turn.like(f64::INFINITY);
        let mut hope = !turn.like(most).below(expected) & are_moderate(swings);
        if !hope.any() {
            return (outlook.to_light.facing, none);
        }

        let cosine = cosine(vectors, outlook);
        let middle = cosine.0[0];
        let shape = cosine.scaled(middle.inverse());
        let [first, second, third] = shape.reaches(vectors.half());
        let tail = tail(swings) * middle.inverse();
        let stray = first + second + third + tail;
        hope = hope & middle.like(LEAST).below(middle) & moderate(stray);
        if !hope.any() {
            return (outlook.to_light.facing, none);
        }

        let k2 = 0.5 * rho * (rho - 1.0);
        let k3 = k2 * (rho - 2.0) / 3.0;
        let k4 = 0.25 * k3 * (rho - 3.0);
        // A power is dear, and where there is no hope nothing is made of it.
        let height = middle.each(|index| {
            if hope.one(index) {
                power_exact(rho, 1.0 - middle.one(index))
            } else {
                0.0
            }
        });
        // A bound on s_0^rho (1 + x)^(rho - 4) and (1 + x)^(rho - 1) wherever s_0 (1 + x) is between s_0 and the s of a
        // pixel: there s^rho is no brighter than on the tile, and |x| <= stray.
        let inverse = (-stray + 1.0).inverse();
        let highest = bright.or_less(height * exponential(stray * rho));
        let square = inverse * inverse;
        let swell = highest * exponential(tail * rho * inverse) * square * square;
        let (strength, left) = shape.composed([rho, k2, k3]).economized(vectors.half());
        let sum = first + second;
        let all = sum + third;
        let cut = (second * second + third * (sum + all)) * k2.abs()
            + (all * all * all - first * first * first) * k3.abs();
        let square = stray * stray;
        let beyond = swell * (tail * rho + square * square * k4.abs());
        let rounding = (outlook.to_light.doubt * PRODUCTS + ROUNDING) * (1.0 + rho);
        let error = height * (cut + left) + beyond + rounding;
        (strength.scaled(height), hope.choose(error, none))
    }

    /// Adds a light's specular term with a series for s, and returns a bound on what that costs, in levels; none, and
    /// nothing added, where it is above what one highlight may lose by rounding.
    #[inline(always)]
    pub(super) fn add_raised(
        &self,
        light: &PointLight,
        vectors: &Vectors,
        outlook: &Outlook,
        patch: &Patch,
        pixels: &mut Pixels,
    ) -> Option<f64> {
        let rho = self.surface.material.shininess;
        let swings = swings(vectors, outlook);
        if rho < 1.0 || !are_moderate(swings) {
            return None;
        }
        let specular = self.surface.coefficients(light)[1];
        let most = ROUNDED * self.share_of_tolerance() / specular.max_element();
        let error = tail(swings) + PRODUCTS * outlook.to_light.doubt;
        if rho * error > most {
            return None;
        }
        let lambda = cosine(vectors, outlook).scaled(-1.0).plus(1.0);
        let size = lambda.0[0].abs() + lambda.reaches(patch.half).iter().sum::<f64>();
        // As of a quadratic: its coefficients are rounded once, and Horner's rule leaves seven roundings at most.
        let error = error + 8.0 * U * size;
        let cost = rho * error * (rho * error).exp() + self.power_error();
        if cost.is_nan() || cost > most {
            return None;
        }
        let ramps = lambda.ramps(-patch.row);
        let lanes = patch.lanes();
        let levels = specular.as_vec3().to_array();
        for (row, &(from, to)) in pixels.coverage.spans.iter().enumerate() {
            if from < to {
                let [middle, slope, curve, bend] = ramps.row(row);
                let mut lambda = [0.0; TILE];
                for lane in 0..TILE {
                    let x = lanes[lane];
                    lambda[lane] = middle + x * (slope + x * (curve + x * bend));
                }
                let mut strength = [1.0; TILE];
                self.raise(&lambda, &mut strength);
                pixels.add(row, levels, &strength);
            }
        }
        Some(specular.max_element() * cost)
    }
}

/// Those of N, L and O.
#[inline(always)]
fn swings<N: Number>(vectors: &Vectors<N>, outlook: &Outlook<N>) -> [N; 3] {
    [
        vectors.swing_normal(),
        outlook.to_light.swing(),
        vectors.swing_eye(),
    ]
}

#[inline(always)]
fn are_moderate<N: Number>([normal, light, eye]: [N; 3]) -> N::Truth {
    moderate(normal) & moderate(light) & moderate(eye)
}

/// s up to third order.
#[inline(always)]
fn cosine<N: Number>(vectors: &Vectors<N>, outlook: &Outlook<N>) -> Cubic<N> {
    let to_light = &outlook.to_light;
    let [mirror, eye_root] = vectors.mirror();
    let along = Cubic::from(to_light.facing)
        .times(&mirror)
        .minus(&to_light.light_eye(vectors).into());
    let roots = Cubic::from(to_light.light_square)
        .inverse_root()
        .times(&eye_root);
    along.times(&roots)
}

/// What the majorant of s is at t = 1 beyond its third order, for the swings of N, L and O.
#[inline(always)]
fn tail<N: Number>([normal, light, eye]: [N; 3]) -> N {
    Majorant::mirror(normal)
        .times(&Majorant::direction(light))
        .times(&Majorant::direction(eye))
        .tail()
}
