//! Invented measurements with simple numbers.

use shadetrade::components::Projection;
use shadetrade::components::ShadingMode::{self, Gouraud, Phong, UnitVectors};
use shadetrade::frame::Counts;
use shadetrade::shading::Method;
use shadetrade::trade::accuracy::{Accuracy, PhongError};
use shadetrade::trade::machine::Machine;
use shadetrade::trade::metrics::Error;
use shadetrade::trade::record::Subject;
use shadetrade::trade::timing::Timing;
use shadetrade::trade::{Measurement, MethodReport, Report};

/// A timing with an interval of half a percent of its median on both sides.
pub fn timing(median: f64) -> Timing {
    Timing {
        samples: 3,
        median,
        interval: [0.995 * median, 1.005 * median],
        min: 0.5 * median,
        raw: vec![0.5 * median, median, 2.0 * median],
    }
}

/// Errors with the largest error `max`.
pub fn error(max: f64) -> PhongError {
    let levels = Error {
        max,
        max_pixel: [1, 0],
        mean: max / 8.0,
        rmse: max / 4.0,
        p999: max / 2.0,
        over_1_level: if max > 1.0 { 0.25 } else { 0.0 },
    };
    PhongError {
        levels,
        flip_mean: max / 512.0,
    }
}

/// A measurement of a method on the front.
pub fn live(method: Method, median: f64, error: f64) -> Measurement {
    Measurement {
        method,
        timing: timing(median),
        error: Some(error),
        worst: Some([0, 0]),
        highlight_kept: None,
        on_front: true,
    }
}

/// Mode, tolerance, time, largest error and own error, share of the highlight.
type Row = (ShadingMode, f64, f64, [f64; 2], f64);

/// Gouraud, the shortcut and two kinds of Phong with a thousand covered pixels: 2, 6, 3 and 8 ns per pixel.
pub fn report() -> Report {
    let rows = [
        (Gouraud, 0.5, 0.002, [163.0, 0.25], 0.0),
        (UnitVectors, 0.0, 0.006, [171.0, 0.0], 0.04),
        (Phong, 0.5, 0.003, [0.4, 0.4], 1.0),
        (Phong, 0.0, 0.008, [0.0, 0.0], 1.0),
    ];
    let method = |(mode, tolerance, median, [max, own], kept): Row| MethodReport {
        method: Method::of(mode, tolerance),
        threads: 1,
        timing: timing(median),
        ns_per_covered_pixel: Some(median * 1e6 / 1000.0),
        counts: Counts {
            covered_pixels: 1000,
            model_evaluations: 8,
            specular_evaluations: 4,
            ..Counts::default()
        },
        accuracy: Accuracy {
            error: Some(error(max)),
            own_error: Some(error(own).levels),
            highlight_kept: Some(kept),
            edge_pixels: 1,
            map: Vec::new(),
        },
        on_front: mode != UnitVectors,
    };
    Report {
        subject: Subject {
            machine: Machine {
                cpu: "Some CPU".to_owned(),
                cores: 4,
                lanes: "avx2",
                os: "Some OS".to_owned(),
                rustc: "rustc 1.99.0 (0123abcd 2030-01-01)",
                profile: "release",
            },
            command: "shadetrade trade".to_owned(),
            scene: "cuboid".to_owned(),
            camera: "1".to_owned(),
            projection: Projection::Perspective,
            size: [40, 30],
        },
        covered_pixels: 1000,
        methods: rows.map(method).to_vec(),
    }
}

/// The same view without a cuboid in the picture.
pub fn empty_report() -> Report {
    let mut report = report();
    report.covered_pixels = 0;
    for one in &mut report.methods {
        one.counts = Counts::default();
        one.ns_per_covered_pixel = None;
        one.accuracy.error = None;
        one.accuracy.own_error = None;
        one.accuracy.highlight_kept = None;
        one.on_front = false;
    }
    report
}
