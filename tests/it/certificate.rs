//! The promise of the tolerance: whatever is drawn, no pixel errs by more against the exact evaluation of its mode.
//!
//! `SHADETRADE_CASES` sets how many random scenes are drawn (default 100), and eighty times as many random squares; the
//! long run is 10000 in a release build, with `--nocapture` to see how much slack the certificates leave.

mod choices;
mod derivatives;
mod overshoot;
mod scenes;
mod squares;

/// How many random scenes are drawn where that is not set.
const SCENES: usize = 100;
