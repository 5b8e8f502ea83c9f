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
    let samples = [40, 31, 39, 32, 1, 38, 33, 37, 34, 36, 35].map(f64::from);
    let timing = Timing::of(&[samples.to_vec()]);
    assert_eq!((timing.samples, timing.median, timing.min), (11, 35.0, 1.0));
    assert_eq!(timing.raw, samples);
    // The interval spans the medians of the batches, not the samples.
    let batches = [[1, 10, 99], [12, 2, 88], [11, 11, 11]];
    let timing = Timing::of(&batches.map(|it| it.map(f64::from).to_vec()));
    assert_eq!((timing.interval, timing.median), ([10.0, 12.0], 11.0));
    assert_eq!(median(&[4.0, 1.0, 2.0, 7.0]), 3.0);
    assert_eq!(median(&[5.0]), 5.0);
}

/// Error and time of each method of a trade; a star is on the front.
const FRONTS: &str = "
160 1 *, 4 2 *, 5 3, 4 2.5, 0 8 *, 0.1 8
Of equal errors the faster stays, even where times are within noise: a budget needs one of them.
165 0.2 *, 165 0.322
1 10 *, 1 10.05
So of errors that read the same.
165.3 0.2 *, 165.2 0.322, 0.001 9 *
2 10, 1 10 *, 1 10
Slower within noise but more accurate: both stay.
1 10 *, 0.5 10.05 *
Not faster, and less accurate.
1 10 *, 1.5 10.05
The rounding of the reference is no error.
7e-15 1 *, 0 2";

#[test]
fn the_front_has_the_methods_that_no_other_one_beats_beyond_noise() {
    let method = Method::of(ShadingMode::Phong, 0.0);
    let front = |measured: &mut [Measurement]| {
        mark_front(measured);
        measured.iter().map(|it| it.on_front).collect::<Vec<_>>()
    };
    assert!(front(&mut []).is_empty());
    for row in FRONTS
        .lines()
        .filter(|row| row.starts_with(char::is_numeric))
    {
        let cells = row.split(", ").map(|cell| {
            let mut numbers = cell.split(' ').map(str::parse::<f64>);
            let mut next = || numbers.next().expect("two numbers").expect("a number");
            let (error, time) = (next(), next());
            (example::live(method, time, error), cell.ends_with('*'))
        });
        let (mut measured, expected): (Vec<_>, Vec<_>) = cells.unzip();
        assert_eq!(front(&mut measured), expected, "{row}");
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
        assert_eq!(share_kept(&shown, &whole), expected, "{shown:?}");
    }
}
