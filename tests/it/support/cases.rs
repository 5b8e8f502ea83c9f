//! How many random cases a test tries.

/// `SHADETRADE_CASES`, or so many where it is not set.
pub fn cases(unset: usize) -> usize {
    std::env::var("SHADETRADE_CASES").map_or(unset, |cases| {
        cases.parse().expect("SHADETRADE_CASES is a number")
    })
}
