//! One view of a scene in; what each shading method costs and how far it errs out.
//!
//! ```text
//!            +-- timing: frames by the clock, methods in turns --+
//! Request ---+                                                   +-- front --> Report --> report, json, csv, plot, error_map
//!            +-- accuracy: pictures against the reference -------+
//! ```
//! What time grows with is measured apart: [`scale`].
//!
//! Rule: measuring and reporting are apart: a [`Report`] is data, what is made of it is a pure function of it, and a
//! quantity that does not exist is `None`, never a number that is none.

pub mod accuracy;
pub(crate) mod chart;
pub mod csv;
pub mod error_map;
pub mod flip;
pub mod front;
pub mod json;
pub mod machine;
pub mod metrics;
pub mod plot;
pub(crate) mod progress;
pub mod report;
pub mod scale;
pub mod subject;
pub mod tables;
pub mod timing;
pub mod verdict;
pub(crate) mod words;

use std::path::Path;
use std::time::Duration;

use anyhow::Context;
use fearless_simd::Level;
use rayon::ThreadPoolBuildError;
use rayon::prelude::*;

use crate::components::View;
use crate::drawing::{Drawing, all_cores};
use crate::frame::{Counts, Frame, Keep, Workers};
use crate::memory::OutOfMemory;
use crate::output::{self, Output};
use crate::scene::Scene;
use crate::shading::{METHODS, Method};
use crate::systems;
use accuracy::Accuracy;
use front::Candidate;
pub use progress::Progress;
use subject::Subject;
use timing::Timing;

/// How long all frames are timed together unless asked otherwise.
pub const USUAL_TIME: Duration = Duration::from_secs(20);

/// The same for those in a hurry: no more than the least number of samples.
pub const QUICK_TIME: Duration = Duration::ZERO;

/// Samples of each method however little time there is: below that a median says little.
pub const LEAST_SAMPLES: usize = 30;

/// What to measure.
pub struct Request {
    /// With the lights on that are to shine.
    pub scene: Scene,
    /// What the camera is called.
    pub camera: String,
    /// How it is seen; shading and tolerance are each method's own.
    pub view: View,
    /// How many threads draw the frames that are timed; 1 is the calling thread alone.
    pub threads: usize,
    /// The SIMD level that draws.
    pub level: Level,
    /// How long all frames are timed together; every method gets [`LEAST_SAMPLES`] even of no time at all.
    pub time: Duration,
    /// The command line, for those who want to repeat it.
    pub command: String,
}

impl Request {
    /// To measure `drawing`, whatever its shading and tolerance, for about this `time`.
    pub fn new(drawing: Drawing, time: Duration, command: String) -> Self {
        let view = drawing.view();
        let mut cameras = drawing.scene.camera_names();
        Request {
            camera: cameras.swap_remove(drawing.camera),
            scene: drawing.scene,
            view,
            threads: drawing.threads,
            level: drawing.level,
            time,
            command,
        }
    }
}

/// What was measured.
#[derive(Clone, Debug)]
pub struct Report {
    /// Of which view, and where.
    pub subject: Subject,
    /// Pixels on which something is drawn.
    pub covered_pixels: u64,
    /// In the order of [`METHODS`].
    pub methods: Vec<Measurement>,
}

/// What one method costs and how far it errs.
#[derive(Clone, Debug)]
pub struct Measurement {
    /// The method.
    pub method: Method,
    /// How many threads drew.
    pub threads: usize,
    /// Milliseconds of a whole warm frame.
    pub timing: Timing,
    /// What a frame evaluates; the same on every machine.
    pub counts: Counts,
    /// How true its picture is.
    pub accuracy: Accuracy,
    /// Whether nothing beats it in error and time both.
    pub on_front: bool,
}

impl Measurement {
    /// Nanoseconds of a frame for each pixel on which something is drawn; `None` where nothing is.
    pub fn ns_per_covered_pixel(&self) -> Option<f64> {
        let pixels = self.counts.covered_pixels;
        (pixels > 0).then(|| self.timing.median * 1e6 / pixels as f64)
    }

    /// The largest error against exact Phong, in levels; `None` where nothing can be compared.
    pub fn max_error(&self) -> Option<f64> {
        self.accuracy.error.error.map(|error| error.max)
    }
}

/// Why a measurement could not be made.
#[derive(Debug, thiserror::Error)]
pub enum TradeError {
    /// The picture is too large.
    #[error("the methods cannot be compared")]
    Memory(#[from] OutOfMemory),
    /// The system gives no threads.
    #[error("cannot start the threads that draw")]
    Threads(#[from] ThreadPoolBuildError),
    /// Nobody wants to know any more.
    #[error("the measurement was cancelled")]
    Cancelled,
}

/// Measures all [`METHODS`]; `progress` hears from any thread how far it is.
///
/// # Errors
/// When memory or threads do not suffice.
pub fn measure(
    request: Request,
    progress: &(dyn Fn(Progress) + Sync),
) -> Result<Report, TradeError> {
    measure_unless(request, &|| false, progress)
}

/// The same; `cancelled` is asked before every frame and every row of the reference, and a yes ends it.
///
/// # Errors
/// As [`measure`], and [`TradeError::Cancelled`].
pub fn measure_unless(
    mut request: Request,
    cancelled: &(dyn Fn() -> bool + Sync),
    progress: &(dyn Fn(Progress) + Sync),
) -> Result<Report, TradeError> {
    accuracy::check_memory(request.view.size)?;
    let telling = |step| move |share| progress(Progress { step, share });
    let timed = time_frames(&mut request, cancelled, telling("timing frames"))?;
    let accuracies = accuracy::of_methods(
        &mut request.scene,
        &request.view,
        Workers::new(all_cores(), request.level)?,
        cancelled,
        &telling("comparing pictures"),
    )?;
    let candidates: Vec<Candidate> = timed
        .iter()
        .zip(&accuracies)
        .map(|((timing, _), accuracy)| Candidate {
            error: accuracy.error.error.map(|error| error.max),
            timing: *timing,
        })
        .collect();
    let measured = METHODS.iter().zip(timed).zip(accuracies);
    let methods: Vec<Measurement> = measured
        .zip(front::on_front(&candidates))
        .map(
            |(((method, (timing, counts)), accuracy), on_front)| Measurement {
                method: *method,
                threads: request.threads,
                timing,
                counts,
                accuracy,
                on_front,
            },
        )
        .collect();
    Ok(Report {
        subject: Subject::of(&request),
        covered_pixels: methods
            .first()
            .map_or(0, |method| method.counts.covered_pixels),
        methods,
    })
}

/// The times of all [`METHODS`], and what each counts.
///
/// All draw into one frame, as a window does, so that none has a better place in memory than another.
fn time_frames(
    request: &mut Request,
    cancelled: &(dyn Fn() -> bool + Sync),
    progress: impl Fn(f64),
) -> Result<Vec<(Timing, Counts)>, TradeError> {
    let workers = Workers::new(request.threads, request.level)?;
    let mut frame = Frame::new(Keep::Display, workers);
    let views: Vec<View> = METHODS
        .iter()
        .map(|method| accuracy::drawn_by(method, &request.view))
        .collect();
    let mut counts = vec![Counts::default(); METHODS.len()];
    let draw = |method: usize| -> Result<(), TradeError> {
        if cancelled() {
            return Err(TradeError::Cancelled);
        }
        systems::draw(&mut request.scene.world, &views[method], &mut frame)?;
        counts[method] = frame.counts();
        Ok(())
    };
    let timings = timing::in_turns(METHODS.len(), LEAST_SAMPLES, request.time, draw, progress)?;
    Ok(timings.into_iter().zip(counts).collect())
}

/// The command: measures, prints the table, and writes everything into the folder `out` if there is one.
///
/// # Errors
/// When it could not be measured or written.
pub fn run(request: Request, out: Option<&Path>) -> anyhow::Result<()> {
    if let Some(folder) = out {
        make_writable(folder)?;
    }
    let report = progress::with_bar(|progress| measure(request, progress))?;
    Output::Stdout.write(|writer| writer.write_all(report::table(&report).as_bytes()))?;
    if let Some(folder) = out {
        write_files(&report, folder)?;
        output::say(&format!(
            "wrote trade.json, trade.csv, trade.md, trade.svg and {} error maps into {}",
            report.methods.len(),
            folder.display()
        ));
    }
    Ok(())
}

/// Makes the folder unless it is there: better to hear now than after the measurement that nothing can be written there.
pub(crate) fn make_writable(folder: &Path) -> anyhow::Result<()> {
    output::make_folder(folder)?;
    tempfile::tempfile_in(folder)
        .with_context(|| format!("cannot write into {}", folder.display()))?;
    Ok(())
}

/// Writes `trade.json`, `.csv`, `.md`, `.svg` and an error map for every method into a folder that is there.
///
/// # Errors
/// When one of them could not be written.
pub fn write_files(report: &Report, folder: &Path) -> anyhow::Result<()> {
    for (name, content) in [
        ("trade.json", json::json(report)),
        ("trade.csv", csv::csv(report)),
        ("trade.md", report::markdown(report)),
        ("trade.svg", plot::svg(report)?),
    ] {
        Output::File(folder.join(name)).write(|writer| writer.write_all(content.as_bytes()))?;
    }
    report.methods.par_iter().try_for_each(|measurement| {
        let id = measurement.method.id;
        let title = format!("{id}: error against exact Phong, in levels");
        let (pixels, size) = measurement.accuracy.map.with_legend(&title);
        Output::File(folder.join(format!("error-{id}.png"))).write_png(&pixels, size)
    })?;
    Ok(())
}
