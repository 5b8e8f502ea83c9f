//! The number of random cases of a test.

/// `SHADETRADE_CASES`, or `unset` if it is not set.
pub fn cases(unset: usize) -> usize {
    std::env::var("SHADETRADE_CASES").map_or(unset, |cases| {
        cases.parse().expect("SHADETRADE_CASES is a number")
    })
}
