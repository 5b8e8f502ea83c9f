//! The command `prove`: prints a proof as text or JSON, and writes a map of the verdicts. It fails unless every pixel is
//! proven.

use std::path::PathBuf;
use std::time::Instant;

use anyhow::ensure;
use serde::Serialize;

use super::{Example, Mark, Proof, Verdict, causes, prove};
use crate::components::{Mesh, names};
use crate::output::progress::with_bar;
use crate::output::words::{aligned, counted, interval, short, wrapped};
use crate::output::{Output, PngPicture, one_line, print, read_png};
use crate::questions::job::{Drawing, Heading};
use crate::systems;
use crate::systems::frame::{Frame, Keep};

const LEGEND: &str = "right: the share of the pixels that show nothing but a cuboid, proven; worst: the largest error, in levels \
    of 255; proven: pixels; cause: proven, too.";

/// The colours of the map, 0x00RRGGBB: proven pixels beside an edge, and pixels that are not proven.
const OUTLINE: u32 = 0x0026_5a78;
const UNDECIDED: u32 = 0x00ff_d500;
const GAP: u32 = 0x00e0_40ff;
const REFUTED: u32 = 0x00ff_2020;

/// The faces of a cuboid by the direction of their normals, before rotation.
const FACES: [&str; 6] = ["+x", "-x", "+y", "-y", "+z", "-z"];

/// A proof with its picture: the record of `prove --json`.
#[derive(Serialize)]
struct Judged {
    #[serde(flatten)]
    heading: Heading,
    mode: &'static str,
    tolerance: f64,
    #[serde(flatten)]
    proof: Proof,
    /// The causes of a wrong picture of another program.
    causes: Vec<String>,
    seconds: f64,
}

/// One of several pictures. It cannot be read if there is an error.
#[derive(Serialize)]
struct OneOfSeveral {
    picture: String,
    #[serde(flatten)]
    judged: Option<Judged>,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<String>,
}

/// Proves the picture of `drawing`, or `picture` instead, prints the proof, and writes a picture of the verdicts to `map`.
///
/// # Errors
/// If a pixel is not proven, the picture does not fit in memory, or the output cannot be written.
pub fn run(
    drawing: &mut Drawing,
    picture: Option<&PngPicture>,
    map: Option<&Output>,
    as_json: bool,
) -> anyhow::Result<()> {
    let judged = judge(drawing, picture)?;
    let proof = &judged.proof;
    if let Some(output) = map {
        let view = drawing.view();
        let mut frame = Frame::new(Keep::Display, drawing.workers()?);
        if picture.is_none() {
            systems::draw(&mut drawing.scene.world, &view, &mut frame)?;
        }
        let pixels = picture.map_or_else(|| frame.pixels(), |(pixels, _)| pixels);
        let marked = pixels.iter().zip(&proof.marks);
        let colors: Vec<u32> = marked.map(|(pixel, mark)| color(*pixel, *mark)).collect();
        output.write_png(&colors, view.size)?;
    }
    print(&judged, as_json, map, || lines(drawing, &judged).join("\n"))?;
    drawing.say_if_unseen(proof.covered);
    let unproven = proof.pixels as u64 - proof.proven;
    ensure!(
        unproven == 0,
        "not proven: {unproven} of {}",
        counted(proof.pixels, "pixel")
    );
    Ok(())
}

/// Judges pictures, and prints a table with a line for each, or an array. One that cannot be read is not proven.
///
/// # Errors
/// If one is not proven, or the table cannot be written.
pub fn run_all(drawing: &mut Drawing, pictures: &[PathBuf], as_json: bool) -> anyhow::Result<()> {
    let mut all = Vec::new();
    for path in pictures {
        let judged = read_png(path).and_then(|picture| judge(drawing, Some(&picture)));
        all.push(OneOfSeveral {
            picture: one_line(path),
            error: judged.as_ref().err().map(|error| format!("{error:#}")),
            judged: judged.ok(),
        });
    }
    let head = ["picture", "right", "worst", "proven", "cause"];
    print(&all, as_json, None, || {
        [aligned(&head, all.iter().map(row)), wrapped(LEGEND)].join("\n\n")
    })?;
    let judged = all.iter().filter_map(|it| it.judged.as_ref());
    let proven = judged.filter(|it| it.proof.is_all()).count();
    ensure!(
        proven == all.len(),
        "not proven: {} of {}",
        all.len() - proven,
        counted(all.len(), "picture")
    );
    Ok(())
}

/// Proves the picture of `drawing`, or `picture` instead, and looks for the causes if it is not proven.
fn judge(drawing: &mut Drawing, picture: Option<&PngPicture>) -> anyhow::Result<Judged> {
    let pixels = picture.map(|(pixels, _)| &**pixels);
    drawing.size = picture.map_or(drawing.size, |(_, size)| *size);
    let view = drawing.view();
    let begin = Instant::now();
    let (scene, level) = (&mut drawing.scene, drawing.level);
    let proof =
        with_bar(async |monitor| prove(&mut scene.world, &view, pixels, level, monitor).await)?;
    let causes = match pixels {
        Some(pixels) if !proof.is_all() => {
            with_bar(async |monitor| causes(scene, &view, pixels, monitor).await)?
        }
        _ => Vec::new(),
    };
    Ok(Judged {
        heading: drawing.heading(),
        mode: drawing.mode(),
        tolerance: view.tolerance,
        proof,
        causes,
        seconds: begin.elapsed().as_secs_f64(),
    })
}

/// The cells of a picture in the table of several.
fn row(one: &OneOfSeveral) -> [String; 5] {
    let name = one.picture.clone();
    let Some(Judged { proof, causes, .. }) = &one.judged else {
        let error = one.error.clone().unwrap_or_default();
        return [name, "-".into(), "-".into(), "-".into(), error];
    };
    let worst = proof.examples.first().map_or(proof.worst, |it| it.error[0]);
    let cause = if causes.is_empty() {
        "-".to_owned()
    } else {
        causes.join("; ")
    };
    let proven = format!("{} of {}", proof.proven, proof.pixels);
    [name, right(proof), short(worst), proven, cause]
}

/// The share of the cuboids' own pixels that is proven.
fn right(proof: &Proof) -> String {
    if proof.own == 0 {
        return "-".to_owned();
    }
    // Rounded down: 100 % are all of them.
    let tenths = (1000 * proof.own_proven / proof.own) as f64;
    format!("{:.1} %", tenths / 10.0)
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

fn lines(drawing: &Drawing, judged: &Judged) -> Vec<String> {
    let proof = &judged.proof;
    let mut lines = vec![drawing.subject()];
    if let Some(worst) = proof.examples.first() {
        lines.push(format!("worst      {}", in_words(drawing, worst)));
        lines.push(format!(
            "right      {}: {} of the {} that show nothing but a cuboid",
            right(proof),
            proof.own_proven,
            counted(proof.own as usize, "pixel"),
        ));
    }
    lines.extend(judged.causes.iter().map(|it| format!("cause      {it}")));
    lines.extend([
        format!(
            "proven     {} of {}, {} of them in squares",
            proof.proven,
            counted(proof.pixels, "pixel"),
            proof.in_squares
        ),
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
    ]);
    if proof.proven > 0 {
        lines.push(format!(
            "largest proven    {:.6} levels off, where {} is allowed",
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
    lines.push(format!("time              {:.2} s", judged.seconds));
    lines
}

/// A pixel that is not proven: its verdict, its face and its error.
fn in_words(drawing: &Drawing, example: &Example) -> String {
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
    format!("pixel {x},{y} is {verdict}, {instead}{face}: off by {error} levels")
}

/// The name of the cuboid and of its face.
fn face(drawing: &Drawing, face: Option<usize>) -> String {
    let Some(face) = face else {
        return "background".to_owned();
    };
    let names = names::<Mesh>(&drawing.scene.world);
    format!("{}, face {}", one_line(&names[face / 6]), FACES[face % 6])
}
