//! The command `trade`: the cost of each shading method in one view, and its error.
//!
//! ```text
//!            +-- timing, batch: frames by the clock, in turns ---+
//! Request ---+                                                   +-- front --> Report --> export, plot, error_map
//!            +-- accuracy: pictures against the reference -------+
//! ```
//! Measuring and reporting are apart: a [`Report`] is data, and every text and picture is a pure function of it.

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
pub mod record;
pub mod timing;
pub mod verdict;

use std::path::Path;
use std::time::Duration;

use rayon::prelude::*;

pub use self::measurement::{Measurement, Request};
use self::record::Subject;
pub use self::record::{MethodReport, Report};
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
    let accuracies = accuracy::of_methods(request, monitor)?;
    let mut methods = Vec::new();
    let measured = request.methods.iter().zip(timings).zip(accuracies);
    for ((method, timing), (counts, accuracy)) in measured {
        let pixels = counts.covered_pixels;
        methods.push(MethodReport {
            method: *method,
            threads: request.threads,
            ns_per_covered_pixel: (pixels > 0).then(|| timing.median * 1e6 / pixels as f64),
            timing,
            counts,
            accuracy,
            on_front: false,
        });
    }
    let mut report = Report {
        subject: Subject::of(request),
        covered_pixels: methods.first().map_or(0, |one| one.counts.covered_pixels),
        methods,
    };
    let front = measurement::on_front(&report.measurements());
    for (one, on_front) in report.methods.iter_mut().zip(front) {
        one.on_front = on_front;
    }
    Ok(report)
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
        let id = one.method.id;
        let title = format!("{id}: error against exact Phong, in levels");
        let (pixels, size) = error_map::with_legend(&one.accuracy.map, report.subject.size, &title);
        Output::File(folder.join(format!("error-{id}.png"))).write_png(&pixels, size)
    })
}
