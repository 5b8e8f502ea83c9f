//! The command `requires`: prints a table or JSON, and writes a reduced scene.
//!
//! The reduced scene is a valid scene file. Its comments list the parts left out and their error.

use serde::Serialize;
use serde_json::json;

use super::bits::{StageBits, bits};
use super::least::least;
use super::share::time_share;
use super::{Part, PartChange, part_changes, parts, without};
use crate::components::View;
use crate::drawing::Drawing;
use crate::output::{Output, print, say};
use crate::report::progress::with_bar;
use crate::report::tables::{aligned, wrapped};
use crate::report::words::short;
use crate::scene::{Scene, SceneRecord, updated};

/// A part in the table and in the output of `--json`.
#[derive(Serialize)]
struct PartRow {
    #[serde(flatten)]
    found: PartChange,
    time_share: Option<f64>,
    required: bool,
}

impl PartRow {
    fn most(&self) -> f64 {
        self.found.change.most()
    }
}

const LEGEND: &str = "One part is left out at a time. largest error: in levels of 255, proven; pixels: pixels with an error \
    above the tolerance, proven; time: the part's share of the shortest frame time on one thread, negative \
    if the frame without the part takes longer, a dash if the renderer cannot draw without it; required: the picture \
    without the part is not proven to keep the tolerance.";

const LEGEND_OF_BITS: &str = "One stage is rounded at a time, after each of its operations; all others are in f64. bits: the \
    fewest bits of significand, 2 to 24, that keep the tolerance; largest error: with that number of bits, in levels of 255, \
    proven; f16, bf16, f32: whether the format keeps the tolerance, and its largest error.";

/// Prints the parts and the bits that a picture requires, and writes a reduced scene to `least_scene`.
///
/// # Errors
/// If the picture does not fit in memory or the output cannot be written.
pub fn run(drawing: &Drawing, least_scene: Option<&Output>, as_json: bool) -> anyhow::Result<()> {
    let (subject, view) = (drawing.subject(), drawing.view());
    let rows = rows(drawing, &view)?;
    let stages = with_bar(|monitor| bits(&drawing.scene, &view, monitor))?;
    let record = json!({
        "scene": drawing.scene.name,
        "tolerance": view.tolerance,
        "parts": rows,
        "bits": stages,
    });
    print(&record, as_json, || {
        let parts = [subject.clone(), table(&rows), wrapped(LEGEND)];
        let head = ["stage", "bits", "largest error", "f16", "bf16", "f32"];
        let cells: Vec<_> = stages.iter().map(StageBits::cells).collect();
        let bits = [aligned(&head, &cells), wrapped(LEGEND_OF_BITS)];
        [&parts[..], &bits[..]].concat().join("\n\n")
    })?;
    match least_scene {
        Some(output) => write_least(&subject, &drawing.scene, &view, rows, output),
        None => Ok(()),
    }
}

/// A row for each part.
fn rows(drawing: &Drawing, view: &View) -> anyhow::Result<Vec<PartRow>> {
    let scene = &drawing.scene;
    let parts = parts(scene);
    let time_shares: Vec<_> = with_bar(|monitor| {
        let of_part = |(index, (part, _)): (usize, &(Part, _))| {
            (monitor.progress)("timing", index as f64 / parts.len() as f64);
            time_share(scene, view, *part, drawing.level)
        };
        parts.iter().enumerate().map(of_part).collect()
    })?;
    let found = with_bar(|monitor| part_changes(scene, view, monitor))?;
    let row = |(found, time_share): (PartChange, _)| PartRow {
        required: !found.change.keeps(view.tolerance),
        found,
        time_share,
    };
    Ok(found.into_iter().zip(time_shares).map(row).collect())
}

/// The table, the largest error first.
fn table(rows: &[PartRow]) -> String {
    let mut sorted: Vec<&PartRow> = rows.iter().collect();
    sorted.sort_by(|one, other| other.most().total_cmp(&one.most()));
    let cells = |row: &&PartRow| {
        let percent = |share: f64| format!("{} %", (100.0 * share).round() as i64);
        vec![
            row.found.name.clone(),
            error(row.found.change.largest_error),
            row.found.change.pixels.to_string(),
            row.time_share.map_or_else(|| "-".to_owned(), percent),
            if row.required { "yes" } else { "no" }.to_owned(),
        ]
    };
    let head = ["part", "largest error", "pixels", "time", "required"];
    aligned(&head, &sorted.iter().map(cells).collect::<Vec<_>>())
}

/// An interval as text: a single number if both ends read the same.
fn error(ends: [f64; 2]) -> String {
    let [least, most] = ends.map(|level| short(Some(level)));
    if least == most || most == "<0.001" {
        most
    } else {
        format!("{least} to {most}")
    }
}

/// Writes the scene without parts that it does not require together. Only parts that a scene file can leave out are tried.
fn write_least(
    subject: &str,
    scene: &Scene,
    view: &View,
    mut rows: Vec<PartRow>,
    output: &Output,
) -> anyhow::Result<()> {
    rows.retain(|row| {
        let is_in_file = !matches!(row.found.part, Part::Rule(_) | Part::F64SetUp);
        is_in_file && !row.required
    });
    rows.sort_by(|one, other| one.most().total_cmp(&other.most()));
    let candidates: Vec<Part> = rows.iter().map(|row| row.found.part).collect();
    let (left_out, change) = with_bar(|monitor| least(scene, view, &candidates, monitor))?;
    rows.retain(|row| left_out.contains(&row.found.part));
    let names: Vec<String> = rows.into_iter().map(|row| row.found.name).collect();
    let most = (1e4 * change.most()).ceil() / 1e4;
    let found = match &names[..] {
        [] => "no part is proven to be unnecessary".to_owned(),
        names => format!(
            "left out: {}; errs at most {most} levels, proven",
            names.join(", ")
        ),
    };
    // A line break in a name would end the comment.
    let comments = format!("The least scene for {subject}: {found}.");
    let comments = wrapped(&comments.replace(char::is_control, "\u{fffd}")).replace('\n', "\n# ");
    let mut record = SceneRecord::of(&without(scene, &left_out).world);
    record.keep_active_camera();
    let text = updated("", &record);
    output.write(|writer| write!(writer, "# {comments}\n\n{text}"))?;
    say(&format!("wrote {}: {found}", output.name()));
    Ok(())
}
