//! The stability charts: f32 leaves its limit where paper predicts, the renderer never does, and all outputs agree.

use std::sync::LazyLock;

use fearless_simd::Level;
use serde::Deserialize;
use shadetrade::extremes::stability::curve::{Curve, EVALUATIONS, table};
use shadetrade::extremes::stability::{measure, sweeps::SWEEPS};
use shadetrade::output::json;
use shadetrade::prove::Verdict;
use shadetrade::report::Monitor;

static CURVES: LazyLock<Vec<Curve>> = LazyLock::new(|| {
    measure(SWEEPS, Level::new(), Monitor::NONE).expect("every value makes a scene")
});

fn of(evaluation: &str) -> impl Iterator<Item = &'static Curve> {
    CURVES
        .iter()
        .filter(move |curve| curve.evaluation == evaluation)
}

/// The verdicts on an evaluation for values of a number in this range.
fn verdicts(evaluation: &str, number: &str, [from, to]: [f64; 2]) -> Vec<Verdict> {
    let curve = of(evaluation)
        .find(|curve| curve.number == number)
        .unwrap_or_else(|| panic!("{number} is swept"));
    let points = curve.points.iter();
    let within = points.filter(|point| (from..=to).contains(&point.value));
    within.map(|point| point.verdict).collect()
}

#[track_caller]
fn assert_all(verdict: Verdict, evaluation: &str, number: &str, ends: [f64; 2]) {
    let found = verdicts(evaluation, number, ends);
    assert!(!found.is_empty(), "{number} has values in {ends:?}");
    assert!(
        found.iter().all(|other| *other == verdict),
        "{evaluation}, {number} in {ends:?}: {found:?}"
    );
}

#[test]
fn the_renderer_keeps_its_limit_wherever_f64_can_decide() {
    for evaluation in ["phong-0", "phong-0.5"] {
        for curve in of(evaluation) {
            // At this distance of the eye f64 cannot tell where a line of sight hits.
            let most = if curve.number == "distance of the eye" {
                1e10
            } else {
                f64::INFINITY
            };
            assert_all(Verdict::Proven, evaluation, curve.number, [0.0, most]);
        }
    }
}

#[test]
fn the_textbook_in_f32_is_right_for_ordinary_numbers() {
    for (number, ends) in [
        ("shininess", [1e-3, 30.0]),
        ("edge length", [0.1, 1e3]),
        ("aspect of a face", [1.0, 10.0]),
        ("distance from the origin", [1.0, 10.0]),
        ("distance of the eye", [3.0, 30.0]),
        ("height of a light over a face", [1.0, 100.0]),
        ("intensity", [1.0, 100.0]),
        ("number of lights", [1.0, 1e3]),
    ] {
        assert_all(Verdict::Proven, "textbook-f32", number, ends);
    }
}

/// f32 has 24 bits, and a range from 1e-45 to 3e38.
#[test]
fn the_textbook_in_f32_fails_where_paper_predicts() {
    for (number, ends) in [
        // The last place of 1e7 in f32 is one world unit.
        ("distance from the origin", [1e7, 1e15]),
        // The square of a length overflows.
        ("edge length", [1e20, 1e97]),
        // The square of a length underflows to 0.
        ("edge length", [1e-97, 1e-24]),
        // The slope of the power is rho, and s has an error of 6e-8.
        ("shininess", [1e6, 1e6]),
    ] {
        assert_all(Verdict::Refuted, "textbook-f32", number, ends);
    }
}

/// A curve in JSON.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Read {
    number: String,
    unit: String,
    evaluation: String,
    limit: f64,
    keeps: Option<[f64; 2]>,
    points: Vec<ReadPoint>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ReadPoint {
    value: f64,
    error: [f64; 2],
    verdict: String,
}

#[test]
fn json_holds_every_point() {
    let text = json(&*CURVES).expect("it is text");
    let read: Vec<Read> = serde_json::from_str(&text).expect("it holds curves");
    assert_eq!(read.len(), CURVES.len());
    for (read, curve) in read.iter().zip(CURVES.iter()) {
        let names = [&read.number, &read.unit, &read.evaluation];
        assert_eq!(names, [curve.number, curve.unit, curve.evaluation]);
        assert_eq!((read.limit, read.keeps), (curve.limit, curve.keeps));
        assert_eq!(read.points.len(), curve.points.len());
        for (read, point) in read.points.iter().zip(&curve.points) {
            assert_eq!((read.value, read.error), (point.value, point.error));
            assert_eq!(read.verdict, format!("{:?}", point.verdict).to_lowercase());
        }
    }
}

/// The range has only proven points, and no longer run of points has.
#[test]
fn the_kept_range_is_the_longest_run_of_proven_points() {
    for curve in CURVES.iter() {
        let is_proven = |range: &[f64; 2]| {
            let points = curve.points.iter();
            let mut within = points.filter(|it| (range[0]..=range[1]).contains(&it.value));
            within.all(|point| point.error[1] <= curve.limit)
        };
        let kept = curve.keeps.inspect(|kept| assert!(is_proven(kept)));
        let kept = kept.map_or(0, |kept| {
            let within = curve.points.iter();
            within
                .filter(|it| (kept[0]..=kept[1]).contains(&it.value))
                .count()
        });
        for run in curve.points.windows(kept + 1) {
            assert!(
                !is_proven(&[run[0].value, run[kept].value]),
                "{}",
                curve.number
            );
        }
    }
}

#[test]
fn the_table_has_a_row_for_each_number_and_a_column_for_each_evaluation() {
    let text = table(&CURVES);
    for sweep in SWEEPS {
        let row = text
            .lines()
            .find(|line| line.trim_start().starts_with(sweep.number));
        assert!(row.is_some(), "{} is not in\n{text}", sweep.number);
    }
    for (id, _) in EVALUATIONS {
        assert!(text.contains(id));
    }
}
