//! What the program reads and writes: the scene that is opened, read again, saved and closed, and pictures of the window.

use std::time::Duration;

use super::app::App;
use super::inspector::Tab;
use crate::components::ViewMode;
use crate::output::encode_png;
use crate::output::files::write_numbered;
use crate::scene::{BUILT_IN, Scene};

impl App {
    /// Opens a file or a built-in scene by its name. If it has an error, the scene before stays.
    pub fn open(&mut self, name: &str) {
        match Scene::load(Some(name)) {
            Ok(scene) => self.open_scene(scene),
            Err(error) => self.desk.file_error = Some(error.to_string()),
        }
    }

    /// Shows a scene. If the edits of the one before cannot be written, that stays.
    pub fn open_scene(&mut self, scene: Scene) {
        if self.writes_edits() {
            self.document.open(scene);
            self.show_document();
        }
    }

    /// Leaves a lesson for the scene from which lessons were opened, which is as it was.
    pub(super) fn leave_lesson(&mut self) {
        match self.document.before_lessons.take() {
            None => self.open(BUILT_IN[0].0),
            Some(before) if self.writes_edits() => {
                self.document = *before;
                self.show_document();
            }
            before => self.document.before_lessons = before,
        }
    }

    /// Whether the edits of the scene are written, or it has none. Else says why.
    fn writes_edits(&mut self) -> bool {
        let written = self.document.write_edits();
        if let Err(error) = &written {
            self.desk.say(format!("not opened: {error:#}"));
        }
        written.is_ok()
    }

    /// Shows the document that has taken the place of another one.
    fn show_document(&mut self) {
        (self.desk.shows_rest, self.desk.answer) = (false, None);
        self.study.clear();
        self.desk.divider = None;
        self.canvas.fit_again();
        self.desk.awaits_worst = false;
        self.desk.selected = None;
        if self.document.state.view.pixel.is_some() {
            self.desk.open(Tab::Pixel);
        }
        self.desk.file_error = None;
    }

    /// Writes unsaved edits before the window closes. If that fails, the window stays unless it `must` close.
    ///
    /// # Errors
    /// If it must close and the edits cannot be written.
    pub fn may_close(&mut self, must: bool) -> anyhow::Result<bool> {
        let closed = self.document.write_edits();
        if let (Err(error), false) = (&closed, must) {
            self.desk.quits = false;
            self.desk.say(format!("not closed: {error:#}"));
            return Ok(false);
        }
        closed.map(|()| true)
    }

    /// Reads the file of the scene again if another program changed it.
    pub(super) fn look_at_file(&mut self, now: Duration) {
        let path = self.document.scene.path.as_deref();
        match self.document.file.look(path, now) {
            Some(Ok(scene)) => {
                self.document.keep(now, true);
                self.desk.file_error = None;
                let message = self.document.reload(scene);
                self.canvas.fit_again();
                self.note_changes();
                self.desk.say(message);
            }
            Some(Err(error)) => self.desk.file_error = Some(error),
            None => {}
        }
    }

    /// Saves the scene, to a new file if `new`.
    pub(super) fn save(&mut self, new: bool) {
        match self.document.save(new) {
            Ok(message) => {
                self.desk.file_error = None;
                self.desk.say(message);
            }
            Err(error) => self.desk.say(format!("not saved: {error:#}")),
        }
    }

    /// The picture on screen: an error map with its scale, a wipe with its line and the names of its sides.
    pub(super) fn labelled_picture(&self) -> Vec<u32> {
        let mut pixels = self.shown().into_owned();
        let viewer = self.viewer();
        let has_labels = matches!(viewer.show, ViewMode::Error | ViewMode::Wipe);
        // Each of two pictures that blink, and one without a part, is another one than the map or the wipe.
        if has_labels && self.desk.turn().is_none() && self.desk.shown_without().is_none() {
            self.labels(&viewer, true, false).draw(&mut pixels);
        }
        pixels
    }

    /// Writes pixels as they are seen into a new PNG file.
    pub(super) fn save_pixels(&mut self, pixels: &[u32], size: [usize; 2]) {
        let name = |number| format!("shadetrade-{number:03}.png");
        let encoded = encode_png(pixels, size);
        let folder = &self.document.folder;
        match encoded.and_then(|file| write_numbered(folder, name, &file)) {
            Ok(path) => self.desk.say(format!("saved {}", path.display())),
            Err(error) => self.desk.say(format!("no picture saved: {error:#}")),
        }
    }
}
