//! The format of `trade.json`: its keys, their types, and the range of each figure.

use serde::Deserialize;
use shadetrade::components::{Projection, ShadingMode};

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
    #[serde(deserialize_with = "Option::deserialize")]
    pub ns_per_covered_pixel: Option<f64>,
    pub counts: Counts,
    #[serde(deserialize_with = "Option::deserialize")]
    pub error: Option<PhongError>,
    #[serde(deserialize_with = "Option::deserialize")]
    pub own_error: Option<Error>,
    #[serde(deserialize_with = "Option::deserialize")]
    highlight_kept: Option<f64>,
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
}

#[derive(Deserialize)]
pub struct PhongError {
    #[serde(flatten)]
    pub levels: Error,
    pub flip_mean: f64,
}

#[derive(Deserialize)]
pub struct Error {
    pub max: f64,
    max_pixel: [u64; 2],
    mean: f64,
    rmse: f64,
    p999: f64,
    over_1_level: f64,
}

/// Reads the report in `text`; panics if it violates the format.
pub fn read(text: &str) -> Report {
    let report: Report = serde_json::from_str(text).expect("it has the keys of the contract");
    let machine = &report.machine;
    let of_machine = [&machine.cpu, &machine.lanes, &machine.os, &machine.rustc];
    let of_view = [&report.command, &report.scene, &report.camera];
    let texts = of_machine.into_iter().chain(of_view);
    assert!(texts.chain([&machine.profile]).all(|text| !text.is_empty()));
    assert!(machine.cores > 0 && !report.size.contains(&0));
    let is_covered = report.covered_pixels > 0;
    for method in &report.methods {
        let what = &method.id;
        let [width, height] = report.size;
        assert!((0.0..=255.0).contains(&method.tolerance) && method.threads > 0);
        assert!(method.edge_pixels <= width * height, "{what}");
        let ms = &method.ms;
        let least = ms.raw.iter().copied().fold(f64::INFINITY, f64::min);
        assert_eq!((ms.samples, ms.min), (ms.raw.len(), least), "{what}");
        let [low, high] = ms.interval;
        assert!(
            [0.0, ms.min, low, high].is_sorted() && ms.min <= ms.median,
            "{what}"
        );
        let time = method.ns_per_covered_pixel;
        let is_there = [
            time.is_some(),
            method.error.is_some(),
            method.own_error.is_some(),
        ];
        assert_eq!(is_there, [is_covered; 3], "{what}");
        assert!(time.is_none_or(|time| time >= 0.0), "{what}");
        let shares = [
            method.highlight_kept,
            method.error.as_ref().map(|it| it.flip_mean),
        ];
        let mut shares = shares.into_iter().flatten();
        assert!(shares.all(|share| (0.0..=1.0).contains(&share)), "{what}");
        let levels = method.error.as_ref().map(|error| &error.levels);
        for error in levels.into_iter().chain(&method.own_error) {
            let in_levels = [0.0, error.mean, error.rmse, error.max, 255.0];
            assert!(in_levels.is_sorted() && error.p999 <= error.max, "{what}");
            assert!((0.0..=1.0).contains(&error.over_1_level), "{what}");
            assert!(
                error.max_pixel[0] < width && error.max_pixel[1] < height,
                "{what}"
            );
        }
    }
    let mut fronts = report.methods.iter().map(|method| method.on_front);
    assert_eq!(
        fronts.any(|it| it),
        is_covered,
        "there is a front if something is drawn"
    );
    report
}
