//! The request of a measurement, its result for one method, and the methods that no other one beats.
//!
//! ```text
//! error |  o            o   on the front
//!       |     o    x    x   beaten: another method is as good in one way and better in the other
//!       |        o      x
//!       +---------------- time
//! ```
//! A method is off the front if another errs less in a median time that is no longer, or errs as much and is measurably
//! faster.

use std::time::Duration;

use fearless_simd::Level;
use serde::{Serialize, Serializer};
use serde_json::json;

use super::machine::Machine;
use super::metrics::Error;
use super::timing::Timing;
use crate::components::{Projection, View};
use crate::drawing::Drawing;
use crate::frame::Counts;
use crate::scene::Scene;
use crate::shading::{METHODS, Method};

/// The view and the methods to measure.
pub struct Request {
    pub scene: Scene,
    /// The name of the camera.
    pub camera: String,
    /// Each method overrides its shading and tolerance.
    pub view: View,
    pub methods: Vec<Method>,
    /// The threads that draw the timed frames; 1 is the calling thread alone.
    pub threads: usize,
    pub level: Level,
    /// The time for timing frames, of all methods together. Each gets [`super::timing::MIN_SAMPLES`] in any case.
    pub time: Duration,
    /// The command line, which repeats the measurement.
    pub command: String,
}

impl Request {
    /// The request to measure `drawing` with all [`METHODS`].
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
        }
    }
}

/// A measurement of methods, with the view and the machine: enough to judge the times and to repeat it.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    pub machine: Machine,
    /// The command line.
    pub command: String,
    pub scene: String,
    pub camera: String,
    pub projection: Projection,
    /// Width and height in pixels.
    pub size: [usize; 2],
    /// Pixels that show a cuboid.
    pub covered_pixels: u64,
    /// In the order of [`crate::shading::METHODS`].
    pub methods: Vec<Measurement>,
}

/// The time of one method in a view, and its error. Each figure stands here once, under its name in `trade.json`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Measurement {
    #[serde(flatten)]
    pub method: Method,
    /// The threads that drew.
    pub threads: usize,
    /// Milliseconds of a whole warm frame.
    #[serde(rename = "ms")]
    pub timing: Timing,
    /// Nanoseconds of a frame for each covered pixel; `None` if there is none, and while the trade is live.
    pub ns_per_covered_pixel: Option<f64>,
    /// The largest error against exact Phong, in levels of 255; `None` if no pixel can be compared.
    #[serde(skip)]
    pub error: Option<f64>,
    /// Column and row of the first pixel with the largest error.
    #[serde(skip)]
    pub worst: Option<[usize; 2]>,
    /// `None` while the trade is live.
    #[serde(flatten)]
    pub details: Option<Details>,
    /// The share of the highlight that is in its place, 0..=1; `None` if exact Phong shows none.
    pub highlight_kept: Option<f64>,
    /// Whether no other method beats it in error and time both.
    pub on_front: bool,
}

/// The figures of a report that need whole pictures.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Details {
    /// The work for a frame; the same on every machine.
    #[serde(serialize_with = "evaluations")]
    pub counts: Counts,
    /// The error against exact Phong; `None` if no pixel can be compared.
    pub error: Option<PhongError>,
    /// The error against the exact evaluation of the method's own mode; `None` if no pixel can be compared.
    pub own_error: Option<Error>,
    /// Pixels at which the method and exact Phong show different faces.
    pub edge_pixels: u64,
    /// The error against exact Phong in the colours of [`super::error_map::Scale::WIDEST`], 0x00RRGGBB.
    #[serde(skip)]
    pub map: Vec<u32>,
}

/// The error against exact Phong.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PhongError {
    #[serde(flatten)]
    pub levels: Error,
    /// Mean FLIP of the displayed bytes, 0..=1.
    pub flip_mean: f64,
}

fn evaluations<S: Serializer>(counts: &Counts, to: S) -> Result<S::Ok, S::Error> {
    json!({
        "model_evaluations": counts.model_evaluations,
        "specular_evaluations": counts.specular_evaluations,
    })
    .serialize(to)
}

impl Measurement {
    /// A method that has not been measured.
    pub fn new(method: Method, threads: usize) -> Self {
        Measurement {
            method,
            threads,
            timing: Timing::default(),
            ns_per_covered_pixel: None,
            error: None,
            worst: None,
            details: None,
            highlight_kept: None,
            on_front: false,
        }
    }
}

/// Errors with a smaller difference, in levels, are equal. The rounding of the reference in f64 is far smaller.
const RESOLUTION: f64 = 1e-6;

/// Marks the methods on the front. A method without an error is not.
pub fn mark_front(methods: &mut [Measurement]) {
    for index in 0..methods.len() {
        let one = &methods[index];
        let is_beaten = methods.iter().any(|other| beats(other, one));
        methods[index].on_front = one.error.is_some() && !is_beaten;
    }
}

fn beats(one: &Measurement, other: &Measurement) -> bool {
    let [mine, theirs] = [one, other].map(|it| it.error.map(|error| (error / RESOLUTION).round()));
    mine <= theirs
        && one.timing.median <= other.timing.median
        && (mine < theirs || one.timing.is_measurably_less_than(&other.timing))
}
