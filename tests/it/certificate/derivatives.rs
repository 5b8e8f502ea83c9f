//! The closed-form bounds on third derivatives against Taylor arithmetic in intervals.
//!
//! ```text
//!   f(x + t) = f0 + f1 t + f2 t^2 + f3 t^3 + ...   each coefficient an interval that holds the exact one; f''' = 6 f3
//! ```
//! The test uses nothing of the derivation of a bound. A bound below a proven derivative is wrong.

use std::ops::{Add, Mul};

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x4};
use glam::DVec3;
use shadetrade::reference::{Interval, Real};
use shadetrade::shading::affine::Affine;
use shadetrade::shading::bound::{self, Highlight, cosine_error, reflection, side};
use shadetrade::shading::field::{Field, MAX_RADIUS, Places};
use shadetrade::simd::baseline;

use super::SCENES;
use crate::support::cases::cases;
use crate::support::random::Random;

/// The first four Taylor coefficients of a function of one variable.
#[derive(Clone, Copy)]
struct Taylor([Interval; 4]);

impl Add for Taylor {
    type Output = Taylor;

    fn add(self, other: Taylor) -> Taylor {
        Taylor([0, 1, 2, 3].map(|k| self.0[k] + other.0[k]))
    }
}

impl Mul for Taylor {
    type Output = Taylor;

    fn mul(self, other: Taylor) -> Taylor {
        Taylor(
            [0, 1, 2, 3].map(|k| {
                (0..=k).fold(Interval::of(0.0), |sum, i| sum + self.0[i] * other.0[k - i])
            }),
        )
    }
}

impl Taylor {
    fn scaled(self, by: f64) -> Taylor {
        Taylor(self.0.map(|coefficient| coefficient * Interval::of(by)))
    }

    /// r with r^2 a = 1, coefficient by coefficient.
    fn inverse_root(self) -> Taylor {
        let [a0, a1, a2, a3] = self.0;
        let two = Interval::of(2.0);
        let s0 = a0.sqrt();
        let s1 = a1 / (two * s0);
        let s2 = (a2 - s1 * s1) / (two * s0);
        let s3 = (a3 - two * s1 * s2) / (two * s0);
        let r0 = Interval::of(1.0) / s0;
        let r1 = -(s1 * r0) / s0;
        let r2 = -(s1 * r1 + s2 * r0) / s0;
        let r3 = -(s1 * r2 + s2 * r1 + s3 * r0) / s0;
        Taylor([r0, r1, r2, r3])
    }

    /// s^rho for s > 0, from p' s = rho s' p coefficient by coefficient. The first coefficient is not rigorous, but its
    /// error is negligible against the bound.
    fn power(self, shininess: f64) -> Taylor {
        let [s0, ..] = self.0;
        let [least, largest] = s0.endpoints();
        let mut p = [Interval::of((0.5 * (least + largest)).powf(shininess)); 4];
        for k in 1..4 {
            let terms = (1..=k).map(|j| {
                let factor = shininess * j as f64 - (k - j) as f64;
                Interval::of(factor) * self.0[j] * p[k - j]
            });
            let sum = terms.fold(Interval::of(0.0), |sum, term| sum + term);
            p[k] = sum / (Interval::of(k as f64) * s0);
        }
        Taylor(p)
    }

    /// A lower bound of the third derivative's magnitude.
    fn third(self) -> f64 {
        let [least, largest] = self.0[3].endpoints();
        6.0 * least.max(-largest).max(0.0)
    }
}

fn dot(a: &[Taylor; 3], b: &[Taylor; 3]) -> Taylor {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The unit vector along an affine one, from a point to the right (`axis` 0) or down (1).
fn unit(vector: &Affine, [x, y]: [f64; 2], axis: usize) -> [Taylor; 3] {
    let exact = |number: f64| Interval::of(number);
    let slope = [vector.dx, vector.dy][axis];
    let components = [0, 1, 2].map(|i| {
        let value = exact(vector.centre[i])
            + exact(vector.dx[i]) * exact(x)
            + exact(vector.dy[i]) * exact(y);
        Taylor([value, exact(slope[i]), exact(0.0), exact(0.0)])
    });
    let inverse = dot(&components, &components).inverse_root();
    components.map(|component| component * inverse)
}

/// A lower bound of the interpolation error of a square, from third derivatives at some of its points.
fn proven(f: impl Fn([f64; 2], usize) -> Taylor) -> f64 {
    let [mut x, mut y] = [0.0_f64; 2];
    for place in places() {
        x = x.max(f(place, 0).third());
        y = y.max(f(place, 1).third());
    }
    (x + y + x.min(y) * (2.0 / 3.0)) / 24.0
}

/// N, L and O of length about one on the square from -1 to 1. They often have a highlight, and often lie in one plane,
/// where all rotations add up.
fn vectors(random: &mut Random) -> [Affine; 3] {
    let flat = random.one_of(&[DVec3::ONE, DVec3::new(1.0, 1.0, 0.0)]);
    let within =
        |random: &mut Random, size: f64| flat * DVec3::ZERO.map(|_| random.within(-size, size));
    let pace = random.decade(-4.0, -0.7);
    let normal = within(random, 1.0).normalize();
    let light = (normal + within(random, 0.9)).normalize();
    let mirrored = normal * (2.0 * normal.dot(light)) - light;
    let spread = random.one_of(&[0.3, 1.0]);
    let eye = (mirrored + within(random, spread)).normalize();
    [normal, light, eye].map(|centre| {
        let pace = pace * random.one_of(&[0.01, 0.3, 1.0]);
        Affine {
            centre,
            dx: within(random, pace),
            dy: within(random, pace),
        }
    })
}

/// Derivatives are compared at these points of a square.
fn places() -> impl Iterator<Item = [f64; 2]> {
    (-2..=2).flat_map(|row| (-2..=2).map(move |column| [column, row].map(|x| f64::from(x) / 2.0)))
}

/// Lower bounds of the lengths of the first three derivatives of a vector.
fn lengths(vector: &[Taylor; 3]) -> [f64; 3] {
    [(1, 1.0), (2, 2.0), (3, 6.0)].map(|(order, factor)| {
        let squares = vector.iter().map(|component| {
            let [least, largest] = component.0[order].endpoints();
            least.max(-largest).max(0.0).powi(2)
        });
        squares.sum::<f64>().sqrt() * factor
    })
}

/// Compares the derivatives of a direction and of the half-turn about it with their bounds; returns the largest shares,
/// by order.
fn shares_of_directions<S: Simd>(simd: S, cases: u64) -> [[f64; 3]; 2] {
    let mut shares = [[0.0_f64; 3]; 2];
    let mut random = Random(17);
    for _ in 0..cases {
        let mut vector = vectors(&mut random)[0];
        // Towards its own origin or away from it: then its length changes fastest.
        let along = random.one_of(&[0.0, 0.0, 0.2, -0.4]);
        vector.dx += vector.centre * along;
        vector.dy += vector.centre * random.one_of(&[0.0, 0.4, -0.4]);
        let field = Field::new(&vector.into(), &Places::single(simd, [0.0; 2], [1.0; 2]));
        let radius = field.radius.as_array()[0];
        if radius >= MAX_RADIUS {
            continue;
        }
        for place in places() {
            let [x, y] = place;
            let moved = vector.at(x, y);
            assert!(moved.distance(vector.centre) <= radius * (1.0 + 1e-9));
            for axis in [0, 1] {
                let direction = unit(&vector, place, axis);
                // In the plane in which the vector rotates, the half-turn rotates all other vectors equally.
                let still = direction.map(|component| {
                    let zero = Interval::of(0.0);
                    Taylor([component.0[0], zero, zero, zero])
                });
                let twice = dot(&direction, &still).scaled(2.0);
                let mirrored = direction.map(|component| component * twice);
                let bounds = [
                    bound::direction(field.rates[axis]),
                    bound::half_turn(field.rates[axis]),
                ];
                let found = [lengths(&direction), lengths(&mirrored)];
                for kind in [0, 1] {
                    for order in 0..3 {
                        let bound = bounds[kind][order].as_array()[0];
                        let share = found[kind][order] / bound;
                        assert!(
                            share <= 1.0 + 1e-6,
                            "{}: {share}",
                            ["direction", "half-turn"][kind]
                        );
                        shares[kind][order] = shares[kind][order].max(share);
                    }
                }
            }
        }
    }
    shares
}

/// The exponents: values at which factors vanish or change their signs, values between them, and values beyond.
const SHININESS: [f64; 9] = [0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 4.5, 10.0, 76.8];

/// The largest proven shares of the bounds of n.l, and of s^rho for each exponent.
fn largest_shares<S: Simd>(simd: S, cases: u64) -> (f64, [f64; SHININESS.len()]) {
    let (mut lit, mut shares) = (0.0_f64, [0.0_f64; SHININESS.len()]);
    let mut random = Random(16);
    for case in 0..cases {
        let [n, l, o] = vectors(&mut random);
        let places = Places::single(simd, [0.0; 2], [1.0; 2]);
        let [normal, light, eye] = [n, l, o].map(|vector| Field::new(&vector.into(), &places));
        let radii = [&normal, &light, &eye].map(|field| field.radius.as_array()[0]);
        if radii.iter().any(|radius| *radius >= MAX_RADIUS) {
            continue;
        }
        let cosine = proven(|place, axis| dot(&unit(&n, place, axis), &unit(&l, place, axis)));
        let bound = cosine_error(&normal, &light).as_array()[0];
        assert!(cosine <= bound * (1.0 + 1e-9), "n.l: {cosine} of {bound}");
        lit = lit.max(cosine / bound);

        let range = reflection(&normal, &light, &eye, side(&normal, &light).cosine);
        if range.least.as_array()[0] <= 0.0 {
            continue;
        }
        let index = case as usize % SHININESS.len();
        let shininess = SHININESS[index];
        let highlight = proven(|place, axis| {
            let [n, l, o] = [&n, &l, &o].map(|vector| unit(vector, place, axis));
            let s = (dot(&n, &l) * dot(&n, &o)).scaled(2.0) + dot(&l, &o).scaled(-1.0);
            s.power(shininess)
        });
        let power = bound::power(shininess as f32, range.most);
        let bound = Highlight::new(shininess).error(&normal, &light, &eye, &range, power);
        let bound = bound.as_array()[0];
        assert!(
            highlight <= bound * (1.0 + 1e-9),
            "s^{shininess}: {highlight} of {bound}"
        );
        shares[index] = shares[index].max(highlight / bound);
    }
    (lit, shares)
}

#[test]
fn no_derivative_of_a_direction_or_a_half_turn_exceeds_its_bound() {
    let simd = baseline().expect("every machine has these lanes");
    let shares = shares_of_directions(simd, 20 * cases(SCENES) as u64);
    println!("largest proven share of the bounds on directions and half-turns: {shares:.3?}");
    assert!(
        shares.as_flattened().iter().all(|share| *share > 0.9),
        "the bound is too loose to show a mistake: {shares:?}"
    );
}

#[test]
fn no_third_derivative_of_a_quotient_exceeds_its_bound() {
    let simd = baseline().expect("every machine has these lanes");
    let mut random = Random(18);
    let mut largest = 0.0_f64;
    for _ in 0..20 * cases(SCENES) as u64 {
        let size = random.decade(-3.0, -0.35);
        let [e, g] = [0, 1].map(|_| random.within(-size, size));
        let [a, b, c] = [300.0, 99.0, 99.0].map(|size| random.within(-size, size));
        let third = |[x, y]: [f64; 2], axis: usize| {
            let w = 1.0 + e * x + g * y;
            let (rise, pace) = ([b, c][axis], [e, g][axis]);
            let first = (rise - pace * (a + b * x + c * y) / w) / w;
            (6.0 * first * (pace / w).powi(2)).abs()
        };
        let [x, y] =
            [0, 1].map(|axis| places().map(|place| third(place, axis)).fold(0.0, f64::max));
        let lanes = |number| f64x4::splat(simd, number);
        let bound = bound::quotient_error([a, b, c].map(lanes), [e, g].map(lanes));
        let share = (x + y + x.min(y) * (2.0 / 3.0)) / 24.0 / bound.as_array()[0];
        assert!(share <= 1.0 + 1e-9, "{share}");
        largest = largest.max(share);
    }
    assert!(largest > 0.9, "the bound is too loose to show a mistake");
}

#[test]
fn an_affine_number_is_given_by_its_middle_and_two_edges() {
    let simd = baseline().expect("every machine has these lanes");
    let mut random = Random(19);
    for _ in 0..100 {
        let mut within = |size: f64| random.within(-size, size);
        let scalar = Affine {
            centre: within(9.0),
            dx: within(1.0),
            dy: within(1.0),
        };
        let (middle, half) = ([within(99.0), within(99.0)], [7.5, 15.5]);
        let places = Places::single(simd, middle, half);
        let [centre, right, down] = places.number(scalar.terms()).map(|term| term.as_array()[0]);
        for [x, y] in [[-1.0, -1.0], [1.0, -0.5], [0.0, 1.0]] {
            let expected = scalar.at(middle[0] + half[0] * x, middle[1] + half[1] * y);
            let found = centre + right * x + down * y;
            assert!((found - expected).abs() < 1e-12, "{found}, not {expected}");
        }
    }
}

#[test]
fn the_product_of_two_rotations_is_a_rotation_by_their_sum() {
    let simd = baseline().expect("every machine has these lanes");
    // (cos(a t), sin(a t)) . (cos(b t), -sin(b t)) = cos((a + b) t).
    let turn = |speed: f64| [1, 2, 3].map(|order| f64x4::splat(simd, speed.powi(order)));
    let numbers = |lanes: [f64x4<_>; 3]| lanes.map(|order| order.as_array()[0]);
    assert_eq!(
        numbers(bound::product(turn(2.0), turn(3.0))),
        numbers(turn(5.0))
    );
}

#[test]
fn no_proven_third_derivative_exceeds_its_bound() {
    let simd = baseline().expect("every machine has these lanes");
    let (cosine, highlights) = largest_shares(simd, 20 * cases(SCENES) as u64);
    println!("largest proven share of the bounds: {cosine:.3} for n.l, {highlights:.3?} for s^rho");
    assert!(
        cosine > 0.5 && highlights.iter().all(|share| *share > 0.5),
        "the bound is too loose to show a mistake: {cosine}, {highlights:?}"
    );
}
