//! The command `prove`: prints a proof as text or JSON, and writes a map of the verdicts. It fails unless every pixel is
//! proven.

use std::time::Instant;

use anyhow::bail;
use serde_json::{Value, json};

use super::png::PngPicture;
use super::{Mark, Proof, Verdict, prove};
use crate::components::{Mesh, names};
use crate::output::progress::with_bar;
use crate::output::words::{CHANNELS, counted, interval};
use crate::output::{Output, print};
use crate::questions::job::Drawing;
use crate::questions::job::camera_name;
use crate::shading;
use crate::systems;
use crate::systems::frame::{Frame, Keep};

/// The colours of the map, 0x00RRGGBB: proven pixels beside an edge, and pixels that are not proven.
const OUTLINE: u32 = 0x0026_5a78;
const UNDECIDED: u32 = 0x00ff_d500;
const GAP: u32 = 0x00e0_40ff;
const REFUTED: u32 = 0x00ff_2020;

/// The faces of a cuboid by the direction of their normals, before rotation.
const FACES: [&str; 6] = ["+x", "-x", "+y", "-y", "+z", "-z"];

/// Proves the picture of `drawing`, or `picture` instead, prints the proof, and writes a picture of the verdicts to `map`.
///
/// # Errors
/// If a pixel is not proven, the picture does not fit in memory, or the output cannot be written.
pub fn run(
    drawing: &mut Drawing,
    picture: Option<PngPicture>,
    map: Option<&Output>,
    as_json: bool,
) -> anyhow::Result<()> {
    let (pixels, size) = picture.unzip();
    drawing.size = size.unwrap_or(drawing.size);
    let view = drawing.view();
    let begin = Instant::now();
    let (world, level) = (&mut drawing.scene.world, drawing.level);
    let proof =
        with_bar(async |monitor| prove(world, &view, pixels.as_deref(), level, monitor).await)?;
    if let Some(output) = map {
        let mut frame = Frame::new(Keep::Display, drawing.workers()?);
        if pixels.is_none() {
            systems::draw(&mut drawing.scene.world, &view, &mut frame)?;
        }
        let pixels = pixels.as_deref().unwrap_or_else(|| frame.pixels());
        let marked = pixels.iter().zip(&proof.marks);
        let marked: Vec<u32> = marked.map(|(pixel, mark)| color(*pixel, *mark)).collect();
        output.write_png(&marked, view.size)?;
    }
    let seconds = begin.elapsed().as_secs_f64();
    let mut record = json!({
        "scene": drawing.scene.name,
        "camera": camera_name(&drawing.scene.world),
        "projection": view.projection,
        "size": view.size,
        "mode": drawing.mode(),
        "tolerance": view.tolerance,
        "seconds": seconds,
    });
    if let (Some(record), Value::Object(proof)) = (record.as_object_mut(), json!(proof)) {
        record.extend(proof);
    }
    let lines = || lines(drawing, &proof, seconds).join("\n");
    print(&record, as_json, map, lines)?;
    drawing.say_if_unseen(proof.covered);
    let unproven = proof.pixels as u64 - proof.proven;
    if unproven > 0 {
        bail!(
            "not proven: {unproven} of {}",
            counted(proof.pixels, "pixel")
        );
    }
    Ok(())
}

/// The colour of a pixel in the map. A proven pixel away from edges has its colour in the picture, darkened.
fn color(pixel: u32, mark: Mark) -> u32 {
    match mark.verdict {
        Verdict::Refuted => REFUTED,
        Verdict::Gap => GAP,
        Verdict::Undecided => UNDECIDED,
        Verdict::Proven if mark.is_outline => OUTLINE,
        Verdict::Proven => (pixel >> 1 & 0x007f_7f7f) - (pixel >> 3 & 0x001f_1f1f),
    }
}

fn lines(drawing: &Drawing, proof: &Proof, seconds: f64) -> Vec<String> {
    let rounding = if proof.limit > shading::limit(drawing.view().tolerance) {
        ", half a level of it for the rounding to bytes"
    } else {
        ""
    };
    let pixels = counted(proof.pixels, "pixel");
    let mut lines = vec![
        drawing.subject(),
        format!("proven     {} of {pixels}", proof.proven),
        format!("refuted    {}", proof.refuted),
        format!("undecided  {}", proof.undecided),
        format!(
            "gaps       {} where touching faces leave a hole",
            counted(proof.gaps as usize, "pixel")
        ),
        format!(
            "outline    {} so near an edge that either side may be shown",
            counted(proof.outline as usize, "pixel")
        ),
    ];
    if proof.proven > 0 {
        lines.push(format!(
            "largest proven    {:.6} levels off, where {} is allowed{rounding}",
            proof.worst, proof.limit
        ));
    }
    // Without a cuboid nothing is enclosed.
    if proof.widest_enclosure > 0.0 {
        lines.push(format!(
            "widest enclosure  {:.1e} levels\n\
             f64 reference     {:.1e} levels off at most",
            proof.widest_enclosure, proof.reference_error
        ));
    }
    lines.push(format!("time              {seconds:.2} s"));
    if !proof.examples.is_empty() {
        lines.push("The pixels that are not proven and err most:".to_owned());
    }
    for example in &proof.examples {
        let [x, y] = example.pixel;
        let verdict = match example.verdict {
            Verdict::Gap => "a gap".to_owned(),
            verdict => verdict.name(),
        };
        let [drawn, face] = [example.drawn_face, example.face].map(|it| face(drawing, it));
        let instead = if drawn == face {
            String::new()
        } else {
            format!("{drawn} instead of ")
        };
        let error = interval(example.error, |level| format!("{level:.3}"));
        lines.push(format!(
            "pixel {x},{y} is {verdict}, {instead}{face}: off by {error} levels"
        ));
        let channels = CHANNELS.iter().zip(example.drawn);
        for ((channel, drawn), exact) in channels.zip(example.enclosure) {
            let exact = interval(exact, |level| format!("{level:>11.6}"));
            lines.push(format!(
                "  {channel:<5}  drawn {drawn:>11.6}, exact {exact}"
            ));
        }
    }
    lines
}

/// The name of the cuboid and of its face.
fn face(drawing: &Drawing, face: Option<usize>) -> String {
    let Some(face) = face else {
        return "background".to_owned();
    };
    let names = names::<Mesh>(&drawing.scene.world);
    format!("{}, face {}", names[face / 6], FACES[face % 6])
}
