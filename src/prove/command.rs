//! A [`Drawing`] in; its proof as text, JSON and a map out.
//!
//! Rule: a picture of which a pixel is refuted is work not done.

use std::time::Instant;

use anyhow::{Context, bail};
use serde::Serialize;

use super::{Mark, Proof, REFUTED, UNDECIDED, Verdict, prove};
use crate::drawing::Drawing;
use crate::frame::{Frame, Keep};
use crate::output::{Output, print};
use crate::shading::limit;
use crate::systems;
use crate::trade::progress::with_bar;

/// The colour of pixels that are proven to show one side of an edge.
const OUTLINE: u32 = 0x0026_5a78;

/// What `--json` prints.
#[derive(Serialize)]
struct Record<'a> {
    scene: &'a str,
    camera: String,
    projection: &'static str,
    size: [usize; 2],
    mode: &'static str,
    tolerance: f64,
    limit: f64,
    seconds: f64,
    pixels: usize,
    #[serde(flatten)]
    proof: &'a Proof,
}

/// Proves what can be proven of a picture, prints it, and writes the map if one is asked for.
///
/// # Errors
/// When a pixel is refuted, or the picture does not fit in memory, or something cannot be written.
pub fn run(drawing: &mut Drawing, map: Option<&Output>, as_json: bool) -> anyhow::Result<()> {
    let view = drawing.view();
    let begin = Instant::now();
    let (world, level) = (&mut drawing.scene.world, drawing.level);
    let proof = with_bar(|on_progress| {
        let progress = |share| on_progress("proving", share);
        prove(world, &view, level, &|| false, &progress)
    })?
    .context("the proof was cancelled")?;
    if let Some(output) = map {
        let mut frame = Frame::new(Keep::Display, drawing.workers()?);
        systems::draw(&mut drawing.scene.world, &view, &mut frame)?;
        let pixels = frame.pixels().iter().zip(&proof.marks);
        let pixels: Vec<u32> = pixels.map(|(pixel, mark)| color(*pixel, *mark)).collect();
        output.write_png(&pixels, view.size)?;
    }
    let record = Record {
        scene: &drawing.scene.name,
        camera: drawing.camera(),
        projection: view.projection.name(),
        size: view.size,
        mode: drawing.mode(),
        tolerance: view.tolerance,
        limit: limit(view.tolerance),
        seconds: begin.elapsed().as_secs_f64(),
        pixels: proof.marks.len(),
        proof: &proof,
    };
    print(&record, as_json, || lines(drawing, &record).join("\n"))?;
    if proof.refuted > 0 {
        bail!("{} of {} pixels are refuted", proof.refuted, record.pixels);
    }
    Ok(())
}

/// A proven pixel is dimmed, so that the others stand out.
fn color(pixel: u32, mark: Mark) -> u32 {
    match mark.verdict {
        Verdict::Refuted => REFUTED,
        Verdict::Undecided => UNDECIDED,
        Verdict::Proven if mark.is_outline => OUTLINE,
        Verdict::Proven => (pixel >> 1 & 0x007f_7f7f) - (pixel >> 3 & 0x001f_1f1f),
    }
}

fn lines(drawing: &Drawing, record: &Record) -> Vec<String> {
    let proof = record.proof;
    let mut lines = vec![
        drawing.subject(),
        format!("proven     {} of {} pixels", proof.proven, record.pixels),
        format!("refuted    {}", proof.refuted),
        format!("undecided  {}", proof.undecided),
        format!(
            "outline    {} pixels are so near an edge that they may show either side",
            proof.outline
        ),
        format!(
            "largest error     {:.6} levels at most, where {} are allowed",
            proof.worst, record.limit
        ),
        format!("widest enclosure  {:.1e} levels", proof.widest_enclosure),
        format!(
            "f64 reference     {:.1e} levels off at most",
            proof.reference_error
        ),
        format!("time              {:.2} s", record.seconds),
    ];
    for example in &proof.examples {
        let [x, y] = example.pixel;
        let verdict = format!("{:?}", example.verdict).to_lowercase();
        lines.push(format!("pixel {x},{y} is {verdict}:"));
        for ((channel, drawn), [least, largest]) in ["red", "green", "blue"]
            .iter()
            .zip(example.drawn)
            .zip(example.enclosure)
        {
            lines.push(format!(
                "  {channel:<5}  drawn {drawn:>11.6}, exact {least:>11.6} to {largest:>11.6}"
            ));
        }
    }
    lines
}
