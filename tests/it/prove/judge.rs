//! Verdicts on one pixel from the surfaces that it may show, and the three-valued decisions of intervals.

use std::cmp::Ordering;

use shadetrade::prove::{Mark, Shown, Verdict, judge};
use shadetrade::reference::{Interval, Real, Seen};

fn interval(least: f64, largest: f64) -> Interval {
    Interval::of(least).either(Interval::of(largest))
}

/// A face or the background with the same enclosure in every channel.
fn seen(face: Option<usize>, [least, largest]: [f64; 2]) -> Seen<Interval> {
    Seen {
        triangle: face.map(|face| 2 * face),
        levels: [interval(least, largest); 3],
    }
}

fn shown(face: Option<usize>, level: f64) -> Shown {
    Shown {
        face,
        levels: [level; 3],
        bytes: None,
    }
}

fn verdict(shown: Shown, seen: &[Seen<Interval>], limit: f64) -> Verdict {
    judge(shown, seen, limit).0.verdict
}

#[test]
fn the_verdict_depends_on_whether_all_some_or_no_values_are_within_the_limit() {
    let seen = [seen(Some(3), [100.0, 101.0])];
    for (level, expected, largest) in [
        (98.0, Verdict::Refuted, 3.0),
        (98.5, Verdict::Undecided, 2.5),
        (99.0, Verdict::Undecided, 2.0),
        (99.5, Verdict::Proven, 1.5),
        (100.5, Verdict::Proven, 0.5),
        (101.5, Verdict::Proven, 1.5),
        (102.5, Verdict::Undecided, 2.5),
        (102.6, Verdict::Refuted, 2.6),
    ] {
        let (mark, error) = judge(shown(Some(3), level), &seen, 1.5);
        assert_eq!(mark.verdict, expected, "{level}");
        assert!((error - largest).abs() < 1e-12, "{level}: {error}");
        let quiet = Mark {
            verdict: expected,
            is_outline: false,
            is_covered: true,
        };
        assert_eq!(mark, quiet);
    }
}

#[test]
fn one_wrong_channel_refutes_a_pixel() {
    let seen = [seen(Some(0), [100.0, 100.0])];
    for channel in 0..3 {
        let mut shown = shown(Some(0), 100.0);
        shown.levels[channel] = 101.1;
        assert_eq!(verdict(shown, &seen, 1.0), Verdict::Refuted);
    }
}

#[test]
fn the_display_clamps_both_sides() {
    for (level, enclosure) in [
        (300.0, [256.0, 1e9]),
        (-5.0, [-1e9, 0.0]),
        (f64::INFINITY, [255.0, 400.0]),
    ] {
        let seen = [seen(Some(0), enclosure)];
        assert_eq!(verdict(shown(Some(0), level), &seen, 0.0), Verdict::Proven);
    }
    let seen = [seen(Some(0), [254.0, 300.0])];
    assert_eq!(verdict(shown(Some(0), 1e5), &seen, 0.5), Verdict::Undecided);
}

#[test]
fn nan_is_displayed_and_judged_as_0() {
    let [dark, bright] = [[0.0, 0.01], [5.0, 5.0]].map(|enclosure| [seen(Some(0), enclosure)]);
    assert_eq!(
        verdict(shown(Some(0), f64::NAN), &dark, 0.5),
        Verdict::Proven
    );
    assert_eq!(
        verdict(shown(Some(0), f64::NAN), &bright, 0.5),
        Verdict::Refuted
    );
}

#[test]
fn the_enclosure_of_all_numbers_proves_and_refutes_nothing() {
    for levels in [Interval::of(f64::NAN), Interval::ALL] {
        let seen = [Seen {
            triangle: Some(0),
            levels: [levels; 3],
        }];
        assert_eq!(
            verdict(shown(Some(0), 40.0), &seen, 8.0),
            Verdict::Undecided
        );
        // Half of the displayed range is within reach of every level of it.
        assert_eq!(
            verdict(shown(Some(0), 127.5), &seen, 127.5),
            Verdict::Proven
        );
    }
}

#[test]
fn another_face_or_none_is_refuted_with_any_levels() {
    let face = [seen(Some(3), [100.0, 100.0])];
    let background = [seen(None, [100.0, 100.0])];
    assert_eq!(
        verdict(shown(Some(2), 100.0), &face, 255.0),
        Verdict::Refuted
    );
    assert_eq!(verdict(shown(None, 100.0), &face, 255.0), Verdict::Refuted);
    assert_eq!(
        verdict(shown(Some(3), 100.0), &background, 255.0),
        Verdict::Refuted
    );
    assert_eq!(
        verdict(shown(None, 100.0), &background, 0.0),
        Verdict::Proven
    );
}

#[test]
fn an_outline_may_show_either_side_but_only_in_its_own_levels() {
    let sides = [seen(Some(3), [100.0, 100.0]), seen(None, [20.0, 20.0])];
    for (face, level, expected) in [
        (Some(3), 100.0, Verdict::Proven),
        (None, 20.0, Verdict::Proven),
        (Some(3), 20.0, Verdict::Refuted),
        (None, 100.0, Verdict::Refuted),
        (Some(4), 100.0, Verdict::Refuted),
    ] {
        let (mark, _) = judge(shown(face, level), &sides, 0.5);
        assert_eq!(mark.verdict, expected, "{face:?} {level}");
        assert!(mark.is_outline);
        assert_eq!(mark.is_covered, face.is_some());
    }
}

#[test]
fn a_tied_gate_may_be_open_or_closed_but_not_between() {
    let ways = [seen(Some(3), [100.0, 100.0]), seen(Some(3), [180.0, 180.0])];
    for (level, expected) in [
        (100.0, Verdict::Proven),
        (180.0, Verdict::Proven),
        (140.0, Verdict::Refuted),
    ] {
        let (mark, _) = judge(shown(Some(3), level), &ways, 0.5);
        assert_eq!(mark.verdict, expected, "{level}");
        assert!(!mark.is_outline);
    }
    // The wide enclosure does not refute a level outside of the narrow one.
    let ways = [seen(Some(3), [100.0, 100.0]), seen(Some(3), [0.0, 255.0])];
    assert_eq!(
        verdict(shown(Some(3), 140.0), &ways, 0.5),
        Verdict::Undecided
    );
}

#[test]
fn bytes_may_err_by_half_a_level_more() {
    let seen = [seen(Some(0), [100.5, 100.5])];
    for (byte, expected) in [
        (99, Verdict::Refuted),
        (100, Verdict::Proven),
        (101, Verdict::Proven),
        (102, Verdict::Refuted),
    ] {
        let shown = Shown {
            bytes: Some([byte; 3]),
            ..shown(Some(0), 100.5)
        };
        assert_eq!(verdict(shown, &seen, 0.25), expected, "{byte}");
    }
}

#[test]
fn a_sign_is_known_if_all_of_the_interval_has_it() {
    let signs = [
        ([1.0, 2.0], Some(Ordering::Greater)),
        ([-2.0, -1.0], Some(Ordering::Less)),
        ([0.0, 1.0], None),
        ([-1.0, 0.0], None),
        ([-1.0, 1.0], None),
        // Within the margin.
        ([0.4, 2.0], None),
        ([-2.0, -0.4], None),
        ([0.0, 0.0], None),
    ];
    for ([least, largest], expected) in signs {
        assert_eq!(interval(least, largest).sign(0.5), expected);
    }
    assert_eq!(interval(0.4, 2.0).sign(0.0), Some(Ordering::Greater));
    assert_eq!(interval(0.0, 0.0).sign(0.0), Some(Ordering::Equal));
    assert_eq!(Interval::ALL.sign(0.0), None);
}

#[test]
fn a_gate_is_open_closed_tied_or_undecided() {
    let gates = [
        ([2e-6, 1.0], [Some(true); 2]),
        ([-1.0, 0.0], [Some(false); 2]),
        ([-1e-7, 1e-7], [Some(false), Some(true)]),
        ([0.0, 0.0], [Some(false), Some(true)]),
        ([-1e-7, 1.0], [None; 2]),
        ([-1.0, 1e-7], [None; 2]),
    ];
    for ([least, largest], expected) in gates {
        let facing = interval(least, largest);
        assert_eq!([false, true].map(|tied| facing.gate(tied)), expected);
    }
    assert_eq!(Interval::ALL.gate(true), None);
}

#[test]
fn either_of_two_is_unknown_if_one_of_them_is() {
    let [one, two] = [1.0, 2.0].map(Interval::of);
    assert_eq!(one.either(two).endpoints(), [1.0, 2.0]);
    for unknown in [one.either(Interval::ALL), Interval::ALL.either(one)] {
        assert_eq!(unknown.endpoints(), [f64::NEG_INFINITY, f64::INFINITY]);
    }
    assert_eq!(
        one.both(two).endpoints(),
        [f64::NEG_INFINITY, f64::INFINITY]
    );
}
