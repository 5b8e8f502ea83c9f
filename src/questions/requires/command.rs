//! The command `requires`: prints a table or JSON, and writes a reduced scene.
//!
//! The reduced scene is a valid scene file. Its comments list the parts left out and their error.

use serde_json::json;

use super::segments::{FewestSegments, fewest_segments};
use super::{Part, PartChange, least, part_changes, ranked, without};
use crate::components::View;
use crate::output::progress::with_bar;
use crate::output::words::{aligned, interval, joined, short, wrapped};
use crate::output::{Output, one_line, print, say};
use crate::questions::job::Drawing;
use crate::scene::{Scene, SceneRecord, updated};

const LEGEND: &str = "One part is left out at a time. largest error: in levels of 255, proven; pixels: pixels with an error \
    above the tolerance, proven; required: yes, unless leaving the part out is proven to keep the tolerance.";

const LEGEND_OF_SEGMENTS: &str = "segments: the fewest along an edge, 1 to 256, with which Gouraud is proven to keep the \
    tolerance against exact Phong, while all other cuboids have exact Phong; largest error: with so many segments, or with 256, in levels \
    of 255, proven.";

/// Prints the parts and the segments that a picture requires, and writes a reduced scene to `least_scene`.
///
/// # Errors
/// If the picture does not fit in memory or the output cannot be written.
pub fn run(drawing: &Drawing, least_scene: Option<&Output>, as_json: bool) -> anyhow::Result<()> {
    let (subject, view) = (drawing.subject(), drawing.view());
    let rows = with_bar(async |monitor| part_changes(&drawing.scene, &view, monitor).await)?;
    let segments = with_bar(async |monitor| fewest_segments(&drawing.scene, &view, monitor).await)?;
    let record = json!({
        "scene": drawing.scene.name,
        "tolerance": view.tolerance,
        "views": 1,
        "parts": rows,
        "segments": segments,
    });
    let rows = ranked(rows);
    print(&record, as_json, least_scene, || {
        let parts = [subject.clone(), table(&rows), wrapped(LEGEND)];
        let segments = [table_of_segments(&segments), wrapped(LEGEND_OF_SEGMENTS)];
        [&parts[..], &segments[..]].concat().join("\n\n")
    })?;
    match least_scene {
        Some(output) => write_least(&subject, &drawing.scene, &view, rows, output),
        None => Ok(()),
    }
}

/// The table of these parts.
fn table(rows: &[PartChange]) -> String {
    let cells = |row: &PartChange| {
        [
            one_line(&row.name),
            interval(row.change.largest_error, short),
            row.change.pixels.to_string(),
            if row.required { "yes" } else { "no" }.to_owned(),
        ]
    };
    let head = ["part", "largest error", "pixels", "required"];
    aligned(&head, rows.iter().map(cells))
}

/// The table of the segments that cuboids require.
fn table_of_segments(rows: &[FewestSegments]) -> String {
    let cells = |row: &FewestSegments| {
        [
            one_line(&row.cuboid),
            row.count(),
            interval(row.largest_error, short),
        ]
    };
    let head = ["cuboid under Gouraud", "segments", "largest error"];
    aligned(&head, rows.iter().map(cells))
}

/// Writes a scene without parts that it does not require. Only parts that a scene file can leave out are tried, each once,
/// the part with the least error first. Another order might leave out more.
fn write_least(
    subject: &str,
    scene: &Scene,
    view: &View,
    mut rows: Vec<PartChange>,
    output: &Output,
) -> anyhow::Result<()> {
    rows.retain(|row| row.part.is_in_file() && !row.required);
    rows.sort_by(|one, other| one.change.most().total_cmp(&other.change.most()));
    let candidates: Vec<Part> = rows.iter().map(|row| row.part).collect();
    let (left_out, change) =
        with_bar(async |monitor| least(scene, view, &candidates, monitor).await)?;
    rows.retain(|row| left_out.contains(&row.part));
    let names = joined(rows.into_iter().map(|row| row.name), ", ");
    let found = if names.is_empty() {
        "no light, cuboid, Phong shading or corner normals can be left out".to_owned()
    } else {
        let most = (1e4 * change.most()).ceil() / 1e4;
        format!("left out: {names}; errs by at most {most} levels, proven")
    };
    // A line break in a name would end the comment.
    let sentence = format!("The least scene for {subject}: {found}.");
    let comments = wrapped(&sentence.replace(char::is_control, "\u{fffd}")).replace('\n', "\n# ");
    let mut record = SceneRecord::of(&without(scene, &left_out).world);
    record.keep_active_camera();
    // The file gets the tolerance that was proven, and no budget.
    (record.view.tolerance, record.view.budget) = (view.tolerance, None);
    let text = updated("", &record);
    output.write(format!("# {comments}\n\n{text}"))?;
    say(&format!("wrote {}: {found}", output.name()));
    Ok(())
}
