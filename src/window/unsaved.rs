//! Edits that are not saved: on disk two seconds after a change, offered when the scene is opened again, and removed once
//! they are saved or undone.
//!
//! ```text
//!        2 s                        the program ends
//! edits -----> SCENE-unsaved.toml ------------------> offer --restore--> edits; the file is this window's
//!                   '--saved, undone--> removed         '----discard--> removed
//! ```
//! The file lies beside the scene's; that of a built-in scene, and one that cannot lie there, in a folder of the user's. A
//! window locks its files while it runs, so that no other window offers, replaces or removes them.

use std::path::{Component, Path, PathBuf, absolute};
use std::sync::Arc;
use std::time::Duration;
use std::{env, mem};

use anyhow::{Context, anyhow};
use egui::{Align2, Area, Frame, Order, Rect, Ui};
use indicatif::HumanDuration;
use web_time::SystemTime;

use super::desk::{Command, Desk};
use super::document::{Document, has_edits};
use super::file::{numbered, stem};
use crate::output::Output;
use crate::output::files::{self, Lock, write_numbered};
use crate::scene::{self, Scene, SceneRecord};

/// The time from a change to its file.
const DELAY: Duration = Duration::from_secs(2);

/// The files of a scene's edits.
pub struct Unsaved {
    /// The folder of the scene's file.
    beside: Option<PathBuf>,
    /// Folders of the user's. The first is taken in which files can be written.
    roots: Vec<PathBuf>,
    /// The place of the scene within them.
    inside: PathBuf,
    /// The name of the files, without number and ending.
    stem: String,
    /// The file of this window's edits, and the state that it holds.
    own: Option<(Locked, Arc<SceneRecord>)>,
    /// From windows that ended, the newest last.
    offers: Vec<Offer>,
    /// When the edits are to be written.
    due: Option<Duration>,
    /// Whether they could not be written the last time.
    has_failed: bool,
}

/// Edits that can be restored.
struct Offer {
    file: Locked,
    state: Arc<SceneRecord>,
    written: SystemTime,
}

/// A file that other windows leave alone.
struct Locked {
    path: PathBuf,
    _lock: Lock,
}

impl Locked {
    /// `None` if there is no such file, or if another window has it.
    fn new(path: PathBuf) -> Option<Self> {
        let lock = files::lock(&path)?;
        Some(Locked { path, _lock: lock })
    }
}

impl Offer {
    fn read(path: PathBuf) -> Option<Self> {
        // Where locks are mandatory, a locked file cannot be read again.
        let scene = Scene::load_path(&path).ok()?;
        let file = Locked::new(path)?;
        Some(Offer {
            state: Arc::new(SceneRecord::of(&scene.world)),
            written: files::stamp(&file.path)?.0,
            file,
        })
    }
}

/// Folders of the user's in which programs keep their state.
pub fn user_folders() -> Vec<PathBuf> {
    let set = env::var_os("XDG_STATE_HOME").map(PathBuf::from);
    let home = || Some(env::home_dir()?.join(".local/state"));
    let state = set.filter(|path| path.is_absolute()).or_else(home);
    let all = state.into_iter().chain([env::temp_dir()]);
    all.map(|folder| folder.join("shadetrade")).collect()
}

impl Unsaved {
    /// Looks for edits of a scene that no window has.
    fn of(scene: &Scene, roots: Vec<PathBuf>) -> Self {
        let path = scene.path.as_deref().and_then(|path| absolute(path).ok());
        let name = path.clone();
        let name = name.unwrap_or_else(|| Path::new("built-in").join(&scene.name));
        let folders = name.parent().into_iter().flat_map(Path::components);
        let mut unsaved = Unsaved {
            beside: path.as_deref().and_then(Path::parent).map(Path::to_owned),
            roots,
            inside: folders
                .filter(|it| matches!(it, Component::Normal(_)))
                .collect(),
            stem: format!("{}-unsaved", stem(&name)),
            own: None,
            offers: Vec::new(),
            due: None,
            has_failed: false,
        };
        let paths = unsaved.folders();
        let paths = paths.flat_map(|folder| files::in_folder(&folder));
        let own = paths.filter(|path| unsaved.is_named(path));
        unsaved.offers = own.filter_map(Offer::read).collect();
        unsaved.offers.sort_by_key(|offer| offer.written);
        unsaved
    }

    /// The folders in which its files may be, in the order in which they are tried.
    fn folders(&self) -> impl Iterator<Item = PathBuf> {
        let in_roots = self.roots.iter().map(|root| root.join(&self.inside));
        self.beside.iter().cloned().chain(in_roots)
    }

    /// Whether a file has the name of edits, perhaps with a number.
    fn is_named(&self, path: &Path) -> bool {
        let name = path.file_name().and_then(|name| name.to_str());
        let rest = name.and_then(|name| name.strip_prefix(&self.stem)?.strip_suffix(".toml"));
        rest.is_some_and(|rest| {
            let number = rest.strip_prefix('-').map(str::parse::<u32>);
            rest.is_empty() || matches!(number, Some(Ok(_)))
        })
    }

    /// Whether its file holds the edits of a state.
    fn holds(&self, state: &SceneRecord) -> bool {
        let own = self.own.as_ref();
        own.is_some_and(|(file, held)| !has_edits(state, held) && files::is_file(&file.path))
    }

    /// Writes a state into its file, or into a new one if that is not possible.
    fn write(&mut self, state: &Arc<SceneRecord>, text: &str) -> anyhow::Result<()> {
        let own = self.own.take().map(|(file, _)| file);
        let own = own.filter(|file| Output::File(file.path.clone()).write(text).is_ok());
        let path = match own {
            Some(file) => file.path,
            None => self.write_new(text)?,
        };
        self.own = Locked::new(path).map(|file| (file, Arc::clone(state)));
        self.has_failed = false;
        Ok(())
    }

    fn write_new(&self, text: &str) -> anyhow::Result<PathBuf> {
        let name = |number| numbered(&self.stem, number);
        let mut failed = None;
        for folder in self.folders() {
            if self.beside.as_ref() != Some(&folder) {
                // If this fails, so does the next.
                let _ = files::make_folders(&folder);
            }
            match write_numbered(&folder, name, text.as_bytes()) {
                Ok(path) => return Ok(path),
                Err(error) => failed = failed.or(Some(error)),
            }
        }
        Err(failed.unwrap_or_else(|| anyhow!("there is no folder for them")))
    }
}

impl Document {
    /// Keeps unsaved edits in files from now on, where they cannot lie beside the scene in one of these folders; and offers
    /// those of windows that ended.
    pub fn keep_edits(&mut self, roots: Vec<PathBuf>) {
        self.unsaved = Some(Unsaved::of(&self.scene, roots));
    }

    /// Goes to the files of the scene that is open now.
    pub(super) fn follow_scene(&mut self) {
        // The locks end first: it may be the same scene.
        if let Some(roots) = self.unsaved.take().map(|unsaved| unsaved.roots) {
            self.keep_edits(roots);
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
        if unsaved.holds(&self.state) {
            unsaved.due = None;
        } else if now >= *unsaved.due.get_or_insert(now + DELAY) {
            unsaved.due = Some(now + DELAY);
            let was_told = mem::replace(&mut unsaved.has_failed, true);
            let written = self.write_edits().map(drop);
            return if was_told { Ok(()) } else { written };
        }
        Ok(())
    }

    /// When the edits are to be written.
    pub fn edits_due(&self) -> Option<Duration> {
        self.unsaved.as_ref().and_then(|unsaved| unsaved.due)
    }

    /// Writes unsaved edits at once. Returns their file.
    ///
    /// # Errors
    /// If there is no folder for them.
    pub fn write_edits(&mut self) -> anyhow::Result<Option<PathBuf>> {
        let is_edited = self.is_edited();
        let Some(unsaved) = self.unsaved.as_mut().filter(|_| is_edited) else {
            return Ok(None);
        };
        if !unsaved.holds(&self.state) {
            let text = scene::updated(&self.scene.text, &self.state);
            let written = unsaved.write(&self.state, &text);
            written.context("the changes that are not saved cannot be written to a file")?;
        }
        Ok(unsaved.own.as_ref().map(|(file, _)| file.path.clone()))
    }

    /// Removes the file of edits that are saved or undone.
    ///
    /// # Errors
    /// If it cannot be removed.
    pub(super) fn forget_edits(&mut self) -> anyhow::Result<()> {
        let own = self.unsaved.as_mut().and_then(|unsaved| {
            unsaved.due = None;
            unsaved.own.take()
        });
        own.map_or(Ok(()), |(file, _)| files::remove(&file.path))
    }

    /// Makes an offer of the present edits, before another state takes their place.
    ///
    /// # Errors
    /// As [`Document::write_edits`].
    pub(super) fn offer_edits(&mut self) -> anyhow::Result<()> {
        self.write_edits()?;
        if let Some(unsaved) = &mut self.unsaved {
            let own = unsaved.own.take();
            unsaved.offers.extend(own.map(|(file, state)| Offer {
                file,
                state,
                written: SystemTime::now(),
            }));
        }
        Ok(())
    }

    /// Shows the edits that are offered. Those of this window are offered then.
    ///
    /// # Errors
    /// As [`Document::write_edits`].
    pub fn restore_edits(&mut self, now: Duration) -> anyhow::Result<()> {
        let offers = self.unsaved.as_ref().map(|unsaved| unsaved.offers.len());
        self.offer_edits()?;
        if let (Some(unsaved), Some(count)) = (&mut self.unsaved, offers) {
            let Offer { file, state, .. } = unsaved.offers.remove(count - 1);
            unsaved.own = Some((file, Arc::clone(&state)));
            self.keep(now, true);
            self.restore(&state);
        }
        Ok(())
    }

    /// Removes the file of the edits that are offered.
    ///
    /// # Errors
    /// If it cannot be removed.
    pub fn discard_edits(&mut self) -> anyhow::Result<()> {
        let unsaved = self.unsaved.as_mut();
        let offer = unsaved.and_then(|unsaved| unsaved.offers.pop());
        offer.map_or(Ok(()), |offer| files::remove(&offer.file.path))
    }
}

/// Offers the newest of the edits that windows left, at the top of `place`.
pub fn edits_bar(ui: &Ui, document: &Document, place: Rect, desk: &mut Desk) {
    let offers = document.unsaved.iter().flat_map(|it| &it.offers);
    let Some(written) = offers.last().map(|offer| offer.written) else {
        return;
    };
    let age = SystemTime::now().duration_since(written);
    let age = HumanDuration(age.unwrap_or_default());
    let bar = Area::new(ui.id().with("offer")).pivot(Align2::CENTER_TOP);
    let bar = bar.fixed_pos(place.center_top()).constrain_to(place);
    let bar = bar.order(Order::Foreground);
    bar.show(ui.ctx(), |ui| {
        ui.set_max_width(place.width());
        Frame::side_top_panel(ui.style()).show(ui, |ui| {
            ui.horizontal_wrapped(|ui| {
                ui.label(format!("There are unsaved edits, {age} old."));
                if ui.button("restore").clicked() {
                    desk.commands.push(Command::RestoreEdits);
                }
                if ui.button("discard").clicked() {
                    desk.commands.push(Command::DiscardEdits);
                }
            });
        });
    });
}
