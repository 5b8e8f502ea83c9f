//! Invented measurements with simple numbers.

use shadetrade::components::{Projection, ShadingMode};
use shadetrade::frame::Counts;
use shadetrade::shading::Method;
use shadetrade::trade::accuracy::{Accuracy, PhongError};
use shadetrade::trade::error_map::ErrorMap;
use shadetrade::trade::machine::Machine;
use shadetrade::trade::metrics::{Error, Picture};
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
pub fn error(max: f64) -> Error {
    Error {
        max,
        max_pixel: [1, 0],
        mean: max / 8.0,
        rmse: max / 4.0,
        p999: max / 2.0,
        over_1_level: if max > 1.0 { 0.25 } else { 0.0 },
    }
}

/// The measurement of a method with a thousand covered pixels.
pub fn measurement(
    (id, mode, tolerance): (&'static str, ShadingMode, f64),
    median: f64,
    [max, own_max]: [f64; 2],
    highlight_kept: Option<f64>,
    on_front: bool,
) -> MethodReport {
    let pixel = Picture {
        width: 1,
        levels: &[[max; 3]],
        triangles: &[0],
    };
    let black = Picture {
        levels: &[[0.0; 3]],
        ..pixel
    };
    MethodReport {
        method: Method {
            id,
            mode,
            tolerance,
        },
        threads: 1,
        timing: timing(median),
        ns_per_covered_pixel: Some(median * 1e6 / 1000.0),
        stages: vec![
            ("lighting", 0.25 * median),
            ("rasterization", 0.75 * median),
        ],
        counts: Counts {
            covered_pixels: 1000,
            model_evaluations: 8,
            specular_evaluations: 4,
            ..Counts::default()
        },
        accuracy: Accuracy {
            error: PhongError {
                levels: Some(error(max)),
                flip_mean: Some(max / 512.0),
            },
            own_error: Some(error(own_max)),
            highlight_kept,
            edge_pixels: 1,
            map: ErrorMap::between(pixel, black),
        },
        on_front,
    }
}

/// A measurement of a method in the window.
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

/// A view and a machine for a measurement that did not take place.
pub fn subject(command: &str) -> Subject {
    Subject {
        machine: Machine {
            cpu: "Some CPU".to_owned(),
            cores: 4,
            lanes: "avx2",
            os: "Some OS".to_owned(),
            rustc: "rustc 1.99.0 (0123abcd 2030-01-01)",
            profile: "release",
        },
        command: command.to_owned(),
        scene: "cuboid".to_owned(),
        camera: "1".to_owned(),
        projection: Projection::Perspective,
        size: [40, 30],
    }
}

/// Gouraud, the shortcut and two kinds of Phong: 2, 6, 3 and 8 ns per pixel.
pub fn report() -> Report {
    use ShadingMode::{Gouraud, Phong, UnitVectors};
    Report {
        subject: subject("shadetrade trade"),
        covered_pixels: 1000,
        methods: vec![
            measurement(
                ("gouraud-0.5", Gouraud, 0.5),
                0.002,
                [163.0, 0.25],
                Some(0.0),
                true,
            ),
            measurement(
                ("phong-unit-vectors", UnitVectors, 0.0),
                0.006,
                [171.0, 0.0],
                Some(0.04),
                false,
            ),
            measurement(
                ("phong-0.5", Phong, 0.5),
                0.003,
                [0.4, 0.4],
                Some(1.0),
                true,
            ),
            measurement(("phong-0", Phong, 0.0), 0.008, [0.0, 0.0], Some(1.0), true),
        ],
    }
}

/// The same view without any cuboid in the picture.
pub fn empty_report() -> Report {
    let mut report = report();
    report.covered_pixels = 0;
    for measurement in &mut report.methods {
        measurement.counts = Counts::default();
        measurement.ns_per_covered_pixel = None;
        measurement.accuracy.error = PhongError {
            levels: None,
            flip_mean: None,
        };
        measurement.accuracy.own_error = None;
        measurement.accuracy.highlight_kept = None;
        measurement.on_front = false;
    }
    report
}
