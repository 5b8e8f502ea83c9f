//! The clock of drawn frames, and robust statistics of their times.
//!
//! A measurement consists of [`BATCHES`]. Each starts with a new frame and a new copy of the scene. In a batch the methods
//! take turns in random order, so that a slow moment of the machine affects all alike. The first frame of a turn warms caches
//! and branch predictors and is not timed.
//!
//! ```text
//! batch 1   turn 1   - C C C   - A A A   - B B B        - is not timed
//!           turn 2   - B B B   - C C C   - A A A   ...
//! batch 2   turn 1   ...
//! ```

use std::sync::OnceLock;
use std::time::Duration;

use serde::Serialize;
use web_time::Instant;

use crate::output::Monitor;

/// Batches of a measurement; see [`Timing::interval`].
pub const BATCHES: usize = 8;

/// The least samples of each method, however short the time: a median of fewer says little.
pub const MIN_SAMPLES: usize = 30;

/// The most samples of each method: more say nothing new.
pub const MAX_SAMPLES: usize = 9_999;

/// Statistics of the times of a frame, in milliseconds.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Timing {
    pub samples: usize,
    pub median: f64,
    /// The least and the greatest median of a batch, and a [`clock_step`] beyond.
    ///
    /// A batch's median lies below the true one with probability 1/2, so all [`BATCHES`] lie on one side of it with
    /// probability 2 / 2^8: this is the distribution-free interval of order statistics, and its confidence is 99.2 %; six
    /// batches are the fewest that give 95 %. Frames within a batch are correlated, so batches are counted, not frames (batch
    /// means; Law, Simulation Modeling and Analysis, 9.5.3).
    pub interval: [f64; 2],
    pub min: f64,
    /// All samples, in order.
    pub raw: Vec<f64>,
}

impl Timing {
    /// The statistics of the samples of these batches.
    ///
    /// # Panics
    /// If a batch is empty, or there is none.
    pub fn of(batches: &[Vec<f64>]) -> Self {
        let raw = batches.concat();
        let medians = batches.iter().map(|batch| median(batch));
        Timing {
            samples: raw.len(),
            median: median(&raw),
            interval: [
                medians.clone().fold(f64::INFINITY, f64::min),
                medians.fold(0.0, f64::max),
            ],
            min: raw.iter().copied().fold(f64::INFINITY, f64::min),
            raw,
        }
    }
}

/// The least difference that the clock shows, in milliseconds: less than a microsecond, but up to 0.1 ms in a browser.
pub fn clock_step() -> f64 {
    static STEP: OnceLock<f64> = OnceLock::new();
    *STEP.get_or_init(|| {
        let next = |_| {
            let start = Instant::now();
            let mut times = std::iter::repeat_with(|| start.elapsed());
            times.find(|time| !time.is_zero())
        };
        let step = (0..8).filter_map(next).min();
        step.unwrap_or_default().as_nanos() as f64 / 1e6
    })
}

/// The middle value, or the mean of the middle two.
///
/// # Panics
/// If there are none.
pub fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    f64::midpoint(sorted[(sorted.len() - 1) / 2], sorted[sorted.len() / 2])
}

/// The milliseconds of the frames of one batch, by method.
pub type Batch = Vec<Vec<f64>>;

/// Times `draw(0)` to `draw(methods - 1)` in one batch, for an eighth of `time`, but at least once. All batches together take
/// [`MIN_SAMPLES`] to [`MAX_SAMPLES`] of each method.
///
/// # Errors
/// The first error of `draw`, or that the work is cancelled.
pub async fn batch(
    number: usize,
    methods: usize,
    time: Duration,
    monitor: Monitor<'_>,
    mut draw: impl FnMut(usize) -> anyhow::Result<()>,
) -> anyhow::Result<Batch> {
    const FRAMES_OF_TURN: usize = MIN_SAMPLES.div_ceil(BATCHES);
    const MAX_TURNS: usize = MAX_SAMPLES / BATCHES / FRAMES_OF_TURN;
    let mut samples = vec![Vec::new(); methods];
    let mut order: Vec<usize> = (0..methods).collect();
    let mut random = fastrand::Rng::with_seed(number as u64);
    let mut timed = |method: usize| {
        monitor.check()?;
        let start = Instant::now();
        draw(method)?;
        anyhow::Ok(start.elapsed())
    };
    // Pauses do not count.
    let mut spent = Duration::ZERO;
    for turn in 1..=MAX_TURNS {
        random.shuffle(&mut order);
        for &method in &order {
            spent += timed(method)?;
            for _ in 0..FRAMES_OF_TURN {
                if monitor.rest().await {
                    spent += timed(method)?;
                }
                let time = timed(method)?;
                samples[method].push(time.as_nanos() as f64 / 1e6);
                spent += time;
            }
        }
        if spent + spent / turn as u32 > time / BATCHES as u32 {
            break;
        }
    }
    Ok(samples)
}

/// The times of all methods, batch by batch. `progress` receives the finished share, 0..=1.
///
/// # Errors
/// The first error of a batch.
pub async fn of_batches(
    batch: impl AsyncFn(usize) -> anyhow::Result<Batch>,
    progress: impl Fn(f64),
) -> anyhow::Result<Vec<Timing>> {
    let mut batches = Vec::with_capacity(BATCHES);
    for number in 0..BATCHES {
        batches.push(batch(number).await?);
        progress((number + 1) as f64 / BATCHES as f64);
    }
    let of_method = |method: usize| {
        let samples: Vec<_> = batches.iter().map(|it| it[method].clone()).collect();
        let timing = Timing::of(&samples);
        let [least, most] = timing.interval;
        let interval = [(least - clock_step()).max(0.0), most + clock_step()];
        Timing { interval, ..timing }
    };
    Ok((0..batches[0].len()).map(of_method).collect())
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;

    use anyhow::bail;

    use super::*;
    use crate::output::finished;

    #[test]
    fn methods_take_turns_in_changing_order_in_every_batch() {
        let drawn = RefCell::new(Vec::new());
        let shares = RefCell::new(Vec::new());
        let time = async |number| {
            drawn.borrow_mut().push(Vec::new());
            let draw = |method| {
                let mut batches = drawn.borrow_mut();
                batches.last_mut().expect("it was begun").push(method);
                Ok(())
            };
            batch(number, 3, Duration::ZERO, Monitor::NONE, draw).await
        };
        let timings = finished(of_batches(time, |share| shares.borrow_mut().push(share)));
        let timings = timings.expect("nothing fails");
        // Four of each of eight batches: the fewest that are at least thirty.
        let samples = timings.iter().map(|it| [it.samples, it.raw.len()]);
        assert_eq!(samples.collect::<Vec<_>>(), [[32; 2]; 3]);

        let batches = drawn.into_inner();
        assert_eq!(batches.len(), BATCHES);
        let mut first = [false; 3];
        for batch in batches {
            let turns: Vec<&[usize]> = batch.chunks(5).collect();
            assert!(turns.iter().all(|turn| turn.iter().all(|m| *m == turn[0])));
            let mut order: Vec<usize> = turns.iter().map(|turn| turn[0]).collect();
            first[order[0]] = true;
            order.sort_unstable();
            assert_eq!(order, [0, 1, 2]);
        }
        assert_eq!(first, [true; 3], "each comes first in some batch");
        let eighths = (1..=8).map(|eighth| f64::from(eighth) / 8.0);
        assert_eq!(shares.into_inner(), eighths.collect::<Vec<_>>());
    }

    #[test]
    fn the_number_of_samples_is_limited_and_the_first_error_ends_the_run() {
        let batch = async |number, methods, time, draw: fn(usize) -> anyhow::Result<()>| {
            batch(number, methods, time, Monitor::NONE, draw).await
        };
        let time = async |number| batch(number, 1, Duration::MAX, |_| Ok(())).await;
        let timings = finished(of_batches(time, |_| ())).expect("nothing fails");
        assert!((9_000..=MAX_SAMPLES).contains(&timings[0].samples));
        assert!(finished(batch(0, 2, Duration::ZERO, |_| bail!("no"))).is_err());
        assert!(finished(of_batches(async |_| bail!("no"), |_| ())).is_err());
    }

    #[test]
    fn a_batch_ends_after_at_least_half_of_its_time() {
        let begin = Instant::now();
        let time = Duration::from_millis(160);
        let frame = |_| {
            let start = Instant::now();
            while start.elapsed() < Duration::from_micros(100) {
                std::hint::spin_loop();
            }
            Ok(())
        };
        finished(batch(0, 1, time, Monitor::NONE, frame)).expect("nothing fails");
        assert!(begin.elapsed() >= time / BATCHES as u32 / 2);
    }

    #[test]
    fn the_interval_holds_the_median_of_a_skewed_distribution_at_its_confidence() {
        let mut random = fastrand::Rng::with_seed(7);
        let mut held = 0;
        let runs = 4000;
        for _ in 0..runs {
            // 1 / (1 - u): a Pareto distribution without a variance; its median is 2.
            let mut sample = || 1.0 / (1.0 - random.f64());
            let batches = [(); BATCHES].map(|()| [(); 5].map(|()| sample()).to_vec());
            let [low, high] = Timing::of(&batches).interval;
            held += i32::from((low..=high).contains(&2.0));
        }
        // 1 - 2 / 2^8 = 0.9922, and four standard errors of 0.0014.
        let share = f64::from(held) / f64::from(runs);
        assert!((share - 0.992_187_5).abs() < 0.006, "{share}");
    }
}
