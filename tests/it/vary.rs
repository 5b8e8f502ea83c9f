//! The stability charts: f32 leaves its limit where paper predicts, and the renderer never does.
//!
//! `SHADETRADE_EXTREMES=full` draws the pictures in the size of the command.

use std::sync::LazyLock;

use fearless_simd::Level;
use serde::Deserialize;
use shadetrade::extremes::stability::curve::{CurvePoint, EVALUATIONS, ErrorCurve, table};
use shadetrade::extremes::stability::{SIZE, measure, sweeps::SWEEPS};
use shadetrade::output::json;
use shadetrade::prove::Verdict::{self, Proven, Refuted};
use shadetrade::report::{Monitor, finished};

use crate::extremes::is_full;

static CURVES: LazyLock<Vec<ErrorCurve>> = LazyLock::new(|| {
    let size = if is_full() { SIZE } else { [16, 12] };
    finished(measure(size, Level::new(), Monitor::NONE)).expect("every value makes a scene")
});

/// Asserts the verdict on an evaluation for all values of a number in this range.
#[track_caller]
fn assert_all(verdict: Verdict, evaluation: &str, number: &str, [from, to]: [f64; 2]) {
    let is_chosen = |it: &&ErrorCurve| it.evaluation == evaluation && it.number == number;
    let curve = CURVES.iter().find(is_chosen).expect("it is swept");
    let within = |it: &&CurvePoint| (from..=to).contains(&it.value);
    let found: Vec<_> = curve.points.iter().filter(within).collect();
    let is_right = !found.is_empty() && found.iter().all(|it| it.verdict == verdict);
    assert!(is_right, "{evaluation}, {number}: {found:?}");
}

#[test]
fn the_renderer_keeps_its_limit_wherever_f64_can_decide() {
    for sweep in SWEEPS {
        // At this distance of the eye f64 cannot tell where a line of sight hits.
        let is_eye = sweep.number == "distance of the eye";
        let most = if is_eye { 1e10 } else { f64::INFINITY };
        for evaluation in ["phong-0", "phong-0.5"] {
            assert_all(Proven, evaluation, sweep.number, [0.0, most]);
        }
    }
}

#[test]
fn values_are_swept_in_even_steps_with_three_or_one_a_decade() {
    let sweep = |number| {
        let mut sweeps = SWEEPS.iter();
        sweeps.find(|it| it.number == number).expect("it is swept")
    };
    for (number, count) in [
        ("shininess", 28),
        ("distance of the eye", 73),
        ("edge length", 195),
    ] {
        assert_eq!(sweep(number).values().len(), count, "{number}");
    }
    // Lights follow the cuboid away from the origin.
    let [near, far] = [1.0, 1e9].map(|value| {
        let scene = sweep("distance from the origin").scene(value);
        let scene = scene.expect("it is built in");
        let centre = scene.cuboid[0].position;
        assert_eq!(centre.y, -0.5 * value);
        let lights = scene.light.into_iter();
        let places = lights.map(|it| it.position.map(|place| place.distance(centre).round()));
        places.collect::<Vec<_>>()
    });
    assert_eq!(near, far);
}

/// f32 has 24 bits, and a range from 1e-45 to 3e38.
#[test]
fn f32_is_right_for_ordinary_numbers_and_fails_where_paper_predicts() {
    for (number, ends, verdict) in [
        ("shininess", [1e-3, 30.0], Proven),
        ("edge length", [0.1, 1e3], Proven),
        ("distance from the origin", [1.0, 10.0], Proven),
        ("distance of the eye", [3.0, 30.0], Proven),
        // The last place of 1e8 in f32 is eight world units.
        ("distance from the origin", [1e8, 1e15], Refuted),
        // The square of a length overflows.
        ("edge length", [1e20, 1e97], Refuted),
        // The square of a length underflows to 0.
        ("edge length", [1e-97, 1e-24], Refuted),
        // The slope of the power is rho, and s has an error of 6e-8.
        ("shininess", [1e6, 1e6], Refuted),
    ] {
        assert_all(verdict, "textbook-f32", number, ends);
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Read {
    number: String,
    #[serde(rename = "unit")]
    _unit: String,
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

/// The range has only proven points, and no longer run of points has.
#[test]
fn the_kept_range_in_json_is_the_longest_run_of_proven_points() {
    let text = json(&*CURVES).expect("it is text");
    let curves: Vec<Read> = serde_json::from_str(&text).expect("it holds curves");
    assert_eq!(curves.len(), SWEEPS.len() * EVALUATIONS.len());
    for curve in curves {
        let mut is_proven = curve.points.iter().map(|it| it.verdict == "proven");
        let by_error = curve.points.iter().map(|it| it.error[1] <= curve.limit);
        assert!(is_proven.by_ref().eq(by_error), "{}", curve.number);
        let holds = |it: &&ReadPoint| {
            let kept = curve.keeps;
            kept.is_some_and(|[from, to]| (from..=to).contains(&it.value))
        };
        let kept: Vec<_> = curve.points.iter().filter(holds).collect();
        let what = format!("{} of {}", curve.evaluation, curve.number);
        assert!(kept.iter().all(|it| it.verdict == "proven"), "{what}");
        let mut longer = curve.points.windows(kept.len() + 1);
        let is_run = |run: &[ReadPoint]| run.iter().all(|it| it.verdict == "proven");
        assert!(!longer.any(is_run), "{what}");
    }
    let text = table(&CURVES);
    let (rows, _) = text.split_once("\n\n").expect("a table and its legend");
    let is_all = |it: &&ErrorCurve| it.points.iter().all(|it| it.verdict == Proven);
    let all = CURVES.iter().filter(is_all).count();
    assert_eq!(
        rows.split_whitespace().filter(|it| *it == "all").count(),
        all
    );
    let names = SWEEPS.iter().map(|it| it.number);
    for word in names.chain(EVALUATIONS.map(|(id, _)| id)) {
        assert!(text.contains(word), "{word} is not in\n{text}");
    }
}
