//! The closed-form bounds on third derivatives against Taylor arithmetic.
//!
//! ```text
//!   f(x + t) = f0 + f1 t + f2 t^2 + f3 t^3 + ...        f' = f1, f'' = 2 f2, f''' = 6 f3
//! ```
//! The test uses nothing of the derivation of a bound. A bound below a derivative is wrong.

use std::array::from_fn;

use fearless_simd::f64x4;
use fearless_simd::prelude::*;
use shadetrade::shading::Surface;
use shadetrade::shading::affine::Affine;
use shadetrade::shading::bound::{
    self, cosine_error, facing, highlight_error, logarithm_error, reflection,
};
use shadetrade::shading::gloss::Gloss;
use shadetrade::shading::moving::{Extents, MAX_RADIUS, MovingVector};
use shadetrade::shading::simd::{Baseline, baseline};

use crate::support::prelude::*;

/// The first four Taylor coefficients of a function of one variable.
type Taylor = [f64; 4];

fn times(f: &Taylor, g: &Taylor) -> Taylor {
    from_fn(|k| (0..=k).map(|i| f[i] * g[k - i]).sum())
}

/// f^exponent for f > 0, from p' f = exponent f' p coefficient by coefficient.
fn power(f: &Taylor, exponent: f64) -> Taylor {
    let mut p = [f[0].powf(exponent); 4];
    for k in 1..4 {
        let terms = (1..=k).map(|j| (exponent * j as f64 - (k - j) as f64) * f[j] * p[k - j]);
        p[k] = terms.sum::<f64>() / (k as f64 * f[0]);
    }
    p
}

/// ln f for f > 0, from f l' = f' coefficient by coefficient.
fn logarithm(f: &Taylor) -> Taylor {
    let mut l = [f[0].ln(); 4];
    for k in 1..4 {
        let terms = (1..k).map(|j| j as f64 * l[j] * f[k - j]);
        l[k] = (f[k] - terms.sum::<f64>() / k as f64) / f[0];
    }
    l
}

fn dot(f: &[Taylor; 3], g: &[Taylor; 3]) -> Taylor {
    let products = [0, 1, 2].map(|i| times(&f[i], &g[i]));
    from_fn(|k| products.iter().map(|product| product[k]).sum())
}

/// The unit vector along an affine one, from a point to the right (`axis` 0) or down (1).
fn unit(vector: &Affine, [x, y]: [f64; 2], axis: usize) -> [Taylor; 3] {
    let (value, slope) = (vector.at(x, y), [vector.dx, vector.dy][axis]);
    let components = [0, 1, 2].map(|i| [value[i], slope[i], 0.0, 0.0]);
    let inverse = power(&dot(&components, &components), -0.5);
    components.map(|component| times(&component, &inverse))
}

/// The lengths of the first three derivatives of a vector.
fn lengths(vector: &[Taylor; 3]) -> [f64; 3] {
    [(1, 1.0), (2, 2.0), (3, 6.0)]
        .map(|(order, factor)| DVec3::from(vector.map(|it| it[order])).length() * factor)
}

/// Derivatives are compared at these points of a square.
fn places() -> impl Iterator<Item = [f64; 2]> {
    (0..25).map(|place| [place % 5, place / 5].map(|step| f64::from(step) / 2.0 - 1.0))
}

/// A lower bound of the interpolation error of a square, from third derivatives at some of its points.
fn error(f: impl Fn([f64; 2], usize) -> Taylor) -> f64 {
    let third = |axis| {
        let all = places().map(|place| 6.0 * f(place, axis)[3].abs());
        all.fold(0.0, f64::max)
    };
    let [x, y] = [third(0), third(1)];
    (x + y + x.min(y) * (2.0 / 3.0)) / 24.0
}

/// N, L and O of length about one on the square from -1 to 1. They often have a highlight, and often lie in one plane,
/// where all rotations add up.
fn vectors(random: &mut Random) -> [Affine; 3] {
    let flat = random.one_of(&[DVec3::ONE, DVec3::new(1.0, 1.0, 0.0)]);
    let pace = random.between(1e-4, 0.2);
    let normal = (flat * random.around(1.0)).normalize();
    let light = (normal + flat * random.around(0.9)).normalize();
    let mirrored = normal * (2.0 * normal.dot(light)) - light;
    let spread = random.one_of(&[0.3, 1.0]);
    let anywhere = (mirrored + flat * random.around(spread)).normalize();
    // Where o.r just stays positive all over the square.
    let across = anywhere.reject_from(mirrored).normalize();
    let grazing = (across + mirrored * random.within(0.0, 10.0 * pace)).normalize();
    let eye = random.one_of(&[anywhere, anywhere, grazing]);
    [normal, light, eye].map(|centre| {
        let pace = pace * random.one_of(&[0.01, 0.3, 1.0]);
        let [dx, dy] = [(); 2].map(|()| flat * random.around(pace));
        Affine { centre, dx, dy }
    })
}

/// The vector on the square, unless it moves too far for bounds.
fn field(vector: &Affine) -> Option<MovingVector<Baseline>> {
    let simd = baseline();
    let [middle, half] = [0.0, 1.0].map(|number| [f64x4::splat(simd, number); 2]);
    let field = MovingVector::new(vector, &Extents { middle, half });
    (field.radius.as_array()[0] < MAX_RADIUS).then_some(field)
}

/// Keeps the larger share of a bound, which must not be exceeded.
#[track_caller]
fn keep(most: &mut f64, found: f64, bound: f64) {
    assert!(found <= bound * (1.0 + 1e-6), "{found} of {bound}");
    *most = most.max(found / bound);
}

#[test]
fn no_turn_of_a_direction_and_no_derivative_of_it_or_a_half_turn_exceeds_its_bound() {
    let (mut shares, mut turned) = ([[0.0_f64; 3]; 2], 0.0);
    let mut random = Random(17);
    for _ in 0..20 * cases(100) {
        let mut vector = vectors(&mut random)[0];
        // Towards its own origin or away from it: then its length changes fastest.
        vector.dx += vector.centre * random.one_of(&[0.0, 0.0, 0.2, -0.4]);
        vector.dy += vector.centre * random.one_of(&[0.0, 0.4, -0.4]);
        let Some(field) = field(&vector) else {
            continue;
        };
        for place in places() {
            let moved = vector.at(place[0], place[1]).distance(vector.centre);
            assert!(moved <= field.radius.as_array()[0] * (1.0 + 1e-9));
            let angle = vector.at(place[0], place[1]).angle_between(vector.centre);
            keep(&mut turned, angle, field.turn.as_array()[0] + 1e-8);
            for axis in [0, 1] {
                let direction = unit(&vector, place, axis);
                // In the plane in which the vector rotates, the half-turn rotates all other vectors equally.
                let still = direction.map(|it| [it[0], 0.0, 0.0, 0.0]);
                let twice = dot(&direction, &still).map(|it| 2.0 * it);
                let mirrored = direction.map(|it| times(&it, &twice));
                let rates = field.rates[axis];
                let bounds = [bound::direction(rates), bound::half_turn(rates)];
                for (kind, found) in [lengths(&direction), lengths(&mirrored)].iter().enumerate() {
                    for order in 0..3 {
                        let bound = bounds[kind][order].as_array()[0];
                        keep(&mut shares[kind][order], found[order], bound);
                    }
                }
            }
        }
    }
    println!("largest shares of the bounds on directions and half-turns: {shares:.3?}");
    let is_tight = shares.as_flattened().iter().all(|share| *share > 0.9);
    assert!(is_tight, "too loose to show a mistake: {shares:?}");
    assert!(turned > 0.9, "{turned} of the bound on the turn");
}

/// The exponents: values at which factors vanish or change their signs, values between them, and values beyond.
const SHININESS: [f64; 9] = [0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 4.5, 10.0, 76.8];

#[test]
fn no_third_derivative_of_a_cosine_or_a_highlight_exceeds_its_bound() {
    let (mut lit, mut reflected, mut shares) = (0.0, 0.0, [0.0_f64; SHININESS.len()]);
    let mut logarithms = 0.0;
    let mut random = Random(16);
    for case in 0..20 * cases(100) {
        let [n, l, o] = vectors(&mut random);
        let [Some(normal), Some(light), Some(eye)] = [&n, &l, &o].map(field) else {
            continue;
        };
        let cosine = error(|place, axis| dot(&unit(&n, place, axis), &unit(&l, place, axis)));
        let bound = cosine_error(&normal, &light).as_array()[0];
        keep(&mut lit, cosine, bound);
        let direction = bound::direction(light.rates[0]);
        let bounds = bound::product(direction, bound::half_turn(normal.rates[0]));
        for place in places() {
            let [n, l] = [&n, &l].map(|vector| unit(vector, place, 0));
            let twice = dot(&n, &l).map(|it| 2.0 * it);
            let r = from_fn(|i| from_fn(|k| times(&n[i], &twice)[k] - l[i][k]));
            for (order, found) in lengths(&r).into_iter().enumerate() {
                keep(&mut reflected, found, bounds[order].as_array()[0]);
            }
        }
        let none = normal.radius * 0.0;
        let (cosine, ..) = facing(&normal, &light, none);
        let range = reflection([&normal, &light, &eye], cosine);
        if range.least.as_array()[0] <= 0.0 {
            continue;
        }
        let index = case % SHININESS.len();
        let shininess = SHININESS[index];
        let s = |place, axis| {
            let [n, l, o] = [&n, &l, &o].map(|vector| unit(vector, place, axis));
            let (both, across) = (times(&dot(&n, &l), &dot(&n, &o)), dot(&l, &o));
            from_fn(|k| 2.0 * both[k] - across[k])
        };
        let highlight = error(|place, axis| power(&s(place, axis), shininess));
        let most = bound::power(shininess as f32, range.most);
        let (material, dark) = (white(shininess), Illumination::default());
        let gloss = Gloss::new(&Surface::new(&material, &dark, DVec3::ZERO), 0.5);
        let fields = [&normal, &light, &eye];
        let bound = highlight_error(&gloss, fields, range, most);
        keep(&mut shares[index], highlight, bound.as_array()[0]);
        // An error x of the exponent makes x / (1 - x) of the power.
        let bound = logarithm_error(&gloss, fields, range, most, none);
        if bound.as_array()[0].is_finite() {
            let bound = bound / (bound + most);
            let found = shininess * error(|place, axis| logarithm(&s(place, axis)));
            keep(&mut logarithms, found, bound.as_array()[0]);
        }
    }
    let found = [&shares[..], &[lit, reflected, logarithms]].concat();
    println!("largest shares of the bounds: {found:.3?}");
    let is_tight = found.iter().all(|share| *share > 0.5);
    assert!(is_tight, "too loose to show a mistake: {found:?}");
}
