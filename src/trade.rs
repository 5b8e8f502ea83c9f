//! The command `trade`: the cost of each shading method in one view, and its error.
//!
//! ```text
//!            +-- timing, batch: frames by the clock, in turns ---+
//! Request ---+                                                   +-- front --> Report --> export, plot, error_map
//!            +-- accuracy: pictures against the reference -------+
//! ```
//! Measuring and reporting are apart: a [`Report`] is data, and every text and picture is a pure function of it. JSON has
//! its fields; a figure that does not exist is `null` there.

pub mod accuracy;
pub mod batch;
pub mod budget;
pub mod error_map;
pub mod export;
pub mod flip;
pub mod live;
pub mod machine;
pub mod measurement;
pub mod metrics;
pub mod plot;
pub mod timing;
pub mod verdict;

use std::path::Path;
use std::time::Duration;

use rayon::prelude::*;

use self::machine::Machine;
pub use self::measurement::{Measurement, Report, Request};
use self::timing::Batch;
use crate::output::{self, Output};
use crate::report::Monitor;
use crate::report::progress::with_bar;
use crate::report::words::counted;

/// The default time for timing frames.
pub const USUAL_TIME: Duration = Duration::from_secs(20);

/// Times the batch with this number.
type TimeBatch = fn(&Request, usize, Monitor) -> anyhow::Result<Batch>;

/// Measures the methods of `request`.
///
/// # Errors
/// If memory or threads do not suffice, or the work is cancelled.
pub fn measure(
    request: &Request,
    time_batch: TimeBatch,
    monitor: Monitor,
) -> anyhow::Result<Report> {
    accuracy::check_memory(request.view.size)?;
    let timings = timing::of_batches(
        |number| time_batch(request, number, monitor),
        |share| (monitor.progress)("timing frames", share),
    )?;
    let mut methods = accuracy::errors(request, request.methods.clone(), monitor)?;
    let details = accuracy::details(request, monitor)?;
    let covered_pixels = details.first().map_or(0, |it| it.counts.covered_pixels);
    for ((one, timing), details) in methods.iter_mut().zip(timings).zip(details) {
        let time = timing.median * 1e6 / covered_pixels as f64;
        one.ns_per_covered_pixel = (covered_pixels > 0).then_some(time);
        one.timing = timing;
        one.details = Some(details);
    }
    measurement::mark_front(&mut methods);
    Ok(Report {
        machine: Machine::this(request.level),
        command: request.command.clone(),
        scene: request.scene.name.clone(),
        camera: request.camera.clone(),
        projection: request.view.projection,
        size: request.view.size,
        covered_pixels,
        methods,
    })
}

/// The command: measures, prints the table, and writes the files into the folder `out` if there is one.
///
/// # Errors
/// If the methods cannot be measured or a file cannot be written.
pub fn run(request: &Request, out: Option<&Path>) -> anyhow::Result<()> {
    if let Some(folder) = out {
        output::make_folder(folder)?;
    }
    let report = with_bar(|monitor| measure(request, batch::time_in_a_process, monitor))?;
    Output::Stdout.write(|writer| writer.write_all(export::table(&report).as_bytes()))?;
    if let Some(folder) = out {
        write_files(&report, folder)?;
        output::say(&format!(
            "wrote trade.json, trade.md, trade.svg and {} into {}",
            counted(report.methods.len(), "error map"),
            folder.display()
        ));
    }
    Ok(())
}

/// Writes `trade.json`, `trade.md`, `trade.svg` and an error map for every method into an existing folder.
///
/// # Errors
/// If one of them cannot be written.
pub fn write_files(report: &Report, folder: &Path) -> anyhow::Result<()> {
    let files = [
        ("trade.json", output::json(report)?),
        ("trade.md", export::markdown(report)),
        ("trade.svg", plot::svg(report)?),
    ];
    output::write_texts(folder, &files)?;
    report.methods.par_iter().try_for_each(|one| {
        let (id, details) = (one.method.id, one.details.as_ref());
        let map = details.map_or(&[][..], |it| &it.map);
        let title = format!("{id}: error against exact Phong, in levels");
        let (pixels, size) = error_map::with_legend(map, report.size, &title);
        Output::File(folder.join(format!("error-{id}.png"))).write_png(&pixels, size)
    })
}
