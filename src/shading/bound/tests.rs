//! Bounds against the errors that interpolation makes on dense grids.
//!
//! Rule: squares are random, a bound is never exceeded, and none is so loose that it would hide a mistake.

use glam::DVec3;

use super::*;
use crate::shading::gloss::tests::gloss;
use crate::shading::interpolation::NODE;
use crate::shading::moving::{Extents, MAX_RADIUS};
use crate::shading::simd::{Baseline, baseline};

type Number = f64x4<Baseline>;

struct Random(u64);

impl Random {
    fn within(&mut self, from: f64, to: f64) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        from + (to - from) * ((self.0 >> 11) as f64 / (1_u64 << 53) as f64)
    }

    fn vector(&mut self, size: f64) -> DVec3 {
        DVec3::new(
            self.within(-size, size),
            self.within(-size, size),
            self.within(-size, size),
        )
    }

    /// Of length about one, moving by about `pace` over the square.
    fn affine(&mut self, centre: DVec3, pace: f64) -> Affine {
        Affine {
            centre,
            dx: self.vector(pace),
            dy: self.vector(pace),
        }
    }
}

/// A square at the picture's middle.
fn square(half: f64) -> Extents<Baseline> {
    let [zero, half] = [0.0, half].map(|number| Number::splat(baseline(), number));
    Extents {
        middle: [zero; 2],
        half: [half; 2],
    }
}

fn value(vector: &Affine, x: f64, y: f64) -> DVec3 {
    vector.at(x, y).normalize()
}

/// The largest difference on a dense grid between a function and its interpolant through nine samples, once both are mapped.
fn interpolation(f: impl Fn(f64, f64) -> f64, map: impl Fn(f64) -> f64) -> f64 {
    let lagrange = |x: f64| {
        let r2 = NODE * NODE;
        [
            x * (x - NODE) / (2.0 * r2),
            1.0 - x * x / r2,
            x * (x + NODE) / (2.0 * r2),
        ]
    };
    let nodes = [-NODE, 0.0, NODE];
    let samples = nodes.map(|y| nodes.map(|x| f(x, y)));
    let mut worst = 0.0_f64;
    for row in 0..=20 {
        for column in 0..=20 {
            let [x, y] = [column, row].map(|step| f64::from(step) / 10.0 - 1.0);
            let (along, down) = (lagrange(x), lagrange(y));
            let mut sum = 0.0;
            for j in 0..3 {
                for i in 0..3 {
                    sum += samples[j][i] * along[i] * down[j];
                }
            }
            worst = worst.max((map(sum) - map(f(x, y))).abs());
        }
    }
    worst
}

fn one(number: Number) -> f64 {
    number.as_array()[0]
}

/// Asserts that enough squares have a bound, that none is exceeded, and that they are not loose.
fn judge(mut ratios: Vec<f64>, least: usize) {
    assert!(
        ratios.len() >= least,
        "{} squares have a bound",
        ratios.len()
    );
    ratios.sort_by(f64::total_cmp);
    let worst = ratios[ratios.len() - 1];
    // Errors as small as f64's own say nothing.
    let told = &ratios[ratios.partition_point(|ratio| *ratio <= 0.0)..];
    let [median, tenth] = [2, 10].map(|part| 1.0 / told[told.len() / part]);
    println!("bound over error: {median:.1} in the median, below {tenth:.1} in 90 %");
    assert!(worst <= 1.0, "{worst} of the bound");
    assert!(
        worst > 0.3,
        "so loose a bound ({worst}) would hide a mistake"
    );
}

fn scene(random: &mut Random) -> [Affine; 3] {
    let pace = 10.0_f64.powf(random.within(-3.0, -0.7));
    let normal = random.vector(1.0).normalize();
    let light = (normal + random.vector(0.9)).normalize();
    // Half of the eyes stand near the mirror image of the light.
    let mirrored = normal * (2.0 * normal.dot(light)) - light;
    let spread = if random.within(0.0, 1.0) < 0.5 {
        0.1
    } else {
        1.0
    };
    let eye = (mirrored + random.vector(spread)).normalize();
    [normal, light, eye].map(|centre| {
        let share = random.within(0.0, 1.0);
        random.affine(centre, pace * share)
    })
}

#[test]
fn the_cosine_strays_no_further_than_its_bound() {
    let mut random = Random(1);
    let mut ratios = Vec::new();
    for _ in 0..4000 {
        let [normal, light, _] = scene(&mut random);
        let extents = square(1.0);
        let [n, l] = [normal, light].map(|vector| MovingVector::new(&vector, &extents));
        if one(n.radius.max(l.radius)) < MAX_RADIUS {
            let bound = one(cosine_error(&n, &l));
            let cosine = |x, y| value(&normal, x, y).dot(value(&light, x, y));
            let error = interpolation(cosine, |cosine| cosine);
            ratios.push((error - 1e-14) / bound);
        }
    }
    judge(ratios, 3000);
}

#[test]
fn a_highlight_strays_no_further_than_its_bound() {
    let mut random = Random(2);
    let [mut ratios, mut logarithms] = [Vec::new(), Vec::new()];
    for index in 0..6000 {
        let [normal, light, eye] = scene(&mut random);
        let shininess = [0.0, 0.5, 1.0, 1.7, 2.0, 2.5, 3.0, 10.0, 76.8, 1000.0][index % 10];
        let extents = square(1.0);
        let [n, l, o] = [normal, light, eye].map(|vector| MovingVector::new(&vector, &extents));
        if one(n.radius.max(l.radius).max(o.radius)) >= MAX_RADIUS {
            continue;
        }
        let ends = |x: f64, y: f64| {
            let [n, l, o] = [normal, light, eye].map(|vector| value(&vector, x, y));
            [o, n * (2.0 * n.dot(l)) - l]
        };
        let s = |x: f64, y: f64| {
            let [o, r] = ends(x, y);
            o.dot(r)
        };
        let rounding = 1e-6;
        let (cosine, lit, dark) = facing(&n, &l, Number::splat(baseline(), rounding));
        let range = reflection([&n, &l, &o], cosine);
        let [most, least, sine] = [range.most, range.least, range.sine].map(one);
        for row in 0..=6 {
            for column in 0..=6 {
                let [x, y] = [column, row].map(|step| f64::from(step) / 3.0 - 1.0);
                let s = s(x, y);
                assert!(s <= most + 1e-14 && s >= least - 1e-14);
                let [o, r] = ends(x, y);
                assert!(o.cross(r).length() <= sine + 1e-14);
                let cosine = value(&normal, x, y).dot(value(&light, x, y));
                assert!(!lit.test(0) || cosine > rounding);
                assert!(!dark.test(0) || cosine < -rounding);
            }
        }
        let gloss = gloss(shininess, 0.5);
        let most = power(shininess as f32, range.most);
        let vectors = [&n, &l, &o];
        let bound = one(highlight_error(&gloss, vectors, range, most));
        if bound < 1.0 {
            let error = interpolation(|x, y| s(x, y).max(0.0).powf(shininess), |power| power);
            ratios.push((error - 1e-14) / (bound + 1e-14));
        }
        let none = Number::splat(baseline(), 0.0);
        let bound = one(logarithm_error(&gloss, vectors, range, most, none));
        if bound < 1.0 {
            let error = interpolation(|x, y| s(x, y).ln() * shininess, f64::exp);
            logarithms.push((error - 1e-14) / (bound + 1e-14));
        }
    }
    judge(ratios, 2000);
    judge(logarithms, 2000);
}

#[test]
fn a_quotient_strays_no_further_than_its_bound() {
    let mut random = Random(3);
    let mut ratios = Vec::new();
    for _ in 0..4000 {
        let size = random.within(0.0, 0.4);
        let [e, g] = [random.within(-size, size), random.within(-size, size)];
        let [a, b, c] = [
            random.within(0.0, 300.0),
            random.within(-99.0, 99.0),
            random.within(-99.0, 99.0),
        ];
        let [numerator, w] = [Affine::new(a, b, c), Affine::new(1.0, e, g)]
            .map(|of| of.map(|number| Number::splat(baseline(), number)));
        let bound = one(quotient_error(numerator, w));
        let quotient = |x, y| (a + b * x + c * y) / (1.0 + e * x + g * y);
        let error = interpolation(quotient, |quotient| quotient);
        ratios.push((error - 1e-10) / (bound + 1e-12));
    }
    judge(ratios, 4000);
}

#[test]
fn the_bound_of_a_quotient_is_the_one_on_paper() {
    // The third derivative of (1 - t) / (1 + t / 2) is largest at t = -1: 6 (1 + 1/2) (1/2)^2 / (1/2)^4 = 36.
    let [unit, half, zero, most] = [1.0, 0.5, 0.0, 36.0].map(|it| Number::splat(baseline(), it));
    for [along, down] in [[unit, zero], [zero, unit]] {
        let w = Affine::new(unit, half * along, half * down);
        let found = quotient_error(Affine::new(unit, -along, -down), w);
        let expected = interpolation_error([most * along, most * down]);
        assert_eq!(one(found), one(expected));
    }
}

#[test]
fn a_numerator_may_change_as_w_along_x_and_against_it_along_y() {
    // (1 + (x - y) / 4) / (1 + (x + y) / 4): b - a e = 0, c - a g = -1/2, b g - c e = 1/8, and w is at least 1/2.
    let lanes = |numbers: [f64; 3]| {
        let [centre, dx, dy] = numbers.map(|it| Number::splat(baseline(), it));
        Affine::new(centre, dx, dy)
    };
    let found = quotient_error(lanes([1.0, 0.25, -0.25]), lanes([1.0, 0.25, 0.25]));
    let expected = [0.75, 3.75].map(|it| Number::splat(baseline(), it));
    assert_eq!(one(found), one(interpolation_error(expected)));
}

#[test]
fn the_derivatives_of_a_product_are_those_of_leibniz() {
    // 3 + 3 (2 10 + 1 20) + 30 is the third.
    let [a, b] =
        [1.0, 10.0].map(|size| [1.0, 2.0, 3.0].map(|it| Number::splat(baseline(), size * it)));
    assert_eq!(product(a, b).map(one), [11.0, 42.0, 153.0]);
}

#[test]
fn the_power_is_never_below_the_true_one() {
    for shininess in [0.0, 0.5, 1.0, 2.0, 76.8, 1e3, 1e6] {
        for step in 0..=1000 {
            let s = 1.0 - (f64::from(step) / 1000.0).powi(5);
            let bound = one(power(shininess as f32, Number::splat(baseline(), s)));
            assert!(bound >= s.powf(shininess), "{s}^{shininess}: {bound}");
        }
    }
}

#[test]
fn the_error_of_a_linear_highlight_is_the_one_on_paper() {
    // o and r are 60 degrees apart, so |r - o| = 1. Only l moves, along x, with p = q = 1/10: E_1 = 0.1,
    // E_2 = 0.02 / sqrt(3), E_3 = 0.003. For rho = 1 the third derivative is at most 3 E_1 E_2 + |r - o| E_3.
    let number = |value| f64x4::splat(baseline(), value);
    let extents = square(0.5);
    let vector = Affine {
        centre: DVec3::Z,
        ..Affine::default()
    };
    let resting = MovingVector::new(&vector, &extents);
    let mut moving = resting;
    moving.rates[0] = [number(0.1); 2];
    // The chord is bounded by the least s alone.
    let range = Reflection {
        most: number(0.9),
        least: number(0.5),
        sine: number(0.75_f64.sqrt()),
    };
    let (vectors, half) = ([&resting, &moving, &resting], number(0.5));
    // For rho = 3/2 both of the last two terms count: b = 9/2 sin, d = 3/2 sin^3.
    let found = highlight_error(&gloss(1.5, 0.5), vectors, range, half);
    let (sin, e1_e2) = (0.75_f64.sqrt(), 0.002 / 3.0_f64.sqrt());
    let b = 4.5 * sin;
    let third = 1.5 * (3.0 * e1_e2 + 0.003) + b * e1_e2 + (b + 1.5 * sin.powi(3)) * 0.001;
    assert!((one(found) / third * 24.0 - 1.0).abs() < 1e-6);

    let gloss = gloss(1.0, 0.5);
    let found = highlight_error(&gloss, vectors, range, half);
    let third = 0.3 * 0.02 / 3.0_f64.sqrt() + 0.003;
    assert!((one(found) / third * 24.0 - 1.0).abs() < 1e-6);

    // ln s with s'''/s, and with tan(60) = sqrt(3): 3 tan / s (E_1 E_2 + E_1^3) + 2 tan^3 E_1^3.
    let tan = 3.0_f64.sqrt();
    let third = 2.0 * third + 6.0 * tan * (0.002 / tan + 0.001) + 2.0 * tan.powi(3) * 0.001;
    let sample = (2.0 + EXPONENT_ERROR / 2.0) * 2.0 * U * AMPLIFICATION;
    let expected = third / 24.0 + sample;
    let found = one(logarithm_error(&gloss, vectors, range, half, half * 0.0));
    assert!((found / (0.5 * expected / (1.0 - expected)) - 1.0).abs() < 1e-9);
}

#[test]
fn a_logarithm_in_f32_errs_by_no_more_than_is_counted() {
    let rounding = 100.0;
    let mut most = 0.0_f64;
    for rho in [1e-3, 0.5, 1.0, 10.0, 76.8, 1e3, 1e6] {
        for step in 0..=4000 {
            // Up to s = 1/4.
            let chord = 1.5_f64.sqrt() * (f64::from(step) / 4000.0).powi(2);
            let exact = |chord: f64| 1.0 - chord * chord / 2.0;
            for sign in [1.0, -1.0] {
                let moved = (chord + sign * rounding * U).max(0.0);
                let one_minus_cos = moved * moved / 2.0 * (1.0 + sign * 3.0 * U);
                let lanes = f32x16::splat(baseline(), one_minus_cos as f32);
                let found = f64::from(specular::exponent(rho as f32, lanes)[0]);
                let error = found * std::f64::consts::LN_2 - rho * exact(chord).ln();
                let [chord, over] =
                    [chord, 1.0 / exact(chord)].map(|it| Number::splat(baseline(), it));
                let lanes = Number::splat(baseline(), rounding);
                let count = rho * one(logarithm_rounding(chord, lanes, over)) * U;
                most = most.max(error.abs() / count);
            }
        }
    }
    println!("{most:.3} of the count");
    assert!(most <= 1.0, "the count is {most} times too small");
    assert!(most > 0.9, "the count is loose: {most}");
}

#[test]
fn a_logarithm_has_no_bound_where_s_may_be_small_or_the_error_large() {
    let number = |value| f64x4::splat(baseline(), value);
    let extents = square(0.5);
    let vector = Affine {
        centre: DVec3::Z,
        ..Affine::default()
    };
    let resting = MovingVector::new(&vector, &extents);
    let found = |least: f64, rounding: f64| {
        let range = Reflection {
            most: number(1.0),
            least: number(least),
            sine: number((1.0 - least * least).sqrt()),
        };
        let vectors = [&resting; 3];
        let error = logarithm_error(
            &gloss(76.8, 0.5),
            vectors,
            range,
            number(1.0),
            number(rounding),
        );
        one(error)
    };
    assert!(found(0.3, 50.0) < 0.01);
    for [least, rounding] in [[0.2, 50.0], [0.3, 6e3], [f64::NAN, 50.0], [0.3, f64::NAN]] {
        assert_eq!(found(least, rounding), f64::INFINITY, "{least}, {rounding}");
    }
}

#[test]
fn the_motion_of_a_vector_does_not_depend_on_its_scale() {
    // At 2^-283 the square of the area of two steps is below the smallest f64.
    let extents = square(1.0);
    let moving = |scale: f64| {
        let vector = Affine {
            centre: DVec3::new(0.0, 0.0, 2.0) * scale,
            dx: DVec3::new(0.05, 0.0, 0.25) * scale,
            dy: DVec3::new(0.0, 0.05, 0.25) * scale,
        };
        MovingVector::new(&vector, &extents)
    };
    for scale in [2.0_f64.powi(-283), 2.0_f64.powi(283)] {
        let [one, other] = [moving(1.0), moving(scale)];
        assert_eq!(one.radius.as_array(), other.radius.as_array());
        let rates = |vector: MovingVector<Baseline>| {
            vector.rates.map(|axis| axis.map(|rate| *rate.as_array()))
        };
        assert_eq!(rates(one), rates(other), "{scale:e}");
    }
}
