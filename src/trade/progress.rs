//! How far a measurement has come, and a bar on standard error that shows it.

use std::fmt::Write;

use anyhow::Context;
use indicatif::{ProgressBar, ProgressState, ProgressStyle};

/// Is told, from any thread, what is being done and the share of it that is done, 0..=1.
pub type OnProgress<'a> = &'a (dyn Fn(&'static str, f64) + Sync);

/// Does `work` with a bar that shows the share of its present step and disappears when it ends well.
pub(crate) fn with_bar<T, E>(work: impl FnOnce(OnProgress) -> Result<T, E>) -> anyhow::Result<T>
where
    anyhow::Error: From<E>,
{
    let style = ProgressStyle::with_template("{msg} {wide_bar} {percent:>3} %{left}")
        .context("the progress bar's template is wrong")?;
    // Less than a second is not worth a word, nor is a step without an estimate yet.
    let style = style.with_key("left", |state: &ProgressState, text: &mut dyn Write| {
        let seconds = state.eta().as_secs();
        if seconds > 0 {
            let _ = write!(text, ", {seconds} s left");
        }
    });
    let bar = ProgressBar::new(1000).with_style(style);
    let done = work(&|step, share| {
        if bar.message() != step {
            bar.set_message(step);
            bar.reset();
            bar.tick();
        }
        bar.set_position((1000.0 * share) as u64);
    })?;
    bar.finish_and_clear();
    Ok(done)
}
