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
pub mod plot;
pub mod timing;
pub mod verdict;

use std::path::Path;
use std::time::Duration;

use serde::{Serialize, Serializer};

use self::machine::Machine;
use self::timing::{Batch, Timing};
use crate::output::progress::with_bar;
use crate::output::words::short;
use crate::output::{self, Monitor, Output, files, one_line, quoted};
use crate::questions::job::{Drawing, Heading};
use crate::questions::metrics::ErrorStatistics;
use crate::shading::Method;
use crate::systems::frame::Counts;

/// The files of a report.
const FILES: [&str; 3] = ["trade.json", "trade.md", "trade.svg"];

/// The view and the methods to measure.
pub struct Request {
    /// Each method overrides its shading and tolerance. Its threads draw the timed frames; 1 is the calling thread alone.
    pub drawing: Drawing,
    pub methods: Vec<Method>,
    /// The time for timing frames, of all methods together. Each gets [`timing::MIN_SAMPLES`] in any case.
    pub time: Duration,
    /// Whether `own_error` is found, which only a report shows.
    pub is_report: bool,
}

impl Request {
    /// The methods whose frames are timed.
    pub fn timed(&self) -> impl Iterator<Item = &Method> {
        self.methods.iter().filter(|it| is_timed(**it))
    }
}

/// The methods of a request, measured or left out.
#[derive(Clone, Debug, Default)]
pub struct Measured {
    /// In the order of the request.
    pub methods: Vec<Measurement>,
    pub left_out: Vec<LeftOut>,
    /// The time in which all of them were timed.
    pub time: Duration,
}

impl Measured {
    /// Whether a method was measured or left out.
    pub fn knows(&self, method: Method) -> bool {
        let measured = self.methods.iter().map(|it| it.method);
        let mut all = measured.chain(self.left_out.iter().map(|it| it.method));
        all.any(|it| it == method)
    }
}

/// A method whose grids do not fit in memory: a record of `trade.json`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LeftOut {
    #[serde(flatten)]
    pub method: Method,
    pub reason: String,
}

/// A measurement of methods, with the view and the machine: enough to judge the times and to repeat it.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    pub machine: Machine,
    /// The command line.
    pub command: String,
    #[serde(flatten)]
    pub heading: Heading,
    /// Pixels that show a cuboid.
    pub covered_pixels: u64,
    /// In the order of [`crate::shading::METHODS`].
    pub methods: Vec<Measurement>,
    pub left_out: Vec<LeftOut>,
}

/// The time of one method in a view, and its error: a record of `trade.json`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Measurement {
    #[serde(flatten)]
    pub method: Method,
    /// The threads that drew.
    pub threads: usize,
    /// Milliseconds of a whole warm frame; no samples, and `null` in JSON, of what the reference draws.
    #[serde(rename = "ms", serialize_with = "null_if_empty")]
    pub timing: Timing,
    /// Nanoseconds of a frame for each covered pixel; `None` if there is none.
    pub ns_per_covered_pixel: Option<f64>,
    /// The work for a frame; the same on every machine.
    pub counts: Counts,
    /// The error against exact Phong; `None` if no pixel can be compared.
    pub error: Option<ErrorStatistics>,
    /// The error against the exact evaluation of the method's own mode; `None` if no pixel can be compared.
    pub own_error: Option<ErrorStatistics>,
    /// Pixels at which the method and exact Phong show different faces.
    pub edge_pixels: u64,
    /// The share of the highlight that is in its place, 0..=1; `None` if exact Phong shows none.
    pub highlight_kept: Option<f64>,
    /// Whether it is a best trade: no other method beats it ([`mark_front`]).
    pub on_front: bool,
}

fn null_if_empty<S: Serializer>(timing: &Timing, serializer: S) -> Result<S::Ok, S::Error> {
    (timing.samples > 0).then_some(timing).serialize(serializer)
}

impl Measurement {
    /// The largest error against exact Phong, in levels of 255.
    pub fn largest_error(&self) -> Option<f64> {
        self.error.map(|it| it.max)
    }
}

/// Measures the methods of `request`. Errors that are `known` from the same view are not computed again, and the timing with
/// more samples stays. `time_batch` times the batch with this number of a request.
///
/// # Errors
/// If memory or threads do not suffice, or the work is cancelled.
pub async fn measure(
    request: &Request,
    known: &Measured,
    time_batch: impl AsyncFn(&Request, usize, Monitor<'_>) -> anyhow::Result<Batch>,
    monitor: Monitor<'_>,
) -> anyhow::Result<Measured> {
    let mut unknown = request.methods.clone();
    unknown.retain(|it| !known.knows(*it));
    let mut found = accuracy::errors(request, &unknown, monitor).await?;
    found.left_out.extend_from_slice(&known.left_out);
    found.methods.extend_from_slice(&known.methods);
    let of_method = |it: &Method| found.methods.iter().find(|one| one.method == *it);
    let mut measured: Vec<Measurement> = (request.methods.iter())
        .filter_map(of_method)
        .cloned()
        .collect();
    let request = &Request {
        drawing: request.drawing.snapshot(),
        methods: measured.iter().map(|it| it.method).collect(),
        ..*request
    };
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
    // The error as it is printed: a difference that is not shown decides nothing.
    let printed = |it: &Measurement| match it.largest_error() {
        Some(error) if is_timed(it.method) => short(error).parse().unwrap_or(0.0),
        _ => f64::INFINITY,
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
        heading: drawing.heading(),
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
