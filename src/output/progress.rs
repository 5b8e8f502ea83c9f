//! Long work: its progress, the bar on standard error that shows it, and its pauses.
//!
//! Long work is an `async` function, so that one loop serves two callers. A thread calls [`finished`] and is blocked until the
//! end. A page in a browser has no threads: it polls the work, which returns after the row or the frame during which
//! [`Monitor::is_due`] became true, and goes on there when it is polled again.
//!
//! ```text
//! thread    |row row row row row row row|
//! page      |row row|window|row row|window|row row|
//! ```

use std::fmt::Write;
use std::future::poll_fn;
use std::mem;
use std::ops::Range;
use std::pin::pin;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::task::{Context as TaskContext, Poll, Waker};

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
    /// Returns true once the caller wants to do something else. `None` if it waits; then rows are distributed over threads.
    pub is_due: Option<&'a (dyn Fn() -> bool + Sync)>,
}

impl Monitor<'_> {
    /// A caller that waits for the result and shows no progress.
    pub const NONE: Monitor<'static> = Monitor {
        is_cancelled: &|| false,
        progress: &|_, _| (),
        is_due: None,
    };

    /// # Errors
    /// If the work is cancelled.
    pub fn check(&self) -> anyhow::Result<()> {
        ensure!(!(self.is_cancelled)(), CANCELLED);
        Ok(())
    }

    /// Pauses if the caller wants to do something else. Returns whether it did.
    pub async fn rest(&self) -> bool {
        let is_due = self.is_due.is_some_and(|is_due| is_due());
        if is_due {
            let mut has_paused = false;
            poll_fn(|_| {
                if mem::replace(&mut has_paused, true) {
                    Poll::Ready(())
                } else {
                    Poll::Pending
                }
            })
            .await;
        }
        is_due
    }

    /// Does `work` for each number, on rayon's current threads or with pauses between numbers. Returns the results in order.
    ///
    /// `done` of `all` numbers of the step are finished before.
    ///
    /// # Errors
    /// An error of `work`, or that the work is cancelled.
    pub async fn in_parallel<T: Send>(
        &self,
        step: &'static str,
        numbers: Range<usize>,
        [done, all]: [usize; 2],
        work: impl Fn(usize) -> anyhow::Result<T> + Sync,
    ) -> anyhow::Result<Vec<T>> {
        let done = AtomicUsize::new(done);
        let first = numbers.start;
        let found: Mutex<Vec<_>> = Mutex::new(numbers.clone().map(|_| None).collect());
        let one = |number| {
            self.check()?;
            let result = work(number)?;
            found.lock().unwrap_or_else(PoisonError::into_inner)[number - first] = Some(result);
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            (self.progress)(step, done as f64 / all as f64);
            Ok(())
        };
        if self.is_due.is_none() {
            on_threads(numbers, &one)?;
        } else {
            for number in numbers {
                one(number)?;
                self.rest().await;
            }
        }
        let found = found.into_inner().unwrap_or_else(PoisonError::into_inner);
        Ok(found.into_iter().flatten().collect())
    }
}

/// Does `work` for each number until it fails. It is compiled once, because parallel loops take long to compile.
fn on_threads(
    numbers: Range<usize>,
    work: &(dyn Fn(usize) -> anyhow::Result<()> + Sync),
) -> anyhow::Result<()> {
    numbers.into_par_iter().try_for_each(work)
}

/// The result of work whose caller waits for it.
///
/// # Panics
/// If the work pauses although its monitor has no [`Monitor::is_due`].
pub fn finished<T>(work: impl Future<Output = T>) -> T {
    match pin!(work).poll(&mut TaskContext::from_waker(Waker::noop())) {
        Poll::Ready(result) => result,
        Poll::Pending => unreachable!("only work that is asked to pause does"),
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
/// The errors of `work`.
pub fn with_bar<T>(work: impl AsyncFnOnce(Monitor<'_>) -> anyhow::Result<T>) -> anyhow::Result<T> {
    let time_left = |state: &ProgressState, text: &mut dyn Write| {
        // Before the first estimate it is 0.
        let left = state.eta();
        if left.as_secs() > 0 {
            // A failure would leave the bar without the time.
            let _ = write!(text, ", {:#} left", HumanDuration(left));
        }
    };
    let style = ProgressStyle::with_template("{msg} {wide_bar} {percent:>3} %{left}")
        .context("the template of the progress bar is wrong")?
        .with_key("left", time_left);
    let bar = ProgressBar::new(1000).with_style(style);
    let progress = |step, share: f64| {
        if bar.message() != step {
            bar.set_message(step);
            bar.reset();
            bar.tick();
        }
        bar.set_position((1000.0 * share) as u64);
    };
    let done = finished(work(Monitor {
        progress: &progress,
        ..Monitor::NONE
    }))?;
    bar.finish_and_clear();
    Ok(done)
}
