//! The format of `trade.json`: its keys, their types, and the range of each figure.

use serde::Deserialize;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Report {
    machine: Machine,
    pub command: String,
    scene: String,
    camera: String,
    projection: String,
    pub size: [u64; 2],
    pub covered_pixels: u64,
    pub methods: Vec<Method>,
    left_out: Vec<LeftOut>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LeftOut {
    id: String,
    mode: String,
    segments: u32,
    tolerance: f64,
    reason: String,
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
    pub mode: String,
    #[serde(deserialize_with = "Option::deserialize")]
    pub segments: Option<u32>,
    pub tolerance: f64,
    pub threads: u64,
    /// `None` of what is not timed.
    #[serde(deserialize_with = "Option::deserialize")]
    pub ms: Option<Timing>,
    #[serde(deserialize_with = "Option::deserialize")]
    pub ns_per_covered_pixel: Option<f64>,
    pub counts: Counts,
    #[serde(deserialize_with = "Option::deserialize")]
    pub error: Option<Error>,
    #[serde(deserialize_with = "Option::deserialize")]
    pub own_error: Option<Error>,
    #[serde(deserialize_with = "Option::deserialize")]
    pub highlight_kept: Option<f64>,
    pub edge_pixels: u64,
    pub on_front: bool,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Timing {
    pub samples: usize,
    pub median: f64,
    interval: [f64; 2],
    min: f64,
    raw: Vec<f64>,
}

#[derive(Deserialize, PartialEq, Debug)]
#[serde(deny_unknown_fields)]
pub struct Counts {
    pub model_evaluations: u64,
    pub specular_evaluations: u64,
}

#[derive(Deserialize, PartialEq, Debug)]
#[serde(deny_unknown_fields)]
pub struct Error {
    pub max: f64,
    pub max_pixel: [usize; 2],
    mean: f64,
    rmse: f64,
    p999: f64,
    over_1_level: f64,
}

/// Reads the report in `text`; panics if it violates the format.
pub fn read(text: &str) -> Report {
    let report: Report = serde_json::from_str(text).expect("it has the keys of the contract");
    let Machine { cpu, os, rustc, .. } = &report.machine;
    let Machine { lanes, profile, .. } = &report.machine;
    let texts = [cpu, os, rustc, lanes, profile, &report.command];
    assert!(texts.into_iter().all(|text| !text.is_empty()));
    assert!(["test", "/dev/stdin"].contains(&&*report.scene));
    assert_eq!([&report.camera, &report.projection], ["1", "perspective"]);
    assert!(report.machine.cores > 0);
    let [width, height] = report.size.map(|side| side as usize);
    let is_covered = report.covered_pixels > 0;
    for method in &report.methods {
        let what = &method.id;
        let is_named = what.contains(&method.mode) || what.is_empty();
        assert!(is_named, "{what} is {}", method.mode);
        if let Some(count) = method.segments {
            assert_eq!(
                *what,
                format!("gouraud-{count}x{count}-{}", method.tolerance)
            );
        }
        assert!(method.edge_pixels <= (width * height) as u64, "{what}");
        let is_timed = !["phong-unit-vectors", "blinn-phong"].contains(&&**what);
        assert_eq!(method.ms.is_some(), is_timed, "{what}");
        let has_time = method.ns_per_covered_pixel.is_some();
        assert_eq!(has_time, is_timed && is_covered, "{what}");
        if let Some(ms) = &method.ms {
            let least = ms.raw.iter().copied().fold(f64::INFINITY, f64::min);
            assert_eq!((ms.samples, ms.min), (ms.raw.len(), least), "{what}");
            let [low, high] = ms.interval;
            // An end may lie a step of the clock below the least time.
            let is_sorted = [0.0, low, high].is_sorted() && ms.min <= ms.median;
            assert!(is_sorted, "{what}");
            let time = ms.median * 1e6 / report.covered_pixels as f64;
            let time = is_covered.then_some(time);
            assert_eq!(method.ns_per_covered_pixel, time, "{what}");
        }
        let errors = [&method.error, &method.own_error].map(Option::as_ref);
        assert_eq!(errors.map(|it| it.is_some()), [is_covered; 2], "{what}");
        let shares = errors.into_iter().flatten().map(|it| it.over_1_level);
        let mut shares = shares.chain(method.highlight_kept);
        assert!(shares.all(|it| (0.0..=1.0).contains(&it)));
        for error in errors.into_iter().flatten() {
            let in_levels = [0.0, error.mean, error.rmse, error.max, 255.0];
            assert!(in_levels.is_sorted() && error.p999 <= error.max, "{what}");
            let [x, y] = error.max_pixel;
            assert!(x < width && y < height, "{what}");
        }
    }
    for out in &report.left_out {
        let (count, tolerance) = (out.segments, out.tolerance);
        assert_eq!(out.id, format!("{}-{count}x{count}-{tolerance}", out.mode));
        assert!(!out.reason.is_empty());
    }
    let has_front = report.methods.iter().any(|method| method.on_front);
    let has_time = report.methods.iter().any(|it| it.ms.is_some());
    assert_eq!(has_front, is_covered && has_time);
    report
}
