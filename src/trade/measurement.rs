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

use super::timing::Timing;
use crate::components::View;
use crate::drawing::Drawing;
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

/// The cost of one method in a view, and its error.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurement {
    pub method: Method,
    /// Milliseconds of a whole warm frame.
    pub timing: Timing,
    /// The largest error against exact Phong, in levels of 255; `None` if no pixel can be compared.
    pub error: Option<f64>,
    /// Column and row of the first pixel with the largest error.
    pub worst: Option<[usize; 2]>,
    /// The share of the highlight that is in its place, 0..=1; `None` if exact Phong shows none.
    pub highlight_kept: Option<f64>,
    /// Whether no other method beats it in error and time both.
    pub on_front: bool,
}

/// Errors with a smaller difference, in levels, are equal. The rounding of the reference in f64 is far smaller.
const RESOLUTION: f64 = 1e-6;

/// Whether each method is on the front. A method without an error is not.
pub fn on_front(methods: &[Measurement]) -> Vec<bool> {
    methods
        .iter()
        .map(|one| one.error.is_some() && !methods.iter().any(|other| beats(other, one)))
        .collect()
}

fn beats(one: &Measurement, other: &Measurement) -> bool {
    let [mine, theirs] = [one, other].map(|it| it.error.map(|error| (error / RESOLUTION).round()));
    mine <= theirs
        && one.timing.median <= other.timing.median
        && (mine < theirs || one.timing.is_measurably_less_than(&other.timing))
}
