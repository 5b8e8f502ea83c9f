//! How far a measurement has come, and a bar on standard error that shows it.

use anyhow::Context;
use indicatif::{ProgressBar, ProgressStyle};

/// How far a measurement has come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// What is being done.
    pub step: &'static str,
    /// How much of it is done, 0..=1.
    pub share: f64,
}

/// Does `work` with a bar that shows the share of its present step and disappears when it ends well.
pub(crate) fn with_bar<T, E>(
    work: impl FnOnce(&(dyn Fn(Progress) + Sync)) -> Result<T, E>,
) -> anyhow::Result<T>
where
    anyhow::Error: From<E>,
{
    let bar = ProgressBar::new(1000).with_style(
        ProgressStyle::with_template("{msg} {wide_bar} {percent:>3} %, {eta} left")
            .context("the progress bar's template is wrong")?,
    );
    let done = work(&|progress| {
        if bar.message() != progress.step {
            bar.set_message(progress.step);
            bar.reset();
        }
        bar.set_position((1000.0 * progress.share) as u64);
    })?;
    bar.finish_and_clear();
    Ok(done)
}
