//! The loop of the window: it decides when to step, to show the pixels again, and to sleep.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use anyhow::Context;
use egui::{Event, RawInput};

use super::app::App;
use super::display::Display;
use super::study::Runner;
use super::unsaved::state_folder;
use crate::output::Output;
use crate::output::files::make_folders;
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
/// The file of the factor of the letters' size, in the folder of the program's state.
const ZOOM: &str = "zoom";

/// Shows `drawing` in a window of its size until the user quits.
///
/// # Errors
/// [`NoWindow`](super::NoWindow) before anything else is done. Later, when the window system or the system fails, memory does not
/// suffice, or changes that were not saved cannot be written.
pub fn run(drawing: Drawing) -> anyhow::Result<()> {
    let mut session = Session::open(drawing)?;
    let is_ended = Arc::new(AtomicBool::new(false));
    let end = Arc::clone(&is_ended);
    ctrlc::set_handler(move || end.store(true, Ordering::Relaxed))
        .context("cannot wait for signals to end")?;
    while session.stays_open(is_ended.load(Ordering::Relaxed))? {
        session.turn()?;
    }
    Ok(())
}

/// The program in its window. Times count from the start.
struct Session {
    display: Display,
    app: App,
    /// The folder of the program's state.
    folder: PathBuf,
    start: Instant,
    title: String,
    /// Width and height of the window in pixels.
    size: [usize; 2],
    /// When a step is wanted even if nothing happens.
    due: Duration,
    last_event: Duration,
    /// When the pixels are shown again.
    present_again: Duration,
}

impl Session {
    fn open(drawing: Drawing) -> anyhow::Result<Self> {
        let display = Display::open("shadetrade", drawing.size)?;
        let mut app = App::new(drawing, Runner::Threads)?;
        let folder = state_folder();
        app.document.keep_edits(&folder);
        app.scale = display.scale;
        let text = std::fs::read_to_string(folder.join(ZOOM)).unwrap_or_default();
        let zoom = text.parse().ok().filter(|it| (0.2..=5.0).contains(it));
        app.painter.context.set_zoom_factor(zoom.unwrap_or(1.0));
        Ok(Session {
            display,
            app,
            folder,
            start: Instant::now(),
            title: String::new(),
            size: [0, 0],
            due: Duration::ZERO,
            last_event: Duration::ZERO,
            present_again: Duration::ZERO,
        })
    }

    /// Whether the window stays open. A signal or the window's frame may end it.
    fn stays_open(&mut self, is_ended: bool) -> anyhow::Result<bool> {
        let must_close = is_ended || !self.display.window.is_open();
        if self.app.desk.quits || must_close {
            if self.app.may_close(must_close)? {
                return Ok(false);
            }
            self.due = Duration::ZERO;
        }
        Ok(true)
    }

    /// Takes a step if something happened, shows the pixels again if that is due, and sleeps.
    fn turn(&mut self) -> anyhow::Result<()> {
        let now = self.start.elapsed();
        if self.display.input.pastes() {
            self.paste();
            self.due = now;
        }
        let has_events = !self.display.input.events.is_empty();
        if has_events {
            self.last_event = now;
        }
        let size = self.display.size();
        let is_resized = std::mem::replace(&mut self.size, size) != size;
        if has_events || is_resized || now >= self.due || self.app.receive(now) {
            self.step(now)?;
            self.display.present(&self.app.pixels, self.app.size)?;
            self.present_again = now + PRESENT_AGAIN;
        } else if now >= self.present_again {
            self.display.present(&self.app.pixels, self.app.size)?;
            let after = self.start.elapsed();
            let pause = PRESENT_AGAIN.max(after.saturating_sub(now) * PRESENT_SHARE);
            self.present_again = after + pause;
        } else {
            self.display.poll();
        }
        if self.display.input.events.is_empty() {
            let is_busy = now < self.last_event + BUSY_TIME || self.display.is_busy();
            let pause = if is_busy { BUSY_PAUSE } else { IDLE_PAUSE };
            thread::sleep(pause.min(self.due.saturating_sub(now)));
        }
        Ok(())
    }

    /// Reads the clipboard.
    fn paste(&mut self) {
        let clipboard = self.display.clipboard();
        match clipboard.and_then(|it| Ok(it.get_text()?)) {
            Ok(text) => self.display.input.events.push(Event::Paste(text)),
            Err(error) => self.app.desk.say(format!("not pasted: {error:#}")),
        }
    }

    /// Hands the events to the program, and carries out what it wants of the system.
    fn step(&mut self, now: Duration) -> anyhow::Result<()> {
        let input = RawInput {
            modifiers: self.display.input.modifiers,
            events: std::mem::take(&mut self.display.input.events),
            ..RawInput::default()
        };
        let zoom = self.app.painter.context.zoom_factor();
        let output = self.app.step(now, self.size, input)?;
        let chosen = self.app.painter.context.zoom_factor();
        if chosen != zoom && make_folders(&self.folder).is_ok() {
            // If it cannot be kept, the next start has the usual size.
            let _ = Output::File(self.folder.join(ZOOM)).write(chosen.to_string());
        }
        self.due = now.saturating_add(output.repaint_after);
        let title = self.app.document.title();
        if self.title != title {
            self.display.window.set_title(&title);
            self.title = title;
        }
        if let Some(text) = output.copied {
            let clipboard = self.display.clipboard();
            if let Err(error) = clipboard.and_then(|it| Ok(it.set_text(text)?)) {
                self.app.desk.say(format!("not copied: {error:#}"));
            }
        }
        Ok(())
    }
}

/// Restarts the program with an environment in which minifb opens a window that can be used. Call it before anything is read.
///
/// Xlib crashes where `XMODIFIERS` names an input method that does not run; the program needs none. GNOME draws no frame
/// around a window of minifb on Wayland, so its X server is taken where there is one.
///
/// # Errors
/// If the program cannot be restarted.
pub fn restart_in_fit_environment() -> anyhow::Result<()> {
    #[cfg(all(unix, not(target_os = "macos")))]
    {
        use std::os::unix::process::CommandExt;

        use super::display::is_set;

        const NO_METHOD: &str = "@im=none";
        let has_display = is_set("DISPLAY");
        let method = std::env::var_os("XMODIFIERS");
        let replaces_method = has_display && method.is_some_and(|method| method != NO_METHOD);
        let desktop = std::env::var("XDG_CURRENT_DESKTOP").unwrap_or_default();
        let leaves_wayland = has_display && is_set("WAYLAND_DISPLAY") && desktop.contains("GNOME");
        if replaces_method || leaves_wayland {
            let restarted = std::env::current_exe().map(|program| {
                let mut command = std::process::Command::new(program);
                command.args(std::env::args_os().skip(1));
                command.env("XMODIFIERS", NO_METHOD);
                if leaves_wayland {
                    command.env_remove("WAYLAND_DISPLAY");
                }
                command.exec()
            });
            let error = restarted.unwrap_or_else(|error| error);
            return Err(error).context("cannot restart in an environment that can open a window");
        }
    }
    Ok(())
}
