//! The commands `render` and `figures`: PNG files of a [`Drawing`].
//!
//! A rendered picture has the bytes of the window's frame.

mod assignment;
pub mod sheet;

pub use assignment::figures;

use std::time::{Duration, Instant};

use crate::components::{TriangleId, viewer};
use crate::output::Monitor;
use crate::output::finished;
use crate::output::memory;
use crate::output::progress::{bands, with_bar};
use crate::output::words::counted;
use crate::output::{Output, say};
use crate::questions::job::Drawing;
use crate::questions::trade::batch::time_here;
use crate::questions::trade::budget;
use crate::questions::trade::timing::{self, Timing};
use crate::reference;
use crate::shading::simd;
use crate::systems;
use crate::systems::frame::{Frame, Keep, display_pixel};

/// Draws one picture into `output` and reports it, with the time of a frame, on standard error.
///
/// The time of a method that a budget has chosen is the one by which it was chosen.
///
/// # Errors
/// If the picture does not fit in memory or cannot be written.
pub fn render(drawing: &mut Drawing, output: &Output) -> anyhow::Result<()> {
    let mut view = drawing.view();
    let budget = viewer(&drawing.scene.world).budget;
    let chosen = match budget {
        Some(budget) => budget::choose(drawing, budget, &time_here)?,
        None => None,
    };
    if let (Some(budget), Some((one, text))) = (budget, &chosen) {
        view = one.method.view(&view);
        say(&format!("a budget of {budget} ms chooses {text}"));
    }
    let mut frame = Frame::new(Keep::Display, drawing.workers()?);
    let world = &mut drawing.scene.world;
    let mut draw = |_| systems::draw(world, &view, &mut frame).map_err(anyhow::Error::from);
    let timing = if let Some((one, _)) = chosen {
        draw(0)?;
        one.timing
    } else {
        let times = timing::batch(0, 1, Duration::ZERO, Monitor::NONE, draw);
        Timing::of(&finished(times)?)
    };
    output.write_png(frame.pixels(), frame.size())?;
    let [width, height] = frame.size();
    say(&format!(
        "wrote {}: PNG, {width}x{height}, {} shaded; a frame takes {:.3} ms \
         (median of {}, PNG apart; {}, {})",
        output.name(),
        counted(frame.counts().covered_pixels as usize, "pixel"),
        timing.median,
        counted(timing.samples, "warm frame"),
        counted(frame.workers().threads(), "thread"),
        simd::name(frame.workers().level()),
    ));
    drawing.say_if_unseen(frame.counts().covered_pixels);
    Ok(())
}

/// Draws one picture with the f64 reference into `output` and reports it on standard error.
///
/// # Errors
/// As [`render`].
pub fn render_reference(drawing: &mut Drawing, output: &Output) -> anyhow::Result<()> {
    let view = drawing.view();
    let [width, height] = view.size;
    let (mut pixels, mut covered) = (memory::reserve_pixels(view.size)?, 0);
    let begin = Instant::now();
    let world = &drawing.scene.world;
    with_bar(async |monitor| {
        for rows in bands(height) {
            let truth = reference::picture(world, &view, rows, monitor).await?;
            let covered_here = truth.triangles.iter().filter(|it| **it != TriangleId::NONE);
            covered += covered_here.count();
            pixels.extend(truth.levels.into_iter().map(display_pixel));
        }
        Ok(())
    })?;
    let time = begin.elapsed();
    output.write_png(&pixels, view.size)?;
    say(&format!(
        "wrote {}: PNG, {width}x{height}, {} shaded by the reference in f64, in {:.3} s",
        output.name(),
        counted(covered, "pixel"),
        time.as_secs_f64()
    ));
    drawing.say_if_unseen(covered as u64);
    Ok(())
}
