//! Every extreme of the table passes.
//!
//! `SHADETRADE_EXTREMES=full` runs the cases of `shadetrade extremes` at every SIMD level of this machine. The largest
//! picture has 16384 x 16384 pixels, which takes a gigabyte of memory and a release build.

use fearless_simd::Level;
use rayon::prelude::*;
use serde_json::{Value, json as value};
use shadetrade::extremes::{Options, Outcome, examine, table, text};
use shadetrade::simd;
use shadetrade::trade::export::json;

#[test]
fn every_extreme_passes() {
    let full = std::env::var("SHADETRADE_EXTREMES").is_ok_and(|size| size == "full");
    let levels: Vec<Level> = if full {
        simd::NAMES.into_iter().filter_map(simd::named).collect()
    } else {
        vec![Level::new()]
    };
    for level in levels {
        let options = Options {
            level,
            threads: 2,
            full,
        };
        let cases = table();
        assert!(cases.len() > 80, "the table is whole");
        // Most of a case runs on one core.
        let examined = cases.par_chunks(4).flat_map(|cases| {
            examine(cases, options, &|_, _| ()).expect("the system gives threads")
        });
        let failed: Vec<Outcome> = examined.filter(|outcome| !outcome.pass).collect();
        assert!(
            failed.is_empty(),
            "{}\n{}",
            simd::name(level),
            text(&failed)
        );
    }
}

#[test]
fn an_outcome_is_printed_with_its_name_expectation_observation_and_verdict() {
    let outcomes = [true, false].map(|pass| Outcome {
        name: "two by two",
        expected: "four".to_owned(),
        observed: if pass { "four" } else { "five" }.to_owned(),
        pass,
    });
    let parsed: Value =
        serde_json::from_str(&json(&outcomes).expect("it is text")).expect("it is JSON");
    let one = |observed, pass| value!({ "name": "two by two", "expected": "four", "observed": observed, "pass": pass });
    assert_eq!(parsed, value!([one("four", true), one("five", false)]));
    let table = text(&outcomes);
    for word in ["two by two", "four", "five", "pass", "FAIL", "1 of 2 pass"] {
        assert!(table.contains(word), "{word} is not in\n{table}");
    }
}
