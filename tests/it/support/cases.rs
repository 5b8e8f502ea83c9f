//! The random cases of a test.

use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, RngAlgorithm, RngSeed, TestRng, TestRunner};

/// `SHADETRADE_CASES`, or `unset` if it is not set.
pub fn cases(unset: usize) -> usize {
    std::env::var("SHADETRADE_CASES").map_or(unset, |cases| {
        cases.parse().expect("SHADETRADE_CASES is a number")
    })
}

/// The configuration of a property test of this many cases, always the same; of `SHADETRADE_CASES` new ones if it is set.
pub fn config(unset: usize) -> Config {
    let is_search = std::env::var_os("SHADETRADE_CASES").is_some();
    Config {
        cases: cases(unset) as u32,
        rng_seed: if is_search {
            RngSeed::Random
        } else {
            RngSeed::Fixed(1)
        },
        ..Config::default()
    }
}

/// The first values of a strategy, which are always the same.
pub fn values<S: Strategy>(strategy: &S, count: usize) -> impl Iterator<Item = S::Value> {
    let random = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let mut runner = TestRunner::new_with_rng(Config::default(), random);
    let values = (0..count).map(move |_| strategy.new_tree(&mut runner).expect("a value"));
    values.map(|value| value.current())
}
