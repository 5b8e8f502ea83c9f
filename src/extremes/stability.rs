//! One number of a scene at a time over its whole range in; how far four evaluations of Phong's model stray from the
//! enclosures of its exact levels out.
//!
//! ```text
//! Sweep (sweeps) --values--> Setting --+-- textbook: all of it in f32 --+
//!                                      +-- the renderer at 0 and 0.5 ---+-- enclosures --> Curves --> report, plot
//!                                      '-- the reference in f64 --------+
//! ```
//!
//! Rule: an error is an interval, from what is drawn to the nearest and to the farthest value of the enclosure. A limit is
//! kept where all of it is within the limit.

mod plot;
mod report;
mod sweeps;
mod textbook;

use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

use anyhow::Context;
use fearless_simd::Level;
use rayon::ThreadPoolBuilder;
use rayon::prelude::*;
use serde::Serialize;

use super::Options;
use super::bench::{Bench, Trouble, enclosures};
use super::setting::{Setting, Way};
use crate::components::{Projection, ShadingMode};
use crate::output::{self, Output};
use crate::prove::{Verdict, nearest, shown_face};
use crate::reference;
use crate::shading::EXACT;
use crate::trade::make_writable;
use crate::trade::progress::{Progress, with_bar};
pub use report::{csv, json, table};
pub use sweeps::{SWEEPS, Sweep};
use textbook::Textbook;

/// An evaluation of Phong's model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evaluation {
    pub id: &'static str,
    /// The error it is to keep, in levels.
    pub limit: f64,
}

/// What is compared.
pub const EVALUATIONS: [Evaluation; 4] = [
    Evaluation {
        id: "textbook-f32",
        limit: EXACT,
    },
    Evaluation {
        id: "phong-0",
        limit: EXACT,
    },
    Evaluation {
        id: "phong-0.5",
        limit: 0.5,
    },
    Evaluation {
        id: "reference-f64",
        limit: EXACT,
    },
];

/// How an evaluation fares over the range of a number.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Curve {
    pub number: &'static str,
    pub unit: &'static str,
    pub evaluation: &'static str,
    pub limit: f64,
    /// The ends of the longest run of points that are proven to keep the limit.
    pub keeps: Option<[f64; 2]>,
    pub points: Vec<Point>,
}

/// How an evaluation fares at one value.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Point {
    pub value: f64,
    /// The largest error of a small picture: not less and not more than this, in levels.
    pub error: [f64; 2],
    /// Whether the limit is kept.
    pub verdict: Verdict,
}

/// The largest errors of one picture by evaluation.
type Errors = [[f64; 2]; EVALUATIONS.len()];

impl Curve {
    /// The least and the largest value.
    pub fn range(&self) -> [f64; 2] {
        let ends = self.points.first().zip(self.points.last());
        ends.map_or([1.0; 2], |(first, last)| [first.value, last.value])
    }

    fn new(sweep: &Sweep, evaluation: usize, errors: &[(f64, Errors)]) -> Self {
        let Evaluation { id, limit } = EVALUATIONS[evaluation];
        let points = errors.iter().map(|(value, errors)| {
            let error = errors[evaluation];
            Point {
                value: *value,
                error,
                verdict: match error {
                    [_, most] if most <= limit => Verdict::Proven,
                    [least, _] if least > limit => Verdict::Refuted,
                    _ => Verdict::Undecided,
                },
            }
        });
        let points: Vec<Point> = points.collect();
        let runs = points.split(|point| point.verdict != Verdict::Proven);
        let longest = runs.max_by_key(|run| run.len()).unwrap_or_default();
        Curve {
            number: sweep.number,
            unit: sweep.unit,
            evaluation: id,
            limit,
            keeps: longest
                .first()
                .zip(longest.last())
                .map(|(first, last)| [first.value, last.value]),
            points,
        }
    }
}

/// Sweeps numbers on rayon's current threads; four curves of each, in the order of [`EVALUATIONS`].
///
/// # Errors
/// When a value makes no scene, or a picture does not fit in memory.
pub fn measure(
    sweeps: &[Sweep],
    level: Level,
    progress: &(dyn Fn(Progress) + Sync),
) -> Result<Vec<Curve>, Trouble> {
    let all: Vec<(&Sweep, f64)> = sweeps
        .iter()
        .flat_map(|sweep| sweep.values().into_iter().map(move |value| (sweep, value)))
        .collect();
    let done = AtomicUsize::new(0);
    let errors = all.par_iter().map(|(sweep, value)| {
        let errors = errors(&(sweep.setting)(*value), level)?;
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        progress(Progress {
            step: "sweeping numbers",
            share: done as f64 / all.len() as f64,
        });
        Ok((*value, errors))
    });
    let mut errors: Vec<(f64, Errors)> = errors.collect::<Result<_, Trouble>>()?;
    let curves = sweeps.iter().flat_map(|sweep| {
        let rest = errors.split_off(sweep.values().len());
        let of_sweep = std::mem::replace(&mut errors, rest);
        (0..EVALUATIONS.len()).map(move |evaluation| Curve::new(sweep, evaluation, &of_sweep))
    });
    Ok(curves.collect())
}

/// How far each evaluation strays in one picture.
fn errors(setting: &Setting, level: Level) -> Result<Errors, Trouble> {
    let way = |tolerance| Way {
        projection: Projection::Perspective,
        mode: ShadingMode::Phong,
        tolerance,
    };
    let scene = setting.scene()?;
    let view = setting.view(&scene, way(0.0));
    let enclosures = enclosures(&scene, &view);
    let mut bench = Bench::alone(level);
    let exact = bench.picture(setting, way(0.0))?;
    let half = bench.picture(setting, way(0.5))?;
    let rows = 0..view.size[1];
    let truth = reference::picture(&scene.world, &view, rows, &|| false, &|_| ())
        .expect("nobody cancels it");
    let textbook = Textbook::new(setting);
    let mut errors = Errors::default();
    for (pixel, seen) in enclosures.iter().enumerate() {
        let place = [pixel % view.size[0], pixel / view.size[0]];
        let met = seen.iter().find_map(|seen| seen.face);
        let shown = [
            met.map(|face| (Some(face), textbook.levels(face, place).map(f64::from))),
            Some((
                shown_face(exact.triangles[pixel]),
                exact.levels[pixel].map(f64::from),
            )),
            Some((
                shown_face(half.triangles[pixel]),
                half.levels[pixel].map(f64::from),
            )),
            Some((shown_face(truth.triangles[pixel]), truth.levels[pixel])),
        ];
        for (worst, shown) in errors.iter_mut().zip(shown) {
            let Some((face, levels)) = shown else {
                continue;
            };
            let error = nearest(face, levels, seen)
                .map_or([255.0; 2], |distance| [distance.nearest, distance.farthest]);
            *worst = [worst[0].max(error[0]), worst[1].max(error[1])];
        }
    }
    Ok(errors)
}

/// The command: sweeps all numbers, prints the ranges, and writes everything into the folder `out` if there is one.
///
/// # Errors
/// When the system gives no threads, or something cannot be written.
pub fn run(options: Options, out: Option<&Path>, as_json: bool) -> anyhow::Result<()> {
    if let Some(folder) = out {
        make_writable(folder)?;
    }
    let pool = ThreadPoolBuilder::new()
        .num_threads(options.threads)
        .build()
        .context("cannot start the threads that sweep")?;
    let curves = with_bar(|progress| pool.install(|| measure(SWEEPS, options.level, progress)))?;
    let text = if as_json {
        json(&curves)?
    } else {
        table(&curves)
    };
    Output::Stdout.write(|writer| writer.write_all(text.as_bytes()))?;
    if let Some(folder) = out {
        for (name, content) in [
            ("stability.json", json(&curves)?),
            ("stability.csv", csv(&curves)),
            ("stability.svg", plot::svg(&curves)?),
        ] {
            Output::File(folder.join(name)).write(|writer| writer.write_all(content.as_bytes()))?;
        }
        output::say(&format!(
            "wrote stability.json, stability.csv and stability.svg into {}",
            folder.display()
        ));
    }
    Ok(())
}
