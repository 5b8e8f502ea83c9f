//! A report in, the text of `trade.json` out.
//!
//! Rule: every key is there in every report; a quantity that does not exist is `null`.

use serde_json::{Map, Value, json};

use super::machine::Machine;
use super::metrics::Error;
use super::subject::Subject;
use super::timing::Timing;
use super::verdict::verdict;
use super::{Measurement, Report, flip};
use crate::shading::TileKind;

/// The report as JSON text.
pub fn json(report: &Report) -> String {
    let methods: Vec<Value> = report.methods.iter().map(method).collect();
    document(
        &verdict(report),
        &report.subject,
        [
            ("covered_pixels", report.covered_pixels.into()),
            ("flip_pixels_per_degree", flip::PIXELS_PER_DEGREE.into()),
            ("methods", methods.into()),
        ],
    )
}

/// A measurement as JSON text: its verdict, its subject, and what was found.
pub(super) fn document<const COUNT: usize>(
    verdict: &str,
    subject: &Subject,
    found: [(&str, Value); COUNT],
) -> String {
    let mut document = json!({
        "verdict": verdict,
        "machine": machine(&subject.machine),
        "command": subject.command,
        "scene": subject.scene,
        "camera": subject.camera,
        "projection": subject.projection.name(),
        "size": subject.size,
    });
    for (key, value) in found {
        document[key] = value;
    }
    format!("{document:#}\n")
}

fn machine(machine: &Machine) -> Value {
    json!({
        "cpu": machine.cpu,
        "cores": machine.cores,
        "lanes": machine.lanes,
        "os": machine.os,
        "rustc": machine.rustc,
        "profile": machine.profile,
    })
}

/// The statistics of times.
pub(super) fn milliseconds(timing: &Timing) -> Value {
    json!({
        "samples": timing.samples,
        "median": timing.median,
        "mad": timing.mad,
        "min": timing.min,
        "p99": timing.p99,
        "interval": timing.interval(),
    })
}

fn method(one: &Measurement) -> Value {
    let (timing, accuracy) = (&one.timing, &one.accuracy);
    let of = |error: Option<Error>, figure: fn(&Error) -> f64| error.as_ref().map(figure);
    let error = |figure| of(accuracy.error.error, figure);
    let own_error = |figure| of(accuracy.own_error.error, figure);
    let tiles: Map<String, Value> = TileKind::ALL
        .iter()
        .zip(one.counts.tiles)
        .map(|(kind, tiles)| (kind.name().to_owned(), tiles.into()))
        .collect();
    json!({
        "id": one.method.id,
        "mode": one.method.mode.name(),
        "tolerance": one.method.tolerance,
        "threads": one.threads,
        "ms": milliseconds(timing),
        "ns_per_covered_pixel": one.ns_per_covered_pixel(),
        "counts": {
            "model_evaluations": one.counts.model_evaluations,
            "specular_evaluations": one.counts.specular_evaluations,
            "tiles": tiles,
        },
        "error": {
            "max": error(|error| error.max),
            "max_pixel": accuracy.error.error.map(|error| error.max_pixel),
            "mean": error(|error| error.mean),
            "rmse": error(|error| error.rmse),
            "p999": error(|error| error.p999),
            "over_1_level": error(|error| error.over_1_level),
            "flip_mean": accuracy.flip_mean,
        },
        "own_error": {
            "max": own_error(|error| error.max),
            "rmse": own_error(|error| error.rmse),
        },
        "highlight_kept": accuracy.highlight_kept,
        "edge_pixels": accuracy.error.edge_pixels,
        "on_front": one.on_front,
    })
}
