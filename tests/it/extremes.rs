//! Every extreme passes, also those that need a generator or are compared with a scene without the extreme.
//!
//! `SHADETRADE_EXTREMES=full` proves all pictures at every SIMD level of this machine, and draws the largest picture of
//! 16384 x 16384 pixels, which takes a gigabyte of memory. It needs a release build.

mod crowds;
mod same;

use fearless_simd::Level;
use rayon::prelude::*;
use serde_json::Value;
use shadetrade::extremes::{Outcome, examine, named, table, text};
use shadetrade::output::json;
use shadetrade::report::Monitor;
use shadetrade::scene::EXTREMES;
use shadetrade::simd;

fn is_full() -> bool {
    std::env::var("SHADETRADE_EXTREMES").is_ok_and(|size| size == "full")
}

fn levels() -> Vec<Level> {
    if is_full() {
        simd::NAMES.into_iter().filter_map(simd::named).collect()
    } else {
        vec![Level::new()]
    }
}

#[test]
fn every_extreme_passes() {
    for level in levels() {
        // Most of an extreme runs on one core.
        let outcomes = table();
        let outcomes = outcomes
            .par_chunks(4)
            .flat_map(|extremes| examine(extremes, level, is_full(), Monitor::NONE));
        let failed: Vec<Outcome> = outcomes.filter(|outcome| !outcome.pass).collect();
        assert!(
            failed.is_empty(),
            "{}\n{}",
            simd::name(level),
            text(&failed)
        );
    }
}

#[test]
fn every_extreme_begins_with_a_comment() {
    assert!(EXTREMES.len() > 100, "the table is whole");
    for (name, text) in EXTREMES {
        assert!(text.starts_with("# "), "{name}");
    }
}

#[test]
fn extremes_are_chosen_by_name_with_or_without_their_folder() {
    let chosen = |names: &[&str]| {
        let names: Vec<String> = names.iter().map(ToString::to_string).collect();
        named(&names).map(|extremes| extremes.iter().map(|it| it.name).collect::<Vec<_>>())
    };
    assert_eq!(
        chosen(&["eye-inside", "extremes/assignment"]).ok(),
        Some(vec!["assignment", "eye-inside"])
    );
    assert_eq!(chosen(&[]).map(|all| all.len()).ok(), Some(EXTREMES.len()));
    assert!(chosen(&["eye-inside", "eye"]).is_err());
}

#[test]
fn an_outcome_is_printed_with_its_name_expectation_observation_and_verdict() {
    let outcomes = [("four", true), ("five", false)].map(|(observed, pass)| Outcome {
        name: "two by two",
        expected: "four".to_owned(),
        observed: observed.to_owned(),
        pass,
    });
    let read: Value = serde_json::from_str(&json(&outcomes).expect("it is text")).expect("JSON");
    let five = serde_json::json!({
        "name": "two by two", "expected": "four", "observed": "five", "pass": false,
    });
    assert_eq!((read.as_array().map(Vec::len), &read[1]), (Some(2), &five));
    let table = text(&outcomes);
    for word in ["two by two", "four", "five", "pass", "FAIL", "1 of 2 pass"] {
        assert!(table.contains(word), "{word} is not in\n{table}");
    }
}
