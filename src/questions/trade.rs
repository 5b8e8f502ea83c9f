//! The command `trade`: the cost of each shading method in one view, and its error.
//!
//! ```text
//!            +-- accuracy: pictures against the reference -------+
//! Request ---+                                                   +-- measure --> Report --> export, plot
//!            +-- timing, batch: frames by the clock, in turns ---+
//! ```
//! Measuring and reporting are apart: a [`Report`] is data, and every text and picture is a pure function of it. JSON has
//! its fields; a figure that does not exist is `null` there. The window measures in the same way, without a report.
//!
//! ```text
//! error |  o            o   on the front
//!       |     o    x    x   beaten
//!       |        o      x
//!       +---------------- time
//! ```
//! The methods on the front are the best trades: no other method is both faster and more exact. Of two with equal errors the
//! faster is on it.

pub mod accuracy;
pub mod batch;
pub mod budget;
pub mod export;
pub mod machine;
pub mod measurement;
pub mod plot;
pub mod timing;
pub mod verdict;

use std::path::Path;

use self::machine::Machine;
pub use self::measurement::{LeftOut, Measured, Measurement, Report, Request};
use self::timing::Batch;
use crate::output::Monitor;
use crate::output::files;
use crate::output::progress::with_bar;
use crate::output::words::short;
use crate::output::{self, Output, one_line, quoted};
use crate::questions::job::camera_name;
use crate::shading::Method;

/// The files of a report.
pub const FILES: [&str; 3] = ["trade.json", "trade.md", "trade.svg"];

/// Measures the methods of `request`. What is `known` from the same view is not computed again, and of two timings
/// the one with more samples stays. `time_batch` times the batch with this number of a request.
///
/// # Errors
/// If memory or threads do not suffice, or the work is cancelled.
pub async fn measure(
    request: &Request,
    known: &Measured,
    time_batch: impl AsyncFn(&Request, usize, Monitor<'_>) -> anyhow::Result<Batch>,
    monitor: Monitor<'_>,
) -> anyhow::Result<Measured> {
    let of_method = |method: &Method| known.methods.iter().find(|it| it.method == *method);
    let mut unknown = request.methods.clone();
    unknown.retain(|it| !known.knows(*it));
    let mut found = accuracy::errors(request, &unknown, monitor).await?;
    found.left_out.extend_from_slice(&known.left_out);
    let mut errors = found.methods.into_iter().peekable();
    let methods = request.methods.iter();
    let measured = methods.filter_map(|it| {
        of_method(it)
            .cloned()
            .or_else(|| errors.next_if(|next| next.method == *it))
    });
    let mut measured: Vec<Measurement> = measured.collect();
    let request = &request.with(measured.iter().map(|it| it.method));
    let timings = timing::of_batches(
        async |number| time_batch(request, number, monitor).await,
        |share| (monitor.progress)("timing frames", share),
    )
    .await?;
    let timed = measured.iter_mut().filter(|it| is_timed(it.method));
    for (one, timing) in timed.zip(timings) {
        if timing.samples >= one.timing.samples {
            one.timing = timing;
        }
        let covered = one.counts.covered_pixels;
        let time = one.timing.median * 1e6 / covered as f64;
        one.ns_per_covered_pixel = (covered > 0).then_some(time);
    }
    mark_front(&mut measured);
    Ok(Measured {
        methods: measured,
        left_out: found.left_out,
        time: request.time,
    })
}

/// Whether the renderer draws a method, so that its time is comparable.
pub fn is_timed(method: Method) -> bool {
    method.mode.is_drawn()
}

/// Marks the methods on the front. From the fastest on, each of them errs less than all before. A method without an error or
/// without a comparable time is not on it.
pub fn mark_front(methods: &mut [Measurement]) {
    // An error as it is printed, so that no difference decides that is not shown.
    let printed = |it: &Measurement| {
        let error = it.largest_error().filter(|_| is_timed(it.method));
        let digits = |error| short(error).parse().unwrap_or(0.0);
        error.map_or(f64::INFINITY, digits)
    };
    let mut methods: Vec<&mut Measurement> = methods.iter_mut().collect();
    methods.sort_by(|one, other| {
        let by_time = one.timing.median.total_cmp(&other.timing.median);
        by_time.then(printed(one).total_cmp(&printed(other)))
    });
    let mut least = f64::INFINITY;
    for one in methods {
        one.on_front = printed(one) < least;
        least = least.min(printed(one));
    }
}

/// The methods on the front, the fastest and least exact first.
pub fn front<'a>(methods: impl IntoIterator<Item = &'a Measurement>) -> Vec<&'a Measurement> {
    let mut front: Vec<_> = methods.into_iter().filter(|it| it.on_front).collect();
    front.sort_by(|one, other| one.timing.median.total_cmp(&other.timing.median));
    front
}

/// Measures the methods of a request for a report.
///
/// # Errors
/// As [`measure()`].
pub async fn measure_report(
    request: &Request,
    time_batch: impl AsyncFn(&Request, usize, Monitor<'_>) -> anyhow::Result<Batch>,
    monitor: Monitor<'_>,
) -> anyhow::Result<Report> {
    let drawing = &request.drawing;
    let none = Measured::default();
    let Measured {
        methods, left_out, ..
    } = measure(request, &none, time_batch, monitor).await?;
    let timed = methods.iter().find(|it| is_timed(it.method));
    let covered = timed.or(methods.first());
    let covered_pixels = covered.map_or(0, |it| it.counts.covered_pixels);
    let arguments = std::env::args_os().skip(1);
    let words: Vec<String> = arguments.map(|it| quoted(&it.to_string_lossy())).collect();
    Ok(Report {
        machine: Machine::this(drawing.level),
        command: format!("shadetrade {}", words.join(" ")),
        scene: drawing.scene.name.clone(),
        camera: camera_name(&drawing.scene.world),
        projection: drawing.view().projection,
        size: drawing.size,
        covered_pixels,
        methods,
        left_out,
    })
}

/// The command: measures, prints the table, and writes the files into the folder `out` if there is one.
///
/// # Errors
/// If the methods cannot be measured or a file cannot be written.
pub fn run(request: &Request, out: Option<&Path>) -> anyhow::Result<()> {
    if let Some(folder) = out {
        files::make_folder(folder)?;
    }
    let report =
        with_bar(async |monitor| measure_report(request, batch::time_in_a_process, monitor).await)?;
    Output::Stdout.write(export::table(&report))?;
    request.drawing.say_if_unseen(report.covered_pixels);
    if let Some(folder) = out {
        write_files(&report, folder)?;
        output::say(&format!(
            "wrote trade.json, trade.md and trade.svg into {}",
            one_line(folder)
        ));
    }
    Ok(())
}

/// Writes [`FILES`] into an existing folder.
///
/// # Errors
/// If one of them cannot be written.
fn write_files(report: &Report, folder: &Path) -> anyhow::Result<()> {
    let texts = [
        output::json(report)?,
        export::markdown(report),
        plot::svg(report)?,
    ];
    output::write_into(folder, FILES.into_iter().zip(texts))
}
