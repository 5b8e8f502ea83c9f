//! The progress of long work, and the bar on standard error that shows it.

use std::fmt::Write;
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

use anyhow::{Context, ensure};
use indicatif::{HumanDuration, ProgressBar, ProgressState, ProgressStyle};
use rayon::prelude::*;

/// The error of work that is cancelled.
pub const CANCELLED: &str = "the work was cancelled";

/// The caller of long work.
#[derive(Clone, Copy)]
pub struct Monitor<'a> {
    /// Returns true once the result is not wanted any more. It is called before every row, and before every frame of `trade`.
    pub is_cancelled: &'a (dyn Fn() -> bool + Sync),
    /// Receives the present step and its finished share, 0..=1, from any thread.
    pub progress: &'a (dyn Fn(&'static str, f64) + Sync),
}

impl Monitor<'_> {
    /// A caller that waits for the result and shows no progress.
    pub const NONE: Monitor<'static> = Monitor {
        is_cancelled: &|| false,
        progress: &|_, _| (),
    };

    /// # Errors
    /// If the work is cancelled.
    pub fn check(&self) -> anyhow::Result<()> {
        ensure!(!(self.is_cancelled)(), CANCELLED);
        Ok(())
    }

    /// Does `work` for each item on rayon's current threads. Returns the results in order.
    ///
    /// `done` of `all` items of the step are finished before.
    ///
    /// # Errors
    /// An error of `work`, or that the work is cancelled.
    pub fn in_parallel<T: Send, I: IntoParallelIterator>(
        &self,
        step: &'static str,
        items: I,
        [done, all]: [usize; 2],
        work: impl Fn(I::Item) -> anyhow::Result<T> + Sync,
    ) -> anyhow::Result<Vec<T>>
    where
        I::Iter: IndexedParallelIterator,
    {
        let done = AtomicUsize::new(done);
        let one = |item| {
            self.check()?;
            let found = work(item)?;
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            (self.progress)(step, done as f64 / all as f64);
            Ok(found)
        };
        items.into_par_iter().map(one).collect()
    }
}

/// The rows of a picture in bands, from the top. Evaluated one after the other, they bound the memory of a comparison.
pub fn bands(height: usize) -> impl Iterator<Item = Range<usize>> {
    const ROWS: usize = 64;
    let starts = (0..height).step_by(ROWS);
    starts.map(move |start| start..height.min(start + ROWS))
}

/// Does `work` while a bar shows the share of its present step. The bar disappears at the end.
///
/// # Errors
/// Those of `work`.
pub fn with_bar<T>(work: impl FnOnce(Monitor) -> anyhow::Result<T>) -> anyhow::Result<T> {
    let style = ProgressStyle::with_template("{msg} {wide_bar} {percent:>3} %{left}")
        .context("the template of the progress bar is wrong")?;
    let style = style.with_key("left", |state: &ProgressState, text: &mut dyn Write| {
        // Before the first estimate it is 0.
        let left = state.eta();
        if left.as_secs() > 0 {
            // A failure would leave the bar without the time.
            let _ = write!(text, ", {:#} left", HumanDuration(left));
        }
    });
    let bar = ProgressBar::new(1000).with_style(style);
    let progress = |step, share: f64| {
        if bar.message() != step {
            bar.set_message(step);
            bar.reset();
            bar.tick();
        }
        bar.set_position((1000.0 * share) as u64);
    };
    let done = work(Monitor {
        progress: &progress,
        ..Monitor::NONE
    })?;
    bar.finish_and_clear();
    Ok(done)
}
