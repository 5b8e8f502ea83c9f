//! What the verdict and the table say, and that they say nothing else than the numbers.

use shadetrade::components::ShadingMode;
use shadetrade::trade::Report;
use shadetrade::trade::export::table;
use shadetrade::trade::tables::WIDTH;
use shadetrade::trade::verdict::verdict;

use super::example;

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

#[track_caller]
fn assert_says(text: &str, parts: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "{part:?} is not in {text:?}");
    }
}

#[track_caller]
fn assert_hides(text: &str, parts: &[&str]) {
    for part in parts {
        assert!(!text.contains(part), "{part:?} is in {text:?}");
    }
}

#[test]
fn the_verdict_says_what_phong_costs_and_gouraud_errs() {
    let text = verdict_of(|_| ());
    assert_says(
        &text,
        &["1.5x Gouraud", "163 levels", "misses the highlight"],
    );
    assert_hides(&text, &["shortcut"]);
}

#[test]
fn the_verdict_says_what_the_shortcut_does_to_the_highlight() {
    let text = verdict(&example::report());
    assert_says(
        &text,
        &["shortcut", "3.0x Gouraud", "171 levels", "misses 96 %"],
    );
}

#[test]
fn a_highlight_that_is_kept_or_not_there_is_not_called_missed() {
    for kept in [None, Some(0.97), Some(1.0)] {
        let text = verdict_of(|report| report.methods[GOURAUD].accuracy.highlight_kept = kept);
        assert_says(&text, &["163 levels"]);
        assert_hides(&text, &["highlight"]);
    }
}

#[test]
fn noise_is_not_called_a_cost() {
    let text = verdict_of(|report| report.methods[PHONG].timing = example::timing(0.002_01));
    assert_says(&text, &["no measurable difference"]);
    assert_hides(&text, &["x Gouraud"]);
}

#[test]
fn phong_may_be_the_faster_one() {
    let text = verdict_of(|report| report.methods[PHONG].timing = example::timing(0.001));
    assert_says(&text, &["0.5x Gouraud"]);
}

#[test]
fn a_time_too_short_for_the_clock_gives_no_ratio() {
    let text = verdict_of(|report| report.methods[GOURAUD].timing = example::timing(0.0));
    assert_says(&text, &["costs 0.003 ms"]);
    assert_hides(&text, &["x Gouraud"]);
}

#[test]
fn a_broken_promise_is_not_called_kept() {
    let text =
        verdict_of(|report| report.methods[PHONG].accuracy.own_error = Some(example::error(0.75)));
    assert_says(&text, &["0.750 levels off"]);
}

#[test]
fn gouraud_may_be_good_enough() {
    let with_error = |error| {
        verdict_of(|report| {
            report.methods[GOURAUD].accuracy.error.levels = Some(example::error(error));
        })
    };
    assert_says(&with_error(0.31), &["0.310 levels at most"]);
    assert_says(&with_error(7e-15), &["same picture"]);
}

#[test]
fn where_nothing_is_drawn_nothing_is_claimed() {
    let text = verdict(&example::empty_report());
    assert_says(&text, &["Nothing is drawn"]);
    assert_hides(&text, &["Gouraud", "levels"]);
}

#[test]
fn where_nothing_can_be_compared_nothing_is_claimed_of_errors() {
    let mut report = example::empty_report();
    report.covered_pixels = 3;
    let text = verdict(&report);
    assert_says(&text, &["1.5x Gouraud", "no pixel"]);
    assert_hides(&text, &["levels", "highlight"]);
}

#[test]
fn where_only_some_methods_are_measured_only_they_are_compared() {
    let mut report = example::report();
    report.methods.truncate(1);
    let text = verdict(&report);
    assert_says(&text, &["not measured"]);
    assert_hides(&text, &["x Gouraud", "levels"]);
}

#[test]
fn the_table_has_the_figures_of_every_method() {
    let text = table(&example::report());
    for row in [
        &[
            "gouraud-0.5",
            "0.002",
            "0.5%",
            "2.00",
            "163",
            "40.8",
            "0.318",
            "0.250",
            "0",
            "%",
            "yes",
        ][..],
        &[
            "phong-unit-vectors",
            "0.006",
            "0.5%",
            "6.00",
            "171",
            "42.8",
            "0.334",
            "0",
            "4",
            "%",
        ],
        &[
            "phong-0", "0.008", "0.5%", "8.00", "0", "0", "0", "0", "100", "%", "yes",
        ],
    ] {
        let mut rows = text.lines().map(|line| line.split_whitespace());
        assert!(
            rows.any(|words| words.eq(row.iter().copied())),
            "{row:?} is not in\n{text}"
        );
    }
    // What was measured and where, and the stages of the last method.
    assert_says(
        &text,
        &[
            "40x30",
            "1000 covered pixels",
            "Some CPU",
            "1 thread,",
            "rasterization 0.006",
        ],
    );
}

#[test]
fn the_table_fits_its_columns_whatever_the_numbers() {
    let mut report = example::report();
    for (index, measurement) in report.methods.iter_mut().enumerate() {
        measurement.method.id = "phong-unit-vectors";
        measurement.timing = example::timing([1e-7, 0.999_9, 99.99, 12_345.6][index]);
        measurement.timing.interval[1] *= 3.0;
        measurement.accuracy.error.levels =
            Some(example::error([1e-9, 0.999, 9.999, 254.9][index]));
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
