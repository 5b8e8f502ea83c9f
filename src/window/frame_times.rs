//! Timed frames of what is shown in, their median and spread out.
//!
//! Rule: all frames are of one state of the window; another state starts anew.

use std::time::Duration;

use crate::frame::Counts;

/// How many warm frames are timed once the picture rests.
pub const FRAMES: usize = 9;

/// What the frames of the present state took.
#[derive(Clone, Debug, Default)]
pub struct FrameTimes {
    /// Of the picture, or of the left and the right one of a wipe between two methods.
    pub sides: [Vec<Duration>; 2],
    /// What the last frame did.
    pub counts: Counts,
    /// How many threads may draw.
    pub threads: usize,
}

/// A median and the quartiles around it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Spread {
    pub lower: Duration,
    pub median: Duration,
    pub upper: Duration,
}

impl Spread {
    /// The quartiles of these times by nearest rank; `None` where there are none.
    pub fn of(times: &[Duration]) -> Option<Self> {
        let mut times = times.to_vec();
        times.sort_unstable();
        let rank = |quarter: usize| times.get((times.len() * quarter).div_ceil(4).max(1) - 1);
        Some(Spread {
            lower: *rank(1)?,
            median: *rank(2)?,
            upper: *rank(3)?,
        })
    }
}
