//! A [`Drawing`] in, PNG files out.
//!
//! Rule: a picture that is written is a frame as the window would show it, byte for byte.

mod figures;
mod sheet;

pub use figures::figures;

use std::time::{Duration, Instant};

use crate::drawing::Drawing;
use crate::frame::{Frame, Keep, OutOfMemory};
use crate::output::{Output, say};
use crate::{simd, systems};

/// Draws one picture into `output`, and says on standard error what it wrote and what a frame of it costs.
///
/// # Errors
/// When the picture does not fit in memory or cannot be written.
pub fn render(mut drawing: Drawing, output: &Output) -> anyhow::Result<()> {
    let view = drawing.view();
    let mut frame = Frame::new(Keep::Display, drawing.workers()?);
    let mut draw = || systems::draw(&mut drawing.scene.world, &view, &mut frame);
    draw()?;
    let (time, frames) = warm_frame(draw)?;
    output.write_png(frame.pixels(), frame.size())?;
    let [width, height] = frame.size();
    let name = match output {
        Output::Stdout => "standard output".into(),
        Output::File(path) => path.to_string_lossy(),
    };
    say(&format!(
        "wrote {name}: PNG, {width}x{height}, {} pixels shaded; a frame takes {:.3} ms \
         (median of {}, PNG apart; {}, {})",
        frame.counts().covered_pixels,
        time.as_secs_f64() * 1e3,
        count(frames, "warm frame"),
        count(frame.workers().threads(), "thread"),
        simd::name(frame.workers().level()),
    ));
    Ok(())
}

fn count(number: usize, thing: &str) -> String {
    format!("{number} {thing}{}", if number == 1 { "" } else { "s" })
}

/// The median time of a frame by `draw`, and of how many: an odd number, so that the median is one of them.
fn warm_frame(
    mut draw: impl FnMut() -> Result<(), OutOfMemory>,
) -> Result<(Duration, usize), OutOfMemory> {
    // Enough for a steady median of small pictures; a large one is steady by itself and should not keep anyone waiting.
    const MOST_FRAMES: usize = 15;
    const ENOUGH: Duration = Duration::from_millis(200);
    let begin = Instant::now();
    let mut times = Vec::with_capacity(MOST_FRAMES);
    while times.len() < MOST_FRAMES && (times.len() % 2 == 0 || begin.elapsed() < ENOUGH) {
        let start = Instant::now();
        draw()?;
        times.push(start.elapsed());
    }
    times.sort_unstable();
    Ok((times[times.len() / 2], times.len()))
}
