//! The program behind the window, without a display: events and a size in, pixels and effects out.
//!
//! ```text
//! events --> keys, panels --write--> World --SceneRecord--> changed? --> undo, recording, jobs
//!                                      |
//!                                      '--systems--> picture --copied--> pixels <--painted-- egui
//! ```
//! The World is the only state of the scene and of how it is looked at. A change is a difference between two
//! [`SceneRecord`]s, whatever made it.

use std::borrow::Cow;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use egui::{CursorIcon, Event, OutputCommand, Rect, ViewportId};
use fearless_simd::Level;
use hecs::Component;

use super::facts::Facts;
use super::file::{INTERVAL, News, SceneFile};
use super::history::History;
use super::inspector::Kind;
use super::jobs::{Jobs, State, Task};
use super::pictures::{Pictures, or_dimmed};
use super::recent::Recent;
use super::recording::Recorder;
use super::viewport::Grab;
use crate::components::{Magnifier, Probed, Show, Side, Spin, View, ViewMode, get, viewer};
use crate::drawing::Drawing;
use crate::memory::OutOfMemory;
use crate::output::{encode_png, write_numbered};
use crate::paint::{Painter, area};
use crate::requires::Part;
use crate::scene::{Scene, SceneRecord, ViewRecord};
use crate::shading::Method;
use crate::trade::budget::Hold;

/// The time without a change after which the picture is compared, measured and proven.
const REST: Duration = Duration::from_millis(100);
/// The time in which a rotating cuboid turns by one degree, as in the assignment's program.
const DEGREE: Duration = Duration::from_millis(30);
/// The time for which a message stands: at least this, and this long for each letter.
const MESSAGE: Duration = Duration::from_secs(3);
const LETTER: Duration = Duration::from_millis(60);

/// A message in the status line.
pub struct Message {
    pub text: String,
    /// When it goes.
    pub until: Duration,
    /// A text to copy.
    pub copy: Option<String>,
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
    /// Exact Phong is shown while a key is held.
    pub shows_exact: bool,
    pub left_out: Option<Part>,
    /// The method whose dot the mouse or the focus is on: its picture is shown instead.
    pub preview: Option<Method>,
    /// The window, or the picture alone, is to be written into a file.
    pub screenshot: Option<bool>,
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
    painter: Painter,
    pixels: Vec<u32>,
    pub(super) jobs: Option<Jobs>,
    pub(super) ordered: Vec<Task>,
    pub(super) level: Level,
    pub(super) threads: usize,
    /// When the picture last changed, until it rests.
    moved: Option<Duration>,
    next_degree: Duration,
    pub(super) next_progress: Duration,
    /// The method that holds the budget: the machine's choice, and so no part of the scene.
    pub(super) held: Option<Method>,
    pub(super) hold: Hold,
    pub(super) drawn: Option<(Arc<SceneRecord>, [usize; 2], Option<Method>)>,
    /// The method of [`Desk::preview`] whose picture was drawn since.
    previewed: Option<Method>,
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

    /// Width and height of the picture in pixels.
    pub fn picture_size(&self) -> [usize; 2] {
        let size = self.place.size() * self.scale();
        [size.x, size.y].map(|side| (side.round() as usize).max(1))
    }

    /// The view that is drawn.
    pub fn view(&self) -> View {
        let view = View::of(&self.scene.world, self.picture_size());
        self.held.map_or(view.clone(), |method| method.view(&view))
    }

    /// The pixels of the window as of the last step, row by row from the top.
    pub fn pixels(&self) -> &[u32] {
        &self.pixels
    }

    /// Whether the picture has not changed for a while.
    pub fn rests(&self) -> bool {
        self.moved.is_none()
    }

    /// Lets the events of `input` happen, in pixels of a window of `size`, and draws what is seen then.
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
        // What is pressed may change the picture; frames that are timed until that is known would delay it.
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
        if let Some(window) = self.desk.screenshot.take() {
            self.screenshot(window, size);
            repaint_after = Duration::ZERO;
        }
        if self.moved.is_some() {
            repaint_after = repaint_after.min(REST);
        }
        if self.look::<Spin>().on {
            repaint_after = repaint_after.min(self.next_degree.saturating_sub(self.now));
        }
        if self.file.path.is_some() {
            repaint_after = repaint_after.min(INTERVAL);
        }
        let mut copied = platform
            .commands
            .into_iter()
            .filter_map(|command| match command {
                OutputCommand::CopyText(text) => Some(text),
                _ => None,
            });
        Ok(Output {
            title: self.title(),
            cursor: platform.cursor_icon,
            copied: copied.next_back(),
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
            copy: None,
        });
    }

    /// Whether the scene was edited since it was saved. Switching lights and modes and moving the camera is looking.
    pub fn is_edited(&self) -> bool {
        let (state, saved) = (&*self.state, &*self.file.saved);
        state.background != saved.background
            || differ(&state.light, &saved.light, |it, saved| it.on = saved.on)
            || differ(&state.cuboid, &saved.cuboid, |it, saved| {
                it.shading = saved.shading;
            })
            || differ(&state.camera, &saved.camera, |it, saved| {
                it.orbit = saved.orbit;
            })
    }

    fn title(&self) -> String {
        let star = if self.is_edited() { "*" } else { "" };
        format!("{}{star} - shadetrade", self.scene.name)
    }

    /// Puts the World into another state.
    pub fn restore(&mut self, record: &SceneRecord) {
        let on = self.look::<Spin>().on;
        self.scene.world = record.spawn();
        self.set_look(Spin { on, ..self.look() });
    }

    /// Shows the scene that the user chose; edits of the one before go into a file.
    pub fn choose(&mut self, scene: Scene) {
        match self.rescue() {
            Some(Ok(path)) => self.say(format!(
                "the changes that were not saved are in {}",
                path.display()
            )),
            Some(Err(error)) => return self.say(format!("not opened: {error}")),
            None => {}
        }
        self.open(scene);
    }

    /// Shows another scene in place of this one.
    pub fn open(&mut self, scene: Scene) {
        if let Some(path) = &scene.path {
            self.desk.recent.add(path);
        }
        self.file = SceneFile::of(&scene);
        self.scene = scene;
        self.state = Arc::new(SceneRecord::of(&self.scene.world));
        self.history = History::new(&self.state);
        self.facts = Facts::default();
        self.desk.left_out = None;
        self.desk.selected = None;
        self.desk.file_error = None;
        self.picture_changed(false);
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

    /// Makes this, which the World is already, the state that changes are told from.
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

    /// Stops what is computed about the picture before; where the view is the same, only its method is another one.
    pub(super) fn picture_changed(&mut self, is_same_view: bool) {
        self.stop_jobs();
        self.facts.are_old(is_same_view);
    }

    /// Draws the pictures if the state or their size is another one.
    fn draw(&mut self) -> Result<(), OutOfMemory> {
        let (show, view): (Show, View) = (self.look(), self.view());
        let size = view.size;
        let drawn = self.drawn.take();
        let (world, present) = (
            &mut self.scene.world,
            (Arc::clone(&self.state), size, self.held),
        );
        let is_same = |(state, size, held): &(Arc<SceneRecord>, _, _)| {
            Arc::ptr_eq(state, &present.0) && (*size, *held) == (present.1, present.2)
        };
        if drawn.as_ref().is_some_and(is_same) {
            self.moved.take_if(|moved| self.now >= *moved + REST);
        } else {
            self.pictures.draw(world, &show, &view)?;
            self.previewed = None;
            self.moved = Some(self.now);
            if let Some((_, before, _)) = drawn.filter(|(_, drawn, _)| *drawn != size) {
                self.keep_pixel(before, size);
                self.picture_changed(false);
            }
        }
        if self.desk.preview != self.previewed {
            self.previewed = self.desk.preview;
            if let Some(method) = self.previewed {
                let world = &mut self.scene.world;
                self.pictures.draw_preview(world, method, &view)?;
            }
        }
        self.drawn = Some(present);
        Ok(())
    }

    /// Keeps the probed pixel where it lies in the scene when the picture gets another size.
    fn keep_pixel(&mut self, before: [usize; 2], size: [usize; 2]) {
        let Probed(Some(pixel)) = self.look() else {
            return;
        };
        // The field of view is vertical, and the middle of the picture stays.
        let scale = size[1] as f64 / before[1] as f64;
        let pixel = [0, 1].map(|axis| {
            let from_middle = pixel[axis] as f64 + 0.5 - before[axis] as f64 / 2.0;
            (from_middle * scale + size[axis] as f64 / 2.0).max(0.0) as usize
        });
        self.set_look(Probed(Some(pixel)));
    }

    /// The picture as it is shown, not magnified, 0x00RRGGBB.
    pub fn shown(&self) -> Cow<'_, [u32]> {
        let show: Show = self.look();
        let comparison = self.facts.comparison.current();
        let exact = comparison.map(|it| it.exact.as_slice());
        let error_map = comparison.map(|it| match show.mode {
            ViewMode::Difference => it.difference.as_slice(),
            _ => &it.error_map,
        });
        let without = self.facts.without.current().map(Vec::as_slice);
        if self.desk.left_out.is_some() {
            or_dimmed(without, self.pictures.frame())
        } else if self.desk.shows_exact {
            or_dimmed(exact, self.pictures.frame())
        } else if self.previewed.is_some() {
            self.pictures.preview().into()
        } else {
            self.pictures.shown(&show, exact, error_map)
        }
    }

    /// Copies the picture into its place in the window, magnified.
    fn copy_picture(&mut self, [width, height]: [usize; 2]) {
        let mut pixels = std::mem::take(&mut self.pixels);
        pixels.resize(width * height, 0);
        // A panel may paint less than it takes: contents that are too wide are cut off.
        let [red, green, blue, _] = self
            .painter
            .context
            .global_style()
            .visuals
            .panel_fill
            .to_array();
        let ground = u32::from_be_bytes([0, red, green, blue]);
        let [columns, rows] = self.pictures.size();
        let shown = self.shown();
        let magnifier = self.look::<Magnifier>().within([columns, rows]);
        let corner = self.place.min * self.scale();
        let [left, top] = [corner.x, corner.y].map(|it| it.round() as usize);
        let [left, right] = [left, left + columns].map(|x| x.min(width));
        for (y, line) in pixels.chunks_exact_mut(width).enumerate() {
            if !(top..top + rows).contains(&y) {
                line.fill(ground);
                continue;
            }
            let [x, y] = magnifier.pixel([0, (y - top) as i32]);
            let drawn = &shown[y * columns..][x..columns];
            line[..left].fill(ground);
            line[right..].fill(ground);
            let line = &mut line[left..right];
            if magnifier.scale == 1 {
                // Squares of one pixel are slow to fill.
                let count = line.len().min(drawn.len());
                line[..count].copy_from_slice(&drawn[..count]);
                continue;
            }
            let squares = line.chunks_mut(magnifier.scale);
            squares
                .zip(drawn)
                .for_each(|(square, pixel)| square.fill(*pixel));
        }
        self.pixels = pixels;
    }

    fn take_news(&mut self, news: News) {
        match news {
            News::Read(scene) => self.reload(&scene),
            News::Wrong(error) => self.desk.file_error = Some(error),
            News::Deleted => {
                let text = format!("{} was deleted; the scene stays", self.scene.name);
                self.desk.file_error = Some(text);
            }
        }
    }

    /// Takes the scene as its file has it now. The camera and the view stay where they are, unless the file moved them.
    fn reload(&mut self, scene: &Scene) {
        let mut record = SceneRecord::of(&scene.world);
        let saved = Arc::clone(&self.file.saved);
        let had_edits = self.is_edited();
        if record.view == saved.view {
            let has_camera = record
                .camera
                .iter()
                .any(|it| Some(&it.name) == self.state.view.camera.as_ref());
            let camera = record.view.camera.clone();
            record.view = self.state.view.clone();
            if !has_camera {
                record.view.camera = camera;
            }
        }
        for camera in &mut record.camera {
            let named = |records: &SceneRecord| {
                records
                    .camera
                    .iter()
                    .find(|it| it.name == camera.name)
                    .map(|it| it.orbit)
            };
            if named(&saved) == Some(camera.orbit) {
                camera.orbit = named(&self.state).unwrap_or(camera.orbit);
            }
        }
        self.file = SceneFile::of(scene);
        self.restore(&record);
        self.desk.file_error = None;
        self.say(if had_edits {
            "read the file again; Ctrl Z brings your edits back"
        } else {
            "read the file again"
        });
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

    /// Saves the scene and says where, or why not.
    pub fn save(&mut self, new: bool) -> bool {
        let record = Arc::clone(&self.state);
        match self.file.save(&record, &self.folder.clone(), new) {
            Ok(path) => {
                self.scene.name = path.to_string_lossy().into_owned();
                self.scene.path = Some(path.clone());
                self.desk.file_error = None;
                let [width, height] = self.picture_size();
                let path = crate::output::quoted(&path.to_string_lossy());
                self.say(format!("saved {path}"));
                if let Some(message) = &mut self.desk.message {
                    message.copy = Some(format!(
                        "shadetrade render {path} --size {width}x{height} -o picture.png"
                    ));
                }
                true
            }
            Err(error) => {
                self.say(format!("not saved: {error:#}"));
                false
            }
        }
    }

    /// Writes edits that nobody saved into a file of their own, which is returned.
    pub fn rescue(&self) -> Option<std::io::Result<PathBuf>> {
        self.is_edited()
            .then(|| self.file.rescue(&self.state, &self.folder))
    }

    /// Writes the window as it was last seen, or the picture alone, into a new PNG file.
    fn screenshot(&mut self, window: bool, size: [usize; 2]) {
        let folder: &Path = &self.folder;
        let name = |number| format!("shadetrade-{number:03}.png");
        let (pixels, size) = if window {
            (self.pixels.as_slice(), size)
        } else {
            (self.pictures.frame(), self.pictures.size())
        };
        match write_numbered(folder, name, |writer| encode_png(writer, pixels, size)) {
            Ok(path) => self.say(format!("saved {}", path.display())),
            Err(error) => self.say(format!("no picture saved: {error}")),
        }
    }
}

/// Whether two states show the scene otherwise, whatever the method.
fn is_another_view(before: &SceneRecord, after: &SceneRecord) -> bool {
    let view = |record: &SceneRecord| {
        let ViewRecord {
            camera,
            projection,
            turned,
            ..
        } = &record.view;
        (camera.clone(), *projection, *turned)
    };
    view(before) != view(after)
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

/// What a picture shows of the methods, and where.
fn shown(record: &SceneRecord) -> (ViewMode, [Side; 2], f64) {
    let view = &record.view;
    (view.show, view.sides, view.divider)
}

/// Whether two lists of entities differ in more than what `forget` overwrites.
fn differ<T: Clone + PartialEq>(one: &[T], other: &[T], forget: impl Fn(&mut T, &T)) -> bool {
    let differ = |(one, other): (&T, &T)| {
        one != other && {
            let mut one = one.clone();
            forget(&mut one, other);
            one != *other
        }
    };
    one.len() != other.len() || one.iter().zip(other).any(differ)
}
