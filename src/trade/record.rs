//! What was measured, and where: the one record that JSON, Markdown and the terminal's table are made of.
//!
//! Rule: a figure is computed once and stands here once, under the name that `trade.json` gives it; every key is there in
//! every report, and a quantity that does not exist is `null`.

use serde::ser::Error as _;
use serde::{Serialize, Serializer};
use serde_json::{Value, json};

use super::Request;
use super::accuracy::Accuracy;
use super::machine::Machine;
use super::metrics::Error;
use super::timing::Timing;
use super::words::counted;
use crate::components::Projection;
use crate::frame::Counts;
use crate::shading::{Method, TileKind};

/// What was measured.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Of which view, and where.
    #[serde(flatten)]
    pub subject: Subject,
    /// Pixels on which something is drawn.
    pub covered_pixels: u64,
    /// In the order of [`crate::shading::METHODS`].
    pub methods: Vec<MethodReport>,
}

/// Of which view, and where: what a reader needs to judge times, and to repeat them.
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

/// What one method costs and how far it errs.
#[derive(Clone, Debug, Serialize)]
pub struct MethodReport {
    #[serde(flatten)]
    pub method: Method,
    /// How many threads drew.
    pub threads: usize,
    /// Milliseconds of a whole warm frame.
    #[serde(rename = "ms")]
    pub timing: Timing,
    /// Nanoseconds of a frame for each pixel on which something is drawn; `None` where nothing is.
    pub ns_per_covered_pixel: Option<f64>,
    /// The median milliseconds of each stage of a frame, in order.
    #[serde(serialize_with = "map")]
    pub stages: Vec<(&'static str, f64)>,
    /// What a frame evaluates; the same on every machine.
    #[serde(serialize_with = "count_keys")]
    pub counts: Counts,
    #[serde(flatten)]
    pub accuracy: Accuracy,
    /// Whether nothing beats it in error and time both.
    pub on_front: bool,
}

impl MethodReport {
    /// The largest error against exact Phong, in levels; `None` where nothing can be compared.
    pub fn max_error(&self) -> Option<f64> {
        self.accuracy.error.levels.map(|error| error.max)
    }
}

impl Subject {
    /// Of a measurement on this machine.
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

    /// What was measured, in words.
    pub fn view(&self) -> String {
        let [width, height] = self.size;
        format!(
            "{}, camera {}, {}, {width}x{height}",
            self.scene,
            self.camera,
            self.projection.name()
        )
    }

    /// Where, in words, with how many `threads` drew.
    pub fn place(&self, threads: &str) -> String {
        let machine = &self.machine;
        // The name and the number; what follows is a commit.
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

fn map<S: Serializer>(pairs: &[(&'static str, f64)], to: S) -> Result<S::Ok, S::Error> {
    to.collect_map(pairs.iter().copied())
}

fn count_keys<S: Serializer>(counts: &Counts, to: S) -> Result<S::Ok, S::Error> {
    let names = TileKind::ALL.iter().map(|kind| kind.name());
    let tiles: serde_json::Map<String, Value> = names
        .zip(counts.tiles)
        .map(|(name, tiles)| (name.to_owned(), tiles.into()))
        .collect();
    json!({
        "model_evaluations": counts.model_evaluations,
        "specular_evaluations": counts.specular_evaluations,
        "tiles": tiles,
    })
    .serialize(to)
}

/// The keys of an error; each is `null` where there is none.
#[expect(clippy::ref_option, reason = "serde hands a reference")]
pub(super) fn error_keys<S: Serializer>(error: &Option<Error>, to: S) -> Result<S::Ok, S::Error> {
    let mut keys = serde_json::to_value(error.unwrap_or_default()).map_err(S::Error::custom)?;
    if let (None, Value::Object(keys)) = (error, &mut keys) {
        keys.values_mut().for_each(|value| *value = Value::Null);
    }
    keys.serialize(to)
}
