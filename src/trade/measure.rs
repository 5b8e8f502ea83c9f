//! Measures methods in a view: their errors, then their times, then the methods that no other one beats.
//!
//! ```text
//! error |  o            o   on the front
//!       |     o    x    x   beaten: another method is as good in one way and better in the other
//!       |        o      x
//!       +---------------- time
//! ```
//! A method is off the front if another errs less in a median time that is no longer, or errs as much and is measurably
//! faster.

use super::accuracy;
use super::measurement::{Measurement, Request};
use super::timing::{self, Batch};
use crate::report::Monitor;
use crate::shading::Method;

/// Times the batch with this number.
pub type TimeBatch = fn(&Request, usize, Monitor) -> anyhow::Result<Batch>;

/// Measures the methods of `request`. Errors that are `known` from the same view are not computed again, and of two timings
/// the one with more samples stays.
///
/// # Errors
/// If memory or threads do not suffice, or the work is cancelled.
pub fn measure(
    request: &Request,
    known: &[Measurement],
    time_batch: TimeBatch,
    monitor: Monitor,
) -> anyhow::Result<Vec<Measurement>> {
    let of_method = |method: &Method| known.iter().find(|it| it.method == *method);
    let mut unknown = request.methods.clone();
    unknown.retain(|it| of_method(it).is_none());
    let mut errors = accuracy::errors(request, &unknown, monitor)?.into_iter();
    let timings = timing::of_batches(
        |number| time_batch(request, number, monitor),
        |share| (monitor.progress)("timing frames", share),
    )?;
    let methods = request.methods.iter();
    let measured = methods.filter_map(|it| of_method(it).cloned().or_else(|| errors.next()));
    let mut measured: Vec<Measurement> = measured.collect();
    for (one, timing) in measured.iter_mut().zip(timings) {
        if timing.samples >= one.timing.samples {
            one.timing = timing;
        }
        let covered = one.counts.covered_pixels;
        let time = one.timing.median * 1e6 / covered as f64;
        one.ns_per_covered_pixel = (covered > 0).then_some(time);
    }
    mark_front(&mut measured);
    Ok(measured)
}

/// Errors with a smaller difference, in levels, are equal. The rounding of the reference in f64 is far smaller.
const RESOLUTION: f64 = 1e-6;

/// Marks the methods on the front. A method without an error is not.
pub fn mark_front(methods: &mut [Measurement]) {
    for index in 0..methods.len() {
        let one = &methods[index];
        let is_beaten = methods.iter().any(|other| beats(other, one));
        methods[index].on_front = one.error.is_some() && !is_beaten;
    }
}

fn beats(one: &Measurement, other: &Measurement) -> bool {
    let steps = |it: &Measurement| it.largest_error().map(|error| (error / RESOLUTION).round());
    let [mine, theirs] = [one, other].map(steps);
    mine <= theirs
        && one.timing.median <= other.timing.median
        && (mine < theirs || one.timing.is_measurably_less_than(&other.timing))
}
