//! Why a run did not do what was asked in, what it says and its exit status out.
//!
//! Rule: a run ends with status 0 (done), 1 (could not do it) or 2 (the command line or the scene was wrong), and with
//! one paragraph on standard error unless it is 0.

use std::process::ExitCode;

use anyhow::anyhow;

use crate::output::say;

/// Why a run did not do what was asked.
#[derive(Debug)]
pub enum Failure {
    /// The command line or the scene was wrong: status 2.
    Usage(anyhow::Error),
    /// It could not be done: status 1.
    Work(anyhow::Error),
}

impl From<anyhow::Error> for Failure {
    fn from(error: anyhow::Error) -> Self {
        Failure::Work(error)
    }
}

impl Failure {
    /// Clap's error with one more tip, as one paragraph: clap sets its tips and the usage apart with blank lines.
    pub(super) fn of(error: &clap::Error, tip: Option<String>) -> Self {
        let text = error.render().to_string();
        let tip = tip.map(|tip| format!("  tip: {tip}"));
        let lines: Vec<&str> = text
            .trim_start_matches("error: ")
            .lines()
            // That tip is for scenes named like an option; a mistyped option is far more likely.
            .filter(|line| !line.trim().is_empty() && !line.starts_with("  tip: to pass "))
            .collect();
        let end = lines.iter().position(|line| line.starts_with("Usage:"));
        let (what, how) = lines.split_at(end.unwrap_or(lines.len()));
        let paragraph = [what, tip.as_deref().as_slice(), how].concat();
        Failure::Usage(anyhow!(paragraph.join("\n")))
    }

    /// Says on standard error what went wrong; the status to end with.
    pub fn report(&self) -> ExitCode {
        let (error, status) = match self {
            Failure::Usage(error) => (error, 2),
            Failure::Work(error) => (error, 1),
        };
        // Some errors say their cause themselves.
        let mut text = error.to_string();
        for cause in error.chain().skip(1).map(ToString::to_string) {
            if !text.contains(&cause) {
                text = format!("{text}: {cause}");
            }
        }
        say(format!("error: {text}").trim_end());
        ExitCode::from(status)
    }
}
