//! The tolerance: no pixel errs by more than it against the exact evaluation of its mode.
//!
//! `SHADETRADE_CASES` sets the number of random scenes (default 100); eighty times as many random squares are drawn.
//! The long run is 10000 in a release build, with `--nocapture` to print the share of the tolerance that was used.

mod choices;
mod derivatives;
mod overshoot;
mod scenes;
mod squares;

/// The default number of random scenes.
const SCENES: usize = 100;
