//! The bounds on derivatives, against derivatives that are known.

use super::super::square::polynomial;
use super::*;

/// The sizes of the first three derivatives of e^(i f), from those of f.
fn of_turn([a, b, c]: [f64; 3]) -> [f64; 3] {
    [a.abs(), b.hypot(a * a), (c - a * a * a).hypot(3.0 * a * b)]
}

/// Asserts that a bound holds the values, and the largest share of it that a value takes.
fn share(values: [f64; 3], bounds: Derivatives, largest: &mut [f64; 3]) {
    for order in 0..3 {
        let share = values[order] / bounds[order].endpoints()[1];
        assert!(share <= 1.0 + 1e-12, "derivative {}: {share}", order + 1);
        largest[order] = largest[order].max(share);
    }
}

#[test]
fn derivatives_of_a_direction_and_of_its_half_turn_are_bounded_sharply() {
    let (mut direction, mut half_turn) = ([0.0; 3], [0.0; 3]);
    for step in 1..1000 {
        // The angle of an affine path is Im log(1 + z t), here with |z| = 1.
        let (sin, cos) = (f64::from(step) * std::f64::consts::PI / 1000.0).sin_cos();
        let angle = [
            sin,
            -2.0 * sin * cos,
            2.0 * sin * (3.0 * cos * cos - sin * sin),
        ];
        let moving = MovingVector {
            rates: [[exact(sin), exact(1.0)]; 2],
            ..MovingVector::constant(RealVector::exact(DVec3::X))
        };
        share(of_turn(angle), moving.derivatives(0), &mut direction);
        let twice = angle.map(|it| 2.0 * it);
        share(of_turn(twice), moving.half_turn(1), &mut half_turn);
    }
    for sharp in direction.into_iter().chain(half_turn) {
        assert!(sharp > 0.9, "{direction:?}, {half_turn:?}");
    }
}

#[test]
fn derivatives_of_a_product_are_those_of_exponentials() {
    let powers = |rate: f64| [1, 2, 3].map(|order| exact(rate.powi(order)));
    let found = product(powers(0.5), powers(0.25));
    assert_eq!(found, powers(0.75));
}

#[test]
fn a_cubic_errs_by_all_of_the_bound() {
    // x (x^2 - 3/4) is 1/4 at x = 1, and its third derivative is 6.
    let [zero, six] = [0.0, 6.0].map(exact);
    for third in [[six, zero], [zero, six]] {
        let [least, most] = interpolation_error(third).endpoints();
        assert!(least <= 0.25 && (0.25..0.250_001).contains(&most));
    }
}

#[test]
fn a_vector_may_turn_faster_at_a_corner_than_in_the_middle() {
    // (1 + a x, b y) moves straight ahead on the middle row.
    let [a, b] = [0.01, 0.02];
    let at = |x, y| RealVector::exact(DVec3::new(x, y, 0.0));
    let places = [at(1.0, 0.0), at(1.0 + a, 0.0), at(1.0, b)];
    let moving = MovingVector::new(at(1.0, 0.0), places).expect("it does not vanish");
    let rate = a * b / ((1.0 - a).powi(2) + b * b);
    let ahead = rate / moving.rates[0][0].endpoints()[1];
    let turn = (b / (1.0 - a)).atan() / moving.turn.endpoints()[1];
    assert!((0.9..=1.0).contains(&ahead), "{ahead}");
    assert!((0.9..=1.0).contains(&turn), "{turn}");
}

#[test]
fn a_sample_errs_by_half_its_width_and_interpolation_amplifies_that() {
    let signs = [1.0, -1.0, 1.0];
    let samples = |of: fn(f64) -> [f64; 2]| signs.map(|row| signs.map(|it| of(it * row)));
    let (coefficients, rounding) = polynomial(samples(|sign| [sign, sign]));
    let corner: f64 = coefficients.as_flattened().iter().sum();
    let (_, error) = polynomial(samples(|_| [-1.0, 1.0]));
    // The function that is -1 at the corner and has these samples.
    let any = any_error(exact(1.0)).endpoints()[1];
    for (bound, known) in [(rounding, 0.0), (error, corner), (any, corner + 1.0)] {
        assert!((bound - known).abs() < 1e-9, "{bound} {known}");
    }
}

/// A vector in the plane of x and y.
fn towards(angle: f64) -> DVec3 {
    DVec3::new(angle.cos(), angle.sin(), 0.0)
}

/// The vector of length one at an angle that changes along an axis, from the middle of the square to its side, by `change`.
fn moving(angle: f64, change: DVec3, axis: usize) -> MovingVector {
    let middle = towards(angle);
    let mut places = [middle; 3];
    places[1 + axis] += change;
    MovingVector::new(RealVector::exact(middle), places.map(RealVector::exact))
        .expect("it does not vanish")
}

/// n, l or o moves, and the other two rest; all lie in one plane.
struct Movement {
    /// The angles of n, l and o.
    angles: [f64; 3],
    mover: usize,
    /// The mover is 1 + z x times itself, with z = q e^(i alpha).
    q: f64,
    alpha: f64,
}

impl Movement {
    /// The bound by `of` for a movement along an axis.
    fn bound(&self, axis: usize, of: impl Fn(&Directions) -> Interval) -> f64 {
        let vectors = [0, 1, 2].map(|index| {
            let angle = self.angles[index];
            let change = self.q * towards(angle + self.alpha);
            let is_mover = index == self.mover;
            moving(angle, if is_mover { change } else { DVec3::ZERO }, axis)
        });
        let [normal, to_light, to_eye] = &vectors;
        let directions = Directions {
            normal,
            to_light,
            to_eye,
        };
        of(&directions).endpoints()[1]
    }

    /// The angle by which the mover has turned at x, and its first three derivatives.
    fn turn(&self, x: f64) -> [f64; 4] {
        // z / (1 + z x), whose powers are the derivatives.
        let [real, imaginary] = [self.alpha.cos(), self.alpha.sin()].map(|it| self.q * it);
        let turn = (x * imaginary).atan2(1.0 + x * real);
        let size = self.q / (1.0 + x * real).hypot(x * imaginary);
        let of_power =
            |power: i32| size.powi(power) * (f64::from(power) * (self.alpha - turn)).sin();
        [turn, of_power(1), -of_power(2), 2.0 * of_power(3)]
    }
}

/// The third derivative of cos(f)^rho, from f and its derivatives.
fn third_of_power([f, a, b, c]: [f64; 4], rho: f64) -> f64 {
    let (sin, s) = f.sin_cos();
    let first = -sin * a;
    let second = -s * a * a - sin * b;
    let third = sin * a.powi(3) - 3.0 * s * a * b - sin * c;
    let power = |less: f64| s.powf(rho - less);
    rho * power(1.0) * third
        + rho
            * (rho - 1.0)
            * (3.0 * power(2.0) * first * second + (rho - 2.0) * power(3.0) * first.powi(3))
}

/// The largest third derivative of (o.r)^rho at three places, as a share of its bound. `theta` is the angle from o to r in the
/// middle; it grows where sin(alpha) > 0.
fn share_of_highlight(mover: usize, [q, alpha]: [f64; 2], rho: f64, theta: f64) -> f64 {
    // r turns by 2 n - l.
    let factor = [2.0, -1.0, -1.0][mover];
    let movement = Movement {
        angles: [0.25, 0.5, -theta],
        mover,
        q,
        alpha: alpha * f64::signum(factor),
    };
    let third = [-1.0, 0.0, 1.0].map(|x| {
        let mut angle = movement.turn(x).map(|it| factor * it);
        angle[0] += theta;
        third_of_power(angle, rho).abs()
    });
    let bounds = [0, 1].map(|axis| 24.0 * movement.bound(axis, |it| it.highlight_error(rho, true)));
    let [across, down] = bounds.map(|bound| third.into_iter().fold(0.0, f64::max) / bound);
    assert!((across - down).abs() < 1e-6);
    across
}

#[test]
fn the_third_derivative_of_a_highlight_is_bounded_sharply() {
    let across = std::f64::consts::FRAC_PI_2;
    // The parts that matter, the mover (n, l, o), q and alpha, rho, theta in the middle, and the least share.
    let table = [
        ("e3 with n", 0, [1e-3, 1e-3], 5.0, 0.5, 0.9),
        ("e3 with l", 1, [1e-3, 1e-3], 5.0, 0.5, 0.9),
        ("e3 with o", 2, [1e-3, 1e-3], 5.0, 0.5, 0.9),
        ("e1 e2", 2, [1e-3, 1e-2], 10.0, 0.0, 0.9),
        ("b e1^3", 2, [1e-8, across], 1e8, 1e-6, 0.9),
        ("b e2, d, e3", 2, [4e-5, 2.5e-3], 1e4, 0.1, 0.9),
        ("d at the largest s", 1, [1e-3, across], 1000.0, 0.3, 0.8),
        ("d, and n turns twice", 0, [1e-3, across], 1000.0, 0.3, 0.8),
        ("d at the least s", 2, [0.03, across], 1.2, 1.5, 0.5),
        ("b at the least s", 2, [0.03, across], 0.5, 1.5, 0.5),
        ("the turn in the sine", 2, [1e-2, across], 1e4, 0.0, 0.2),
    ];
    let shares = table.map(|(what, mover, path, rho, theta, least)| {
        let share = share_of_highlight(mover, path, rho, theta);
        (what, share, (least..=1.0).contains(&share))
    });
    assert!(shares.iter().all(|it| it.2), "{shares:?}");
}

#[test]
fn the_third_derivative_of_a_cosine_is_bounded_sharply() {
    for mover in [0, 1] {
        let movement = Movement {
            angles: [0.0, 1.5, 0.0],
            mover,
            q: 1e-3,
            alpha: 1e-3,
        };
        let [_, first, second, third] = movement.turn(0.0);
        // The sine and the cosine of the angle between n and l.
        let [sin, cos] = [1.5_f64.sin(), 1.5_f64.cos()];
        let known = sin * (third - first.powi(3)) + 3.0 * cos * first * second;
        for axis in [0, 1] {
            let share = known.abs() / (24.0 * movement.bound(axis, |it| it.cosine_error(true)));
            assert!((0.9..=1.0).contains(&share), "{mover}, {axis}: {share}");
        }
    }
}

#[test]
fn where_light_may_begin_the_levels_at_the_ends_are_bounded() {
    // n.l is 0 in the middle, and sin(atan(0.1)) at the side.
    let across = std::f64::consts::FRAC_PI_2;
    for mover in [0, 1] {
        let movement = Movement {
            angles: [0.0, across, 0.0],
            mover,
            q: 0.1,
            alpha: across,
        };
        let most = 0.1_f64.atan().sin() * any_error(exact(1.0)).endpoints()[1];
        let share = most / movement.bound(0, |it| it.cosine_error(false));
        assert!((0.8..=1.0).contains(&share), "{mover}: {share}");
        // The highlight may be as large as one.
        let movement = Movement {
            angles: [0.0; 3],
            ..movement
        };
        let jump = movement.bound(0, |it| it.highlight_error(2.0, false));
        assert_eq!(jump, any_error(exact(1.0)).endpoints()[1]);
    }
}
