//! The window: minifb opens it, egui lays it out, the World is its state.
//!
//! ```text
//! minifb --reports--> input --events of egui--> App::step --pixels, effects--> minifb
//!                                                  |
//!              keys, panel, inspector, viewport <--'--> questions (threads in the background)
//! ```
//! Only [`display`] and [`run`] need a display. A step is taken when something happens; else nothing is laid out, drawn or
//! painted.

mod actions;
pub mod app;
mod budget;
mod chart;
pub mod comparison;
pub mod display;
mod edits;
pub mod facts;
pub mod file;
pub mod history;
pub mod input;
pub mod inspector;
pub mod keys;
mod layout;
pub mod lights;
mod panel;
pub mod pictures;
mod questions;
pub mod recording;
pub mod replay;
mod screen;
mod tags;
pub mod viewport;
pub mod widgets;

use std::fs::{self, File};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use anyhow::Context;
use egui::{Key, RawInput};
#[cfg(unix)]
use signal_hook::{
    consts::{SIGHUP, SIGINT, SIGTERM},
    flag,
};

use crate::drawing::Drawing;
use crate::output;
use app::App;
use display::Display;
use recording::{Log, Recorder};
use replay::{Player, is_pressed};

pub use display::{NoDisplay, restart_in_fit_environment};

/// The time between two polls while the user does something, so that short clicks are seen.
const BUSY_PAUSE: Duration = Duration::from_millis(2);
/// The time between two polls while nothing happens.
const IDLE_PAUSE: Duration = Duration::from_millis(16);
/// How long after the last event the user counts as busy.
const BUSY_TIME: Duration = Duration::from_secs(1);
/// The pixels are shown again after this time even if nothing has changed, because the system does not say when another window
/// has covered them. Less often if this would take more than one part in [`PRESENT_SHARE`] of the time.
const PRESENT_AGAIN: Duration = Duration::from_millis(400);
const PRESENT_SHARE: u32 = 200;

/// Shows `drawing` in a window of its size until the user quits, and records that in a new file if one is named.
///
/// A log, which begins with `drawing`, is played until the user quits or takes over. Then the window is as without it. Every
/// frame has its recorded size; the window opens in the largest.
///
/// # Errors
/// [`NoDisplay`] before anything else is done. Later, when the window system or the system fails, memory does not
/// suffice, there is such a file, or changes that were not saved cannot be written.
pub fn run(drawing: Drawing, recording: Option<&Path>, log: Option<&Log>) -> anyhow::Result<()> {
    let size = log.map_or(drawing.size, |log| log.canvas(drawing.size));
    let mut display = Display::open("shadetrade", size)?;
    let mut app = App::new(drawing, true)?;
    if let Some(path) = recording {
        output::check_place(path)?;
        let file = File::create_new(path);
        let file =
            file.with_context(|| format!("cannot record to a new file {}", path.display()))?;
        app.recorder = Some(Recorder::new(file));
    }
    let start = Instant::now();
    let mut player = log.map(Player::new);
    let (mut title, mut window) = (String::new(), [0, 0]);
    let (mut due, mut last_event, mut present_again) =
        (Duration::ZERO, Duration::ZERO, Duration::ZERO);
    let ends = Arc::new(AtomicBool::new(false));
    #[cfg(unix)]
    end_on_signals(&ends)?;
    loop {
        let must_end = !display.window.is_open() || ends.load(Ordering::Relaxed);
        if app.quits || must_end {
            if player.is_some() || app.may_close(must_end)? {
                return Ok(());
            }
            due = Duration::ZERO;
        }
        // A recording has milliseconds.
        let now = Duration::from_millis(start.elapsed().as_millis() as u64);
        let has_events = !display.input.events.is_empty();
        if has_events {
            last_event = now;
        }
        let is_resized = std::mem::replace(&mut window, display.size()) != window;
        if has_events || is_resized || now >= due || app.receive(now) {
            let mut input = RawInput {
                modifiers: display.input.modifiers,
                events: std::mem::take(&mut display.input.events),
                ..RawInput::default()
            };
            if player.is_some() && is_pressed(&input.events, &[Key::Enter]) {
                player = None;
                // The edits of the log are not the user's.
                app.file.saved = Arc::clone(&app.state);
            }
            let (mut next, mut size, mut kind) = (Duration::MAX, window, "");
            if let Some(player) = &mut player {
                app.quits = is_pressed(&input.events, &[Key::Escape, Key::Q]);
                next = player.play(&mut app, now, &input.events)?;
                (size, kind) = (app.size, player.title());
                input = RawInput::default();
            }
            let output = app.step(now, size, input)?;
            due = now.saturating_add(output.repaint_after).min(next);
            let new = format!("{kind}{}", app.title());
            if title != new {
                title = new;
                display.window.set_title(&title);
            }
            if let Some(text) = output.copied
                && let Err(error) = display.copy(text)
            {
                app.say(format!("not copied: {error:#}"));
            }
            display.present(&app.pixels, app.size)?;
            present_again = now + PRESENT_AGAIN;
        } else if now >= present_again {
            let before = start.elapsed();
            display.present(&app.pixels, app.size)?;
            let after = start.elapsed();
            present_again = after + PRESENT_AGAIN.max(after.saturating_sub(before) * PRESENT_SHARE);
        } else {
            display.poll();
        }
        if display.input.events.is_empty() {
            let is_busy = now < last_event + BUSY_TIME || display.is_busy();
            let pause = if is_busy { BUSY_PAUSE } else { IDLE_PAUSE };
            thread::sleep(pause.min(due.saturating_sub(now)));
        }
    }
}

/// Sets `ends` when the system asks the program to end. Signals that its parent ignores, as `nohup` does, stay ignored.
#[cfg(unix)]
fn end_on_signals(ends: &Arc<AtomicBool>) -> anyhow::Result<()> {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let ignored = ignored.and_then(|bits| u64::from_str_radix(bits.trim(), 16).ok());
    for signal in [SIGHUP, SIGINT, SIGTERM] {
        if ignored.unwrap_or(0) >> (signal - 1) & 1 == 0 {
            flag::register(signal, Arc::clone(ends)).context("cannot wait for signals")?;
        }
    }
    Ok(())
}
