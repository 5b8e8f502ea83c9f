//! The bounds on derivatives, against derivatives that are known.

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
