//! A scene in, a window that shows it until the user closes it.
//!
//! ```text
//! display --Event--> input --Gesture--> response --Action--> session --View--> composition
//!    ^             (bindings)          (hud: which row) (actions, editing) ^         |
//!    |                      jobs --Progress--, watch --the scene's file----'         |
//!    '---------------------- hud, around it and over it <-- pixels ------------------'
//!
//! Actions --recording--> a log --replay--> the same session, composition and hud without a display
//! ```
//! Only [`display`] with `full_screen`, and [`run`], need a display; all else is tested without. Rule: nothing is drawn while
//! nothing changes, and what the user does shows within a sixtieth of a second.

pub mod bindings;
pub mod composition;
pub mod display;
pub mod examination;
mod full_screen;
pub mod history;
pub mod hud;
pub mod input;
pub mod jobs;
pub mod magnifier;
pub mod orbit;
pub mod recording;
pub mod replay;
pub mod response;
pub mod saving;
pub mod session;
pub mod view_state;
pub mod views;
pub mod watch;

use std::io;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::{Duration, Instant};

use anyhow::Context;

use crate::drawing::Drawing;
use crate::frame::Workers;
use crate::output;
use crate::scene::Scene;
use bindings::Action;
use composition::Composition;
use display::Display;
use hud::{Hud, Part};
use input::{Gesture, Input};
use jobs::Jobs;
use recording::{Event, Recorder, Start};
use session::{Measuring, Redraw, Request, Session};
use watch::Watch;

pub use display::{NoDisplay, restart_without_input_method};

/// The time between two polls while the user does something, so that short clicks are seen.
const BUSY_PAUSE: Duration = Duration::from_millis(4);
/// The time between two polls while nothing happens.
const IDLE_PAUSE: Duration = Duration::from_millis(16);
/// How long after the last event the user counts as busy.
const BUSY_TIME: Duration = Duration::from_secs(1);
/// The picture is shown again this often though nothing has changed, for the system does not say when another window
/// has covered it; less often where it would take more than one part in [`PRESENT_SHARE`] of the time.
const PRESENT_AGAIN: Duration = Duration::from_millis(400);
const PRESENT_SHARE: u32 = 200;

/// Shows `drawing` until the user quits; its size is the window's at the start. What happens is written to `log`, a new file.
///
/// # Errors
/// [`NoDisplay`] before anything else is done. Later, when the window system or the system fails, or memory does not suffice.
pub fn run(drawing: Drawing, log: Option<&Path>) -> anyhow::Result<()> {
    let (size, level, threads) = (drawing.size, drawing.level, drawing.threads);
    let watch = drawing.scene.path.clone().map(Watch::new);
    let mut start = Start::new(&drawing);
    let session = Session::new(drawing);
    let hud = Hud::new(&session, size);
    let title = title(&session, &hud);
    start.size = hud.picture.size();
    let display = Display::open(&title, size)?;
    let workers = Workers::new(threads, level).context("cannot start the threads that draw")?;
    let recorder = log.map(|path| Recorder::create(path, &start)).transpose();
    let window = Window {
        display,
        session,
        watch,
        recorder: recorder.context("cannot begin the recording, which makes a new file")?,
        input: Input::default(),
        composition: Composition::new(workers),
        jobs: Jobs::start(level)?,
        actions: Vec::new(),
        hud,
        picture: Vec::new(),
        shown: Vec::new(),
        title,
    };
    window.run()
}

/// What the frame around the window says.
fn title(session: &Session, hud: &Hud) -> String {
    hud::lines::title(session, hud.boards(Part::Panel).next().is_some())
}

/// The running window.
struct Window {
    session: Session,
    /// The scene's file, where it has one.
    watch: Option<Watch>,
    /// Where what happens is written, if anywhere.
    recorder: Option<Recorder>,
    display: Display,
    input: Input,
    composition: Composition,
    jobs: Jobs,
    /// What the user did since the window was last drawn.
    actions: Vec<Action>,
    /// The layout that is shown.
    hud: Hud,
    /// The picture as its view shows it.
    picture: Vec<u32>,
    /// The window's pixels as they were last shown.
    shown: Vec<u32>,
    title: String,
}

impl Window {
    fn run(mut self) -> anyhow::Result<()> {
        let start = Instant::now();
        let (mut last_event, mut present_again) = (Duration::ZERO, Duration::ZERO);
        let (mut size, mut picture) = ([0, 0], self.hud.picture.size());
        let mut was_active = false;
        let mut job_is_for = (0, false, false);
        while self.display.is_open() {
            // A log has milliseconds.
            let now = Duration::from_millis(start.elapsed().as_millis() as u64);
            if !self.display.events.is_empty() {
                last_event = now;
            }
            self.react(now);
            let new_size = self.display.size();
            if std::mem::replace(&mut size, new_size) != new_size {
                self.session.changed();
            }
            let mut redraw = self.session.take_redraw();
            if redraw > Redraw::Nothing {
                let new_picture = hud::picture(&self.session, size).size();
                if std::mem::replace(&mut picture, new_picture) != new_picture {
                    self.record(now, &Event::Size(picture));
                    self.session.changed();
                    redraw = self.session.take_redraw();
                }
            }
            let measures = matches!(self.session.measuring, Measuring::Running(..));
            let requires = self.session.requires.is_some();
            let wanted = (self.session.revision, measures, requires);
            if std::mem::replace(&mut job_is_for, wanted) != wanted {
                self.jobs.cancel();
            }
            if redraw > Redraw::Nothing {
                if redraw == Redraw::Picture {
                    self.composition.draw(&mut self.session, picture)?;
                }
                self.compose(size);
            }
            for action in std::mem::take(&mut self.actions) {
                match action {
                    Action::Screenshot => {
                        let mut pixels = Vec::new();
                        self.hud.draw(&self.picture, true, &mut pixels);
                        let saved = saving::save_picture(Path::new("."), &pixels, size);
                        self.say_saved(saved);
                    }
                    Action::SavePicture => {
                        let saved = saving::save_picture(Path::new("."), &self.picture, picture);
                        self.say_saved(saved);
                    }
                    Action::Save => self.save_scene(picture),
                    Action::FullScreen => {
                        if let Err(error) = self.display.toggle_full_screen() {
                            self.session.say(format!("no full screen: {error}"));
                        }
                    }
                    Action::Quit => return Ok(()),
                    // The session has done it.
                    _ => {}
                }
            }
            for request in self.session.take_requests() {
                if request == Request::Time {
                    self.composition.time(&mut self.session)?;
                } else {
                    self.jobs.submit(request, self.session.snapshot(picture));
                }
            }
            let is_active = self.display.is_active;
            let raised = std::mem::replace(&mut was_active, is_active) != is_active;
            if redraw > Redraw::Nothing || raised || now >= present_again {
                let before = start.elapsed();
                self.display.present(&self.shown, size)?;
                let after = start.elapsed();
                present_again =
                    after + PRESENT_AGAIN.max(after.saturating_sub(before) * PRESENT_SHARE);
            } else {
                self.display.poll();
            }
            if self.display.events.is_empty() {
                let busy =
                    now < last_event + BUSY_TIME || self.input.is_busy() || self.session.spin().on;
                thread::sleep(if busy { BUSY_PAUSE } else { IDLE_PAUSE });
            }
        }
        Ok(())
    }

    /// Lets the session know what has happened.
    fn react(&mut self, now: Duration) {
        let revision = self.session.revision;
        self.session.tick(now);
        if self.session.revision != revision {
            self.record(now, &Event::Time);
        }
        if let Some(path) = self.watch.as_mut().and_then(|it| it.changed(now)) {
            let event = Event::from(Scene::load_path(path));
            self.record(now, &event);
            self.session.happens(event);
        }
        for (revision, progress) in self.jobs.progress() {
            self.session.on_progress(revision, progress);
        }
        for event in std::mem::take(&mut self.display.events) {
            self.input.is_editing = self.session.state.editor.is_some();
            if let Some(gesture) = self.input.handle(event, now) {
                self.respond(gesture, now);
            }
        }
        while let Some(gesture) = self.input.repeated(now) {
            self.respond(gesture, now);
        }
    }

    fn respond(&mut self, gesture: Gesture, now: Duration) {
        if let Some(action) = response::respond(&mut self.session, gesture, &self.hud) {
            self.record(now, &Event::Action(action));
            self.actions.push(action);
        }
    }

    /// Notes what happened, if anybody wants it; the first failure ends the recording.
    fn record(&mut self, now: Duration, event: &Event) {
        let noted = self.recorder.as_mut().map(|it| it.note(now, event));
        if let Some(Err(error)) = noted {
            self.recorder = None;
            self.session.say(format!("the recording ends: {error}"));
        }
    }

    /// Puts the window's pixels together, and tells in the window's frame what state that is.
    fn compose(&mut self, size: [usize; 2]) {
        self.hud = Hud::new(&self.session, size);
        self.composition.compose(&self.session, &mut self.picture);
        self.hud.draw(&self.picture, false, &mut self.shown);
        let title = title(&self.session, &self.hud);
        if title != self.title {
            self.display.set_title(&title);
            self.title = title;
        }
    }

    fn say_saved(&mut self, saved: io::Result<PathBuf>) {
        match saved {
            Ok(path) => {
                let name = path.file_name().unwrap_or_default().display();
                self.session.say(format!("saved {name}"));
            }
            Err(error) => self.session.say(format!("no picture saved: {error}")),
        }
    }

    fn save_scene(&mut self, size: [usize; 2]) {
        match saving::save_scene(Path::new("."), &self.session) {
            Ok(path) => {
                let name = path.file_name().unwrap_or_default().to_string_lossy();
                let command = saving::command(&self.session, &name, size);
                self.session.say(format!("saved {name}: {command}"));
                output::say(&command);
            }
            Err(error) => self.session.say(format!("no scene saved: {error}")),
        }
    }
}
