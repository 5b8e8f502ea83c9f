//! Replay: the states of a recording are shown at their times, in the window or, frame by frame, without a display.
//!
//! Without a display the window shows no times, which are the machine's: its frames are the same everywhere.

use std::fmt::Write;
use std::io;
use std::iter::Peekable;
use std::time::Duration;

use egui::RawInput;

use super::app::App;
use super::recording::{Event, Frame, Log};
use crate::drawing::Drawing;
use crate::memory;
use crate::output::{Animation, Output, say};
use crate::scene::Scene;
use crate::trade::progress::with_bar;

/// How long the last frame of an animation is shown.
const LAST: Duration = Duration::from_secs(2);
/// The most steps until the window shows the answers to the questions of the step before.
const STEPS: usize = 4;
/// The bytes of a pixel in the window's buffer and in its picture.
const PIXEL: usize = 8;

/// Lets everything happen that is due at `now`; returns the time of the next frame.
///
/// # Errors
/// The first mistake in the log.
pub fn play(
    frames: &mut Peekable<impl Iterator<Item = anyhow::Result<Frame>>>,
    app: &mut App,
    now: Duration,
) -> anyhow::Result<Duration> {
    app.now = now;
    while let Some(frame) = frames.next_if(|next| !matches!(next, Ok(frame) if frame.at > now)) {
        happen(app, frame?);
    }
    let next = frames.peek().and_then(|next| next.as_ref().ok());
    Ok(next.map_or(Duration::MAX, |next| next.at))
}

/// Changes the state as a frame says; returns the size that the window gets, if there is one.
fn happen(app: &mut App, frame: Frame) -> Option<[usize; 2]> {
    let mut size = None;
    for event in frame.events {
        match event {
            Event::Scene(name, record) => app.open(Scene::spawn(name, &record)),
            Event::State(record) => app.restore(&record),
            Event::Say(words) => app.say(words),
            Event::Size(new) => size = Some(new),
        }
    }
    size
}

/// A frame as it was drawn.
pub struct Drawn<'a> {
    pub app: &'a App,
    /// Counted from 0.
    pub index: usize,
    /// The time in the log.
    pub time: Duration,
    /// How long it is shown.
    pub lasts: Duration,
    /// Of the window, in pixels.
    pub size: [usize; 2],
}

/// Draws the window as `log` says, and hands over each of its frames.
///
/// # Errors
/// When a frame does not fit in memory, or `take` fails.
pub fn draw(
    log: &Log,
    drawing: Drawing,
    mut take: impl FnMut(&Drawn) -> anyhow::Result<()>,
) -> anyhow::Result<()> {
    let mut size = drawing.size;
    let mut app = App::new(drawing, false)?;
    app.shows_times = false;
    let mut frames = log.frames().peekable();
    for index in 0.. {
        let Some(frame) = frames.next().transpose()? else {
            break;
        };
        let (time, now) = (frame.time, frame.at);
        app.now = now;
        size = happen(&mut app, frame).unwrap_or(size);
        memory::check(size, PIXEL * size[0] * size[1])?;
        for _ in 0..STEPS {
            app.step(now, size, RawInput::default())?;
        }
        let lasts = match frames.peek() {
            Some(Ok(next)) => next.at - now,
            _ => LAST,
        };
        take(&Drawn {
            app: &app,
            index,
            time,
            lasts,
            size,
        })?;
    }
    Ok(())
}

/// Draws `log` again: writes its last frame, or all of them where `animated`, and prints a hash of each picture where
/// that is asked for.
///
/// # Errors
/// When a frame does not fit in memory, or something cannot be written.
pub fn run(
    log: &Log,
    drawing: Drawing,
    output: Option<&Output>,
    animated: bool,
    with_hashes: bool,
) -> anyhow::Result<()> {
    let mut hashes = String::new();
    with_bar(|on_progress| {
        let mut note = |drawn: &Drawn| {
            let hash = hash(&drawn.app.shown());
            let done = drawn.index + 1;
            on_progress("replaying", done as f64 / log.count as f64);
            writeln!(hashes, "{:.3} {hash:016x}", drawn.time.as_secs_f64())
        };
        match output {
            Some(output) if animated => output.write(|writer| {
                let mut animation = Animation::new(writer, log.canvas, log.count)?;
                draw(log, drawing, |drawn| {
                    note(drawn)?;
                    Ok(animation.add(drawn.app.pixels(), drawn.size, drawn.lasts)?)
                })
                .map_err(io::Error::other)?;
                animation.finish()
            }),
            _ => draw(log, drawing, |drawn| {
                note(drawn)?;
                match output {
                    Some(output) if drawn.index + 1 == log.count => {
                        output.write_png(drawn.app.pixels(), drawn.size)
                    }
                    _ => Ok(()),
                }
            }),
        }
    })?;
    if with_hashes {
        Output::Stdout.write(|writer| writer.write_all(hashes.as_bytes()))?;
    }
    let written = output.map_or_else(String::new, |it| format!("; wrote {}", it.name()));
    say(&format!("replayed {} frames{written}", log.count));
    Ok(())
}

/// FNV-1a in 64 bits (Fowler, Noll and Vo) of the bytes 0, red, green and blue of every pixel.
pub fn hash(pixels: &[u32]) -> u64 {
    let bytes = pixels.iter().flat_map(|pixel| pixel.to_be_bytes());
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}
