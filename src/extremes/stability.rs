//! The stability charts: one number of a scene varies over its whole range, and four evaluations of Phong's model are compared
//! with the enclosures of its exact levels.
//!
//! ```text
//! sweeps --values--> SceneRecord -+-- textbook, in f32 --------+
//!                                +-- renderer at 0 and 0.5 ---+-- enclosures --> curves --> report, plot
//!                                '-- reference in f64 --------+
//! ```
//! An error is an interval: from the drawn level to the nearest and to the farthest value of the enclosure. A limit is kept
//! where all of the interval is within it.

mod plot;
mod report;
mod sweeps;
mod textbook;

use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

use anyhow::Context;
use fearless_simd::Level;
use rayon::prelude::*;
use serde::Serialize;

use crate::components::{ShadingMode, View};
use crate::frame::{Frame, Keep, Workers};
use crate::output::{Output, print, say};
use crate::prove::{Verdict, nearest, shown_face};
use crate::reference::{Interval, Reference, Seen};
use crate::scene::SceneRecord;
use crate::shading::EXACT;
use crate::systems;
use crate::trade::export::json;
use crate::trade::make_writable;
use crate::trade::progress::{OnProgress, with_bar};
pub use report::table;
pub use sweeps::{SWEEPS, Sweep};
use textbook::Textbook;

/// What is compared: evaluations of Phong's model, and the error in levels that each is to keep.
pub const EVALUATIONS: [(&str, f64); 4] = [
    ("textbook-f32", EXACT),
    ("phong-0", EXACT),
    ("phong-0.5", 0.5),
    ("reference-f64", EXACT),
];

/// Width and height of a picture, in pixels.
const SIZE: [usize; 2] = [64, 48];

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
        ends(&self.points).unwrap_or([1.0; 2])
    }

    fn new(sweep: &Sweep, evaluation: usize, errors: &[(f64, Errors)]) -> Self {
        let (id, limit) = EVALUATIONS[evaluation];
        let points = errors.iter().map(|(value, errors)| {
            let error = errors[evaluation];
            Point {
                value: *value,
                error,
                verdict: Verdict::of(error, limit),
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
            keeps: ends(longest),
            points,
        }
    }
}

fn ends(points: &[Point]) -> Option<[f64; 2]> {
    Some([points.first()?.value, points.last()?.value])
}

/// Sweeps numbers on rayon's current threads; four curves of each, in the order of [`EVALUATIONS`].
///
/// # Errors
/// When a value makes no scene, or a picture does not fit in memory.
pub fn measure(
    sweeps: &[Sweep],
    level: Level,
    on_progress: OnProgress,
) -> anyhow::Result<Vec<Curve>> {
    let total: usize = sweeps.iter().map(|sweep| sweep.values().len()).sum();
    let done = AtomicUsize::new(0);
    let mut curves = Vec::new();
    for sweep in sweeps {
        let errors = sweep.values().into_par_iter().map(|value| {
            let errors = errors(&sweep.scene(value), level)?;
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            on_progress("sweeping numbers", done as f64 / total as f64);
            Ok((value, errors))
        });
        let errors = errors.collect::<anyhow::Result<Vec<_>>>()?;
        let evaluations = 0..EVALUATIONS.len();
        curves.extend(evaluations.map(|evaluation| Curve::new(sweep, evaluation, &errors)));
    }
    Ok(curves)
}

/// How far each evaluation errs in one picture.
fn errors(record: &SceneRecord, level: Level) -> anyhow::Result<Errors> {
    record.check()?;
    let mut world = record.spawn();
    let view = View::of(&world, SIZE).shaded(ShadingMode::Phong);
    let mut drawn = |tolerance| {
        let mut frame = Frame::new(Keep::Levels, Workers::alone(level));
        systems::draw(&mut world, &view.with_tolerance(tolerance), &mut frame)?;
        anyhow::Ok(frame)
    };
    let frames = [drawn(0.0)?, drawn(0.5)?];
    let truth = Reference::<f64>::new(&world, &view)
        .picture(0..SIZE[1], &|| false, &|_| ())
        .context("the reference was cancelled")?;
    let textbook = Textbook::new(record, SIZE);
    let enclosures = Reference::<Interval>::new(&world, &view);
    let mut errors = Errors::default();
    for y in 0..SIZE[1] {
        enclosures.row(y, |x, seen| {
            let pixel = y * SIZE[0] + x;
            let met = seen.iter().find_map(Seen::face);
            let [exact, half] = frames.each_ref().map(|frame| {
                let face = shown_face(frame.triangles()[pixel]);
                Some((face, frame.levels()[pixel].map(f64::from)))
            });
            let shown = [
                met.map(|face| (Some(face), textbook.levels(face, [x, y]).map(f64::from))),
                exact,
                half,
                Some((shown_face(truth.triangles[pixel]), truth.levels[pixel])),
            ];
            for (worst, shown) in errors.iter_mut().zip(shown) {
                let Some((face, levels)) = shown else {
                    continue;
                };
                let error = nearest(face, levels, seen).unwrap_or([255.0; 2]);
                *worst = [worst[0].max(error[0]), worst[1].max(error[1])];
            }
        });
    }
    Ok(errors)
}

/// The command: sweeps all numbers, prints the ranges, and writes everything into the folder `out` if there is one.
///
/// # Errors
/// When the system gives no threads, or something cannot be written.
pub fn run(level: Level, out: Option<&Path>, as_json: bool) -> anyhow::Result<()> {
    if let Some(folder) = out {
        make_writable(folder)?;
    }
    let curves = with_bar(|progress| measure(SWEEPS, level, progress))?;
    print(&curves, as_json, || table(&curves))?;
    if let Some(folder) = out {
        for (name, content) in [
            ("stability.json", json(&curves)?),
            ("stability.svg", plot::svg(&curves)?),
        ] {
            Output::File(folder.join(name)).write(|writer| writer.write_all(content.as_bytes()))?;
        }
        say(&format!(
            "wrote stability.json and stability.svg into {}",
            folder.display()
        ));
    }
    Ok(())
}
