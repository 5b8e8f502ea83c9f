//! The closed-form bounds on third derivatives against Taylor arithmetic in intervals.
//!
//! ```text
//!   f(x + t) = f0 + f1 t + f2 t^2 + f3 t^3 + ...   each coefficient an interval that holds the exact one; f''' = 6 f3
//! ```
//! Rule: nothing of the bound's derivation is used here; a bound below what an interval proves is wrong.

use std::ops::{Add, Mul};

use fearless_simd::Simd;
use fearless_simd::prelude::*;
use glam::DVec3;
use shadetrade::reference::Interval;
use shadetrade::shading::affine::Affine;
use shadetrade::shading::bound::{
    self, Field, Highlight, MAX_RADIUS, Places, cosine_error, reflection, side,
};
use shadetrade::shading::kernel::Power;
use shadetrade::simd::baseline;

use crate::cases;
use crate::random::Random;

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
        Taylor([0, 1, 2, 3].map(|k| {
            (0..=k).fold(Interval::from(0.0), |sum, i| {
                sum + self.0[i] * other.0[k - i]
            })
        }))
    }
}

impl Taylor {
    fn scaled(self, by: f64) -> Taylor {
        Taylor(self.0.map(|coefficient| coefficient * Interval::from(by)))
    }

    /// r with r^2 a = 1, coefficient by coefficient.
    fn inverse_root(self) -> Taylor {
        let [a0, a1, a2, a3] = self.0;
        let two = Interval::from(2.0);
        let s0 = a0.sqrt();
        let s1 = a1 / (two * s0);
        let s2 = (a2 - s1 * s1) / (two * s0);
        let s3 = (a3 - two * s1 * s2) / (two * s0);
        let r0 = Interval::from(1.0) / s0;
        let r1 = -(s1 * r0) / s0;
        let r2 = -(s1 * r1 + s2 * r0) / s0;
        let r3 = -(s1 * r2 + s2 * r1 + s3 * r0) / s0;
        Taylor([r0, r1, r2, r3])
    }

    /// The third derivative is at least this large.
    fn third(self) -> f64 {
        let [least, largest] = self.0[3].endpoints();
        6.0 * least.max(-largest).max(0.0)
    }
}

fn dot(a: &[Taylor; 3], b: &[Taylor; 3]) -> Taylor {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The unit vector along an affine one, from a point on to the right (`axis` 0) or down (1).
fn unit(vector: &Affine, [x, y]: [f64; 2], axis: usize) -> [Taylor; 3] {
    let exact = |number: f64| Interval::from(number);
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

/// What interpolation errs by at least as far as the third derivatives tell that occur at places of a square.
fn proven(f: impl Fn([f64; 2], usize) -> Taylor) -> f64 {
    let [mut x, mut y] = [0.0_f64; 2];
    for row in -2..=2 {
        for column in -2..=2 {
            let place = [f64::from(column) / 2.0, f64::from(row) / 2.0];
            x = x.max(f(place, 0).third());
            y = y.max(f(place, 1).third());
        }
    }
    (x + y + x.min(y) * (2.0 / 3.0)) / 24.0
}

/// N, L and O of length about one on the square from -1 to 1; often with a highlight.
fn vectors(random: &mut Random) -> [Affine; 3] {
    let within = |random: &mut Random, size: f64| DVec3::ZERO.map(|_| random.within(-size, size));
    let pace = 10.0_f64.powf(random.within(-2.5, -0.7));
    let normal = within(random, 1.0).normalize();
    let light = (normal + within(random, 0.9)).normalize();
    let mirrored = normal * (2.0 * normal.dot(light)) - light;
    let eye = (mirrored + within(random, 0.3)).normalize();
    [normal, light, eye].map(|centre| {
        let pace = pace * random.within(0.0, 1.0);
        Affine {
            centre,
            dx: within(random, pace),
            dy: within(random, pace),
        }
    })
}

/// Largest shares that are proven of the bounds of n.l and of s^rho.
fn largest_shares<S: Simd>(simd: S, cases: u64) -> [f64; 2] {
    let mut shares = [0.0_f64; 2];
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
        shares[0] = shares[0].max(cosine / bound);

        let range = reflection(&normal, &light, &eye, side(&normal, &light).cosine);
        if range.least.as_array()[0] <= 0.0 {
            continue;
        }
        let shininess = [1, 2, 3, 4, 10, 77][case as usize % 6];
        let highlight = proven(|place, axis| {
            let [n, l, o] = [&n, &l, &o].map(|vector| unit(vector, place, axis));
            let s = (dot(&n, &l) * dot(&n, &o)).scaled(2.0) + dot(&l, &o).scaled(-1.0);
            (1..shininess).fold(s, |power, _| power * s)
        });
        let shininess = f64::from(shininess);
        let power = bound::power(&Power::new(shininess, 0.0, 0.0), range.most);
        let bound = Highlight::new(shininess).error(&normal, &light, &eye, &range, power);
        let bound = bound.as_array()[0];
        assert!(
            highlight <= bound * (1.0 + 1e-9),
            "s^{shininess}: {highlight} of {bound}"
        );
        shares[1] = shares[1].max(highlight / bound);
    }
    shares
}

#[test]
fn no_third_derivative_that_intervals_prove_is_above_its_bound() {
    let simd = baseline().expect("every machine has these lanes");
    let [cosine, highlight] = largest_shares(simd, 20 * cases());
    println!("of the bounds are proven at most {cosine} for n.l, {highlight} for s^rho");
    assert!(
        cosine > 0.5 && highlight > 0.2,
        "so loose a bound would hide a mistake: {cosine}, {highlight}"
    );
}
