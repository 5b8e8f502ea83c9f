//! Replay: the states of a recording are shown at their times, in the window or, frame by frame, without a display.
//!
//! Without a display the window shows no times, which are the machine's: its frames are the same everywhere.

use std::fmt::Write;
use std::iter::Peekable;
use std::slice::Iter;
use std::time::Duration;

use egui::{Key, RawInput};

use super::app::App;
use super::recording::{Event, Log, RecordedFrame, patched};
use crate::drawing::Drawing;
use crate::memory;
use crate::output::{Animation, Output, say};
use crate::report::progress::with_bar;
use crate::report::words::counted;
use crate::scene::{Scene, SceneRecord};

/// How long the last frame of an animation is shown.
const LAST: Duration = Duration::from_secs(2);
/// A message is shown until a pause ends, and at least this long after it.
const AFTER_PAUSE: Duration = Duration::from_secs(2);
/// The most steps until the window shows the answers to the questions of the step before.
const STEPS: usize = 4;
/// The bytes of a pixel in the window's buffer and in its picture.
const PIXEL: usize = 8;

/// Plays a log in a window. Space pauses it and lets it go on.
pub struct Player<'a> {
    /// The frames to come.
    frames: Peekable<Iter<'a, RecordedFrame>>,
    /// The length of all pauses before.
    delay: Duration,
    /// When the present pause began, by the window's clock.
    paused: Option<Duration>,
}

impl<'a> Player<'a> {
    pub fn new(log: &'a Log) -> Self {
        Player {
            frames: log.frames.iter().peekable(),
            delay: Duration::ZERO,
            paused: None,
        }
    }

    /// Plays the frames until `now` by the window's clock. Returns when the next one is due.
    ///
    /// # Errors
    /// None of a valid log.
    pub fn play(
        &mut self,
        app: &mut App,
        now: Duration,
        events: &[egui::Event],
    ) -> anyhow::Result<Duration> {
        if let (Some(_), Some((_, until))) = (self.paused, &mut app.desk.message) {
            *until = (*until).max(now + AFTER_PAUSE);
        }
        if is_pressed(events, &[Key::Space]) {
            match self.paused.take() {
                Some(begin) => self.delay += now.saturating_sub(begin),
                None => self.paused = Some(now),
            }
        }
        if self.paused.is_some() {
            return Ok(Duration::MAX);
        }
        let delay = self.delay;
        while let Some(frame) = self.frames.next_if(|frame| frame.at + delay <= now) {
            play(app, frame, frame.at + delay)?;
        }
        let next = self.frames.peek();
        Ok(next.map_or(Duration::MAX, |next| next.at + delay))
    }

    /// The state of the replay and its keys, for the window's title.
    pub fn title(&mut self) -> &'static str {
        match (self.paused, self.frames.peek()) {
            (_, None) => "replay has ended (Enter takes over, Q quits): ",
            (None, _) => "replay (Space pauses, Enter takes over, Q quits): ",
            (Some(_), _) => "replay is paused (Space goes on, Enter takes over, Q quits): ",
        }
    }
}

/// Whether one of these keys was pressed.
pub fn is_pressed(events: &[egui::Event], keys: &[Key]) -> bool {
    let mut pressed = events.iter().filter_map(|event| match event {
        egui::Event::Key {
            key,
            pressed: true,
            repeat: false,
            ..
        } => Some(key),
        _ => None,
    });
    pressed.any(|key| keys.contains(key))
}

/// Changes the state and the size of the window as a frame says, at this time by the window's clock.
///
/// # Errors
/// None of a valid log.
pub fn play(app: &mut App, frame: &RecordedFrame, at: Duration) -> anyhow::Result<()> {
    app.now = at;
    for event in &frame.events {
        match event {
            Event::Scene(it) => app.open(Scene::spawn(it.name.clone(), &it.scene)),
            Event::Patch(patch) => {
                let state = SceneRecord::of(&app.scene.world);
                app.restore(&patched(&state, patch)?);
            }
            Event::Say(words) => app.say(words),
            Event::Size(size) => app.size = *size,
        }
    }
    Ok(())
}

/// Draws the window as `log` says, and hands it over after each of the log's frames.
///
/// # Errors
/// If a frame does not fit in memory, or `take` fails.
pub fn draw(
    log: &Log,
    drawing: Drawing,
    mut take: impl FnMut(&App, &RecordedFrame) -> anyhow::Result<()>,
) -> anyhow::Result<()> {
    let mut app = App::new(drawing, false)?;
    app.shows_times = false;
    for frame in &log.frames {
        play(&mut app, frame, frame.at)?;
        let size = app.size;
        memory::check(size, PIXEL * size[0] * size[1])?;
        for _ in 0..STEPS {
            app.step(frame.at, size, RawInput::default())?;
        }
        take(&app, frame)?;
    }
    Ok(())
}

/// Draws `log` again: writes its last frame, or all of them into a file that ends in .apng, and prints a hash of each
/// picture where that is asked for.
///
/// # Errors
/// If a frame does not fit in memory, or something cannot be written.
pub fn run(
    log: &Log,
    drawing: Drawing,
    output: Option<&Output>,
    with_hashes: bool,
) -> anyhow::Result<()> {
    let count = log.frames.len();
    let mut times = log.frames.iter().map(|frame| frame.at).skip(1);
    let is_animated = |it: &&Output| it.name().to_lowercase().ends_with(".apng");
    let animated = output.filter(is_animated);
    let (mut file, canvas) = (Vec::new(), log.canvas(drawing.size));
    let animation = animated.map(|_| Animation::new(&mut file, canvas, count));
    let mut animation = animation.transpose()?;
    let (mut hashes, mut done) = (String::new(), 0);
    with_bar(|monitor| {
        draw(log, drawing, |app, frame| {
            done += 1;
            (monitor.progress)("drawing", f64::from(done) / count as f64);
            let hash = hash(&app.shown());
            writeln!(hashes, "{:.3} {hash:016x}", frame.time.as_secs_f64())?;
            let next = times.next();
            if let Some(animation) = &mut animation {
                let lasts = next.map_or(LAST, |next| next.saturating_sub(frame.at));
                animation.add(&app.pixels, app.size, lasts)?;
            } else if let (None, Some(output)) = (next, output) {
                output.write_png(&app.pixels, app.size)?;
            }
            Ok(())
        })
    })?;
    animation.map(Animation::finish).transpose()?;
    if let Some(output) = animated {
        output.write(file)?;
    }
    if with_hashes {
        Output::Stdout.write(hashes)?;
    }
    let written = output.map_or_else(String::new, |it| format!("; wrote {}", it.name()));
    say(&format!("replayed {}{written}", counted(count, "frame")));
    Ok(())
}

/// FNV-1a in 64 bits (Fowler, Noll and Vo) of the bytes 0, red, green and blue of every pixel.
pub fn hash(pixels: &[u32]) -> u64 {
    let bytes = pixels.iter().flat_map(|pixel| pixel.to_be_bytes());
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}
