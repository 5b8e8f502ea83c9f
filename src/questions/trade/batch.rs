//! One batch of timed frames, drawn by this process or by one of its own.
//!
//! ```text
//! trade --the batch on stdin, JSON--> trade --batch --times on stdout, JSON--> trade
//! ```
//! Some properties vary from run to run of the program, for example the place of its memory. In processes of their own
//! the batches vary as runs do, so the interval of their medians includes this variation.

use std::env;
use std::io::{self, Write};
use std::process::{Command, Stdio};
use std::time::Duration;

use anyhow::{Context, ensure};
use serde::{Deserialize, Serialize};
use toml::Value;

use super::Request;
use super::timing::{self, Batch};
use crate::output::{Monitor, Output, finished};
use crate::questions::job::Drawing;
use crate::scene::key::tree;
use crate::scene::{Scene, SceneRecord};
use crate::shading::{METHODS, simd};
use crate::systems;
use crate::systems::frame::{Frame, Keep};

/// A batch for a process of its own: a [`Request`] and the number of the batch.
#[derive(Serialize, Deserialize)]
struct BatchRequest {
    /// A [`SceneRecord`] as TOML.
    scene: Value,
    size: [usize; 2],
    threads: usize,
    simd: String,
    /// By their ids.
    methods: Vec<String>,
    time: Duration,
    number: usize,
}

/// Times a batch in this process. All methods draw into one frame, so that they have the same place in memory.
///
/// # Errors
/// If memory or threads do not suffice, or the work is cancelled.
pub async fn time_here(
    request: &Request,
    number: usize,
    monitor: Monitor<'_>,
) -> anyhow::Result<Batch> {
    let view = request.drawing.view();
    let views: Vec<_> = request.timed().map(|it| it.view(&view)).collect();
    let mut frame = Frame::new(Keep::Display, request.drawing.workers()?);
    let mut scene = request.drawing.scene.snapshot();
    let draw = |method: usize| {
        systems::draw(&mut scene.world, &views[method], &mut frame)
            .context("the methods cannot be compared")
    };
    timing::batch(number, views.len(), request.time, monitor, draw).await
}

/// Runs this program as `trade --batch`, and returns the times that it prints.
///
/// # Errors
/// If the process cannot be started or cannot measure.
pub async fn time_in_a_process(
    request: &Request,
    number: usize,
    _: Monitor<'_>,
) -> anyhow::Result<Batch> {
    let drawing = &request.drawing;
    let asked = BatchRequest {
        scene: tree(&SceneRecord::of(&drawing.scene.world)),
        size: drawing.size,
        threads: drawing.threads,
        simd: simd::name(drawing.level).to_owned(),
        methods: request.timed().map(|it| it.id.to_owned()).collect(),
        time: request.time,
        number,
    };
    let times = || {
        let mut child = Command::new(env::current_exe()?)
            .args(["trade", "--batch"])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()?;
        if let Some(mut input) = child.stdin.take() {
            // A process that ends before it reads this says why.
            let _ = input.write_all(&serde_json::to_vec(&asked)?);
        }
        let output = child.wait_with_output()?;
        let errors = String::from_utf8_lossy(&output.stderr);
        let why = errors.trim().trim_start_matches("error: ");
        ensure!(output.status.success(), "{why}");
        serde_json::from_slice(&output.stdout).context("its times cannot be read")
    };
    times().context("cannot measure in a process of its own")
}

/// The command `trade --batch`: times the batch on standard input and prints its times.
///
/// # Errors
/// If there is none, or it cannot be measured.
pub fn run() -> anyhow::Result<()> {
    let asked: BatchRequest = serde_json::from_reader(io::stdin().lock())
        .context("cannot read a batch from standard input")?;
    let method = |id: &String| METHODS.iter().find(|it| it.id == id).copied();
    let methods = asked.methods.iter().map(method).collect::<Option<_>>();
    let request = Request {
        drawing: Drawing {
            scene: Scene::spawn(String::new(), &SceneRecord::from_tree(asked.scene)?),
            size: asked.size,
            threads: asked.threads,
            level: simd::named(&asked.simd).context("no such SIMD level")?,
        },
        methods: methods.context("no such method")?,
        time: asked.time,
        is_report: false,
    };
    let times = finished(time_here(&request, asked.number, Monitor::NONE))?;
    Output::Stdout.write(serde_json::to_vec(&times)?)
}
