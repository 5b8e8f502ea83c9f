//! Every extreme of the table gives the picture it ought to.
//!
//! `SHADETRADE_EXTREMES=full` draws the largest pictures at their full size, as `shadetrade extremes` does: 16384 x 16384
//! pixels take a gigabyte, and a release build.

use fearless_simd::Level;
use shadetrade::extremes::{Options, Outcome, examine, text};
use shadetrade::simd;

#[track_caller]
fn assert_all_pass(level: Level, threads: usize) {
    let options = Options {
        level,
        threads,
        full: std::env::var("SHADETRADE_EXTREMES").is_ok_and(|size| size == "full"),
    };
    let outcomes = examine(options, &|_| ()).expect("the system gives threads");
    assert!(outcomes.len() > 80, "the table is whole");
    let failed: Vec<Outcome> = outcomes
        .into_iter()
        .filter(|outcome| !outcome.pass)
        .collect();
    assert!(failed.is_empty(), "{}", text(&failed));
}

#[test]
fn every_extreme_passes_with_the_best_instructions_of_this_machine() {
    assert_all_pass(Level::new(), 2);
}

#[test]
fn every_extreme_passes_without_simd() {
    let fallback = simd::named("fallback").expect("every machine has it");
    assert_all_pass(fallback, 1);
}
