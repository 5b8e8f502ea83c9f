//! The request of a measurement, and its result: the report, with a record for each method.

use std::time::Duration;

use serde::{Serialize, Serializer};

use super::is_timed;
use super::machine::Machine;
use super::timing::Timing;
use crate::components::Projection;
use crate::questions::job::Drawing;
use crate::questions::metrics::ErrorStatistics;
use crate::shading::Method;
use crate::systems::frame::Counts;

/// The view and the methods to measure.
pub struct Request {
    /// Each method overrides its shading and tolerance. Its threads draw the timed frames; 1 is the calling thread alone.
    pub drawing: Drawing,
    pub methods: Vec<Method>,
    /// The time for timing frames, of all methods together. Each gets [`super::timing::MIN_SAMPLES`] in any case.
    pub time: Duration,
    /// Whether `own_error` is found, which only a report shows.
    pub is_report: bool,
    /// Whether grids that do not fit in memory are an error; else their methods are left out.
    pub must_fit: bool,
}

impl Request {
    /// The methods whose frames are timed.
    pub fn timed(&self) -> impl Iterator<Item = &Method> {
        self.methods.iter().filter(|it| is_timed(**it))
    }

    /// The same request for other methods.
    pub(super) fn with(&self, methods: impl Iterator<Item = Method>) -> Request {
        Request {
            drawing: Drawing {
                scene: self.drawing.scene.snapshot(),
                ..self.drawing
            },
            methods: methods.collect(),
            ..*self
        }
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
    pub scene: String,
    pub camera: String,
    pub projection: Projection,
    /// Width and height in pixels.
    pub size: [usize; 2],
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
    /// Whether it is a best trade: no other method beats it ([`super`]).
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

    /// Column and row of the first pixel with the largest error.
    pub fn worst_pixel(&self) -> Option<[usize; 2]> {
        self.error.map(|it| it.max_pixel)
    }
}
