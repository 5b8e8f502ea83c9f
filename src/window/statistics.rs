//! Measured frames in, the figures under the panel out.

use std::collections::VecDeque;
use std::time::Duration;

use crate::frame::Counts;
use crate::shading::TileKind;

/// How many frames the median is taken of.
const FRAMES: usize = 60;

/// What the last frames have cost.
#[derive(Debug, Default)]
pub struct Statistics {
    times: VecDeque<Duration>,
    counts: Counts,
    size: [usize; 2],
}

impl Statistics {
    /// Notes a frame of `size` pixels.
    pub fn record(&mut self, time: Duration, counts: Counts, size: [usize; 2]) {
        if self.times.len() == FRAMES {
            self.times.pop_front();
        }
        self.times.push_back(time);
        self.counts = counts;
        self.size = size;
    }

    /// The median of the last 60 frames' times, of the earlier ones while there are fewer; `None` before the first.
    pub fn frame_time(&self) -> Option<Duration> {
        let mut times: Vec<_> = self.times.iter().copied().collect();
        times.sort_unstable();
        let upper = *times.get(times.len() / 2)?;
        let lower = times[(times.len() - 1) / 2];
        Some((lower + upper) / 2)
    }

    /// Pixels of the last frame that a triangle covers.
    pub fn shaded_pixels(&self) -> u64 {
        self.counts.covered_pixels
    }

    /// Tiles of the last frame, by [`crate::shading::TileKind`] in the order of its `ALL`.
    pub fn tiles(&self) -> [u64; TileKind::ALL.len()] {
        self.counts.tiles
    }

    /// Width and height of the last frame, in pixels.
    pub fn size(&self) -> [usize; 2] {
        self.size
    }
}
