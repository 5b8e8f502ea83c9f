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
    /// Clap's error as one paragraph: clap sets its tips and the usage apart with blank lines.
    pub(super) fn of(error: &clap::Error) -> Self {
        let text = error.render().to_string();
        let lines = text.trim_start_matches("error: ").lines();
        let lines: Vec<&str> = lines.filter(|line| !line.trim().is_empty()).collect();
        Failure::Usage(anyhow!(lines.join("\n")))
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
