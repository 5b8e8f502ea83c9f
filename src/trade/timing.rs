//! Frames drawn by the clock in, robust statistics of their times out.
//!
//! A run has [`BATCHES`]; each starts with a new frame and a new copy of the scene, and the command `trade` has each timed
//! by a process of its own, so that what varies between runs varies between batches too. In a batch the methods take turns
//! in random order, so that a slow moment of the machine meets all alike. The first frame of a turn warms caches and branch
//! predictors and is not timed.
//!
//! ```text
//! batch 1   turn 1   - C C C   - A A A   - B B B        - is not timed
//!           turn 2   - B B B   - C C C   - A A A   ...
//! batch 2   turn 1   ...
//! ```
//!
//! Rule: two times differ only where their intervals do not overlap.

use std::time::{Duration, Instant};

use serde::Serialize;

/// Batches of a run; see [`Timing::interval`].
pub const BATCHES: usize = 8;

/// Samples of each method however much time there is: more would say nothing new.
pub const MAX_SAMPLES: usize = 9_999;

/// Statistics of the times of a frame, in milliseconds.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Timing {
    pub samples: usize,
    pub median: f64,
    /// The least and the greatest median of a batch.
    ///
    /// A batch's median lies below the true one with probability 1/2, so all [`BATCHES`] lie on one side of it with
    /// probability 2 / 2^8: this is the distribution-free interval of order statistics, and its confidence is 99.2 %; six
    /// batches are the fewest that give 95 %. Frames within a batch are correlated, so batches are counted, not frames (batch
    /// means; Law, Simulation Modeling and Analysis, 9.5.3).
    pub interval: [f64; 2],
    pub min: f64,
    /// Every sample in order.
    pub raw: Vec<f64>,
}

impl Timing {
    /// The statistics of the samples of these batches.
    ///
    /// # Panics
    /// When a batch is empty, or there is none.
    pub fn of(batches: &[Vec<f64>]) -> Self {
        let raw = batches.concat();
        let median = median(&raw);
        let medians = batches.iter().map(|batch| self::median(batch));
        Timing {
            samples: raw.len(),
            median,
            interval: [
                medians.clone().fold(f64::INFINITY, f64::min),
                medians.fold(0.0, f64::max),
            ],
            min: raw.iter().copied().fold(f64::INFINITY, f64::min),
            raw,
        }
    }

    /// Whether this is less than `other` beyond doubt.
    pub fn is_measurably_less_than(&self, other: &Timing) -> bool {
        self.interval[1] < other.interval[0]
    }
}

/// The middle value, or the mean of the middle two.
///
/// # Panics
/// When there are none.
pub fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    f64::midpoint(sorted[(sorted.len() - 1) / 2], sorted[sorted.len() / 2])
}

/// The milliseconds of the frames of one batch, by method.
pub type Batch = Vec<Vec<f64>>;

/// Times `draw(0)` to `draw(methods - 1)` in one batch: as many turns as fit into its part of `time`, but so many that all
/// batches together have at least `min_samples` and at most [`MAX_SAMPLES`] of each method.
///
/// # Errors
/// The first that `draw` gives.
pub fn batch<E>(
    number: usize,
    methods: usize,
    min_samples: usize,
    time: Duration,
    mut draw: impl FnMut(usize) -> Result<(), E>,
) -> Result<Batch, E> {
    let frames_of_turn = min_samples.div_ceil(BATCHES).max(1);
    let max_turns = (MAX_SAMPLES / BATCHES / frames_of_turn).max(1);
    let mut samples = vec![Vec::new(); methods];
    let mut order: Vec<usize> = (0..methods).collect();
    let mut random = Random(number as u64);
    let begin = Instant::now();
    for turn in 1..=max_turns {
        random.shuffle(&mut order);
        for &method in &order {
            draw(method)?;
            for _ in 0..frames_of_turn {
                let start = Instant::now();
                draw(method)?;
                samples[method].push(start.elapsed().as_nanos() as f64 / 1e6);
            }
        }
        let spent = begin.elapsed();
        if spent + spent / turn as u32 > time / BATCHES as u32 {
            break;
        }
    }
    Ok(samples)
}

/// The times of all methods, batch by batch; `on_progress` is told the share done, 0..=1.
///
/// # Errors
/// The first that a batch gives.
pub fn of_batches<E>(
    mut batch: impl FnMut(usize) -> Result<Batch, E>,
    on_progress: impl Fn(f64),
) -> Result<Vec<Timing>, E> {
    let mut by_method: Vec<Vec<Vec<f64>>> = Vec::new();
    for number in 0..BATCHES {
        let samples = batch(number)?;
        by_method.resize(samples.len(), Vec::new());
        for (batches, own) in by_method.iter_mut().zip(samples) {
            batches.push(own);
        }
        on_progress((number + 1) as f64 / BATCHES as f64);
    }
    Ok(by_method
        .iter()
        .map(|batches| Timing::of(batches))
        .collect())
}

/// The same sequence every time: SplitMix64 (Steele, Lea and Flood 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ mixed >> 31
    }

    /// Fisher and Yates's.
    fn shuffle(&mut self, list: &mut [usize]) {
        for last in (1..list.len()).rev() {
            list.swap(last, (self.next() % (last as u64 + 1)) as usize);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;
    use std::convert::Infallible;

    use super::*;

    #[test]
    fn methods_take_turns_in_changing_order_in_every_batch() {
        let drawn = RefCell::new(Vec::new());
        let shares = RefCell::new(Vec::new());
        let time = |number| {
            drawn.borrow_mut().push(Vec::new());
            batch(number, 3, 30, Duration::ZERO, |method| {
                let mut batches = drawn.borrow_mut();
                batches.last_mut().expect("it was begun").push(method);
                Ok::<_, Infallible>(())
            })
        };
        let Ok(timings) = of_batches(time, |share| shares.borrow_mut().push(share));
        assert_eq!(timings.len(), 3);
        // Four of each of eight batches: the fewest that are at least thirty.
        assert!(timings.iter().all(|timing| timing.samples == 32));
        assert!(timings.iter().all(|timing| timing.raw.len() == 32));

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
        let shares = shares.into_inner();
        assert!(shares.is_sorted() && shares.iter().all(|share| (0.0..=1.0).contains(share)));
        assert_eq!(shares.last(), Some(&1.0));
    }

    #[test]
    fn there_are_only_so_many_samples_and_the_first_error_ends_it() {
        let time = |number| batch(number, 1, 30, Duration::MAX, |_| Ok::<_, Infallible>(()));
        let Ok(timings) = of_batches(time, |_| ());
        assert!((9_000..=MAX_SAMPLES).contains(&timings[0].samples));
        assert_eq!(batch(0, 2, 30, Duration::ZERO, |_| Err("no")), Err("no"));
        assert_eq!(of_batches(|_| Err("no"), |_| ()), Err("no"));
    }

    #[test]
    fn the_interval_holds_the_median_of_a_skewed_distribution_as_often_as_it_says() {
        let mut random = Random(7);
        let mut held = 0;
        let runs = 4000;
        for _ in 0..runs {
            // 1 / (1 - u): a Pareto distribution without a variance; its median is 2.
            let mut sample = || 1.0 / (1.0 - (random.next() >> 11) as f64 / (1_u64 << 53) as f64);
            let batches: Vec<Vec<f64>> = (0..BATCHES)
                .map(|_| (0..5).map(|_| sample()).collect())
                .collect();
            let [low, high] = Timing::of(&batches).interval;
            held += i32::from((low..=high).contains(&2.0));
        }
        // 1 - 2 / 2^8 = 0.9922, and four standard errors of 0.0014.
        let share = f64::from(held) / f64::from(runs);
        assert!((share - 0.992_187_5).abs() < 0.006, "{share}");
    }
}
