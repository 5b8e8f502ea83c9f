//! The command `prove`: prints a proof as text or JSON, and writes a map of the verdicts. It fails unless every pixel is
//! proven.

use std::path::PathBuf;
use std::time::Instant;

use anyhow::ensure;
use serde_json::{Value, json};

use super::{Example, Mark, Proof, Verdict, causes, prove};
use crate::components::{Mesh, names};
use crate::output::progress::with_bar;
use crate::output::words::{CHANNELS, aligned, counted, interval, short, wrapped};
use crate::output::{Output, PngPicture, one_line, print, read_png};
use crate::questions::job::Drawing;
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

/// A proof, with the causes of a wrong picture and the seconds that it took.
struct Judged {
    proof: Proof,
    causes: Vec<String>,
    seconds: f64,
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
    let lines = || lines(drawing, &judged, picture.is_some()).join("\n");
    let mut record = record(drawing, &judged);
    if picture.is_some() {
        extend(&mut record, of_picture(&judged));
    }
    print(&record, as_json, map, lines)?;
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
    let (mut records, mut rows, mut unproven) = (Vec::new(), Vec::new(), 0);
    for path in pictures {
        let name = one_line(path);
        let judged = read_png(path).and_then(|picture| judge(drawing, Some(&picture)));
        let is_proven = |it: &Judged| it.proof.proven == it.proof.pixels as u64;
        unproven += usize::from(!judged.as_ref().is_ok_and(is_proven));
        let mut record = json!({ "picture": name });
        match &judged {
            Ok(judged) => {
                extend(&mut record, self::record(drawing, judged));
                extend(&mut record, of_picture(judged));
            }
            Err(error) => extend(&mut record, json!({ "error": format!("{error:#}") })),
        }
        records.push(record);
        rows.push(match judged {
            Ok(judged) => row(name, &judged),
            Err(error) => [
                name,
                "-".into(),
                "-".into(),
                "-".into(),
                format!("{error:#}"),
            ],
        });
    }
    let head = ["picture", "right", "worst", "proven", "cause"];
    print(&records, as_json, None, || {
        [aligned(&head, rows), wrapped(LEGEND)].join("\n\n")
    })?;
    ensure!(
        unproven == 0,
        "not proven: {unproven} of {}",
        counted(pictures.len(), "picture")
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
        Some(pixels) if proof.proven < proof.pixels as u64 => {
            with_bar(async |monitor| causes(scene, &view, pixels, monitor).await)?
        }
        _ => Vec::new(),
    };
    Ok(Judged {
        proof,
        causes,
        seconds: begin.elapsed().as_secs_f64(),
    })
}

/// A proof as JSON.
fn record(drawing: &Drawing, judged: &Judged) -> Value {
    let mut record = json!(drawing.heading());
    let picture = json!({
        "mode": drawing.mode(),
        "tolerance": drawing.view().tolerance,
        "seconds": judged.seconds,
    });
    extend(&mut record, picture);
    extend(&mut record, json!(judged.proof));
    record
}

/// The facts about a judged picture besides its proof.
fn of_picture(judged: &Judged) -> Value {
    let proof = &judged.proof;
    json!({ "own": proof.own, "own_proven": proof.own_proven, "causes": judged.causes })
}

/// Adds the fields of one object to another.
fn extend(record: &mut Value, fields: Value) {
    if let (Some(record), Value::Object(fields)) = (record.as_object_mut(), fields) {
        record.extend(fields);
    }
}

/// The cells of a picture in the table of several.
fn row(name: String, judged: &Judged) -> [String; 5] {
    let proof = &judged.proof;
    let worst = proof.examples.first().map_or(proof.worst, |it| it.error[0]);
    let cause = if judged.causes.is_empty() {
        "-".to_owned()
    } else {
        judged.causes.join("; ")
    };
    [
        name,
        right(proof),
        short(worst),
        format!("{} of {}", proof.proven, proof.pixels),
        cause,
    ]
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

fn lines(drawing: &Drawing, judged: &Judged, is_judged: bool) -> Vec<String> {
    let (proof, seconds) = (&judged.proof, judged.seconds);
    let rounding = if is_judged {
        ", half a level of it for the rounding to bytes"
    } else {
        ""
    };
    let pixels = counted(proof.pixels, "pixel");
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
            "proven     {} of {pixels}, {} of them in squares",
            proof.proven, proof.in_squares
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
    lines.extend(examples(drawing, proof, is_judged));
    lines
}

/// The pixels that are not proven, each with its drawn and its exact levels.
fn examples(drawing: &Drawing, proof: &Proof, is_judged: bool) -> Vec<String> {
    if proof.examples.is_empty() {
        return Vec::new();
    }
    let mut lines = vec!["The pixels that are not proven and err most:".to_owned()];
    // Bytes are whole, and are compared with halves.
    let [of_drawn, of_exact] = if is_judged { [0, 3] } else { [6, 6] };
    for example in &proof.examples {
        lines.push(in_words(drawing, example));
        let channels = CHANNELS.iter().zip(example.drawn);
        for ((channel, drawn), exact) in channels.zip(example.enclosure) {
            let exact = interval(exact, |level| format!("{level:.of_exact$}"));
            lines.push(format!(
                "  {channel:<5}  drawn {drawn:.of_drawn$}, exact {exact}"
            ));
        }
    }
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
