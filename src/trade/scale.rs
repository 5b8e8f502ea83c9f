//! One view of a scene in; how the time of a frame grows with pixels, lights, cuboids and threads out.
//!
//! ```text
//! Request --scenes--> settings --frames by the clock, in turns--> Scaling --growth--> report, data, plot
//! ```
//!
//! Rule: the settings of a series take turns as methods do, so that their ratios are fair; one frame is held at a time.

pub mod data;
pub mod growth;
pub mod plot;
pub mod report;
mod scenes;
mod settings;

use std::path::Path;
use std::time::Duration;

use super::progress::{self, Progress};
use super::subject::Subject;
use super::timing::{self, Timing};
use super::{Request, TradeError, accuracy, make_writable};
use crate::frame::{Frame, Keep, Workers};
use crate::output::{self, Output};
use crate::scene::Scene;
use crate::shading::{METHODS, Method};
use crate::systems;
pub use settings::LARGEST;
use settings::{Setting, settings};

/// The methods measured, out of [`METHODS`].
const MEASURED: [&str; 3] = ["gouraud-0.5", "phong-0.5", "phong-0"];

/// Samples of each method in each setting however little time there is: settings are told apart by factors.
pub const LEAST_SAMPLES: usize = 9;

/// What a frame's time is measured against.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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

    /// In the plural.
    pub fn name(self) -> &'static str {
        match self {
            Quantity::Pixels => "pixels",
            Quantity::Lights => "lights",
            Quantity::Cuboids => "cuboids",
            Quantity::Threads => "threads",
        }
    }

    /// What [`Series::cost`] is called.
    pub fn cost(self) -> &'static str {
        match self {
            Quantity::Pixels => "ns_per_covered_pixel",
            Quantity::Lights => "us_per_light",
            Quantity::Cuboids => "us_per_cuboid",
            Quantity::Threads => "speed_up",
        }
    }

    /// What the bar calls its measurement.
    fn step(self) -> &'static str {
        match self {
            Quantity::Pixels => "timing pixels",
            Quantity::Lights => "timing lights",
            Quantity::Cuboids => "timing cuboids",
            Quantity::Threads => "timing threads",
        }
    }
}

/// What was measured.
#[derive(Clone, Debug)]
pub struct Scaling {
    /// Where; of which scene where it is pixels or threads that vary, and of which size where it is not pixels.
    pub subject: Subject,
    /// What drew.
    pub methods: Vec<Method>,
    /// One for each [`Quantity`].
    pub series: Vec<Series>,
}

/// Times against one quantity, everything else unchanged.
#[derive(Clone, Debug)]
pub struct Series {
    /// What varies.
    pub quantity: Quantity,
    /// By increasing number.
    pub points: Vec<Point>,
}

/// The times of one setting.
#[derive(Clone, Debug)]
pub struct Point {
    /// Of pixels, lights, cuboids or threads.
    pub number: usize,
    /// Width and height in pixels.
    pub size: [usize; 2],
    /// How many threads drew.
    pub threads: usize,
    /// Pixels on which something is drawn.
    pub covered_pixels: u64,
    /// Milliseconds of a whole warm frame, by method.
    pub timings: Vec<Timing>,
}

impl Point {
    /// The least time of a frame, in milliseconds: other work on the machine lengthens long frames more than short ones,
    /// so that medians would grow faster than what is drawn.
    pub fn ms(&self, method: usize) -> f64 {
        self.timings[method].min
    }
}

impl Series {
    /// How many of the quantity there are in words: for pixels, the picture's size.
    pub fn number(&self, point: &Point) -> String {
        match self.quantity {
            Quantity::Pixels => format!("{}x{}", point.size[0], point.size[1]),
            Quantity::Lights | Quantity::Cuboids | Quantity::Threads => point.number.to_string(),
        }
    }

    /// What one of the quantity costs with a method: ns per covered pixel, µs per light or cuboid; for threads, how many
    /// times faster than the first setting's thread they are. `None` where that does not exist.
    pub fn cost(&self, point: &Point, method: usize) -> Option<f64> {
        let ms = point.ms(method);
        let cost = match self.quantity {
            Quantity::Pixels => ms * 1e6 / point.covered_pixels as f64,
            Quantity::Lights | Quantity::Cuboids => ms * 1e3 / point.number as f64,
            Quantity::Threads => self.points.first()?.ms(method) / ms,
        };
        cost.is_finite().then_some(cost)
    }
}

/// Measures every [`Quantity`]; `request.threads` is where the threads end. `progress` hears how far it is.
///
/// # Errors
/// When memory or threads do not suffice.
pub fn measure(
    request: &Request,
    progress: &(dyn Fn(Progress) + Sync),
) -> Result<Scaling, TradeError> {
    let methods: Vec<Method> = METHODS
        .iter()
        .filter(|method| MEASURED.contains(&method.id))
        .copied()
        .collect();
    let time = request.time / Quantity::ALL.len() as u32;
    let series = Quantity::ALL.map(|quantity| {
        let (mut scenes, settings) = settings(quantity, request);
        let telling = |share| {
            progress(Progress {
                step: quantity.step(),
                share,
            });
        };
        let points = time_settings(&mut scenes, &settings, &methods, request, time, telling)?;
        Ok::<_, TradeError>(Series { quantity, points })
    });
    Ok(Scaling {
        subject: Subject::of(request),
        methods,
        series: series.into_iter().collect::<Result<_, _>>()?,
    })
}

/// The times of all methods in all settings.
///
/// A frame is made anew whenever another number of threads draws: the largest takes hundreds of megabytes, and the first
/// frame of a turn, which fills it, is off the clock.
fn time_settings(
    scenes: &mut [Scene],
    settings: &[Setting],
    methods: &[Method],
    request: &Request,
    time: Duration,
    progress: impl Fn(f64),
) -> Result<Vec<Point>, TradeError> {
    let mut frame = Frame::new(Keep::Display, Workers::alone(request.level));
    // As the frames say, not as they were asked for.
    let blank = |setting: &Setting| Point {
        number: setting.number,
        size: [0, 0],
        threads: 0,
        covered_pixels: 0,
        timings: Vec::new(),
    };
    let mut points: Vec<Point> = settings.iter().map(blank).collect();
    let draw = |turn: usize| -> Result<(), TradeError> {
        let (setting, method) = (turn / methods.len(), turn % methods.len());
        let Setting {
            view,
            threads,
            scene,
            ..
        } = &settings[setting];
        if frame.workers().threads() != *threads {
            frame = Frame::new(Keep::Display, Workers::new(*threads, request.level)?);
        }
        let view = accuracy::drawn_by(&methods[method], view);
        systems::draw(&mut scenes[*scene].world, &view, &mut frame)?;
        let point = &mut points[setting];
        (point.size, point.threads) = (frame.size(), frame.workers().threads());
        point.covered_pixels = frame.counts().covered_pixels;
        Ok(())
    };
    let turns = settings.len() * methods.len();
    let timings = timing::in_turns(turns, LEAST_SAMPLES, time, draw, progress)?;
    for (point, timings) in points.iter_mut().zip(timings.chunks(methods.len())) {
        point.timings = timings.to_vec();
    }
    Ok(points)
}

/// The command: measures, prints the tables, and writes everything into the folder `out` if there is one.
///
/// # Errors
/// When it could not be measured or written.
pub fn run(request: &Request, out: Option<&Path>) -> anyhow::Result<()> {
    if let Some(folder) = out {
        make_writable(folder)?;
    }
    let scaling = progress::with_bar(|progress| measure(request, progress))?;
    Output::Stdout.write(|writer| writer.write_all(report::table(&scaling).as_bytes()))?;
    if let Some(folder) = out {
        for (name, content) in [
            ("scale.json", data::json(&scaling)),
            ("scale.csv", data::csv(&scaling)),
            ("scale.md", report::markdown(&scaling)),
            ("scale.svg", plot::svg(&scaling)?),
        ] {
            Output::File(folder.join(name)).write(|writer| writer.write_all(content.as_bytes()))?;
        }
        output::say(&format!(
            "wrote scale.json, scale.csv, scale.md and scale.svg into {}",
            folder.display()
        ));
    }
    Ok(())
}
