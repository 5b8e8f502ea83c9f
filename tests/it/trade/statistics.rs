//! Statistics of times and the front, against results computed by hand.

use shadetrade::components::ShadingMode;
use shadetrade::questions::trade::Measurement;
use shadetrade::questions::trade::accuracy::share_kept;
use shadetrade::questions::trade::mark_front;
use shadetrade::questions::trade::timing::{Timing, median};
use shadetrade::shading::Method;

use super::example;

#[test]
fn the_figures_of_samples_are_those_computed_by_hand() {
    // In ascending order 1, 31, ..., 40: the sixth is 35.
    let samples = [
        40.0, 31.0, 39.0, 32.0, 1.0, 38.0, 33.0, 37.0, 34.0, 36.0, 35.0,
    ];
    let timing = Timing::of(&[samples.to_vec()]);
    assert_eq!((timing.samples, timing.median, timing.min), (11, 35.0, 1.0));
    assert_eq!(timing.raw, samples);
    // The interval spans the medians of the batches, not the samples.
    let timing = Timing::of(&[
        vec![1.0, 10.0, 99.0],
        vec![12.0, 2.0, 88.0],
        vec![11.0, 11.0, 11.0],
    ]);
    assert_eq!((timing.interval, timing.median), ([10.0, 12.0], 11.0));
    assert_eq!(median(&[4.0, 1.0, 2.0, 7.0]), 3.0);
    assert_eq!(median(&[5.0]), 5.0);
}

#[test]
fn the_front_has_the_methods_that_no_other_one_beats_beyond_noise() {
    // Error and time of each method, and whether it is on the front.
    for methods in [
        &[
            (160.0, 1.0, true),
            (4.0, 2.0, true),
            (5.0, 3.0, false),
            (4.0, 2.5, false),
            (0.0, 8.0, true),
            (0.1, 8.0, false),
        ][..],
        // Of equal errors the faster stays, even where times are within noise: a budget needs one of them.
        &[(165.0, 0.2, true), (165.0, 0.322, false)],
        &[(1.0, 10.0, true), (1.0, 10.05, false)],
        // So of errors that read the same.
        &[
            (165.3, 0.2, true),
            (165.2, 0.322, false),
            (0.001, 9.0, true),
        ],
        &[(2.0, 10.0, false), (1.0, 10.0, true), (1.0, 10.0, false)],
        // Slower within noise but more accurate: both stay.
        &[(1.0, 10.0, true), (0.5, 10.05, true)],
        // Not faster, and less accurate.
        &[(1.0, 10.0, true), (1.5, 10.05, false)],
        // The rounding of the reference is no error.
        &[(7e-15, 1.0, true), (0.0, 2.0, false)],
        &[],
    ] {
        let method = Method::of(ShadingMode::Phong, 0.0);
        let measured = methods.iter().map(|it| example::live(method, it.1, it.0));
        let mut measured: Vec<_> = measured.collect();
        let front = |measured: &mut [Measurement]| {
            mark_front(measured);
            measured.iter().map(|it| it.on_front).collect::<Vec<_>>()
        };
        let expected: Vec<bool> = methods.iter().map(|it| it.2).collect();
        assert_eq!(front(&mut measured), expected, "{methods:?}");
        // Without a cuboid in the picture there is no front.
        for one in &mut measured {
            one.error = None;
        }
        assert!(!front(&mut measured).contains(&true));
    }
}

#[test]
fn a_highlight_is_kept_by_the_share_that_is_in_its_place() {
    let whole = [[100.0, 50.0, 50.0], [0.0; 3]];
    for (shown, whole, expected) in [
        // Displayed levels are rounded and not negative.
        ([[100.4, 49.6, 50.0], [-9.0; 3]], whole, Some(1.0)),
        // 40 + 50 + 10 of 200: excess brightness, and light in other places, add nothing.
        ([[40.0, 90.0, 10.0], [200.0; 3]], whole, Some(0.5)),
        ([[0.0; 3], [255.0; 3]], whole, Some(0.0)),
        ([[100.0; 3]; 2], [[0.0; 3]; 2], None),
    ] {
        assert_eq!(share_kept(shown.into_iter(), &whole), expected, "{shown:?}");
    }
}
