//! The words of verdict and table, which must agree with the numbers.

use shadetrade::components::ShadingMode::{self, Gouraud, Phong};
use shadetrade::shading::Method;
use shadetrade::trade::export::table;
use shadetrade::trade::tables::WIDTH;
use shadetrade::trade::verdict::{sentence, verdict};
use shadetrade::trade::{Measurement, Report};

use super::example;
use crate::support::random::Random;

/// The milliseconds and the largest errors of Gouraud, Phong at tolerance 0.5, and exact Phong.
type Trade = [(f64, f64); 3];
/// Gouraud saves half of the time, and tolerance 0.5 saves half of it again.
const USUAL: Trade = [(0.2, 165.0), (0.46, 0.5), (1.0, 0.0)];

const NOTHING: &str = "nothing to trade";
const ALIKE: &str = "about as fast";

fn measured(trade: Trade) -> Vec<Measurement> {
    let methods = [(Gouraud, 0.5), (Phong, 0.5), (Phong, 0.0)];
    let measurement = |((mode, tolerance), (time, error))| {
        example::live(Method::of(mode, tolerance), time, error)
    };
    methods.into_iter().zip(trade).map(measurement).collect()
}

/// A trade, the method on screen, and parts of the sentence that are in it and that are not.
type Row = (
    Trade,
    (ShadingMode, f64),
    &'static [&'static str],
    &'static [&'static str],
);

#[test]
fn the_sentence_states_only_measured_facts() {
    let [gouraud, half, exact] = [(Gouraud, 0.5), (Phong, 0.5), (Phong, 0.0)];
    let rows: [Row; 11] = [
        (
            USUAL,
            gouraud,
            &["2.3 times faster", "half a level", "but off by 165"],
            &[ALIKE],
        ),
        (
            USUAL,
            half,
            &["2.3 times slower", "330 times more exact"],
            &["but", NOTHING],
        ),
        (
            USUAL,
            exact,
            &["5 times slower", "rounding", "2.2 times faster"],
            &[NOTHING],
        ),
        // Within the intervals of each other.
        (
            [(0.2, 165.0), (0.201, 0.5), (1.0, 0.0)],
            gouraud,
            &[ALIKE, "and off by 165"],
            &["times", "but"],
        ),
        // Exact Phong is as fast as Phong at tolerance 0.5, or faster.
        (
            [(0.2, 165.0), (0.46, 0.5), (0.461, 0.0)],
            gouraud,
            &["exact Phong", "2.3 times"],
            &["half"],
        ),
        (
            [(0.2, 165.0), (0.46, 0.5), (0.461, 0.0)],
            half,
            &[ALIKE, NOTHING],
            &[],
        ),
        (
            [(0.2, 165.0), (0.46, 0.5), (0.461, 0.0)],
            exact,
            &[NOTHING],
            &["2.2"],
        ),
        (
            [(0.2, 165.0), (0.46, 0.5), (0.3, 0.0)],
            half,
            &["1.5 times faster", NOTHING],
            &[],
        ),
        // An invisible error.
        (
            [(0.2, 0.31), (0.46, 0.2), (1.0, 0.0)],
            gouraud,
            &["2.3 times faster", "0.310"],
            &["but"],
        ),
        (
            [(0.2, 0.31), (0.46, 0.2), (1.0, 0.0)],
            half,
            &["2.3 times slower", "0.200"],
            &["more exact"],
        ),
        // Too short for the resolution of the clock.
        (
            [(0.0, 165.0), (0.46, 0.5), (1.0, 0.0)],
            gouraud,
            &["faster"],
            &["times", "inf", "NaN"],
        ),
    ];
    for (trade, (mode, tolerance), says, hides) in rows {
        let text = sentence(&measured(trade), Method::of(mode, tolerance)).expect("it is measured");
        for part in says {
            assert!(text.contains(part), "{part:?} is not in {text:?}");
        }
        for part in hides {
            assert!(!text.contains(part), "{part:?} is in {text:?}");
        }
    }
    assert_eq!(sentence(&measured(USUAL), Method::of(Phong, 0.7)), None);
    // Intervals that are so wide that they overlap allow no verdict.
    let mut noisy = measured(USUAL);
    for one in &mut noisy {
        one.timing.interval = [0.1, 2.0];
    }
    for one in &noisy {
        let text = sentence(&noisy, one.method).expect("it is measured");
        assert!(
            text.contains("not measurably") && !text.contains(NOTHING),
            "{text}"
        );
    }
    let mut alike = measured([(0.2, 165.0), (0.46, 0.5), (0.461, 0.0)]);
    for one in &mut alike {
        one.timing.interval = [0.1, 2.0];
    }
    for one in &alike {
        let text = sentence(&alike, one.method).expect("it is measured");
        assert!(!text.contains(NOTHING), "{text}");
    }
}

#[test]
fn times_within_noise_are_called_neither_faster_nor_slower() {
    let mut random = Random(5);
    for _ in 0..200 {
        let mut one = || {
            (
                1.0 + 0.004 * random.within(-1.0, 1.0),
                random.within(0.0, 3.0),
            )
        };
        let measured = measured([one(), one(), one()]);
        let sentences = measured
            .iter()
            .filter_map(|it| sentence(&measured, it.method));
        for text in sentences.chain([verdict(&measured)]) {
            assert!(
                !text.contains("faster") && !text.contains("slower"),
                "{text}"
            );
        }
    }
}

#[test]
fn the_verdict_states_only_measured_facts() {
    let report = |change: fn(&mut Report)| {
        let mut report = example::report();
        change(&mut report);
        let measured: Vec<Measurement> = report.methods.iter().map(Measurement::from).collect();
        verdict(&measured)
    };
    let whole = report(|_| ());
    for part in ["Gouraud", "163", "xact Phong", "unit vectors", "171"] {
        assert!(whole.contains(part), "{part:?} is not in {whole:?}");
    }
    assert!(!report(|it| drop(it.methods.remove(1))).contains("unit vectors"));
    let alone = report(|it| it.methods.truncate(1));
    assert!(
        alone.contains("163") && !alone.contains("faster"),
        "{alone:?}"
    );
    let nothing = report(|it| *it = example::empty_report());
    assert!(
        !nothing.contains("off by") && !nothing.is_empty(),
        "{nothing:?}"
    );
}

#[test]
fn the_table_has_the_figures_of_every_method() {
    let text = table(&example::report());
    for row in [
        "gouraud-0.5 0.002 0.002 to 0.002 163 0 % yes",
        "phong-unit-vectors 0.006 0.006 to 0.006 171 4 %",
        "phong-0 0.008 0.008 to 0.008 0 100 % yes",
    ] {
        let mut rows = text.lines().map(|line| line.split_whitespace());
        assert!(
            rows.any(|words| words.eq(row.split(' '))),
            "{row:?} is not in\n{text}"
        );
    }
    for part in [
        "40x30",
        "1000 covered pixels",
        "Some CPU",
        "1 thread,",
        "1/255",
    ] {
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
        ["phong-0", "0.008", "0.008", "to", "0.008", "-", "-"]
    );
}
