//! One view of a scene in; how the time of a frame grows with pixels, lights, cuboids and threads out.
//!
//! ```text
//! Request --scenes--> configurations --frames by the clock, in turns--> Scaling --growth--> report, scale.json
//! ```
//!
//! Rule: the configurations of a series take turns as methods do, so that their ratios are fair; one frame is held at a time.

mod configurations;
pub mod growth;
pub mod report;
mod scenes;

use std::path::Path;
use std::time::Duration;

use serde::Serialize;

use super::progress::{self, OnProgress};
use super::record::Subject;
use super::timing::{self, Timing};
use super::{Request, TradeError, accuracy, export, make_writable};
use crate::frame::{Frame, Keep, Workers};
use crate::output::{self, Output};
use crate::scene::Scene;
use crate::shading::Method;
use crate::systems;
pub use configurations::LARGEST;
use configurations::{Configuration, configurations};
use growth::Fit;

/// The methods measured unless others are asked for.
pub const METHODS: [&str; 3] = ["gouraud-0.5", "phong-0.5", "phong-0"];

/// Samples of each method in each configuration however little time there is: configurations are told apart by factors.
pub const MIN_SAMPLES: usize = 8;

/// What a frame's time is measured against.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Quantity {
    /// Of the picture.
    Pixels,
    /// Places from which diffuse and specular light comes.
    Lights,
    /// In view, none before another.
    Cuboids,
    /// That draw one frame.
    Threads,
}

impl Quantity {
    /// In the order in which they are measured.
    pub const ALL: [Quantity; 4] = [
        Quantity::Pixels,
        Quantity::Lights,
        Quantity::Cuboids,
        Quantity::Threads,
    ];

    /// Its name in the plural, the unit of [`Times::cost`], and what the bar calls its measurement.
    fn words(self) -> [&'static str; 3] {
        match self {
            Quantity::Pixels => ["pixels", "ns/px", "timing pixels"],
            Quantity::Lights => ["lights", "\u{b5}s each", "timing lights"],
            Quantity::Cuboids => ["cuboids", "\u{b5}s each", "timing cuboids"],
            Quantity::Threads => ["threads", "faster", "timing threads"],
        }
    }
}

/// What was measured.
#[derive(Clone, Debug, Serialize)]
pub struct Scaling {
    /// Where; of which scene where it is pixels or threads that vary, and of which size where it is not pixels.
    #[serde(flatten)]
    pub subject: Subject,
    /// One for each [`Quantity`].
    pub series: Vec<Series>,
}

/// Times against one quantity, everything else unchanged.
#[derive(Clone, Debug, Serialize)]
pub struct Series {
    /// What varies.
    pub quantity: Quantity,
    /// Of the costs.
    pub unit: &'static str,
    /// How time grows, by method; none where threads share the work.
    pub fits: Vec<Fit>,
    /// By increasing number.
    pub points: Vec<Point>,
}

/// The times of one configuration.
#[derive(Clone, Debug, Serialize)]
pub struct Point {
    /// Of pixels, lights, cuboids or threads.
    pub number: usize,
    /// Width and height in pixels.
    pub size: [usize; 2],
    /// How many threads drew.
    pub threads: usize,
    /// Pixels on which something is drawn.
    pub covered_pixels: u64,
    /// By method.
    pub methods: Vec<Times>,
}

/// The times of one method in one configuration.
#[derive(Clone, Debug, Serialize)]
pub struct Times {
    /// The method's.
    pub id: &'static str,
    /// Milliseconds of a whole warm frame.
    #[serde(rename = "ms")]
    pub timing: Timing,
    /// What one of the quantity costs: ns per covered pixel, µs per light or cuboid; for threads, how many times faster than
    /// the first configuration's thread they are. `None` where that does not exist.
    pub cost: Option<f64>,
}

impl Times {
    /// The least time of a frame, in milliseconds: other work on the machine lengthens long frames more than short ones,
    /// so that medians would grow faster than what is drawn.
    pub fn ms(&self) -> f64 {
        self.timing.min
    }
}

impl Series {
    /// With costs and fits, which follow from the times.
    pub fn new(quantity: Quantity, mut points: Vec<Point>) -> Self {
        let first = points.iter().take(1).flat_map(|point| &point.methods);
        let first: Vec<f64> = first.map(Times::ms).collect();
        for point in &mut points {
            for (times, first) in point.methods.iter_mut().zip(&first) {
                let cost = match quantity {
                    Quantity::Pixels => times.ms() * 1e6 / point.covered_pixels as f64,
                    Quantity::Lights | Quantity::Cuboids => times.ms() * 1e3 / point.number as f64,
                    Quantity::Threads => first / times.ms(),
                };
                times.cost = cost.is_finite().then_some(cost);
            }
        }
        let [_, unit, _] = quantity.words();
        Series {
            quantity,
            unit,
            fits: if quantity == Quantity::Threads {
                Vec::new()
            } else {
                growth::fits(&points)
            },
            points,
        }
    }
}

/// Measures every [`Quantity`]; `request.threads` is where the threads end.
///
/// # Errors
/// When memory or threads do not suffice.
pub fn measure(request: &Request, on_progress: OnProgress) -> Result<Scaling, TradeError> {
    let time = request.time / Quantity::ALL.len() as u32;
    let series = Quantity::ALL.map(|quantity| {
        let [_, _, step] = quantity.words();
        let on_progress = |share| on_progress(step, share);
        let points = time_settings(quantity, request, time, on_progress)?;
        Ok::<_, TradeError>(Series::new(quantity, points))
    });
    Ok(Scaling {
        subject: Subject::of(request),
        series: series.into_iter().collect::<Result<_, _>>()?,
    })
}

/// The times of all methods in all configurations of a series.
///
/// A frame is made anew whenever another number of threads draws: the largest takes hundreds of megabytes, and the first
/// frame of a turn, which fills it, is off the clock.
fn time_settings(
    quantity: Quantity,
    request: &Request,
    time: Duration,
    on_progress: impl Fn(f64),
) -> Result<Vec<Point>, TradeError> {
    let configurations = configurations(quantity, request);
    let methods = &request.methods;
    let mut covered = vec![0; configurations.len()];
    let turns = configurations.len() * methods.len();
    let batch = |number| {
        let scenes = configurations.iter().map(|it| it.scene.snapshot());
        let mut scenes: Vec<Scene> = scenes.collect();
        let mut frame = Frame::new(Keep::Display, Workers::alone(request.level));
        timing::batch(number, turns, MIN_SAMPLES, time, |turn| {
            let (index, method) = (turn / methods.len(), turn % methods.len());
            let Configuration { view, threads, .. } = &configurations[index];
            if frame.workers().threads() != *threads {
                frame = Frame::new(Keep::Display, Workers::new(*threads, request.level)?);
            }
            let view = accuracy::drawn_by(&methods[method], view);
            systems::draw(&mut scenes[index].world, &view, &mut frame)?;
            covered[index] = frame.counts().covered_pixels;
            Ok::<_, TradeError>(())
        })
    };
    let timings = timing::of_batches(batch, on_progress)?;
    let times = |(method, timing): (&Method, &Timing)| Times {
        id: method.id,
        timing: timing.clone(),
        cost: None,
    };
    let drawn = configurations.iter().zip(covered);
    let points = drawn.zip(timings.chunks(methods.len()));
    let points = points.map(|((drawn, covered_pixels), timings)| Point {
        number: drawn.number,
        size: drawn.view.size,
        threads: drawn.threads,
        covered_pixels,
        methods: methods.iter().zip(timings).map(times).collect(),
    });
    Ok(points.collect())
}

/// The command: measures, prints the tables, and writes `scale.json` into the folder `out` if there is one.
///
/// # Errors
/// When it could not be measured or written.
pub fn run(request: &Request, out: Option<&Path>) -> anyhow::Result<()> {
    if let Some(folder) = out {
        make_writable(folder)?;
    }
    let scaling = progress::with_bar(|on_progress| measure(request, on_progress))?;
    Output::Stdout.write(|writer| writer.write_all(report::table(&scaling).as_bytes()))?;
    if let Some(folder) = out {
        let text = export::json(&scaling)?;
        Output::File(folder.join("scale.json"))
            .write(|writer| writer.write_all(text.as_bytes()))?;
        output::say(&format!("wrote scale.json into {}", folder.display()));
    }
    Ok(())
}
