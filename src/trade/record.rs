//! The report of a measurement, from which JSON, Markdown, table and plot are made.
//!
//! Each figure is computed once and stands here once, under its name in `trade.json`. A figure that does not exist is
//! `null` there.

use serde::{Serialize, Serializer};
use serde_json::json;

use super::accuracy::Accuracy;
use super::machine::Machine;
use super::measurement::{Measurement, Request};
use super::timing::Timing;
use crate::components::Projection;
use crate::frame::Counts;
use crate::report::words::counted;
use crate::shading::Method;

/// A measurement of all methods.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    #[serde(flatten)]
    pub subject: Subject,
    /// Pixels that show a cuboid.
    pub covered_pixels: u64,
    /// In the order of [`crate::shading::METHODS`].
    pub methods: Vec<MethodReport>,
}

/// The view and the machine: enough to judge the times and to repeat the measurement.
#[derive(Clone, Debug, Serialize)]
pub struct Subject {
    pub machine: Machine,
    /// The command line.
    pub command: String,
    pub scene: String,
    pub camera: String,
    pub projection: Projection,
    /// Width and height in pixels.
    pub size: [usize; 2],
}

/// The cost and the error of one method.
#[derive(Clone, Debug, Serialize)]
pub struct MethodReport {
    #[serde(flatten)]
    pub method: Method,
    /// The threads that drew.
    pub threads: usize,
    /// Milliseconds of a whole warm frame.
    #[serde(rename = "ms")]
    pub timing: Timing,
    /// Nanoseconds of a frame for each covered pixel; `None` if there is none.
    pub ns_per_covered_pixel: Option<f64>,
    /// The work for a frame; the same on every machine.
    #[serde(serialize_with = "evaluations")]
    pub counts: Counts,
    #[serde(flatten)]
    pub accuracy: Accuracy,
    /// Whether no other method beats it in error and time both.
    pub on_front: bool,
}

impl Report {
    /// The measurements of the methods without their other figures.
    pub fn measurements(&self) -> Vec<Measurement> {
        self.methods.iter().map(MethodReport::measurement).collect()
    }
}

impl MethodReport {
    /// The largest error against exact Phong, in levels; `None` if no pixel can be compared.
    pub fn max_error(&self) -> Option<f64> {
        self.accuracy.error.map(|error| error.levels.max)
    }

    fn measurement(&self) -> Measurement {
        Measurement {
            method: self.method,
            timing: self.timing.clone(),
            error: self.max_error(),
            worst: self.accuracy.error.map(|error| error.levels.max_pixel),
            highlight_kept: self.accuracy.highlight_kept,
            on_front: self.on_front,
        }
    }
}

impl Subject {
    /// The view of `request` on this machine.
    pub fn of(request: &Request) -> Self {
        Subject {
            machine: Machine::this(request.level),
            command: request.command.clone(),
            scene: request.scene.name.clone(),
            camera: request.camera.clone(),
            projection: request.view.projection,
            size: request.view.size,
        }
    }

    /// The view in words.
    pub fn view(&self) -> String {
        let [width, height] = self.size;
        format!(
            "{}, camera {}, {}, {width}x{height}",
            self.scene,
            self.camera,
            self.projection.name()
        )
    }

    /// The machine in words, with the number of `threads` that drew.
    pub fn place(&self, threads: &str) -> String {
        let machine = &self.machine;
        // The name and the version, without the commit.
        let rustc: Vec<&str> = machine.rustc.split(' ').take(2).collect();
        format!(
            "{}, {}, {}, {threads}, {}, {}, {} build",
            machine.cpu,
            counted(machine.cores, "core"),
            machine.lanes,
            machine.os,
            rustc.join(" "),
            machine.profile
        )
    }
}

fn evaluations<S: Serializer>(counts: &Counts, to: S) -> Result<S::Ok, S::Error> {
    json!({
        "model_evaluations": counts.model_evaluations,
        "specular_evaluations": counts.specular_evaluations,
    })
    .serialize(to)
}
