//! One batch of timed frames, drawn by this process or by one of its own.
//!
//! ```text
//! trade --the same arguments, scene on stdin--> trade --batch 0 --times on stdout--> trade
//! ```
//! Some properties vary from run to run of the program, for example the place of its memory. In processes of their own
//! the batches vary as runs do, so the interval of their medians includes this variation.

use std::env;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, ensure};

use super::measurement::Request;
use super::timing::{self, Batch};
use crate::frame::{Frame, Keep};
use crate::output::Output;
use crate::report::Monitor;
use crate::scene::{SceneRecord, updated};
use crate::systems;

/// Times a batch in this process. All methods draw into one frame, so that they have the same place in memory.
///
/// # Errors
/// If memory or threads do not suffice, or the work is cancelled.
pub fn time_here(request: &Request, number: usize, monitor: Monitor) -> anyhow::Result<Batch> {
    let view = request.drawing.view();
    let views: Vec<_> = request.methods.iter().map(|it| it.view(&view)).collect();
    let mut frame = Frame::new(Keep::Display, request.drawing.workers()?);
    let mut scene = request.drawing.scene.snapshot();
    timing::batch(number, views.len(), request.time, |method| {
        monitor.check()?;
        systems::draw(&mut scene.world, &views[method], &mut frame)
            .context("the methods cannot be compared")
    })
}

/// Runs this program as `trade --batch N` with its own arguments and the scene of the request, and returns the times that
/// it prints. The arguments contain the rest of the request.
///
/// # Errors
/// If the process cannot be started or cannot measure.
pub fn time_in_a_process(request: &Request, number: usize, _: Monitor) -> anyhow::Result<Batch> {
    let times = || {
        let mut child = Command::new(this_program()?)
            .args(["trade", "--batch", &number.to_string()])
            .args(env::args_os().skip(2))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()?;
        if let Some(mut scene) = child.stdin.take() {
            // A process that does not read it says why.
            let text = updated("", &SceneRecord::of(&request.drawing.scene.world));
            let _ = scene.write_all(text.as_bytes());
        }
        let output = child.wait_with_output()?;
        let said = String::from_utf8_lossy(&output.stderr);
        let said = said.trim().trim_start_matches("error: ");
        ensure!(output.status.success(), "{said}");
        serde_json::from_slice(&output.stdout).context("its times cannot be read")
    };
    times().context("cannot measure in a process of its own")
}

/// The file of the running program. Linux keeps it even if a new build has replaced it.
fn this_program() -> std::io::Result<PathBuf> {
    let kept = Path::new("/proc/self/exe");
    if kept.exists() {
        Ok(kept.to_owned())
    } else {
        env::current_exe()
    }
}

/// The command `trade --batch`: times the batch and prints its times.
///
/// # Errors
/// If it cannot be measured.
pub fn run(request: &Request, number: usize) -> anyhow::Result<()> {
    let times = time_here(request, number, Monitor::NONE)?;
    Output::Stdout.write(serde_json::to_vec(&times)?)
}
