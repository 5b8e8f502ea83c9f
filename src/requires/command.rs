//! A [`Drawing`] in; what it requires as a table or JSON, and the least scene as a file, out.
//!
//! Rule: the file is a scene that is read as it stands; comments say what was left out of it and what that errs.

use serde::Serialize;

use super::least::Least;
use super::share::time_share;
use super::{Change, Part, changes, parts};
use crate::components::{Orbit, ShadingMode, View};
use crate::drawing::Drawing;
use crate::output::{Output, printable, say};
use crate::scene::Scene;
use crate::trade::progress::{Progress, with_bar};
use crate::trade::tables::{aligned, wrapped};
use crate::trade::words::short;

/// What `--json` prints.
#[derive(Serialize)]
struct Record<'a> {
    scene: &'a str,
    tolerance: f64,
    views: usize,
    parts: Vec<Row>,
}

#[derive(Clone, Serialize)]
struct Row {
    #[serde(skip)]
    left_out: Part,
    part: String,
    /// At least, and at most.
    largest_error: [f64; 2],
    /// In all views together.
    pixels: u64,
    time_share: Option<f64>,
    required: bool,
    /// In how many views.
    required_in: usize,
}

const LEGEND: &str = "largest error: what leaving out that part alone changes, in levels of 255, proven; pixels: how many \
    change by more than the tolerance; time: share of a frame on one thread, - where the renderer cannot do without; \
    required: not proven to keep the tolerance without it.";

/// Finds what a picture requires, prints it, and writes the least scene if one is asked for.
///
/// # Errors
/// When the picture does not fit in memory, or something cannot be written.
pub fn run(
    drawing: &Drawing,
    orbit: usize,
    least: Option<&Output>,
    as_json: bool,
) -> anyhow::Result<()> {
    let (scene, views) = (scene(drawing), views(drawing, orbit));
    let rows = rows(drawing, &scene, &views)?;
    let text = if as_json {
        serde_json::to_string_pretty(&Record {
            scene: &drawing.scene.name,
            tolerance: drawing.tolerance,
            views: views.len(),
            parts: rows.clone(),
        })?
    } else {
        let table = table(&rows, views.len());
        let texts = [
            subject(drawing, &scene, views.len()),
            table,
            wrapped(LEGEND),
        ];
        printable(&texts.join("\n\n"))
    };
    Output::Stdout.write(|writer| writeln!(writer, "{text}"))?;
    match least {
        Some(output) => write_least(drawing, &scene, &views, &rows, output),
        None => Ok(()),
    }
}

/// The scene as the options have it, with one camera.
fn scene(drawing: &Drawing) -> Scene {
    let mut record = drawing.scene.to_record();
    if let Some(mode) = drawing.shading {
        for cuboid in &mut record.cuboid.value {
            *cuboid.shading = mode;
        }
    }
    record.camera.value = vec![record.camera.swap_remove(drawing.camera)];
    Scene::spawn(drawing.scene.name.clone(), &record)
}

/// So many views, evenly round the camera's target, at its height; the first is the camera's own.
fn views(drawing: &Drawing, count: usize) -> Vec<View> {
    let view = View {
        shading: None,
        ..drawing.view()
    };
    let turned = |number: usize| {
        let azimuth = 360.0 * number as f64 / count as f64;
        let orbit = Orbit {
            azimuth: if azimuth > 180.0 {
                azimuth - 360.0
            } else {
                azimuth
            },
            ..Orbit::default()
        };
        View {
            viewpoint: view.viewpoint.orbited(&orbit),
            ..view.clone()
        }
    };
    (0..count).map(turned).collect()
}

/// A row for each part.
fn rows(drawing: &Drawing, scene: &Scene, views: &[View]) -> anyhow::Result<Vec<Row>> {
    with_bar(|on_progress| {
        let parts = parts(scene);
        let progress = |step, share| on_progress(Progress { step, share });
        let left_out: Vec<Vec<Part>> = parts.iter().map(|part| vec![*part]).collect();
        let by_view = changes(scene, views, &left_out, &|share| {
            progress("leaving out", share);
        });
        let row = |(index, part): (usize, &Part)| {
            progress("timing", index as f64 / parts.len() as f64);
            let mut sum = Change::default();
            let mut required_in = 0;
            for changes in &by_view {
                sum.append(changes[index]);
                required_in += usize::from(!changes[index].keeps(drawing.tolerance));
            }
            anyhow::Ok(Row {
                left_out: *part,
                part: part.name(scene),
                largest_error: sum.largest_error,
                pixels: sum.pixels,
                time_share: time_share(scene, views, *part, drawing.level)?,
                required: required_in > 0,
                required_in,
            })
        };
        parts.iter().enumerate().map(row).collect()
    })
}

/// What was looked at.
fn subject(drawing: &Drawing, scene: &Scene, views: usize) -> String {
    let [width, height] = drawing.size;
    let mut query = scene.world.query::<&ShadingMode>();
    let mut modes: Vec<&str> = query.iter().map(|mode| mode.name()).collect();
    modes.sort_unstable();
    modes.dedup();
    let orbit = if views > 1 {
        format!(", {views} views round its target")
    } else {
        String::new()
    };
    format!(
        "{}, camera {}{orbit}, {}, {width}x{height}, {}, tolerance {}",
        drawing.scene.name,
        scene.camera_names()[0],
        drawing.projection.name(),
        modes.join(" and "),
        drawing.tolerance
    )
}

/// The parts that err most first.
fn table(rows: &[Row], views: usize) -> String {
    let mut sorted: Vec<&Row> = rows.iter().collect();
    sorted.sort_by(|left, right| right.largest_error[1].total_cmp(&left.largest_error[1]));
    let cells = |row: &&Row| {
        vec![
            row.part.clone(),
            error(row.largest_error),
            row.pixels.to_string(),
            row.time_share
                .map_or_else(|| "-".to_owned(), |share| format!("{:.0} %", 100.0 * share)),
            match (row.required_in, views) {
                (0, _) => "no".to_owned(),
                (_, 1) => "yes".to_owned(),
                (some, all) => format!("in {some} of {all}"),
            },
        ]
    };
    let head = ["part", "largest error", "pixels", "time", "required"].map(str::to_owned);
    aligned(&head, &sorted.iter().map(cells).collect::<Vec<_>>())
}

/// An interval in as few words as say it.
fn error([least, most]: [f64; 2]) -> String {
    let [from, to] = [least, most].map(|level| short(Some(level)));
    if from == to || least == 0.0 && most < 0.001 {
        to
    } else if least == 0.0 {
        format!("at most {to}")
    } else {
        format!("{from} to {to}")
    }
}

/// Writes the least scene that keeps the tolerance, of those parts that a scene file can do without.
fn write_least(
    drawing: &Drawing,
    scene: &Scene,
    views: &[View],
    rows: &[Row],
    output: &Output,
) -> anyhow::Result<()> {
    let is_of_scene = |part| matches!(part, Part::Light(_) | Part::EveryPixel(_) | Part::Cuboid(_));
    let mut rows: Vec<&Row> = rows.iter().filter(|row| !row.required).collect();
    rows.retain(|row| is_of_scene(row.left_out));
    rows.sort_by(|left, right| left.largest_error[1].total_cmp(&right.largest_error[1]));
    let candidates: Vec<Part> = rows.iter().map(|row| row.left_out).collect();
    let least = with_bar(|on_progress| {
        let step = "looking for the least scene";
        anyhow::Ok(Least::find(scene, views, &candidates, &|share| {
            on_progress(Progress { step, share });
        }))
    })?;
    let names: Vec<String> = least.left_out.iter().map(|part| part.name(scene)).collect();
    let [_, most] = least.change.largest_error;
    let found = if names.is_empty() {
        "nothing can be left out".to_owned()
    } else {
        let most = (1e4 * most).ceil() / 1e4;
        format!(
            "left out: {}; errs at most {most} levels, proven",
            names.join(", ")
        )
    };
    let comments = [
        "The least scene that keeps the tolerance, found by `shadetrade requires`.".to_owned(),
        subject(drawing, scene, views.len()),
        found.clone(),
    ];
    // A name may hold a line break, which would end the comment.
    let comments =
        comments.map(|line| format!("# {}\n", line.replace(char::is_control, "\u{fffd}")));
    let text = super::without(scene, &least.left_out).to_toml();
    output.write(|writer| write!(writer, "{}\n{text}", comments.concat()))?;
    say(&format!("wrote {}: {found}", output.name()));
    Ok(())
}
