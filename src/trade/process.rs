//! One batch of a measurement: a request in, its times out, from a process of its own.
//!
//! ```text
//! trade --the same words, scene on stdin--> trade --batch 0 --times on stdout--> trade
//! ```
//! Where the first process is killed, the batch it waits for ends by itself.
//!
//! Rule: what varies between runs of the program, such as where its memory lies, varies between batches too, so that the
//! interval of their medians knows of it.

use std::env;
use std::io::Write;
use std::process::{Command, Stdio};

use anyhow::{Context, ensure};

use super::timing::Batch;
use super::{IsCancelled, Request, TradeError, time_batch};
use crate::output::Output;
use crate::scene::{SceneRecord, updated};

/// Runs this program as `trade --batch N` with the arguments it was called with and the request's scene, and returns the times
/// it prints. All of the request but the scene is in the arguments.
///
/// # Errors
/// When that cannot be started, or could not measure.
pub fn in_a_process(
    request: &Request,
    number: usize,
    _cancelled: IsCancelled,
) -> Result<Batch, TradeError> {
    let times = || {
        let mut child = Command::new(env::current_exe()?)
            .args(["trade", "--batch", &number.to_string()])
            .args(env::args_os().skip(2))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()?;
        if let Some(mut scene) = child.stdin.take() {
            // Where it is not read, the process says why.
            let text = updated("", &SceneRecord::of(&request.scene.world));
            let _ = scene.write_all(text.as_bytes());
        }
        let output = child.wait_with_output()?;
        let said = String::from_utf8_lossy(&output.stderr);
        let said = said.trim().trim_start_matches("error: ");
        ensure!(output.status.success(), "{said}");
        serde_json::from_slice(&output.stdout).context("its times cannot be read")
    };
    times().map_err(TradeError::Process)
}

/// The command in that process: times the batch and prints its times.
///
/// # Errors
/// When it could not be measured.
pub fn run(request: &Request, number: usize) -> anyhow::Result<()> {
    let times = time_batch(request, number, &|| false)?;
    let text = serde_json::to_vec(&times)?;
    Output::Stdout.write(|writer| writer.write_all(&text))
}
