//! The program behind the window, without a display: events and a size in, pixels and effects out.
//!
//! ```text
//! events --> keys, panels --write--> World --SceneRecord--> changed? --> undo, questions
//!                                      |
//!                                      '--systems--> picture --copied--> pixels <--painted-- egui
//! ```
//! The World is the only state of the scene and of how it is looked at. A change is a difference between two
//! [`SceneRecord`]s, whatever made it.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use egui::util::undoer::Undoer;
use egui::{Event, OutputCommand, RawInput, Rect, ViewportId};
use hecs::{Ref, RefMut};
use rayon::ThreadPool;

use super::facts::{Facts, Question, Work, pool};
use super::file::{INTERVAL, SceneFile};
use super::history::{State, history};
use super::inspector::Tab;
use super::pictures::Pictures;
use super::unsaved::Unsaved;
use crate::components::{View, Viewer, viewer, viewer_mut};
use crate::drawing::Drawing;
use crate::paint::{Painter, area};
use crate::scene::{Scene, SceneRecord};
use crate::shading::Method;

/// The time without a change after which the picture is compared, measured and proven.
pub const REST: Duration = Duration::from_millis(100);
/// The width of a window that opens without its panel, in pixels.
const NARROW: usize = 430;
/// The time in which a rotating cuboid turns by one degree, as in the assignment's program.
const DEGREE: Duration = Duration::from_millis(30);
/// How long each of two pictures is shown while they take turns.
pub const TURN: Duration = Duration::from_millis(500);

/// Everything but the display.
pub struct App {
    pub scene: Scene,
    pub facts: Facts,
    pub desk: Desk,
    pub pictures: Pictures,
    pub history: Undoer<State>,
    pub file: SceneFile,
    /// `None` where edits are not kept.
    pub unsaved: Option<Unsaved>,
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
    /// Whether a field or a popup of the last layout takes Escape.
    pub(super) takes_escape: bool,
    pub(super) painter: Painter,
    /// The pixels of the window as of the last step, row by row from the top.
    pub pixels: Vec<u32>,
    /// Width and height of the window, in pixels.
    pub(super) size: [usize; 2],
    /// The threads that answer questions.
    pub(super) pool: Option<ThreadPool>,
    /// The work on a question.
    pub(super) work: Option<Work>,
    /// When the picture last changed, until it rests.
    pub(super) moved: Option<Duration>,
    next_degree: Duration,
    pub(super) next_progress: Duration,
    /// The method that holds the budget: the machine's choice, and so no part of the scene.
    pub(super) held: Option<Method>,
    /// The state and the view that were drawn last.
    pub(super) drawn: Option<(Arc<SceneRecord>, View)>,
}

/// An entity of the scene: the key of its kind in scene files, and its place among those, counted from 0.
pub type EntityPlace = (&'static str, usize);

/// The state of the window that is not the scene's: nothing of it changes the picture that is judged.
#[derive(Default)]
pub struct Desk {
    pub help: bool,
    pub panel_folded: bool,
    /// Whether the inspector has a room of its own beside the picture.
    pub has_room: bool,
    /// The open tab of the inspector; `None` is folded.
    pub tab: Option<Tab>,
    /// Two pictures take turns since this time, while a key is held.
    pub blinks: Option<Duration>,
    /// Of the status line, and when it goes.
    pub message: Option<(String, Duration)>,
    /// The error in the scene's file.
    pub file_error: Option<String>,
    /// The step of the lesson, counted from 0.
    pub step: usize,
    /// The entity that the scene's tab shows.
    pub selected: Option<EntityPlace>,
    /// The pixel that was clicked, until it is known which cuboid it shows. That one is selected then.
    pub clicked: Option<[usize; 2]>,
}

/// The part of a step that the window system carries out.
pub struct StepOutput {
    /// A text for the clipboard.
    pub copied: Option<String>,
    /// The time after which a step is wanted even if nothing happens.
    pub repaint_after: Duration,
}

impl App {
    /// Starts with `drawing`. Without threads in the background, questions about the picture are answered at once.
    ///
    /// # Errors
    /// If the system gives no threads.
    pub fn new(drawing: Drawing, has_threads: bool) -> anyhow::Result<Self> {
        let workers = drawing.workers()?;
        let scene = drawing.scene;
        let state = Arc::new(SceneRecord::of(&scene.world));
        let painter = Painter::default();
        super::widgets::apply_style(&painter.context);
        let desk = Desk {
            panel_folded: drawing.size[0] < NARROW,
            tab: state.view.pixel.map(|_| Tab::Pixel),
            ..Desk::default()
        };
        Ok(App {
            history: history(&state),
            file: SceneFile::of(&scene),
            unsaved: None,
            scene,
            state,
            facts: Facts::default(),
            desk,
            pictures: Pictures::new(workers),
            place: Rect::ZERO,
            folder: PathBuf::from("."),
            shows_times: true,
            now: Duration::ZERO,
            quits: false,
            takes_escape: false,
            painter,
            pixels: Vec::new(),
            size: drawing.size,
            pool: has_threads.then(pool).transpose()?,
            work: None,
            moved: None,
            next_degree: Duration::ZERO,
            next_progress: Duration::ZERO,
            drawn: None,
            held: None,
        })
    }

    /// The viewer of the scene.
    pub fn viewer(&self) -> Ref<'_, Viewer> {
        viewer(&self.scene.world)
    }

    /// The viewer of the scene, to be changed.
    pub fn viewer_mut(&mut self) -> RefMut<'_, Viewer> {
        viewer_mut(&mut self.scene.world)
    }

    /// Pixels of the window in a point of egui.
    pub fn scale(&self) -> f32 {
        self.painter.context.pixels_per_point()
    }

    /// Applies the events of `input` and draws the window of `size` pixels.
    ///
    /// # Errors
    /// If the picture does not fit in memory.
    pub fn step(
        &mut self,
        now: Duration,
        size: [usize; 2],
        mut input: RawInput,
    ) -> anyhow::Result<StepOutput> {
        // egui moves no slider if the button is pressed and released in one pass.
        let is_button = |event: &Event| matches!(event, Event::PointerButton { .. });
        let mut copied = None;
        while let Some(press) = input.events.iter().position(is_button)
            && input.events[press + 1..].iter().any(is_button)
        {
            let rest = input.events.split_off(press + 1);
            let first = RawInput {
                events: std::mem::replace(&mut input.events, rest),
                modifiers: input.modifiers,
                ..RawInput::default()
            };
            copied = self.pass(now, size, first)?.copied.or(copied);
        }
        let output = self.pass(now, size, input)?;
        Ok(StepOutput {
            copied: output.copied.or(copied),
            ..output
        })
    }

    /// A step with one change of the mouse's button at most.
    fn pass(
        &mut self,
        now: Duration,
        size: [usize; 2],
        mut input: RawInput,
    ) -> anyhow::Result<StepOutput> {
        self.now = now;
        self.receive(now);
        let is_gesture = |begins: bool| {
            input.events.iter().any(|event| match event {
                Event::Key {
                    pressed,
                    repeat: false,
                    ..
                }
                | Event::PointerButton { pressed, .. } => *pressed == begins,
                _ => false,
            })
        };
        let [begins, ends] = [true, false].map(is_gesture);
        self.keep_state(begins);
        if begins {
            // The press may change the picture, and frames that are being timed would delay it.
            self.work.take_if(|work| work.question == Question::Measure);
        }
        self.spin_on();
        match self.file.look(self.scene.path.as_deref(), now) {
            Some(Ok(scene)) => {
                self.keep_state(true);
                self.reload(scene);
            }
            Some(Err(error)) => self.desk.file_error = Some(error),
            None => {}
        }
        input.time = Some(now.as_secs_f64());
        input.screen_rect = Some(area(size) / self.scale());
        let context = self.painter.context.clone();
        let mut output = context.run_ui(input, |ui| self.ui(ui));
        self.note_changes();
        self.keep_state(ends);
        self.tend_edits();
        self.outdate();
        self.hold_time();
        // A budget may be held by another method now.
        self.outdate();
        self.draw()?;
        self.ask();
        self.copy_picture(size);
        let commands = std::mem::take(&mut output.platform_output.commands);
        let copied = |command| match command {
            OutputCommand::CopyText(text) => Some(text),
            _ => None,
        };
        let viewport = output.viewport_output.get(&ViewportId::ROOT);
        let turns = self.viewer().turns;
        let unsaved = self.unsaved.as_ref().and_then(|it| it.due);
        let waits = [
            viewport.map(|it| it.repaint_delay),
            self.moved.map(|_| REST),
            self.desk.blinks.map(|_| TURN / 10),
            turns.then(|| self.next_degree.saturating_sub(now)),
            self.scene.path.as_ref().map(|_| INTERVAL),
            unsaved.map(|due| due.saturating_sub(now)),
        ];
        let repaint_after = waits.into_iter().flatten().min();
        self.painter.paint(output, &mut self.pixels, size);
        Ok(StepOutput {
            copied: commands.into_iter().rev().find_map(copied),
            repaint_after: repaint_after.unwrap_or(Duration::MAX),
        })
    }

    /// Shows a message for as long as it takes to read.
    pub fn say(&mut self, text: impl Into<String>) {
        let text = text.into();
        let until = self.now + reading_time(&text);
        self.desk.message = Some((text, until));
    }

    /// Puts the World into another state.
    pub fn restore(&mut self, record: &SceneRecord) {
        let turns = self.viewer().turns;
        self.scene.world = record.spawn();
        self.viewer_mut().turns = turns;
    }

    /// Notes the state that keys and widgets made. One that no scene may have is taken back.
    fn note_changes(&mut self) {
        let record = SceneRecord::of(&self.scene.world);
        if record == *self.state {
            return;
        }
        match record.check() {
            Ok(()) => {
                let pixel = record.view.pixel;
                if pixel != self.state.view.pixel && self.desk.tab.is_none() {
                    self.desk.tab = pixel.map(|_| Tab::Pixel);
                }
                self.state = Arc::new(record);
            }
            Err(reason) => {
                self.restore(&Arc::clone(&self.state));
                self.say(reason.to_string());
            }
        }
    }

    /// Tells the history the present state. A step of undo ends with it if a gesture begins or ends.
    pub(super) fn keep_state(&mut self, ends_step: bool) {
        let state = State(Arc::clone(&self.state));
        self.history.feed_state(self.now.as_secs_f64(), &state);
        if ends_step {
            self.history.add_undo(&state);
        }
    }

    fn spin_on(&mut self) {
        if !self.viewer().turns || self.now < self.next_degree {
            return;
        }
        let late = self.now.saturating_sub(self.next_degree);
        let degrees = 1 + (late.as_millis() / DEGREE.as_millis()) as u32;
        self.next_degree += DEGREE * degrees;
        let mut viewer = self.viewer_mut();
        viewer.turned = (viewer.turned + degrees) % 360;
    }

    /// Starts and stops the rotation.
    pub fn rotate(&mut self) {
        self.next_degree = self.now + DEGREE;
        self.viewer_mut().turns ^= true;
    }
}

/// The time for which a message stands.
pub fn reading_time(text: &str) -> Duration {
    const LEAST: Duration = Duration::from_secs(3);
    const LETTER: Duration = Duration::from_millis(60);
    LEAST.max(LETTER * text.len() as u32)
}
