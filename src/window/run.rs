//! The loop of the window: it decides when to step, to show the pixels again, and to sleep.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use anyhow::Context;
use egui::{Event, RawInput};

use super::app::App;
use super::display::Display;
use super::study::Background;
use super::unsaved::state_folder;
use crate::questions::job::Drawing;

/// The time between two polls while the user does something, so that short clicks are seen.
const BUSY_PAUSE: Duration = Duration::from_millis(2);
/// The time between two polls while nothing happens.
const IDLE_PAUSE: Duration = Duration::from_millis(8);
/// How long after the last event the user counts as busy.
const BUSY_TIME: Duration = Duration::from_secs(1);
/// The pixels are shown again after this time even if nothing has changed, because the system does not say when another window
/// has covered them. Less often if this would take more than one part in [`PRESENT_SHARE`] of the time.
const PRESENT_AGAIN: Duration = Duration::from_millis(400);
const PRESENT_SHARE: u32 = 200;

/// Shows `drawing` in a window of its size until the user quits.
///
/// # Errors
/// [`NoDisplay`](super::NoDisplay) before anything else is done. Later, when the window system or the system fails, memory does not
/// suffice, or changes that were not saved cannot be written.
pub fn run(drawing: Drawing) -> anyhow::Result<()> {
    let mut display = Display::open("shadetrade", drawing.size)?;
    let mut app = App::new(drawing, Background::Threads)?;
    let start = Instant::now();
    app.document.keep_edits(&state_folder());
    let (mut title, mut window) = (String::new(), [0, 0]);
    let (mut due, mut last_event, mut present_again) =
        (Duration::ZERO, Duration::ZERO, Duration::ZERO);
    let ends = Arc::new(AtomicBool::new(false));
    let end = Arc::clone(&ends);
    ctrlc::set_handler(move || end.store(true, Ordering::Relaxed))
        .context("cannot wait for signals to end")?;
    loop {
        let must_end = !display.window.is_open() || ends.load(Ordering::Relaxed);
        if app.desk.quits || must_end {
            if app.may_close(must_end)? {
                return Ok(());
            }
            due = Duration::ZERO;
        }
        let now = start.elapsed();
        if std::mem::take(&mut display.input.pastes) {
            let text = display.clipboard().and_then(|it| Ok(it.get_text()?));
            match text {
                Ok(text) => display.input.events.push(Event::Paste(text)),
                Err(error) => app.desk.say(format!("not pasted: {error:#}")),
            }
            due = now;
        }
        let has_events = !display.input.events.is_empty();
        if has_events {
            last_event = now;
        }
        let is_resized = std::mem::replace(&mut window, display.size()) != window;
        if has_events || is_resized || now >= due || app.receive(now) {
            let input = RawInput {
                modifiers: display.input.modifiers,
                events: std::mem::take(&mut display.input.events),
                ..RawInput::default()
            };
            let output = app.step(now, window, input)?;
            due = now.saturating_add(output.repaint_after);
            let new = app.document.title();
            if title != new {
                title = new;
                display.window.set_title(&title);
            }
            if let Some(text) = output.copied
                && let Err(error) = display.clipboard().and_then(|it| Ok(it.set_text(text)?))
            {
                app.desk.say(format!("not copied: {error:#}"));
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
