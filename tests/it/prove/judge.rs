//! Verdicts on one pixel from the surfaces that it may show, and the three-valued decisions of intervals.

use std::cmp::Ordering;

use shadetrade::components::TriangleId;
use shadetrade::questions::prove::Verdict::{Gap, Proven, Refuted, Undecided};
use shadetrade::questions::prove::{Mark, Shown, Verdict, judge};
use shadetrade::reference::{Interval, Real, Seen};

fn interval([least, largest]: [f64; 2]) -> Interval {
    Interval::of(least).either(Interval::of(largest))
}

/// A face or the background with the same enclosure in every channel.
fn seen(face: Option<usize>, ends: [f64; 2]) -> Seen<Interval> {
    Seen {
        triangle: face.map(|face| TriangleId::of_face(face as u32, false)),
        levels: [interval(ends); 3],
        is_hidden: false,
    }
}

fn shown(face: Option<usize>, level: f64) -> Shown {
    Shown {
        face,
        levels: [level; 3],
        ..Shown::default()
    }
}

fn verdict(shown: Shown, seen: &[Seen<Interval>], limit: f64) -> Verdict {
    judge(shown, seen, limit).0.verdict
}

#[test]
fn the_verdict_depends_on_whether_all_some_or_no_values_are_within_the_limit() {
    let seen = [seen(Some(3), [100.0, 101.0])];
    for (level, expected, largest) in [
        (98.0, Refuted, 3.0),
        (98.5, Undecided, 2.5),
        (99.0, Undecided, 2.0),
        (99.5, Proven, 1.5),
        (100.5, Proven, 0.5),
        (101.5, Proven, 1.5),
        (102.5, Undecided, 2.5),
        (102.6, Refuted, 2.6),
    ] {
        let (mark, [_, error]) = judge(shown(Some(3), level), &seen, 1.5);
        assert!((error - largest).abs() < 1e-12, "{level}: {error}");
        let quiet = Mark {
            verdict: expected,
            is_outline: false,
            is_covered: true,
        };
        assert_eq!(mark, quiet, "{level}");
        // One wrong channel suffices, and NaN is displayed as 0.
        for channel in 0..3 {
            let mut one = shown(Some(3), 100.5);
            one.levels[channel] = level;
            assert_eq!(verdict(one, &seen, 1.5), expected, "{level}");
            one.levels[channel] = f64::NAN;
            assert_eq!(verdict(one, &seen, 1.5), Refuted);
        }
    }
}

#[test]
fn the_display_clamps_both_sides() {
    for (level, enclosure, limit, expected) in [
        (300.0, [256.0, 1e9], 0.0, Proven),
        (-5.0, [-1e9, 0.0], 0.0, Proven),
        (f64::NAN, [-1e9, 0.0], 0.0, Proven),
        (f64::INFINITY, [255.0, 400.0], 0.0, Proven),
        (1e5, [254.0, 300.0], 0.5, Undecided),
    ] {
        let seen = [seen(Some(0), enclosure)];
        let found = verdict(shown(Some(0), level), &seen, limit);
        assert_eq!(found, expected, "{level}");
    }
}

#[test]
fn the_enclosure_of_all_numbers_proves_and_refutes_nothing() {
    for levels in [Interval::of(f64::NAN), Interval::ALL] {
        let seen = [Seen {
            triangle: Some(TriangleId(0)),
            levels: [levels; 3],
            is_hidden: false,
        }];
        assert_eq!(verdict(shown(Some(0), 40.0), &seen, 8.0), Undecided);
        // Half of the displayed range is within reach of every level of it.
        assert_eq!(verdict(shown(Some(0), 127.5), &seen, 127.5), Proven);
    }
}

#[test]
fn a_pixel_shows_one_of_its_faces_in_the_levels_of_that_face() {
    let (face, background) = ([100.0, 100.0], [20.0, 20.0]);
    let one = [seen(Some(3), face)];
    let none = [seen(None, face)];
    let outline = [seen(Some(3), face), seen(None, background)];
    let tied = [seen(Some(3), face), seen(Some(3), [180.0, 180.0])];
    // The wide enclosure does not refute a level outside of the narrow one.
    let wide = [seen(Some(3), face), seen(Some(3), [0.0, 255.0])];
    for (seen, face, level, limit, expected) in [
        (&one[..], Some(2), 100.0, 255.0, Refuted),
        (&one, None, 100.0, 255.0, Refuted),
        (&none, Some(3), 100.0, 255.0, Refuted),
        (&none, None, 100.0, 0.0, Proven),
        (&outline, Some(3), 100.0, 0.5, Proven),
        (&outline, None, 20.0, 0.5, Proven),
        (&outline, Some(3), 20.0, 0.5, Refuted),
        (&outline, None, 100.0, 0.5, Refuted),
        (&outline, Some(4), 100.0, 0.5, Refuted),
        (&tied, Some(3), 100.0, 0.5, Proven),
        (&tied, Some(3), 180.0, 0.5, Proven),
        (&tied, Some(3), 140.0, 0.5, Refuted),
        (&wide, Some(3), 140.0, 0.5, Undecided),
    ] {
        let (mark, _) = judge(shown(face, level), seen, limit);
        assert_eq!(mark.verdict, expected, "{seen:?} {face:?} {level}");
        let [first, last] = [&seen[0], &seen[seen.len() - 1]].map(Seen::face);
        assert_eq!(mark.is_outline, first != last);
        assert_eq!(mark.is_covered, face.is_some());
    }
    let (_, [_, error]) = judge(shown(Some(4), 90.0), &outline, 0.5);
    assert!((error - 10.0).abs() < 1e-9, "{error} from the first face");
}

/// The background is hidden by two faces, one of them with an enclosure that decides nothing.
#[test]
fn a_pixel_that_shows_a_hidden_face_is_a_gap() {
    let hidden = Seen {
        is_hidden: true,
        ..seen(None, [20.0, 22.0])
    };
    let joint = [
        hidden,
        seen(Some(3), [100.0, 100.0]),
        seen(Some(8), [0.0, 255.0]),
    ];
    for (face, level, expected) in [
        (None, 21.0, Gap),
        (None, 20.0, Gap),
        (None, 30.0, Refuted),
        (Some(3), 100.0, Proven),
        (Some(3), 20.0, Refuted),
        (Some(8), 20.0, Undecided),
        (Some(4), 100.0, Refuted),
    ] {
        let (mark, _) = judge(shown(face, level), &joint, 1.5);
        assert_eq!(mark.verdict, expected, "{face:?} {level}");
        assert!(mark.is_outline, "the two faces");
        let (mark, [least, _]) = judge(shown(face, level), &joint[..2], 1.5);
        assert!(!mark.is_outline, "one face");
        let differs = face.is_none() || face == Some(3);
        assert!(
            !differs || (least - (100.0 - level)).abs() < 1e-9,
            "{least}"
        );
    }
    let bytes = |byte| Shown {
        bytes: Some([byte; 3]),
        ..shown(None, 21.0)
    };
    assert_eq!(verdict(bytes(21), &joint, 1.5), Gap);
    assert_eq!(verdict(bytes(25), &joint, 1.5), Refuted);
}

#[test]
fn bytes_may_err_by_half_a_level_more() {
    for (ends, limit, others) in [
        ([100.5, 100.5], 0.25, Refuted),
        // 99.5 is displayed as 100.
        ([100.0, 100.0], 0.5, Refuted),
        ([100.0, 101.0], 1.0, Undecided),
    ] {
        let seen = [seen(Some(0), ends)];
        for (byte, expected) in [(99, others), (100, Proven), (101, Proven), (102, others)] {
            let shown = Shown {
                bytes: Some([byte; 3]),
                ..shown(Some(0), ends[0])
            };
            assert_eq!(verdict(shown, &seen, limit), expected, "{byte}");
        }
    }
}

#[test]
fn a_sign_is_known_if_all_of_the_interval_has_it() {
    for (ends, margin, expected) in [
        ([1.0, 2.0], 0.5, Some(Ordering::Greater)),
        ([-2.0, -1.0], 0.5, Some(Ordering::Less)),
        ([0.0, 1.0], 0.5, None),
        ([-1.0, 0.0], 0.5, None),
        ([-1.0, 1.0], 0.5, None),
        // Within the margin.
        ([0.5, 2.0], 0.5, None),
        ([-2.0, -0.5], 0.5, None),
        ([0.0, 0.0], 0.5, None),
        ([0.4, 2.0], 0.0, Some(Ordering::Greater)),
        ([0.0, 0.0], 0.0, Some(Ordering::Equal)),
    ] {
        assert_eq!(interval(ends).sign(margin), expected, "{ends:?}");
    }
    assert_eq!(Interval::ALL.sign(0.0), None);
}

#[test]
fn a_gate_is_open_closed_tied_or_undecided() {
    for (ends, expected) in [
        ([2e-6, 1.0], [Some(true); 2]),
        ([-1.0, 0.0], [Some(false); 2]),
        ([-1e-7, 1e-7], [Some(false), Some(true)]),
        ([0.0, 0.0], [Some(false), Some(true)]),
        ([-1e-7, 1.0], [None; 2]),
        ([-1.0, 1e-7], [None; 2]),
    ] {
        let gate = [false, true].map(|tied| interval(ends).gate(tied));
        assert_eq!(gate, expected, "{ends:?}");
    }
    assert_eq!(Interval::ALL.gate(true), None);
}

#[test]
fn either_of_two_is_unknown_if_one_of_them_is() {
    let [one, two] = [1.0, 2.0].map(Interval::of);
    assert_eq!(one.either(two).endpoints(), [1.0, 2.0]);
    for unknown in [
        one.either(Interval::ALL),
        Interval::ALL.either(one),
        one.both(two),
    ] {
        assert_eq!(unknown.endpoints(), [f64::NEG_INFINITY, f64::INFINITY]);
    }
}
