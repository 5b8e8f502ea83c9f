//! Invented measurements with simple numbers.

use shadetrade::components::Projection;
use shadetrade::components::ShadingMode::{Gouraud, Phong, UnitVectors};
use shadetrade::questions::job::Heading;
use shadetrade::questions::metrics::ErrorStatistics;
use shadetrade::questions::trade::machine::Machine;
use shadetrade::questions::trade::timing::Timing;
use shadetrade::questions::trade::{Measurement, Report};
use shadetrade::shading::Method;
use shadetrade::systems::frame::Counts;

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

/// A measurement of a method on the front.
pub fn live(method: Method, median: f64, error: f64) -> Measurement {
    Measurement {
        method,
        threads: 1,
        timing: timing(median),
        ns_per_covered_pixel: None,
        counts: Counts::default(),
        error: Some(ErrorStatistics {
            max: error,
            ..ErrorStatistics::default()
        }),
        own_error: None,
        edge_pixels: 0,
        highlight_kept: None,
        on_front: true,
    }
}

/// Gouraud, the shortcut and two kinds of Phong.
pub fn report() -> Report {
    let rows = [
        (Gouraud, 0.5, 0.002, 163.0, 0.0),
        (UnitVectors, 0.0, 0.006, 171.0, 0.04),
        (Phong, 0.5, 0.003, 0.4, 1.0),
        (Phong, 0.0, 0.008, 0.0, 1.0),
    ];
    let method = |(mode, tolerance, median, error, kept)| Measurement {
        ns_per_covered_pixel: Some(1e3 * median),
        highlight_kept: Some(kept),
        on_front: mode != UnitVectors,
        ..live(Method::of(mode, tolerance), median, error)
    };
    Report {
        machine: Machine {
            cpu: "Some CPU".to_owned(),
            cores: 4,
            lanes: "avx2",
            os: "Some OS".to_owned(),
            rustc: "rustc 1.99.0 (0123abcd 2030-01-01)",
            profile: "release",
        },
        command: "shadetrade trade".to_owned(),
        heading: Heading {
            scene: "cuboid".to_owned(),
            camera: "1".to_owned(),
            projection: Projection::Perspective,
            size: [40, 30],
        },
        covered_pixels: 1000,
        methods: rows.map(method).to_vec(),
        left_out: Vec::new(),
    }
}

/// The same view without a cuboid in the picture.
pub fn empty_report() -> Report {
    let mut report = report();
    report.covered_pixels = 0;
    for one in &mut report.methods {
        (one.error, one.highlight_kept) = (None, None);
        one.on_front = false;
    }
    report
}
