//! One view of a scene in; what each shading method costs and how far it errs out.
//!
//! ```text
//!            +-- timing, process: frames by the clock, in turns -+
//! Request ---+                                                   +-- front --> Report --> export, plot, error_map
//!            +-- accuracy: pictures against the reference -------+
//! ```
//!
//! Rule: measuring and reporting are apart: a [`Report`] is data, and every text and picture is a pure function of it.

pub mod accuracy;
pub mod budget;
pub(crate) mod chart;
pub mod error_map;
pub mod export;
pub mod flip;
pub mod front;
pub mod live;
pub mod machine;
pub mod metrics;
pub mod plot;
pub mod process;
pub(crate) mod progress;
pub mod record;
pub mod tables;
pub mod timing;
pub mod verdict;
pub(crate) mod words;

use std::path::Path;
use std::time::{Duration, Instant};

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
pub use live::Measurement;
use progress::OnProgress;
use record::Subject;
pub use record::{MethodReport, Report};
use timing::Batch;

/// How long all frames are timed together unless asked otherwise.
pub const USUAL_TIME: Duration = Duration::from_secs(20);

/// The same for those in a hurry: no more than [`MIN_SAMPLES`].
pub const QUICK_TIME: Duration = Duration::ZERO;

/// Samples of each method however little time there is: below that a median says little.
pub const MIN_SAMPLES: usize = 30;

/// Frames whose stages are timed, for each method.
const STAGED_FRAMES: usize = 15;

/// What to measure.
pub struct Request {
    /// With the lights on that are to shine.
    pub scene: Scene,
    /// What the camera is called.
    pub camera: String,
    /// How it is seen; shading and tolerance are each method's own.
    pub view: View,
    /// What draws it.
    pub methods: Vec<Method>,
    /// How many threads draw the frames that are timed; 1 is the calling thread alone.
    pub threads: usize,
    /// The SIMD level that draws.
    pub level: Level,
    /// How long all frames are timed together; every method gets [`MIN_SAMPLES`] even of no time at all.
    pub time: Duration,
    /// The command line, for those who want to repeat it.
    pub command: String,
    /// What times a batch, given its number: [`time_batch`], or [`process::in_a_process`].
    pub time_batch: fn(&Request, usize, IsCancelled) -> Result<Batch, TradeError>,
}

/// Is asked before every frame and every row of the reference; a yes ends the measurement.
pub type IsCancelled<'a> = &'a (dyn Fn() -> bool + Sync);

impl Request {
    /// To measure `drawing` with all [`METHODS`], whatever its shading and tolerance, for about this `time`.
    pub fn new(drawing: Drawing, time: Duration, command: String) -> Self {
        Request {
            camera: drawing.camera(),
            view: drawing.view(),
            scene: drawing.scene,
            methods: METHODS.to_vec(),
            threads: drawing.threads,
            level: drawing.level,
            time,
            command,
            time_batch,
        }
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
    /// A batch that another process was to time.
    #[error("cannot measure in a process of its own")]
    Process(#[source] anyhow::Error),
    /// Whoever asked no longer wants to know.
    #[error("the measurement was cancelled")]
    Cancelled,
}

/// Measures the methods of `request`.
///
/// # Errors
/// When memory or threads do not suffice, or it is cancelled.
pub fn measure(
    mut request: Request,
    cancelled: IsCancelled,
    on_progress: OnProgress,
) -> Result<Report, TradeError> {
    accuracy::check_memory(request.view.size)?;
    let step = |step| move |share| on_progress(step, share);
    let time_batch = |number| (request.time_batch)(&request, number, cancelled);
    let timings = timing::of_batches(time_batch, step("timing frames"))?;
    let stages = time_stages(&request, cancelled)?;
    let subject = Subject::of(&request);
    let accuracies = accuracy::of_methods(
        &request.methods,
        &mut request.scene,
        &request.view,
        Workers::new(all_cores(), request.level)?,
        cancelled,
        &step("comparing pictures"),
    )?;
    let times = timings.into_iter().zip(stages);
    let mut methods: Vec<MethodReport> = request
        .methods
        .iter()
        .zip(times)
        .zip(accuracies)
        .map(|((method, (timing, (stages, counts))), accuracy)| {
            let pixels = counts.covered_pixels;
            MethodReport {
                method: *method,
                threads: request.threads,
                ns_per_covered_pixel: (pixels > 0).then(|| timing.median * 1e6 / pixels as f64),
                timing,
                stages,
                counts,
                accuracy,
                on_front: false,
            }
        })
        .collect();
    let measured: Vec<Measurement> = methods.iter().map(Measurement::from).collect();
    let on_front = front::on_front(&measured);
    for (one, on_front) in methods.iter_mut().zip(on_front) {
        one.on_front = on_front;
    }
    Ok(Report {
        subject,
        covered_pixels: methods.first().map_or(0, |one| one.counts.covered_pixels),
        methods,
    })
}

/// The views that the methods of `request` draw.
fn views(request: &Request) -> Vec<View> {
    let methods = request.methods.iter();
    methods.map(|method| method.view(&request.view)).collect()
}

/// A frame as a window holds it, and a scene of one's own to draw into it.
fn prepare(request: &Request) -> Result<(Frame, Scene), TradeError> {
    let workers = Workers::new(request.threads, request.level)?;
    Ok((Frame::new(Keep::Display, workers), request.scene.snapshot()))
}

/// Times a batch in this process. All methods draw into one frame, so that none has a better place in memory than another.
///
/// # Errors
/// When memory or threads do not suffice, or it is cancelled.
pub fn time_batch(
    request: &Request,
    number: usize,
    is_cancelled: IsCancelled,
) -> Result<Batch, TradeError> {
    let views = &views(request);
    let (mut frame, mut scene) = prepare(request)?;
    timing::batch(number, views.len(), MIN_SAMPLES, request.time, |method| {
        if is_cancelled() {
            return Err(TradeError::Cancelled);
        }
        Ok(systems::draw(&mut scene.world, &views[method], &mut frame)?)
    })
}

/// The median milliseconds of each stage of a frame, by method, and what such a frame counts. Not of the frames timed as a
/// whole, whose clock runs undisturbed.
#[expect(clippy::type_complexity, reason = "a stage is a name and a time")]
fn time_stages(
    request: &Request,
    cancelled: IsCancelled,
) -> Result<Vec<(Vec<(&'static str, f64)>, Counts)>, TradeError> {
    let (mut frame, mut scene) = prepare(request)?;
    let mut of_method = |view: &View| {
        let mut times: Vec<(&str, Vec<f64>)> = Vec::new();
        for number in 0..=STAGED_FRAMES {
            if cancelled() {
                return Err(TradeError::Cancelled);
            }
            let (mut stage, mut start) = (0, Instant::now());
            let rows = 0..view.size[1];
            systems::draw_in_stages(&mut scene.world, view, rows, &mut frame, |name| {
                let now = Instant::now();
                // The first frame warms caches.
                if number == 0 {
                    times.push((name, Vec::new()));
                } else {
                    times[stage].1.push((now - start).as_secs_f64() * 1e3);
                }
                (stage, start) = (stage + 1, now);
            })?;
        }
        let medians = times
            .iter()
            .map(|(name, times)| (*name, timing::median(times)));
        Ok((medians.collect(), frame.counts()))
    };
    views(request).iter().map(&mut of_method).collect()
}

/// The command: measures, prints the table, and writes everything into the folder `out` if there is one.
///
/// # Errors
/// When it could not be measured or written.
pub fn run(request: Request, out: Option<&Path>) -> anyhow::Result<()> {
    if let Some(folder) = out {
        make_writable(folder)?;
    }
    let report = progress::with_bar(|on_progress| measure(request, &|| false, on_progress))?;
    Output::Stdout.write(|writer| writer.write_all(export::table(&report).as_bytes()))?;
    if let Some(folder) = out {
        write_files(&report, folder)?;
        output::say(&format!(
            "wrote trade.json, trade.md, trade.svg and {} into {}",
            words::counted(report.methods.len(), "error map"),
            folder.display()
        ));
    }
    Ok(())
}

/// Makes the folder unless it is there, and fails before the measurement rather than after it if nothing can be written there.
pub(crate) fn make_writable(folder: &Path) -> anyhow::Result<()> {
    output::make_folder(folder)?;
    tempfile::tempfile_in(folder)
        .with_context(|| format!("cannot write into {}", folder.display()))?;
    Ok(())
}

/// Writes `trade.json`, `.md`, `.svg` and an error map for every method into a folder that is there.
///
/// # Errors
/// When one of them could not be written.
pub fn write_files(report: &Report, folder: &Path) -> anyhow::Result<()> {
    for (name, content) in [
        ("trade.json", export::json(report)?),
        ("trade.md", export::markdown(report)),
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
