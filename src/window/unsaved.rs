//! Edits that are not saved: on disk two seconds after a change, offered when the scene is opened again, and removed once
//! they are saved or undone.
//!
//! ```text
//!        2 s                     the program ends
//! edits -----> file of the scene -----------------> offer --restore--> edits
//!                  '--saved, undone--> removed        '----discard--> removed
//! ```
//! Each scene has one file in the user's state folder. Of two windows on one scene the last writer stays.

use std::env;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use anyhow::Context;
use egui::{Align2, Rect, Ui};

use super::desk::Desk;
use super::document::{Document, has_edits};
use super::widgets::bar;
use crate::output::Output;
use crate::output::files;
use crate::scene::{self, Scene, SceneRecord};

/// The time from a change to its file.
const DELAY: Duration = Duration::from_secs(2);

/// The file of a scene's edits.
pub struct Unsaved {
    /// The folder of all such files.
    pub(super) folder: PathBuf,
    path: PathBuf,
    /// The state in the file; `None` while it holds no edits of this window.
    written: Option<Arc<SceneRecord>>,
    /// The edits of a window that ended.
    offer: Option<Arc<SceneRecord>>,
    /// When the edits are to be written.
    due: Option<Duration>,
    /// Whether they could not be written the last time.
    has_failed: bool,
}

/// The folder of the user's in which the program keeps its state.
pub fn state_folder() -> PathBuf {
    let set = env::var_os("XDG_STATE_HOME").map(PathBuf::from);
    let home = || Some(env::home_dir()?.join(".local/state"));
    let state = set.filter(|path| path.is_absolute()).or_else(home);
    state.unwrap_or_else(env::temp_dir).join("shadetrade")
}

/// The file of a scene's edits: the path of the scene, within `folder`.
fn file_of(scene: &Scene, folder: &Path) -> PathBuf {
    let mut name = match &scene.path {
        Some(path) => path.canonicalize().unwrap_or_else(|_| path.clone()),
        None => Path::new("built-in").join(&scene.name),
    }
    .into_os_string();
    name.push("-unsaved.toml");
    let parts = Path::new(&name).components();
    let inside = parts.filter(|part| matches!(part, Component::Normal(_)));
    folder.join(inside.collect::<PathBuf>())
}

impl Document {
    /// Keeps unsaved edits in `folder` from now on, and offers those that are there.
    pub fn keep_edits(&mut self, folder: &Path) {
        let path = file_of(&self.scene, folder);
        let offer = Scene::load_path(&path).ok().map(|scene| scene.record);
        self.unsaved = Some(Unsaved {
            folder: folder.to_owned(),
            path,
            written: None,
            offer,
            due: None,
            has_failed: false,
        });
    }

    /// Goes to the file of the scene that is open now.
    pub(super) fn follow_scene(&mut self) {
        if let Some(unsaved) = &mut self.unsaved {
            unsaved.path = file_of(&self.scene, &unsaved.folder);
        }
    }

    /// Writes edits two seconds after a change, and removes their file when there are none.
    ///
    /// # Errors
    /// If they cannot be written, once; or if the file cannot be removed.
    pub fn tend_edits(&mut self, now: Duration) -> anyhow::Result<()> {
        if !self.is_edited() {
            return self.forget_edits();
        }
        let Some(unsaved) = &mut self.unsaved else {
            return Ok(());
        };
        let written = unsaved.written.as_deref();
        if written.is_some_and(|written| !has_edits(&self.state, written)) {
            unsaved.due = None;
            return Ok(());
        }
        if now < *unsaved.due.get_or_insert(now + DELAY) {
            return Ok(());
        }
        unsaved.due = Some(now + DELAY);
        let was_told = std::mem::replace(&mut unsaved.has_failed, true);
        let result = self.write_edits();
        if was_told { Ok(()) } else { result }
    }

    /// When the edits are to be written.
    pub fn edits_due(&self) -> Option<Duration> {
        self.unsaved.as_ref().and_then(|unsaved| unsaved.due)
    }

    /// Writes unsaved edits at once.
    ///
    /// # Errors
    /// If they cannot be written.
    pub fn write_edits(&mut self) -> anyhow::Result<()> {
        let is_edited = self.is_edited();
        let Some(unsaved) = &mut self.unsaved else {
            return Ok(());
        };
        if is_edited {
            let text = scene::updated(&self.scene.text, &self.state);
            files::make_folders(files::folder_of(&unsaved.path))
                .map_err(anyhow::Error::from)
                .and_then(|()| Output::File(unsaved.path.clone()).write(&text))
                .context("the changes that are not saved cannot be written to a file")?;
            unsaved.written = Some(Arc::clone(&self.state));
            unsaved.has_failed = false;
        }
        Ok(())
    }

    /// Removes the file of edits that are saved or undone.
    ///
    /// # Errors
    /// If it cannot be removed.
    pub(super) fn forget_edits(&mut self) -> anyhow::Result<()> {
        let Some(unsaved) = &mut self.unsaved else {
            return Ok(());
        };
        unsaved.due = None;
        match unsaved.written.take() {
            Some(_) => files::remove(&unsaved.path),
            None => Ok(()),
        }
    }

    /// Shows the edits that are offered.
    pub fn restore_edits(&mut self, now: Duration) {
        if let Some(unsaved) = &mut self.unsaved
            && let Some(state) = unsaved.offer.take()
        {
            unsaved.written.get_or_insert(Arc::clone(&state));
            self.keep(now, true);
            self.restore(&state);
        }
    }

    /// Forgets the edits that are offered. Those of this window stay.
    ///
    /// # Errors
    /// If their file cannot be removed.
    pub fn discard_edits(&mut self) -> anyhow::Result<()> {
        let Some(unsaved) = &mut self.unsaved else {
            return Ok(());
        };
        unsaved.offer = None;
        match unsaved.written {
            Some(_) => Ok(()),
            None => files::remove(&unsaved.path),
        }
    }
}

/// Offers the edits that a window left, at the top of `place`.
pub fn edits_bar(ui: &Ui, document: &mut Document, place: Rect, desk: &mut Desk) {
    let unsaved = document.unsaved.as_ref();
    if unsaved.is_none_or(|it| it.offer.is_none()) {
        return;
    }
    bar(ui, "offer", Align2::CENTER_TOP, place, |ui| {
        ui.horizontal_wrapped(|ui| {
            ui.label("There are unsaved edits.");
            if ui.button("restore").clicked() {
                document.restore_edits(desk.now);
            }
            if ui.button("discard").clicked()
                && let Err(error) = document.discard_edits()
            {
                desk.say(format!("not discarded: {error:#}"));
            }
        });
    });
}
