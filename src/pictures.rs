//! The commands `render` and `figures`: PNG files of a [`Drawing`].
//!
//! A rendered picture has the bytes of the window's frame.

mod figures;
mod sheet;

pub use figures::figures;

use std::time::{Duration, Instant};

use crate::components::{TriangleId, viewer};
use crate::drawing::Drawing;
use crate::frame::{Frame, Keep, display_pixel};
use crate::memory;
use crate::output::{Output, say};
use crate::report::progress::{bands, with_bar};
use crate::report::words::counted;
use crate::trade::{budget, timing};
use crate::{reference, simd, systems};

/// Draws one picture into `output` and reports it, with the time of a frame, on standard error.
///
/// # Errors
/// If the picture does not fit in memory or cannot be written.
pub fn render(drawing: &mut Drawing, output: &Output) -> anyhow::Result<()> {
    let mut view = drawing.view();
    if let Some(budget) = viewer(&drawing.scene.world).budget
        && let Some((method, text)) = budget::choose(drawing, budget)?
    {
        view = method.view(&view);
        say(&format!("a budget of {budget} ms chooses {text}"));
    }
    let mut frame = Frame::new(Keep::Display, drawing.workers()?);
    let times = timing::batch(0, 1, Duration::ZERO, |_| {
        Ok(systems::draw(&mut drawing.scene.world, &view, &mut frame)?)
    })?;
    output.write_png(frame.pixels(), frame.size())?;
    let [width, height] = frame.size();
    say(&format!(
        "wrote {}: PNG, {width}x{height}, {} shaded; a frame takes {:.3} ms \
         (median of {}, PNG apart; {}, {})",
        output.name(),
        counted(frame.counts().covered_pixels as usize, "pixel"),
        timing::median(&times[0]),
        counted(times[0].len(), "warm frame"),
        counted(frame.workers().threads(), "thread"),
        simd::name(frame.workers().level()),
    ));
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
    with_bar(|monitor| {
        for rows in bands(height) {
            let truth = reference::picture(world, &view, rows, monitor)?;
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
    Ok(())
}
