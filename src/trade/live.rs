//! The trade of a view while it is looked at: the time and the largest error of every method.
//!
//! Known errors are not computed again, and of two timings the one with more samples stays.

use super::measurement::{Measurement, Request, mark_front};
use super::{accuracy, batch, timing};
use crate::report::Monitor;
use crate::shading::Method;

/// Measures the methods of `request`. Some of them are already `known` from the same view.
///
/// # Errors
/// If memory or threads do not suffice, or the work is cancelled.
pub fn measure(
    request: &Request,
    known: &[Measurement],
    monitor: Monitor,
) -> anyhow::Result<Vec<Measurement>> {
    let progress = |_, share| (monitor.progress)("measuring", share / 2.0);
    let first_half = Monitor {
        progress: &progress,
        ..monitor
    };
    let of_method = |method: &Method| known.iter().find(|it| it.method == *method);
    let unknown = request.methods.iter().copied();
    let unknown = unknown.filter(|it| of_method(it).is_none()).collect();
    let mut errors = accuracy::errors(request, unknown, first_half)?.into_iter();
    let timings = timing::of_batches(
        |number| batch::time_here(request, number, monitor),
        |share| (monitor.progress)("measuring", f64::midpoint(1.0, share)),
    )?;
    let methods = request.methods.iter();
    let measured = methods.filter_map(|it| of_method(it).cloned().or_else(|| errors.next()));
    let mut measured: Vec<Measurement> = measured.collect();
    for (one, timing) in measured.iter_mut().zip(timings) {
        if timing.samples >= one.timing.samples {
            one.timing = timing;
        }
    }
    mark_front(&mut measured);
    Ok(measured)
}
