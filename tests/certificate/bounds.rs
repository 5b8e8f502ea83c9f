//! What the certificates are made of, against paper.

use glam::DVec3;
use shadetrade::shading::affine::{Affine, Scalar};
use shadetrade::shading::certificate::{
    Color, MOST_SWING, angle, cosine_remainder, exponential, positive_part, quotient, rate,
};
use shadetrade::shading::series::{Cubic, Quadratic};

use crate::random::Random;

#[test]
fn a_product_of_quadratics_is_that_of_paper_to_second_order() {
    // xy: 2 * 31 + 3 * 23 + 5 * 19 + 11 * 17.
    let product = Quadratic([2.0, 3.0, 5.0, 7.0, 11.0, 13.0])
        .times(&Quadratic([17.0, 19.0, 23.0, 29.0, 31.0, 37.0]));
    assert_eq!(product, Quadratic([34.0, 89.0, 131.0, 234.0, 413.0, 410.0]));
}

#[test]
fn a_product_of_cubic_series_is_that_of_paper_to_third_order() {
    // x^2 y: 2 * 61 + 3 * 47 + 5 * 43 + 7 * 41 + 11 * 37 + 19 * 31.
    let product = Cubic([2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0, 23.0, 29.0]).times(&Cubic([
        31.0, 37.0, 41.0, 43.0, 47.0, 53.0, 59.0, 61.0, 67.0, 71.0,
    ]));
    let expected = [
        62.0, 167.0, 237.0, 414.0, 743.0, 714.0, 1033.0, 1761.0, 2173.0, 1839.0,
    ];
    assert_eq!(product, Cubic(expected));
}

#[test]
fn the_reaches_of_a_cubic_series_and_what_economizing_it_costs_are_those_of_paper() {
    let series = Cubic([0.0, 1.0, -2.0, 3.0, -4.0, 5.0, -6.0, 7.0, -8.0, 9.0]);
    let half = [2.0, 3.0];
    // 2 + 2 * 3; 3 * 4 + 4 * 6 + 5 * 9; 6 * 8 + 7 * 12 + 8 * 18 + 9 * 27.
    assert_eq!(series.reaches(half), [8.0, 81.0, 519.0]);
    // x: 1 - 6 * 3 / 4 * 4 - 8 / 2 * 9; y: -2 + 9 * 3 / 4 * 9 + 7 / 2 * 4; lost: 6 * 8 / 4 + 7 * 12 / 2 + 8 * 18 / 2 + 9 * 27 / 4.
    let (quadratic, lost) = series.economized(half);
    assert_eq!(quadratic, Quadratic([0.0, -53.0, 72.75, 3.0, -4.0, 5.0]));
    assert_eq!(lost, 186.75);
}

#[test]
fn a_vector_moves_as_far_as_to_a_corner_of_its_tile() {
    let vector = |dx: [f64; 3], dy: [f64; 3]| Affine {
        centre: DVec3::ONE,
        dx: dx.into(),
        dy: dy.into(),
    };
    // (3, 4, 0) and, along one line, 2 and -3.
    assert_eq!(
        vector([1.0, 0.0, 0.0], [0.0, 2.0, 0.0]).reach([3.0, 2.0]),
        5.0
    );
    assert_eq!(
        vector([1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]).reach([2.0, 3.0]),
        5.0
    );
}

#[test]
fn the_bound_of_the_exponential_is_above_it_and_near() {
    for step in -640..640 {
        let x = f64::from(step) / 10.0;
        let bound = exponential(x);
        // Rounding may take 64 roundings off.
        assert!(bound >= x.exp() * (1.0 - 1e-13), "{x}");
        assert!(x.abs() > 8.0 || bound < 1.8 * x.exp(), "{x}");
    }
    assert_eq!(exponential(0.0), 1.0);
    assert_eq!(exponential(64.0), f64::INFINITY);
    assert_eq!(exponential(100.0), f64::INFINITY);
    assert_eq!(exponential(f64::NAN), f64::INFINITY);
}

#[test]
fn a_direction_turns_no_faster_than_its_swing_over_what_may_be_left_of_its_length() {
    assert_eq!([0.0, 0.25, 0.4].map(rate), [0.0, 0.25 / 0.75, 0.4 / 0.6]);
    assert_eq!(rate(MOST_SWING), f64::INFINITY);
    assert_eq!(rate(f64::NAN), f64::INFINITY);
}

#[test]
fn the_remainder_of_a_cosine_is_a_sixth_of_its_third_derivative() {
    // (3 * 8 + 2 sqrt 3 * 4 * 3 + 2 sqrt 3 * 2 * 9 + 3 * 27) / 6 for rates 2 and 3.
    let expected = (105.0 + 60.0 * 3.0_f64.sqrt()) / 6.0;
    assert!((cosine_remainder(2.0, 3.0) - expected).abs() < 1e-12);
    assert_eq!(cosine_remainder(1.0, 0.0), 0.5);
    assert_eq!(cosine_remainder(0.0, 1.0), 0.5);
}

#[test]
fn the_angle_of_a_swing_is_bounded_from_above_and_closely() {
    for step in 1..500 {
        let swing = f64::from(step) * 1e-3;
        let share = angle(swing) / swing.asin();
        assert!((1.0..1.048).contains(&share), "{swing}: {share}");
    }
    assert_eq!(angle(MOST_SWING), f64::INFINITY);
    assert_eq!(angle(f64::NAN), f64::INFINITY);
}

#[test]
fn a_quotient_of_affine_functions_is_the_quadratic_of_paper_within_the_bound_of_paper() {
    let colors = Affine {
        centre: DVec3::new(8.0, 16.0, 0.0),
        dx: DVec3::new(1.0, 1.0, 2.0),
        dy: DVec3::new(0.5, 2.0, -1.0),
    };
    let total = Scalar {
        centre: 1.0,
        dx: 0.0625,
        dy: -0.125,
    };
    // kappa is (1 - 8 / 16, 0.5 + 8 / 8), (0, 4) and (2, -1); e reaches 2 / 16 + 1 / 8 = 1 / 4 and kappa.d 5, of which
    // (1 / 4)^2 / (1 - 1 / 4) may be lost.
    let (color, bound) = quotient(&colors, &total, [2.0, 1.0]);
    let expected = [
        Quadratic([8.0, 0.5, 1.5, -0.03125, -0.03125, 0.1875]),
        Quadratic([16.0, 0.0, 4.0, 0.0, -0.25, 0.5]),
        Quadratic([0.0, 2.0, -1.0, -0.125, 0.3125, -0.125]),
    ];
    assert_eq!(color, Color(expected));
    assert!((bound - 5.0 / 12.0).abs() < 1e-15, "{bound}");
    // Where e reaches a half nothing is certified.
    for half in [[4.0, 2.0], [9.0, 2.0]] {
        assert_eq!(quotient(&colors, &total, half).1, f64::INFINITY);
    }
}

#[test]
fn a_term_that_is_cut_off_at_zero_is_as_near_to_a_quadratic_as_is_said() {
    let half = [7.5, 4.0];
    let random = &mut Random(1);
    let mut most = 0.0_f64;
    for case in 0..300 {
        let bend = if case < 100 { 0.0 } else { 0.002 };
        let sizes = [0.1, 0.02, 0.02, bend, bend, bend];
        let c = Quadratic(sizes.map(|size| random.within(-size, size)));
        let (part, bound) = positive_part(&c, half);
        for step in 0..41 * 41 {
            let [x, y] = [f64::from(step % 41), f64::from(step / 41)];
            let place = [half[0] * (x / 20.0 - 1.0), half[1] * (y / 20.0 - 1.0)];
            let error = (part.at(place) - c.at(place).max(0.0)).abs();
            assert!(error <= bound * (1.0 + 1e-12), "{error} of {bound}: {c:?}");
            most = most.max(error / bound);
        }
    }
    assert!(most > 0.99, "the bound is attained: {most}");
}
