//! The words of verdict and table, which must agree with the numbers.

use shadetrade::components::ShadingMode;
use shadetrade::trade::Report;
use shadetrade::trade::export::table;
use shadetrade::trade::tables::WIDTH;
use shadetrade::trade::verdict::verdict;

use super::example;

/// A measurement, parts that its verdict must contain, and parts that it must not contain.
type Row = (
    fn(&mut Report),
    &'static [&'static str],
    &'static [&'static str],
);

/// Gouraud takes 2 ns and Phong 3 ns; Gouraud errs by 163 levels and keeps nothing of the highlight.
#[test]
fn the_verdict_states_only_measured_facts() {
    let rows: [Row; 9] = [
        (|_| (), &["1.5x", "163 levels", "highlight"], &["shortcut"]),
        (
            |report| report.methods[0].accuracy.highlight_kept = Some(0.97),
            &["163 levels"],
            &["highlight"],
        ),
        (
            |report| report.methods[0].accuracy.highlight_kept = None,
            &["163 levels"],
            &["highlight"],
        ),
        // Within the intervals of both.
        (
            |report| report.methods[1].timing = example::timing(0.002_01),
            &["163 levels"],
            &["x Gouraud"],
        ),
        (
            |report| report.methods[1].timing = example::timing(0.001),
            &["0.5x"],
            &[],
        ),
        // Too short for the resolution of the clock.
        (
            |report| report.methods[0].timing = example::timing(0.0),
            &["0.003 ms"],
            &["x Gouraud"],
        ),
        (
            |report| report.methods[1].accuracy.own_error = Some(example::error(0.75)),
            &["0.750 levels"],
            &[],
        ),
        (
            |report| report.methods[0].accuracy.error.levels = Some(example::error(0.31)),
            &["0.310 levels"],
            &["highlight"],
        ),
        (|report| report.methods.truncate(1), &[], &["x ", "levels"]),
    ];
    for (change, says, hides) in rows {
        let mut report = example::report();
        report
            .methods
            .retain(|one| one.method.mode != ShadingMode::UnitVectors);
        change(&mut report);
        assert_verdict(&report, says, hides);
    }
    let shortcut = ["shortcut", "3.0x", "171 levels", "96 %"];
    assert_verdict(&example::report(), &shortcut, &[]);
    let mut report = example::empty_report();
    assert_verdict(&report, &[], &["Gouraud", "levels"]);
    report.covered_pixels = 3;
    assert_verdict(&report, &["1.5x"], &["levels", "highlight"]);
}

#[track_caller]
fn assert_verdict(report: &Report, says: &[&str], hides: &[&str]) {
    let text = verdict(report);
    for part in says {
        assert!(text.contains(part), "{part:?} is not in {text:?}");
    }
    for part in hides {
        assert!(!text.contains(part), "{part:?} is in {text:?}");
    }
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
    for part in ["40x30", "1000 covered pixels", "Some CPU", "1 thread,"] {
        assert!(text.contains(part), "{part:?} is not in\n{text}");
    }
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
