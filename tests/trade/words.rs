//! What the verdict and the table say, and that they say nothing else than the numbers.

use shadetrade::components::ShadingMode;
use shadetrade::trade::Report;
use shadetrade::trade::report::table;
use shadetrade::trade::tables::WIDTH;
use shadetrade::trade::verdict::verdict;

use crate::example;

/// The example without the shortcut, changed.
fn verdict_of(change: impl FnOnce(&mut Report)) -> String {
    let mut report = example::report();
    report
        .methods
        .retain(|one| one.method.mode != ShadingMode::UnitVectors);
    change(&mut report);
    verdict(&report)
}

const GOURAUD: usize = 0;
const PHONG: usize = 1;

#[test]
fn the_verdict_says_what_phong_costs_and_gouraud_errs() {
    assert_eq!(
        verdict_of(|_| ()),
        "Phong within half a level costs 1.5x Gouraud here; Gouraud errs up to 163 levels and misses the highlight."
    );
}

#[test]
fn the_verdict_says_what_the_shortcut_does_to_the_highlight() {
    assert_eq!(
        verdict(&example::report()),
        "Phong within half a level costs 1.5x Gouraud here; Gouraud errs up to 163 levels and misses the highlight. \
         The assignment's shortcut, unit vectors interpolated and not renormalised, costs 3.0x Gouraud, errs up to 171 \
         levels and misses 96 % of the highlight."
    );
}

#[test]
fn a_highlight_that_is_kept_or_not_there_is_not_called_missed() {
    for kept in [None, Some(0.97), Some(1.0)] {
        assert_eq!(
            verdict_of(|report| report.methods[GOURAUD].accuracy.highlight_kept = kept),
            "Phong within half a level costs 1.5x Gouraud here; Gouraud errs up to 163 levels."
        );
    }
}

#[test]
fn noise_is_not_called_a_cost() {
    assert_eq!(
        verdict_of(|report| report.methods[PHONG].timing = example::timing(0.002_01)),
        "Phong within half a level costs as much as Gouraud here (no measurable difference); \
         Gouraud errs up to 163 levels and misses the highlight."
    );
}

#[test]
fn phong_may_be_the_faster_one() {
    let text = verdict_of(|report| report.methods[PHONG].timing = example::timing(0.001));
    assert!(
        text.starts_with("Phong within half a level costs 0.5x Gouraud here;"),
        "{text}"
    );
}

#[test]
fn a_time_too_short_for_the_clock_gives_no_ratio() {
    let text = verdict_of(|report| report.methods[GOURAUD].timing = example::timing(0.0));
    assert!(
        text.starts_with("Phong within half a level costs 0.003 ms here;"),
        "{text}"
    );
}

#[test]
fn a_broken_promise_is_not_called_kept() {
    let text =
        verdict_of(|report| report.methods[PHONG].accuracy.own_error = example::difference(0.75));
    assert!(
        text.starts_with("Phong, meant to stay within half a level but 0.750 levels off, costs 1.5x Gouraud here;"),
        "{text}"
    );
}

#[test]
fn gouraud_may_be_good_enough() {
    let with_error = |error| {
        verdict_of(|report| report.methods[GOURAUD].accuracy.error = example::difference(error))
    };
    assert!(
        with_error(0.31).ends_with("; Gouraud errs by 0.310 levels at most, which nobody sees.")
    );
    assert!(with_error(7e-15).ends_with("; Gouraud draws the same picture."));
}

#[test]
fn where_nothing_is_drawn_nothing_is_claimed() {
    assert_eq!(
        verdict(&example::empty_report()),
        "Nothing is drawn in this view, so there is no error to trade for time."
    );
}

#[test]
fn where_nothing_can_be_compared_nothing_is_claimed_of_errors() {
    let mut report = example::empty_report();
    report.covered_pixels = 3;
    assert_eq!(
        verdict(&report),
        "Phong within half a level costs 1.5x Gouraud here; no pixel of it can be compared with the reference."
    );
}

#[test]
fn the_table_is_the_one_that_people_read() {
    let expected = "\
Phong within half a level costs 1.5x Gouraud here; Gouraud errs up to 163 levels and misses the
highlight. The assignment's shortcut, unit vectors interpolated and not renormalised, costs 3.0x
Gouraud, errs up to 171 levels and misses 96 % of the highlight.

cuboid, camera 1, perspective, 40x30: 1000 pixels covered
Some CPU, 4 cores, avx2, 1 thread, Some OS, rustc 1.99.0, release build

method                  ms      \u{b1}   ns/px     max    RMSE     FLIP     own    kept   front
──────────────────────────────────────────────────────────────────────────────────────────
gouraud-0.5          0.002   0.5%    2.00     163    40.8    0.318   0.250     0 %     yes
phong-unit-vectors   0.006   0.5%    6.00     171    42.8    0.334       0     4 %
phong-0.5            0.003   0.5%    3.00   0.400   0.100   <0.001   0.400   100 %     yes
phong-0              0.008   0.5%    8.00       0       0        0       0   100 %     yes

Every difference in time is measurable.

ms: the median time of a whole frame, and how far off it may be. ns/px: the same for each covered
pixel. max, RMSE: error in levels of 255 against exact Phong in f64. FLIP: its mean at 67 pixels per
degree. own: largest error against the method's own definition. kept: how much of the highlight is
shown where it belongs. front: nothing beats it in error and time both.
";
    assert_eq!(table(&example::report()), expected);
}

#[test]
fn the_table_fits_its_columns_whatever_the_numbers() {
    let mut report = example::report();
    for (index, measurement) in report.methods.iter_mut().enumerate() {
        measurement.method.id = "phong-unit-vectors";
        measurement.timing = example::timing([1e-7, 0.999_9, 99.99, 12_345.6][index]);
        measurement.timing.mad = 0.5 * measurement.timing.median;
        measurement.accuracy.error = example::difference([1e-9, 0.999, 9.999, 254.9][index]);
    }
    for report in [report, example::report(), example::empty_report()] {
        let text = table(&report);
        for line in text.lines() {
            assert!(line.chars().count() <= WIDTH, "{line}");
        }
        assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
    }
}

#[test]
fn the_table_shows_a_dash_for_what_does_not_exist() {
    let text = table(&example::empty_report());
    let row = text
        .lines()
        .find(|line| line.starts_with("phong-0 "))
        .expect("there is a row of phong-0");
    let cells: Vec<&str> = row.split_whitespace().collect();
    assert_eq!(
        cells,
        ["phong-0", "0.008", "0.5%", "-", "-", "-", "-", "-", "-"]
    );
}

#[test]
fn times_that_cannot_be_told_apart_are_named() {
    let mut report = example::report();
    assert!(table(&report).contains("Every difference in time is measurable."));
    report.methods[2].timing = example::timing(0.002_01);
    assert!(table(&report).contains("No measurable difference in time: gouraud-0.5, phong-0.5."));
}
