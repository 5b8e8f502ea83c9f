//! A scene in, a window that shows it until the user closes it.
//!
//! ```text
//! display --Event--> input --Gesture--> response --Action--> session --View--> composition
//!    ^             (bindings)          (hud: which row)     (actions)                |
//!    '---------------------- hud, over it <-- pixels -------------------------------'
//! ```
//! Everything but [`display`] and [`run`] is pure and tested without a display. Rule: nothing is drawn while nothing
//! changes, and what the user does shows within a sixtieth of a second.

pub mod bindings;
pub mod composition;
pub mod display;
pub mod examination;
pub mod examiner;
pub mod hud;
pub mod input;
pub mod looking;
pub mod measuring;
pub mod orbit;
pub mod overlay;
pub mod probing;
pub mod response;
pub mod screenshot;
pub mod session;
pub mod statistics;
pub mod views;

use std::io;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::{Duration, Instant};

use crate::drawing::Drawing;
use crate::frame::Workers;
use crate::memory::OutOfMemory;
use composition::Composition;
use display::Display;
use examiner::Examiner;
use hud::{Hud, Shown};
use input::Input;
use measuring::Measurement;
use session::{Redraw, Request, Session};

pub use display::restart_without_input_method;

/// The time between two polls while the user does something, so that short clicks are seen.
const BUSY_PAUSE: Duration = Duration::from_millis(4);
/// The time between two polls while nothing happens.
const IDLE_PAUSE: Duration = Duration::from_millis(8);
/// How long after the last event the user counts as busy.
const BUSY_TIME: Duration = Duration::from_secs(1);
/// The picture is shown again this often though nothing has changed, for the system does not say when another window
/// has covered it; less often where it would take more than one part in [`PRESENT_SHARE`] of the time.
const PRESENT_AGAIN: Duration = Duration::from_millis(400);
const PRESENT_SHARE: u32 = 200;

/// What came of it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Outcome {
    /// The pictures saved, in order.
    pub screenshots: Vec<PathBuf>,
}

/// Why there is no window, or no longer.
#[derive(Debug, thiserror::Error)]
pub enum WindowError {
    /// There is nothing to open a window on; nothing has been done.
    #[error("no display to open a window on ({reason})")]
    NoDisplay {
        /// What the window system says.
        reason: String,
    },
    /// The program could not start itself anew; see [`restart_without_input_method`].
    #[error("cannot start again with XMODIFIERS=@im=none, which opening a window needs: {0}")]
    Restart(#[source] io::Error),
    /// The picture did not reach the window.
    #[error("cannot show the picture: {reason}")]
    Present {
        /// What the window system says.
        reason: String,
    },
    /// The system gives no threads.
    #[error("cannot start the threads that draw: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// The system gives no thread.
    #[error("cannot start the thread that examines pictures: {0}")]
    Examiner(#[source] io::Error),
    /// The window is larger than memory allows.
    #[error(transparent)]
    OutOfMemory(#[from] OutOfMemory),
}

/// Shows `drawing` until the user quits; its size is the window's at the start.
///
/// # Errors
/// [`WindowError::NoDisplay`] before anything else is done; otherwise see [`WindowError`].
pub fn run(drawing: Drawing) -> Result<Outcome, WindowError> {
    restart_without_input_method()?;
    let (size, threads, level) = (drawing.size, drawing.threads, drawing.level);
    let session = Session::new(drawing);
    let display = Display::open(&hud::lines::title(&session), size)?;
    let workers = || Workers::new(threads, level);
    let window = Window {
        session,
        display,
        input: Input::default(),
        composition: Composition::new(workers()?, workers()?),
        examiner: Examiner::start(level)?,
        measurement: None,
        shown: Vec::new(),
        title: String::new(),
        outcome: Outcome::default(),
    };
    window.run()
}

/// The running window.
struct Window {
    session: Session,
    display: Display,
    input: Input,
    composition: Composition,
    examiner: Examiner,
    measurement: Option<Measurement>,
    /// The picture with everything over it, as it was last shown.
    shown: Vec<u32>,
    title: String,
    outcome: Outcome,
}

impl Window {
    fn run(mut self) -> Result<Outcome, WindowError> {
        let start = Instant::now();
        let (mut last_event, mut present_again) = (Duration::ZERO, Duration::ZERO);
        let mut size = [0, 0];
        let mut active = false;
        while self.display.is_open() {
            let now = start.elapsed();
            if self.display.has_events() {
                last_event = now;
            }
            size = self.react(now, size);
            self.examiner.keep_to(self.session.revision());
            self.measurement
                .take_if(|_| !self.session.measuring().is_running());
            let redraw = self.session.take_redraw();
            if redraw > Redraw::Nothing {
                self.draw(redraw, size)?;
            }
            for request in self.session.take_requests() {
                match request {
                    Request::Screenshot => self.save_screenshot(),
                    Request::Measure => {
                        let request = self.session.measurement(size);
                        self.measurement = Some(Measurement::start(request));
                    }
                    Request::Examine => self.examiner.ask(self.session.question(size)),
                    Request::Quit => return Ok(self.outcome),
                }
            }
            let raised = std::mem::replace(&mut active, self.display.is_active()) != active;
            if redraw > Redraw::Nothing || raised || now >= present_again {
                let before = start.elapsed();
                self.display.present(&self.shown, size)?;
                let after = start.elapsed();
                present_again =
                    after + PRESENT_AGAIN.max(after.saturating_sub(before) * PRESENT_SHARE);
            } else {
                self.display.poll();
            }
            if !self.display.has_events() {
                let busy =
                    now < last_event + BUSY_TIME || self.input.is_busy() || self.session.spin().on;
                thread::sleep(if busy { BUSY_PAUSE } else { IDLE_PAUSE });
            }
        }
        Ok(self.outcome)
    }

    /// Lets the session know what has happened; returns the window's size.
    fn react(&mut self, now: Duration, old_size: [usize; 2]) -> [usize; 2] {
        let size = self.display.size();
        if size != old_size {
            self.session.resized();
        }
        self.session.tick(now);
        for news in self.measurement.iter().flat_map(Measurement::news) {
            self.session.hear(news);
        }
        for answer in self.examiner.answers() {
            self.session.answer(answer);
        }
        for event in self.display.take_events() {
            if let Some(gesture) = self.input.handle(event, now) {
                response::respond(&mut self.session, gesture, size);
            }
        }
        while let Some(gesture) = self.input.repeated(now) {
            response::respond(&mut self.session, gesture, size);
        }
        size
    }

    /// Draws what has changed, and tells in the window's frame what state that is.
    fn draw(&mut self, redraw: Redraw, size: [usize; 2]) -> Result<(), OutOfMemory> {
        if redraw == Redraw::Picture {
            self.composition.draw(&mut self.session, size)?;
        }
        self.composition.compose(&self.session, &mut self.shown);
        Hud::new(&self.session, size, Shown::All).draw(&mut self.shown);
        let title = hud::lines::title(&self.session);
        if title != self.title {
            self.display.set_title(&title);
            self.title = title;
        }
        Ok(())
    }

    fn save_screenshot(&mut self) {
        let size = self.composition.size();
        let mut pixels = Vec::new();
        self.composition.compose(&self.session, &mut pixels);
        Hud::new(&self.session, size, Shown::Lasting).draw(&mut pixels);
        match screenshot::save(Path::new("."), &pixels, size) {
            Ok(path) => {
                self.session.say(format!(
                    "saved {}",
                    path.file_name().unwrap_or_default().display()
                ));
                self.outcome.screenshots.push(path);
            }
            Err(error) => self.session.say(format!("no picture saved: {error}")),
        }
    }
}
