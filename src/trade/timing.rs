//! Frames drawn by the clock in, robust statistics of their times out.
//!
//! Methods take turns, in another order every round, so that whatever slows the machine for a while slows all alike. A
//! turn is one frame off the clock, which warms caches and branch predictors, and [`FRAMES_PER_TURN`] on it.
//!
//! ```text
//! round 1   C C C C  A A A A  B B B B        the first of each turn is not timed
//! round 2   B B B B  C C C C  A A A A   ...
//! ```
//!
//! Rule: two times are told apart only where their intervals do not overlap.

use std::time::{Duration, Instant};

/// Frames on the clock each time a method's turn comes.
pub const FRAMES_PER_TURN: usize = 3;

/// Samples of each method however much time there is: more would say nothing new.
pub const MOST_SAMPLES: usize = 9_999;

/// Half of this share of its median is the least that an interval reaches to either side: where code and data happen to
/// lie in memory moves times by as much, and repeating does not average it out (Mytkowicz et al. 2009).
const INDISTINGUISHABLE: f64 = 0.01;

/// Statistics of the times of a frame, in milliseconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timing {
    /// How many frames were timed; at least 1.
    pub samples: usize,
    /// The middle one, or the mean of the middle two.
    pub median: f64,
    /// The median of the distances from the median.
    pub mad: f64,
    /// The least.
    pub min: f64,
    /// The least that at least 99 % of the samples do not exceed (nearest rank).
    pub p99: f64,
}

impl Timing {
    /// The statistics of these times.
    ///
    /// # Panics
    /// When there are none.
    pub fn of(mut times: Vec<f64>) -> Self {
        times.sort_unstable_by(f64::total_cmp);
        let median = median(&times);
        let mut distances: Vec<f64> = times.iter().map(|time| (time - median).abs()).collect();
        distances.sort_unstable_by(f64::total_cmp);
        Timing {
            samples: times.len(),
            median,
            mad: self::median(&distances),
            min: times[0],
            p99: times[(times.len() * 99).div_ceil(100) - 1],
        }
    }

    /// Where the median would lie if all were measured again: with 95 % confidence if times were normally distributed.
    ///
    /// The standard deviation is 1.4826 MAD (Rousseeuw and Croux 1993), and the standard error of a median is sqrt(pi / 2)
    /// that of a mean. The frames of one turn share the machine's mood, so turns are counted, not frames.
    pub fn interval(&self) -> [f64; 2] {
        let turns = (self.samples as f64 / FRAMES_PER_TURN as f64).max(1.0);
        let spread = 1.96 * (std::f64::consts::PI / 2.0).sqrt() * 1.4826 * self.mad / turns.sqrt();
        let reach = spread.max(INDISTINGUISHABLE / 2.0 * self.median);
        [(self.median - reach).max(0.0), self.median + reach]
    }

    /// Whether this is less than `other` beyond doubt.
    pub fn is_measurably_less_than(&self, other: &Timing) -> bool {
        self.interval()[1] < other.interval()[0]
    }
}

/// The median of times in order.
fn median(times: &[f64]) -> f64 {
    let middle = times.len() / 2;
    if times.len() % 2 == 1 {
        times[middle]
    } else {
        f64::midpoint(times[middle - 1], times[middle])
    }
}

/// Times `draw(0)` to `draw(methods - 1)` in turns, as many rounds as fit into `time`, but at least `least` samples and
/// at most [`MOST_SAMPLES`] of each; `progress` hears the share done, 0..=1.
///
/// # Errors
/// The first that `draw` gives.
pub fn in_turns<E>(
    methods: usize,
    least: usize,
    time: Duration,
    mut draw: impl FnMut(usize) -> Result<(), E>,
    progress: impl Fn(f64),
) -> Result<Vec<Timing>, E> {
    const MOST_ROUNDS: usize = MOST_SAMPLES / FRAMES_PER_TURN;
    let least_rounds = least.div_ceil(FRAMES_PER_TURN);
    for method in 0..methods {
        for _ in 0..=FRAMES_PER_TURN {
            draw(method)?;
        }
    }
    let mut times = vec![Vec::new(); methods];
    let mut order: Vec<usize> = (0..methods).collect();
    let mut random = Random(0);
    let begin = Instant::now();
    for round in 1..=MOST_ROUNDS {
        random.shuffle(&mut order);
        for &method in &order {
            draw(method)?;
            for _ in 0..FRAMES_PER_TURN {
                let start = Instant::now();
                draw(method)?;
                times[method].push(start.elapsed().as_secs_f64() * 1e3);
            }
        }
        let spent = begin.elapsed();
        let next = spent + spent / round as u32;
        if round >= least_rounds && next > time {
            break;
        }
        let share_of_time = spent.as_secs_f64() / time.as_secs_f64().max(f64::MIN_POSITIVE);
        let rounds = [least_rounds, MOST_ROUNDS].map(|rounds| round as f64 / rounds as f64);
        progress(share_of_time.max(rounds[1]).min(rounds[0]).min(1.0));
    }
    Ok(times.into_iter().map(Timing::of).collect())
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
    fn methods_take_turns_in_changing_order() {
        let drawn = RefCell::new(Vec::new());
        let shares = RefCell::new(Vec::new());
        let draw = |method| {
            drawn.borrow_mut().push(method);
            Ok::<_, Infallible>(())
        };
        let Ok(timings) = in_turns(3, 30, Duration::ZERO, draw, |share| {
            shares.borrow_mut().push(share);
        });
        assert_eq!(timings.len(), 3);
        assert!(timings.iter().all(|timing| timing.samples == 30));

        let drawn = drawn.into_inner();
        let turns: Vec<_> = drawn.chunks(FRAMES_PER_TURN + 1).collect();
        assert!(turns.iter().all(|turn| turn.iter().all(|m| *m == turn[0])));
        let order: Vec<usize> = turns.iter().map(|turn| turn[0]).collect();
        // The warm-up, and ten rounds of thirty samples.
        assert_eq!(order.len(), 3 + 3 * 10);
        assert!(
            order
                .chunks(3)
                .all(|round| (0..3).all(|m| round.contains(&m)))
        );
        assert!((0..3).all(|m| order[3..].chunks(3).any(|round| round[0] == m)));
        let shares = shares.into_inner();
        assert!(shares.is_sorted() && shares.iter().all(|share| (0.0..=1.0).contains(share)));
    }

    #[test]
    fn there_are_only_so_many_samples_and_the_first_error_ends_it() {
        let Ok(timings) = in_turns(1, 30, Duration::MAX, |_| Ok::<_, Infallible>(()), |_| ());
        assert_eq!(timings[0].samples, MOST_SAMPLES);
        assert_eq!(
            in_turns(2, 30, Duration::ZERO, |_| Err("no"), |_| ()),
            Err("no")
        );
    }
}
