//! The program behind the window, without a display: events and a size in, pixels and effects out.
//!
//! ```text
//! events --> keys, panels --write--> World --SceneRecord--> changed? --> undo, recording, jobs
//!                                      |
//!                                      '--systems--> picture --copied--> pixels <--painted-- egui
//! ```
//! The World is the only state of the scene and of how it is looked at. A change is a difference between two
//! [`SceneRecord`]s, whatever made it.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use egui::{CursorIcon, Event, OutputCommand, Rect, ViewportId};
use fearless_simd::Level;
use hecs::Component;

use super::edits::differ;
use super::facts::Facts;
use super::file::{INTERVAL, SceneFile};
use super::history::History;
use super::inspector::Kind;
use super::jobs::{Jobs, State, Task};
use super::pictures::Pictures;
use super::recent::Recent;
use super::recording::Recorder;
use super::viewport::Grab;
use crate::components::{Side, Spin, ViewMode, get, viewer};
use crate::drawing::Drawing;
use crate::paint::{Painter, area};
use crate::requires::Part;
use crate::scene::{Scene, SceneRecord};
use crate::shading::Method;
use crate::trade::budget::Hold;

/// The time without a change after which the picture is compared, measured and proven.
pub const REST: Duration = Duration::from_millis(100);
/// The time in which a rotating cuboid turns by one degree, as in the assignment's program.
const DEGREE: Duration = Duration::from_millis(30);
/// The time for which a message stands: at least this, and this long for each letter.
const MESSAGE: Duration = Duration::from_secs(3);
const LETTER: Duration = Duration::from_millis(60);
/// How long each of two pictures is shown while they take turns.
pub const TURN: Duration = Duration::from_millis(500);

/// A message in the status line.
pub struct Message {
    pub text: String,
    /// When it goes.
    pub until: Duration,
}

/// The state of the window that is not the scene's: nothing of it changes the picture that is judged.
#[derive(Default)]
#[expect(clippy::struct_excessive_bools, reason = "each is a switch of its own")]
pub struct Desk {
    pub help: bool,
    pub panel_folded: bool,
    /// The profile below a wipe is folded.
    pub profile_folded: bool,
    /// Whether the panel and the inspector have room beside the picture.
    pub has_room: [bool; 2],
    /// The panel and the inspector are open over the picture, where there is no room beside it.
    pub over: [bool; 2],
    /// Two pictures take turns since this time, while a key is held.
    pub blinks: Option<Duration>,
    pub left_out: Option<Part>,
    /// The method whose dot the mouse or the focus is on: its picture is shown instead.
    pub preview: Option<Method>,
    /// The window is to be written into a file.
    pub screenshot: bool,
    /// Asks whether to save before the program ends.
    pub asks_to_save: bool,
    pub message: Option<Message>,
    /// The error in the scene's file.
    pub file_error: Option<String>,
    /// The kind and the name of the entity that the scene's tab shows.
    pub selected: Option<(Kind, String)>,
    pub grab: Grab,
    pub recent: Recent,
    /// The field of the scene's path.
    pub path: String,
}

/// Everything but the display.
pub struct App {
    pub scene: Scene,
    pub facts: Facts,
    pub desk: Desk,
    pub pictures: Pictures,
    pub history: History,
    pub file: SceneFile,
    pub recorder: Option<Recorder>,
    /// The World as it was last written down.
    pub state: Arc<SceneRecord>,
    /// The place of the picture, in points.
    pub place: Rect,
    /// Files without a path of their own are written here.
    pub folder: PathBuf,
    /// Whether times are shown; they are the machine's, and differ from run to run.
    pub shows_times: bool,
    pub now: Duration,
    pub quits: bool,
    pub(super) painter: Painter,
    pub(super) pixels: Vec<u32>,
    pub(super) jobs: Option<Jobs>,
    pub(super) ordered: Vec<Task>,
    pub(super) level: Level,
    pub(super) threads: usize,
    /// When the picture last changed, until it rests.
    pub(super) moved: Option<Duration>,
    next_degree: Duration,
    pub(super) next_progress: Duration,
    /// The method that holds the budget: the machine's choice, and so no part of the scene.
    pub(super) held: Option<Method>,
    pub(super) hold: Hold,
    pub(super) drawn: Option<(Arc<SceneRecord>, [usize; 2], Option<Method>)>,
    /// The method of [`Desk::preview`] whose picture was drawn since.
    pub(super) previewed: Option<Method>,
}

/// The part of a step that the window system carries out.
pub struct Output {
    pub title: String,
    pub cursor: CursorIcon,
    /// A text for the clipboard.
    pub copied: Option<String>,
    /// The time after which a step is wanted though nothing happens.
    pub repaint_after: Duration,
}

impl App {
    /// Starts with `drawing`. Without background jobs, questions about the picture are answered at once.
    ///
    /// # Errors
    /// When the system gives no threads.
    pub fn new(drawing: Drawing, has_jobs: bool) -> anyhow::Result<Self> {
        let (level, threads) = (drawing.level, drawing.threads);
        let workers = drawing.workers()?;
        let jobs = has_jobs.then(|| Jobs::start(level)).transpose()?;
        let scene = drawing.scene;
        let state = Arc::new(SceneRecord::of(&scene.world));
        let painter = Painter::default();
        super::style::apply(&painter.context);
        Ok(App {
            history: History::new(&state),
            file: SceneFile::of(&scene),
            recorder: None,
            scene,
            state,
            facts: Facts::default(),
            desk: Desk::default(),
            pictures: Pictures::new(workers),
            place: Rect::ZERO,
            folder: PathBuf::from("."),
            shows_times: true,
            now: Duration::ZERO,
            quits: false,
            painter,
            pixels: Vec::new(),
            jobs,
            ordered: Vec::new(),
            level,
            threads,
            moved: None,
            next_degree: Duration::ZERO,
            next_progress: Duration::ZERO,
            drawn: None,
            previewed: None,
            held: None,
            hold: Hold::at(0),
        })
    }

    /// A component of the viewer.
    pub fn look<C: Component + Clone + Default>(&self) -> C {
        let world = &self.scene.world;
        get(world, viewer(world)).unwrap_or_default()
    }

    /// Overwrites a component of the viewer.
    pub fn set_look<C: Component>(&mut self, component: C) {
        let viewer = viewer(&self.scene.world);
        // A scene's viewer is never despawned.
        let _ = self.scene.world.insert_one(viewer, component);
    }

    /// Pixels of the window in a point of egui.
    pub fn scale(&self) -> f32 {
        self.painter.context.pixels_per_point()
    }

    /// The pixels of the window as of the last step, row by row from the top.
    pub fn pixels(&self) -> &[u32] {
        &self.pixels
    }

    /// Applies the events of `input` and draws the window of `size` pixels.
    ///
    /// # Errors
    /// When the picture does not fit in memory.
    pub fn step(
        &mut self,
        now: Duration,
        size: [usize; 2],
        mut input: egui::RawInput,
    ) -> anyhow::Result<Output> {
        self.now = now;
        self.receive(now);
        // A press may change the picture, and frames that are being timed would delay it.
        let is_press = |event: &Event| {
            matches!(
                event,
                Event::Key { pressed: true, .. } | Event::PointerButton { pressed: true, .. }
            )
        };
        if self.ordered == [Task::Measure] && input.events.iter().any(is_press) {
            self.stop_jobs();
        }
        self.spin_on();
        if let Some(news) = self.file.look(now) {
            self.take_news(news);
        }
        input.time = Some(now.as_secs_f64());
        let screen = area(size) / self.scale();
        input.screen_rect = Some(screen);
        let context = self.painter.context.clone();
        let mut output = context.run_ui(input, |ui| self.ui(ui));
        self.note_changes();
        self.record(size);
        self.hold_time();
        self.draw()?;
        self.order_jobs();
        self.copy_picture(size);
        let platform = std::mem::take(&mut output.platform_output);
        let viewport = output.viewport_output.get(&ViewportId::ROOT);
        let mut repaint_after = viewport.map_or(Duration::MAX, |it| it.repaint_delay);
        self.painter.paint(output, &mut self.pixels, size);
        if std::mem::take(&mut self.desk.screenshot) {
            self.screenshot(size);
            repaint_after = Duration::ZERO;
        }
        if self.moved.is_some() {
            repaint_after = repaint_after.min(REST);
        }
        if let Some(since) = self.desk.blinks {
            let passed = self.now.saturating_sub(since).as_millis() % TURN.as_millis();
            let rest = TURN.saturating_sub(Duration::from_millis(passed as u64));
            repaint_after = repaint_after.min(rest);
        }
        if self.look::<Spin>().on {
            repaint_after = repaint_after.min(self.next_degree.saturating_sub(self.now));
        }
        if self.file.path.is_some() {
            repaint_after = repaint_after.min(INTERVAL);
        }
        let copied = |command| match command {
            OutputCommand::CopyText(text) => Some(text),
            _ => None,
        };
        Ok(Output {
            title: self.title(),
            cursor: platform.cursor_icon,
            copied: platform.commands.into_iter().rev().find_map(copied),
            repaint_after,
        })
    }

    /// Shows a message for as long as it takes to read.
    pub fn say(&mut self, text: impl Into<String>) {
        let text = text.into();
        let time = MESSAGE.max(LETTER * text.chars().count() as u32);
        self.desk.message = Some(Message {
            text,
            until: self.now + time,
        });
    }

    /// Puts the World into another state.
    pub fn restore(&mut self, record: &SceneRecord) {
        let on = self.look::<Spin>().on;
        self.scene.world = record.spawn();
        self.set_look(Spin { on, ..self.look() });
    }

    /// Notes the difference that keys and widgets made.
    fn note_changes(&mut self) {
        let record = SceneRecord::of(&self.scene.world);
        if record == *self.state {
            return self.history.feed(self.now, &self.state);
        }
        if let Err(reason) = record.check() {
            self.restore(&Arc::clone(&self.state));
            return self.say(reason.to_string());
        }
        let after = Arc::new(record);
        self.history.note(self.now, &self.state, &after);
        self.adopt(after);
    }

    /// Compares later states with this one, in which the World is already.
    fn adopt(&mut self, after: Arc<SceneRecord>) {
        let is_same_view = !is_another_view(&self.state, &after);
        if !is_same_view || is_another_method(&self.state, &after) {
            self.picture_changed(is_same_view);
        } else if shown(&self.state) != shown(&after)
            || self.state.view.pixel != after.view.pixel
                && (self.probed().is_none() || after.view.show == ViewMode::Wipe)
        {
            self.facts.section.state = State::Idle;
        }
        self.state = after;
    }

    /// Goes to a state of the history.
    pub fn travel(&mut self, record: &SceneRecord) {
        self.restore(record);
        self.adopt(Arc::new(SceneRecord::of(&self.scene.world)));
    }

    /// Writes the state into the recording, if there is one.
    fn record(&mut self, size: [usize; 2]) {
        if let Some(recorder) = &mut self.recorder
            && let Err(error) = recorder.note(self.now, &self.scene.name, &self.state, size)
        {
            self.recorder = None;
            self.say(format!("the recording ends here: {error}"));
        }
    }

    fn stop_jobs(&mut self) {
        if let Some(jobs) = &self.jobs {
            jobs.cancel();
        }
        self.ordered.clear();
    }

    /// Stops the jobs about the picture before. If the view is the same, only its method has changed.
    pub(super) fn picture_changed(&mut self, is_same_view: bool) {
        self.stop_jobs();
        self.facts.are_old(is_same_view);
    }

    fn spin_on(&mut self) {
        let mut spin: Spin = self.look();
        let Some(late) = self.now.checked_sub(self.next_degree).filter(|_| spin.on) else {
            return;
        };
        let degrees = 1 + (late.as_millis() / DEGREE.as_millis()) as u32;
        self.next_degree += DEGREE * degrees;
        spin.degrees = (spin.degrees + degrees) % 360;
        self.set_look(spin);
    }

    /// Starts and stops the rotation.
    pub fn rotate(&mut self) {
        let spin: Spin = self.look();
        self.next_degree = self.now + DEGREE;
        self.set_look(Spin {
            on: !spin.on,
            ..spin
        });
    }
}

/// Whether two states show the scene otherwise, whatever the method.
fn is_another_view(before: &SceneRecord, after: &SceneRecord) -> bool {
    let (one, other) = (&before.view, &after.view);
    one.camera != other.camera
        || (one.projection, one.turned) != (other.projection, other.turned)
        || before.background != after.background
        || before.light != after.light
        || before.camera != after.camera
        || differ(&before.cuboid, &after.cuboid, |it, other| {
            it.shading = other.shading;
        })
}

/// Whether two states of one view are drawn by different methods.
fn is_another_method(before: &SceneRecord, after: &SceneRecord) -> bool {
    before.view.tolerance != after.view.tolerance || before.cuboid != after.cuboid
}

/// The mode, the sides and the divider of the picture on screen.
fn shown(record: &SceneRecord) -> (ViewMode, [Side; 2], f64) {
    let view = &record.view;
    (view.show, view.sides, view.divider)
}
