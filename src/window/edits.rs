//! Edits of the scene and its file: which of them are not saved, saving, and reading the file again; and which of them change
//! more than the method.

use std::path::Path;
use std::sync::Arc;

use super::app::App;
use super::facts::Facts;
use super::file::SceneFile;
use super::history::history;
use super::inspector::Tab;
use crate::output::{self, quoted};
use crate::scene::{CameraRecord, Scene, SceneRecord};

impl App {
    /// Whether the scene was edited since it was saved.
    pub fn is_edited(&self) -> bool {
        has_edits(&self.state, &self.file.saved)
    }

    /// The title of the window.
    pub fn title(&self) -> String {
        let star = if self.is_edited() { "*" } else { "" };
        format!("{}{star} - shadetrade", self.scene.name)
    }

    /// Writes unsaved edits before the window closes, and tells their file. If that fails, the window stays unless it `must`
    /// close.
    ///
    /// # Errors
    /// If it must close and the edits cannot be written.
    pub fn may_close(&mut self, must: bool) -> anyhow::Result<bool> {
        match self.write_edits() {
            Ok(path) => {
                if let Some(path) = path {
                    output::say(&told(&path));
                }
                Ok(true)
            }
            Err(error) if must => Err(error),
            Err(error) => {
                self.quits = false;
                self.say(format!("not closed: {error:#}"));
                Ok(false)
            }
        }
    }

    /// Shows the scene that the user chose; edits of the one before stay in their file.
    pub fn choose(&mut self, scene: Scene) {
        match self.write_edits() {
            Ok(path) => {
                if let Some(path) = path {
                    self.say(told(&path));
                }
                self.open(scene);
            }
            Err(error) => self.say(format!("not opened: {error:#}")),
        }
    }

    /// Shows another scene in place of this one.
    pub fn open(&mut self, scene: Scene) {
        self.file = SceneFile::of(&scene);
        self.scene = scene;
        self.state = Arc::new(SceneRecord::of(&self.scene.world));
        self.history = history(&self.state);
        self.facts = Facts::default();
        (self.desk.selected, self.desk.step) = (None, 0);
        self.desk.tab = self.state.view.pixel.map(|_| Tab::Pixel);
        self.desk.file_error = None;
        self.work = None;
        self.follow_scene();
    }

    /// Takes the scene as its file has it now. The camera and the view stay where they are, unless the file moved them.
    pub(super) fn reload(&mut self, scene: Scene) {
        let mut record = SceneRecord::clone(&scene.record);
        let (saved, had_edits) = (Arc::clone(&self.file.saved), self.is_edited());
        let offered = self.offer_edits();
        let find = |cameras: &[CameraRecord], name: &str| {
            let own = cameras.iter().find(|it| it.name == name);
            own.map(|it| it.orbit)
        };
        if record.view == saved.view {
            let mut view = self.state.view.clone();
            let is_there = |name: &String| find(&record.camera, name).is_some();
            view.camera = view.camera.filter(is_there).or(record.view.camera);
            record.view = view;
        }
        for camera in &mut record.camera {
            if find(&saved.camera, &camera.name) == Some(camera.orbit) {
                let moved = find(&self.state.camera, &camera.name);
                camera.orbit = moved.unwrap_or(camera.orbit);
            }
        }
        let new_name = std::mem::take(&mut self.file.new_name);
        self.file = SceneFile::of(&scene);
        self.file.new_name = new_name;
        self.scene.text = scene.text;
        self.restore(&record);
        self.desk.file_error = None;
        self.say(match offered {
            Err(error) => format!("read the file again; {error:#}"),
            Ok(()) if had_edits => "read the file again; Ctrl Z brings your edits back".to_owned(),
            Ok(()) => "read the file again".to_owned(),
        });
    }

    /// Saves the scene, to a new file if `new`, and says where, or why not.
    pub fn save(&mut self, new: bool) {
        match self.file.save(&mut self.scene, &self.folder, new) {
            Ok(()) => {
                self.say(format!("saved {}", quoted(&self.scene.name)));
                self.desk.file_error = None;
                self.forget_edits();
                self.follow_scene();
            }
            Err(error) => self.say(format!("not saved: {error:#}")),
        }
    }
}

fn told(path: &Path) -> String {
    let path = path.display();
    format!(
        "the changes that were not saved are in {path} and offered when the scene is opened again"
    )
}

/// Whether a state has edits that another one lacks. Switching lights and modes and moving the camera is looking.
pub fn has_edits(state: &SceneRecord, saved: &SceneRecord) -> bool {
    state.background != saved.background
        || differ(&state.light, &saved.light, |it, saved| it.on = saved.on)
        || differ(&state.cuboid, &saved.cuboid, |it, saved| {
            it.shading = saved.shading;
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
