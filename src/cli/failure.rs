//! The failure of a command, its message and its exit status.
//!
//! The exit status is 0 for success, 1 for a failure, and 2 for a wrong command line or scene. A failure prints one
//! paragraph to standard error.

use std::process::ExitCode;

use anyhow::anyhow;

use crate::output::say;

/// The failure of a command.
#[derive(Debug)]
pub enum Failure {
    /// The command line or the scene is wrong: status 2.
    Usage(anyhow::Error),
    /// The command failed: status 1.
    Work(anyhow::Error),
}

impl From<anyhow::Error> for Failure {
    fn from(error: anyhow::Error) -> Self {
        Failure::Work(error)
    }
}

impl Failure {
    /// Clap's error as one paragraph: blank lines between its message, tips and usage are dropped.
    pub(super) fn of(error: &clap::Error) -> Self {
        let text = error.render().to_string();
        let all = text.trim_start_matches("error: ").lines();
        let lines: Vec<&str> = all.filter(|line| !line.trim().is_empty()).collect();
        Failure::Usage(anyhow!(lines.join("\n")))
    }

    /// Prints the error to standard error and returns the exit status.
    pub fn report(&self) -> ExitCode {
        let (error, status) = match self {
            Failure::Usage(error) => (error, 2),
            Failure::Work(error) => (error, 1),
        };
        // The text of some errors already contains the cause.
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
