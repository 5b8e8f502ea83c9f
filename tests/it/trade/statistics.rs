//! Statistics of times and the front, against results computed by hand.

use shadetrade::components::ShadingMode;
use shadetrade::trade::Measurement;
use shadetrade::trade::accuracy::share_kept;
use shadetrade::trade::front::on_front;
use shadetrade::trade::timing::{Timing, median};

use super::example;

#[test]
fn the_figures_of_eleven_samples_are_those_computed_by_hand() {
    // In ascending order 1, 31, ..., 40: the sixth is 35.
    let samples = [
        40.0, 31.0, 39.0, 32.0, 1.0, 38.0, 33.0, 37.0, 34.0, 36.0, 35.0,
    ];
    let timing = Timing::of(&[samples.to_vec()]);
    assert_eq!((timing.samples, timing.median, timing.min), (11, 35.0, 1.0));
    assert_eq!(timing.raw, samples);
}

#[test]
fn the_median_is_the_middle_or_the_mean_of_the_middle_two() {
    assert_eq!(median(&[4.0, 1.0, 2.0, 7.0]), 3.0);
    assert_eq!(median(&[7.0, 1.0, 2.0]), 2.0);
    assert_eq!(median(&[5.0]), 5.0);
}

#[test]
fn the_figures_of_one_sample_are_that_sample() {
    let timing = Timing::of(&[vec![5.0]]);
    assert_eq!([timing.median, timing.min], [5.0, 5.0]);
    assert_eq!(timing.interval, [5.0, 5.0]);
}

#[test]
fn the_interval_spans_the_medians_of_the_batches_not_the_samples() {
    let timing = Timing::of(&[
        vec![1.0, 10.0, 99.0],
        vec![12.0, 2.0, 88.0],
        vec![11.0, 11.0, 11.0],
    ]);
    assert_eq!(timing.interval, [10.0, 12.0]);
    assert_eq!(timing.median, 11.0);
}

#[test]
fn times_differ_only_if_their_intervals_do_not_overlap() {
    let [ten, nearly, eleven] = [10.0, 10.09, 11.0].map(example::timing);
    assert!(ten.is_measurably_less_than(&eleven));
    assert!(!eleven.is_measurably_less_than(&ten));
    assert!(!ten.is_measurably_less_than(&nearly) && !nearly.is_measurably_less_than(&ten));
}

/// A method with this largest error and this time.
fn measurement((error, time): (f64, f64)) -> Measurement {
    let method = ("", ShadingMode::Phong, 0.0);
    Measurement::from(&example::measurement(
        method,
        time,
        [error, 0.0],
        None,
        false,
    ))
}

/// The front of methods, given as (error, time).
fn front(methods: &[(f64, f64)]) -> Vec<bool> {
    let methods: Vec<_> = methods.iter().copied().map(measurement).collect();
    on_front(&methods)
}

#[test]
fn a_method_that_is_worse_in_error_or_time_and_better_in_neither_is_not_on_the_front() {
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
fn noise_removes_nothing_from_the_front() {
    // Equal error, and times within noise: both stay.
    assert_eq!(front(&[(1.0, 10.0), (1.0, 10.05)]), [true, true]);
    // Slower within noise but more accurate: both stay.
    assert_eq!(front(&[(1.0, 10.0), (0.5, 10.05)]), [true, true]);
    // Not faster, and less accurate: it is not on the front.
    assert_eq!(front(&[(1.0, 10.0), (1.5, 10.05)]), [true, false]);
}

#[test]
fn rounding_of_the_reference_is_no_error() {
    assert_eq!(front(&[(7e-15, 1.0), (0.0, 2.0)]), [true, false]);
}

#[test]
fn without_a_cuboid_in_the_picture_there_is_no_front() {
    let mut nothing = measurement((0.0, 1.0));
    nothing.error = None;
    assert_eq!(on_front(&[nothing.clone(), nothing]), [false, false]);
    assert_eq!(on_front(&[]), [false; 0]);
}

#[test]
fn a_highlight_is_kept_by_the_share_that_is_in_its_place() {
    let whole = [[100.0, 50.0, 50.0], [0.0; 3]];
    // In displayed levels: rounded and not negative.
    let shown = [[100.4, 49.6, 50.0], [-9.0; 3]];
    assert_eq!(share_kept(&shown, &whole), Some(1.0));
    // 40 + 50 + 10 of 200: excess brightness, and light in other places, add nothing.
    assert_eq!(
        share_kept(&[[40.0, 90.0, 10.0], [200.0; 3]], &whole),
        Some(0.5)
    );
    assert_eq!(share_kept(&[[0.0; 3], [255.0; 3]], &whole), Some(0.0));
    assert_eq!(share_kept(&shown, &[[0.0; 3]; 2]), None);
}
