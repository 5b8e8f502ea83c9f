//! The stability charts: one number of a scene varies over its whole range, and four evaluations of Phong's model are compared
//! with the enclosures of its exact levels.
//!
//! ```text
//! sweeps --values--> SceneRecord -+-- reference in f32, f64 ---+
//!                                '-- renderer at 0 and 0.5 ---+-- enclosures --> curves --> table, plot
//! ```
//! The error of a pixel lies in an interval: from the drawn level to the nearest and to the farthest value of the enclosure.

pub mod curve;
mod plot;
pub mod sweeps;

use std::path::Path;

use fearless_simd::Level;

use self::curve::{EVALUATIONS, ErrorCurve, Errors, table};
use self::sweeps::SWEEPS;
use crate::components::{ShadingMode, View};
use crate::files;
use crate::frame::{Frame, Keep, Workers};
use crate::output::{self, print, say};
use crate::prove::{nearest, shown};
use crate::reference::{Interval, Real, Reference};
use crate::report::Monitor;
use crate::report::progress::with_bar;
use crate::scene::SceneRecord;
use crate::systems;

/// Width and height of a picture, in pixels.
pub const SIZE: [usize; 2] = [128, 96];

/// Sweeps all numbers on rayon's current threads. Each has four curves, in the order of [`EVALUATIONS`].
///
/// # Errors
/// If a value makes no valid scene, or a picture does not fit in memory.
pub async fn measure(
    size: [usize; 2],
    level: Level,
    monitor: Monitor<'_>,
) -> anyhow::Result<Vec<ErrorCurve>> {
    let all = SWEEPS.iter().map(|sweep| sweep.values().len()).sum();
    let (mut curves, mut done) = (Vec::new(), 0);
    for sweep in SWEEPS {
        let values = sweep.values();
        let errors = |value: &f64| Ok((*value, errors(&sweep.scene(*value)?, size, level)?));
        let errors = monitor.in_parallel("sweeping numbers", &values, [done, all], errors);
        let errors = errors.await?;
        let evaluations = 0..EVALUATIONS.len();
        curves.extend(evaluations.map(|evaluation| ErrorCurve::new(sweep, evaluation, &errors)));
        done += values.len();
    }
    Ok(curves)
}

/// The errors of each evaluation in one picture.
fn errors(record: &SceneRecord, size: [usize; 2], level: Level) -> anyhow::Result<Errors> {
    record.check()?;
    let mut world = record.spawn();
    let view = View::of(&world, size).shaded(ShadingMode::Phong);
    let mut drawn = |tolerance| {
        let mut frame = Frame::new(Keep::Levels, Workers::alone(level));
        systems::draw(&mut world, &view.with_tolerance(tolerance), &mut frame)?;
        anyhow::Ok(frame)
    };
    let frames = [drawn(0.0)?, drawn(0.5)?];
    let in_f32 = Reference::<f32>::new(&world, &view);
    let in_f64 = Reference::<f64>::new(&world, &view);
    let enclosures = Reference::<Interval>::new(&world, &view);
    let mut errors = Errors::default();
    for y in 0..size[1] {
        enclosures.row(y, |x, seen| {
            let pixel = y * size[0] + x;
            let [exact, half] = frames.each_ref().map(|frame| shown(frame, pixel));
            let surfaces = [
                nearest_surface(&in_f32, [x, y]),
                exact,
                half,
                nearest_surface(&in_f64, [x, y]),
            ];
            for (worst, (face, levels)) in errors.iter_mut().zip(surfaces) {
                let error = nearest(face, levels, seen).unwrap_or([255.0; 2]);
                *worst = [worst[0].max(error[0]), worst[1].max(error[1])];
            }
        });
    }
    Ok(errors)
}

/// The face that a pixel shows in a picture of floats, and its levels.
fn nearest_surface<R: Real>(
    picture: &Reference<R>,
    pixel: [usize; 2],
) -> (Option<usize>, [f64; 3]) {
    let seen = picture.at(pixel)[0];
    (seen.face(), seen.levels.map(|level| level.endpoints()[0]))
}

/// The command: sweeps all numbers, prints the ranges, and writes the files into the folder `out` if there is one.
///
/// # Errors
/// If a picture does not fit in memory or a file cannot be written.
pub fn run(level: Level, out: Option<&Path>, as_json: bool) -> anyhow::Result<()> {
    if let Some(folder) = out {
        files::make_folder(folder)?;
    }
    let curves = with_bar(async |monitor| measure(SIZE, level, monitor).await)?;
    print(&curves, as_json, None, || table(&curves))?;
    if let Some(folder) = out {
        let files = [
            ("stability.json", output::json(&curves)?),
            ("stability.svg", plot::svg(&curves)?),
        ];
        output::write_texts(folder, &files)?;
        say(&format!(
            "wrote stability.json and stability.svg into {}",
            folder.display()
        ));
    }
    Ok(())
}
