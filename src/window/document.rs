//! The document: the scene that is open, its file, its edits and its history.
//!
//! ```text
//! keys, panels --write--> World --note--> state --keep--> history
//!                                           |
//!                  file --open, reload--> scene --save--> file
//! ```
//! The World is the only state of the scene and of how it is looked at. A change is a difference between two
//! [`SceneRecord`]s, whatever made it. A function returns the message for the status line.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use egui::util::undoer::{Settings, Undoer};

use super::file::SceneFile;
use super::unsaved::Unsaved;
use crate::components::{Viewer, viewer, viewer_mut};
use crate::output::quoted;
use crate::scene::key;
use crate::scene::{Scene, SceneRecord};

/// The memory that all states together may take, and that of an entity in a state, in bytes.
const MEMORY: usize = 64 << 20;
const ENTITY: usize = 512;
/// The most steps that are kept.
const STEPS: usize = 500;

/// The scene that is open.
pub struct Document {
    pub scene: Scene,
    /// The World as it was last written down.
    pub state: Arc<SceneRecord>,
    pub history: Undoer<State>,
    pub file: SceneFile,
    /// `None` where edits are not kept.
    pub(super) unsaved: Option<Unsaved>,
    /// Files without a path of their own are written here.
    pub folder: PathBuf,
    /// The step of the lesson, counted from 0.
    pub step: usize,
    /// The scene from which lessons were opened, as it was left.
    pub before_lessons: Option<Box<Document>>,
}

impl Document {
    /// Opens a scene. Its edits are not kept in files.
    pub fn of(scene: Scene) -> Self {
        let state = Arc::new(SceneRecord::of(&scene.world));
        Document {
            history: history(&state),
            file: SceneFile::of(&scene),
            unsaved: None,
            folder: PathBuf::from("."),
            before_lessons: None,
            step: 0,
            state,
            scene,
        }
    }

    /// Shows another scene in place of this one.
    pub fn open(&mut self, scene: Scene) {
        let before = std::mem::replace(self, Document::of(scene));
        self.folder.clone_from(&before.folder);
        if let Some(unsaved) = &before.unsaved {
            self.keep_edits(&unsaved.folder);
        }
        if !self.scene.lesson.is_empty() {
            self.before_lessons = if before.scene.lesson.is_empty() {
                Some(Box::new(before))
            } else {
                before.before_lessons
            };
        }
    }

    /// Whether the scene was edited since it was saved. It is asked in each step.
    pub fn is_edited(&self) -> bool {
        has_edits(&self.state, &self.file.saved)
    }

    /// The title of the window, which names the file before anything is written.
    pub fn title(&self) -> String {
        let star = if self.is_edited() { "*" } else { "" };
        let (name, path) = (&self.scene.name, self.target(false));
        format!(
            "{name}{star} (Ctrl S writes {}) - shadetrade",
            path.display()
        )
    }

    /// Puts the World into another state. Cuboids that turn keep turning.
    pub fn restore(&mut self, record: &SceneRecord) {
        let turns = viewer_mut(&mut self.scene.world).turns;
        self.scene.world = record.spawn();
        viewer_mut(&mut self.scene.world).turns = turns;
    }

    /// Notes the state that keys and widgets made. One that no scene may have is taken back, and the reason returned.
    pub fn note(&mut self) -> Option<String> {
        let record = SceneRecord::of(&self.scene.world);
        if record == *self.state {
            return None;
        }
        let error = record.check().err();
        match error {
            None => self.state = Arc::new(record),
            Some(_) => self.restore(&Arc::clone(&self.state)),
        }
        error.map(|error| error.to_string())
    }

    /// Tells the history the present state. A step of undo ends with it if a gesture begins or ends.
    pub fn keep(&mut self, now: Duration, ends_step: bool) {
        let state = State(Arc::clone(&self.state));
        self.history.feed_state(now.as_secs_f64(), &state);
        if ends_step {
            self.history.add_undo(&state);
        }
    }

    /// Undoes the last change, or redoes it, and names it.
    pub fn travel(&mut self, is_undo: bool) -> String {
        let present = State(Arc::clone(&self.state));
        let (verb, found) = if is_undo {
            ("undo", self.history.undo(&present))
        } else {
            ("redo", self.history.redo(&present))
        };
        let Some(found) = found else {
            return format!("nothing to {verb}");
        };
        let mut record = SceneRecord::clone(&found.0);
        record.view = found.view_as(&present.0.view);
        self.restore(&record);
        format!("{verb}: {}", change(&present.0, &record))
    }

    /// Shows the scene as a later step of its lesson has it. Undo brings edits of the step before back.
    pub fn step_lesson(&mut self, steps: isize) -> Option<String> {
        let lesson = Arc::clone(&self.scene.lesson);
        if lesson.is_empty() {
            return Some("no lesson is open".to_owned());
        }
        let place = self.step.checked_add_signed(steps);
        let Some((place, step)) = place.and_then(|place| Some((place, lesson.get(place)?))) else {
            let end = if steps < 0 { "first" } else { "last" };
            return Some(format!("this is the {end} step of the lesson"));
        };
        self.restore(&step.record);
        // A step is no edit.
        self.file.saved = Arc::clone(&step.record);
        self.step = place;
        None
    }

    /// Takes the scene as its file has it now. Cameras and the view stay as they are, unless the file changed one of them.
    pub fn reload(&mut self, mut scene: Scene) -> &'static str {
        let (saved, had_edits) = (Arc::clone(&self.file.saved), self.is_edited());
        let mut record = SceneRecord::clone(&scene.record);
        if (&record.view, &record.camera) == (&saved.view, &saved.camera) {
            record.view = self.state.view.clone();
            record.camera.clone_from(&self.state.camera);
        }
        let turns = viewer(&self.scene.world).turns;
        scene.world = record.spawn();
        viewer_mut(&mut scene.world).turns = turns;
        self.file = SceneFile::of(&scene);
        let lesson = Arc::clone(&self.scene.lesson);
        self.scene = Scene { lesson, ..scene };
        if had_edits {
            "read the file again; Ctrl Z brings your edits back"
        } else {
            "read the file again"
        }
    }

    /// The path that [`Document::save`] writes.
    pub fn target(&self, new: bool) -> PathBuf {
        let own = self.scene.path.clone().filter(|_| !new);
        let path = own.unwrap_or_else(|| self.file.next_path(&self.folder));
        std::path::absolute(&path).unwrap_or(path)
    }

    /// Saves the scene, to a new file if `new`, and names it.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn save(&mut self, new: bool) -> anyhow::Result<String> {
        self.file.save(&mut self.scene, &self.folder, new)?;
        let forgotten = self.forget_edits();
        self.follow_scene();
        let path = quoted(&self.target(false).to_string_lossy());
        Ok(match forgotten {
            Ok(()) => format!("saved {path}"),
            Err(error) => format!("saved {path}; {error:#}"),
        })
    }
}

/// A state that can be gone back to. States that differ in rotation or pixel only are equal: undo leaves these as they
/// are.
#[derive(Clone)]
pub struct State(pub Arc<SceneRecord>);

impl State {
    /// The view with the rotation and pixel of another one.
    pub fn view_as(&self, present: &Viewer) -> Viewer {
        Viewer {
            turned: present.turned,
            pixel: present.pixel,
            ..self.0.view.clone()
        }
    }
}

impl PartialEq for State {
    /// Compared in every frame, so it copies no entities.
    fn eq(&self, other: &State) -> bool {
        let (one, another) = (&*self.0, &*other.0);
        Arc::ptr_eq(&self.0, &other.0)
            || one.camera == another.camera
                && one.light == another.light
                && one.cuboid == another.cuboid
                && one.background == another.background
                && self.view_as(&another.view) == another.view
    }
}

/// The states to go back to. There will be about as many entities as in `record`.
pub fn history(record: &SceneRecord) -> Undoer<State> {
    let entities = record.cuboid.len() + record.light.len() + record.camera.len();
    Undoer::with_settings(Settings {
        max_undos: (MEMORY / (ENTITY * entities)).clamp(8, STEPS),
        // A gesture is one step. After a second without a change the next one begins a step.
        auto_save_interval: f32::INFINITY,
        ..Settings::default()
    })
}

/// The key of the values that differ, in words.
fn change(before: &SceneRecord, after: &SceneRecord) -> String {
    let keys = key::differences(before, after);
    // The sides of a wipe follow the tolerance and the view, which name the change.
    let (sides, others): (Vec<_>, Vec<_>) = keys.into_iter().partition(|it| it.is_of("view.sides"));
    let named = if others.is_empty() { sides } else { others };
    match named.into_iter().reduce(|one, other| one.common(&other)) {
        Some(key) if !key.is_of("*") => key.to_string(),
        _ => "several changes".to_owned(),
    }
}

/// Whether a state has edits that another one lacks. Switching lights and modes and moving the camera is looking.
pub fn has_edits(state: &SceneRecord, saved: &SceneRecord) -> bool {
    state.background != saved.background
        || differ(&state.light, &saved.light, |it, saved| it.on = saved.on)
        || differ(&state.cuboid, &saved.cuboid, |it, saved| {
            (it.shading, it.normals) = (saved.shading, saved.normals);
            it.segments = saved.segments;
        })
        || differ(&state.camera, &saved.camera, |it, saved| {
            it.orbit = saved.orbit;
        })
}

/// Whether two states have other lights, or other cuboids whatever their mode.
pub fn is_another_scene(before: &SceneRecord, after: &SceneRecord) -> bool {
    before.light != after.light
        || differ(&before.cuboid, &after.cuboid, |it, other| {
            it.shading = other.shading;
        })
}

/// Whether two lists of entities differ after `forget` has overwritten fields of the first.
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
