//! The format of `trade.json`: the keys and types of [`Report`], and the range of each figure.

use std::collections::HashMap;

use serde::Deserialize;
use shadetrade::components::{Projection, ShadingMode};

/// The methods that every full measurement contains.
pub const LADDER: [&str; 9] = [
    "gouraud-0",
    "gouraud-0.5",
    "phong-0",
    "phong-0.25",
    "phong-0.5",
    "phong-1",
    "phong-2",
    "phong-4",
    "phong-unit-vectors",
];

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Report {
    machine: Machine,
    pub command: String,
    scene: String,
    camera: String,
    pub projection: Projection,
    pub size: [u64; 2],
    pub covered_pixels: u64,
    pub methods: Vec<Method>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Machine {
    cpu: String,
    cores: u64,
    lanes: String,
    os: String,
    rustc: String,
    profile: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Method {
    pub id: String,
    pub mode: ShadingMode,
    tolerance: f64,
    threads: u64,
    pub ms: Timing,
    pub ns_per_covered_pixel: Figure,
    pub stages: HashMap<String, f64>,
    pub counts: Counts,
    pub error: PhongError,
    pub own_error: Error,
    highlight_kept: Figure,
    pub edge_pixels: u64,
    pub on_front: bool,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Timing {
    samples: usize,
    pub median: f64,
    interval: [f64; 2],
    min: f64,
    pub raw: Vec<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Counts {
    pub model_evaluations: u64,
    pub specular_evaluations: u64,
    tiles: HashMap<String, u64>,
}

#[derive(Deserialize)]
pub struct PhongError {
    #[serde(flatten)]
    pub levels: Error,
    pub flip_mean: Figure,
}

#[derive(Deserialize)]
pub struct Error {
    pub max: Figure,
    max_pixel: Figure<[u64; 2]>,
    mean: Figure,
    rmse: Figure,
    p999: Figure,
    over_1_level: Figure,
}

/// A quantity, or `null` if it does not exist. The key must be present, which serde does not require of an `Option`.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(untagged)]
pub enum Figure<T = f64> {
    Some(T),
    None(()),
}

impl<T> Figure<T> {
    pub fn value(self) -> Option<T> {
        match self {
            Figure::Some(value) => Some(value),
            Figure::None(()) => None,
        }
    }
}

/// Reads the report in `text`; panics if it violates the format.
pub fn read(text: &str) -> Report {
    let report: Report = serde_json::from_str(text).expect("it has the keys of the contract");
    let Machine {
        cpu,
        cores,
        lanes,
        os,
        rustc,
        profile,
    } = &report.machine;
    let Report {
        command,
        scene,
        camera,
        ..
    } = &report;
    for text in [cpu, lanes, os, rustc, profile, command, scene, camera] {
        assert!(!text.is_empty());
    }
    assert!(*cores > 0 && !report.size.contains(&0));
    for method in &report.methods {
        method.assert_in_range(&report);
    }
    assert_eq!(
        report.methods.iter().any(|method| method.on_front),
        report.covered_pixels > 0,
        "the front is empty exactly where nothing is drawn"
    );
    report
}

impl Method {
    #[track_caller]
    fn assert_in_range(&self, report: &Report) {
        let [width, height] = report.size;
        assert!((0.0..=255.0).contains(&self.tolerance) && self.threads > 0);
        assert!(self.edge_pixels <= width * height);
        let Timing {
            samples,
            median,
            interval: [low, high],
            min,
            raw,
        } = &self.ms;
        let least = raw.iter().copied().fold(f64::INFINITY, f64::min);
        assert_eq!((*samples, *min), (raw.len(), least), "{}", self.id);
        let is_ordered = min <= low && low <= high && min <= median;
        assert!(0.0 <= *min && is_ordered, "{}", self.id);
        assert!(!self.stages.is_empty() && self.stages.values().all(|ms| *ms >= 0.0));
        assert!(!self.counts.tiles.is_empty());

        let (levels, own) = (&self.error.levels, &self.own_error);
        let figures = [levels, own].map(|error| {
            [
                (error.max, 255.0),
                (error.mean, 255.0),
                (error.rmse, 255.0),
                (error.p999, 255.0),
                (error.over_1_level, 1.0),
            ]
        });
        let others = [
            (self.error.flip_mean, 1.0),
            (self.ns_per_covered_pixel, f64::MAX),
        ];
        for (figure, most) in figures.as_flattened().iter().chain(&others) {
            let value = figure.value();
            assert_eq!(value.is_some(), report.covered_pixels > 0, "{}", self.id);
            let in_range = |value| (0.0..=*most).contains(&value);
            assert!(value.is_none_or(in_range), "{}: {value:?}", self.id);
        }
        for [x, y] in [levels, own]
            .into_iter()
            .filter_map(|error| error.max_pixel.value())
        {
            assert!(x < width && y < height, "{}", self.id);
        }
        let kept = self.highlight_kept.value();
        assert!(
            kept.is_none_or(|kept| (0.0..=1.0).contains(&kept)),
            "{}",
            self.id
        );
    }
}
