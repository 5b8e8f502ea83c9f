//! Times and the front, on numbers whose answers were computed by hand.

use shadetrade::trade::accuracy::share_kept;
use shadetrade::trade::front::{Candidate, indistinguishable, on_front};
use shadetrade::trade::timing::Timing;

use crate::example;

/// 1 ms and 31 ms, 32 ms, ..., 40 ms, out of order.
fn eleven_samples() -> Timing {
    Timing::of(vec![
        40.0, 31.0, 39.0, 32.0, 1.0, 38.0, 33.0, 37.0, 34.0, 36.0, 35.0,
    ])
}

#[test]
fn the_figures_of_eleven_samples_are_those_computed_by_hand() {
    // In order 1, 31, ..., 40: the sixth is 35; distances 0 1 1 2 2 3 3 4 4 5 34: the sixth is 3.
    let timing = eleven_samples();
    assert_eq!((timing.samples, timing.median, timing.mad), (11, 35.0, 3.0));
    // 99 % of eleven are 10.89: the eleventh.
    assert_eq!((timing.min, timing.p99), (1.0, 40.0));
}

#[test]
fn an_even_number_of_samples_has_the_mean_of_the_middle_two() {
    let timing = Timing::of(vec![4.0, 1.0, 2.0, 7.0]);
    // Distances from 3: 2, 1, 1, 4.
    assert_eq!((timing.median, timing.mad), (3.0, 1.5));
}

#[test]
fn of_a_hundred_samples_the_99th_is_the_percentile() {
    let timing = Timing::of((1..=100).rev().map(f64::from).collect());
    assert_eq!(timing.p99, 99.0);
    assert_eq!(Timing::of((1..=101).map(f64::from).collect()).p99, 100.0);
}

#[test]
fn one_sample_is_all_there_is() {
    let timing = Timing::of(vec![5.0]);
    assert_eq!(
        [timing.median, timing.mad, timing.min, timing.p99],
        [5.0, 0.0, 5.0, 5.0]
    );
}

#[test]
fn the_interval_is_that_of_the_median_over_turns_of_three() {
    // 1.96 * sqrt(pi / 2) * 1.4826 * 2 / sqrt(100) = 0.72840...
    let timing = Timing {
        samples: 300,
        median: 10.0,
        mad: 2.0,
        min: 8.0,
        p99: 20.0,
    };
    let [low, high] = timing.interval();
    assert!(
        (high - 10.728_40).abs() < 1e-5 && (low - 9.271_60).abs() < 1e-5,
        "{low} {high}"
    );
}

#[test]
fn the_interval_is_never_narrower_than_half_a_percent_to_either_side_nor_below_zero() {
    let still = Timing {
        samples: 300,
        median: 10.0,
        mad: 0.0,
        min: 10.0,
        p99: 10.0,
    };
    assert_eq!(still.interval(), [9.95, 10.05]);
    let wild = Timing {
        samples: 3,
        mad: 9.0,
        ..still
    };
    assert_eq!(wild.interval()[0], 0.0);
}

#[test]
fn times_are_told_apart_only_where_intervals_do_not_overlap() {
    let [ten, nearly, eleven] = [10.0, 10.09, 11.0].map(example::timing);
    assert!(ten.is_measurably_less_than(&eleven));
    assert!(!eleven.is_measurably_less_than(&ten));
    assert!(!ten.is_measurably_less_than(&nearly) && !nearly.is_measurably_less_than(&ten));
}

/// The front of methods given as (error, time).
fn front(methods: &[(f64, f64)]) -> Vec<bool> {
    let candidate = |(error, time): &(f64, f64)| Candidate {
        error: Some(*error),
        timing: example::timing(*time),
    };
    on_front(&methods.iter().map(candidate).collect::<Vec<_>>())
}

#[test]
fn what_is_beaten_in_both_ways_or_in_one_is_off_the_front() {
    let methods = [
        (160.0, 1.0),
        (4.0, 2.0),
        (5.0, 3.0),
        (4.0, 2.5),
        (0.0, 8.0),
        (0.1, 8.0),
    ];
    assert_eq!(front(&methods), [true, true, false, false, true, false]);
}

#[test]
fn noise_takes_nothing_off_the_front() {
    // Within noise of each other and as true: both stay.
    assert_eq!(front(&[(1.0, 10.0), (1.0, 10.05)]), [true, true]);
    // Slower by noise alone but truer: both stay.
    assert_eq!(front(&[(1.0, 10.0), (0.5, 10.05)]), [true, true]);
    // No faster, and less true: nothing to choose it for.
    assert_eq!(front(&[(1.0, 10.0), (1.5, 10.05)]), [true, false]);
}

#[test]
fn rounding_of_the_reference_is_no_error() {
    assert_eq!(front(&[(7e-15, 1.0), (0.0, 2.0)]), [true, false]);
}

#[test]
fn where_nothing_is_drawn_there_is_no_front() {
    let nothing = Candidate {
        error: None,
        timing: example::timing(1.0),
    };
    assert_eq!(on_front(&[nothing, nothing]), [false, false]);
    assert_eq!(on_front(&[]), [false; 0]);
}

#[test]
fn groups_without_measurable_difference_are_as_large_as_can_be() {
    let groups = |medians: &[f64]| {
        indistinguishable(
            &medians
                .iter()
                .map(|median| example::timing(*median))
                .collect::<Vec<_>>(),
        )
    };
    assert_eq!(groups(&[30.0, 10.0, 10.05, 20.0]), [[1, 2]]);
    // Neighbours overlap, the first and the last do not.
    assert_eq!(groups(&[10.0, 10.08, 10.16]), [[0, 1], [1, 2]]);
    assert_eq!(groups(&[10.0, 10.0, 10.0]), [[0, 1, 2]]);
    assert!(groups(&[10.0, 11.0, 12.0]).is_empty());
    assert!(groups(&[]).is_empty());
}

#[test]
fn a_highlight_is_kept_as_far_as_it_is_where_it_belongs() {
    let whole = [[100, 50, 50], [0, 0, 0]];
    assert_eq!(share_kept(&whole, &whole), Some(1.0));
    // 40 + 50 + 10 of 200: what is too bright or elsewhere adds nothing.
    assert_eq!(
        share_kept(&[[40, 90, 10], [200, 200, 200]], &whole),
        Some(0.5)
    );
    assert_eq!(share_kept(&[[0; 3], [255; 3]], &whole), Some(0.0));
    assert_eq!(share_kept(&whole, &[[0; 3]; 2]), None);
}
