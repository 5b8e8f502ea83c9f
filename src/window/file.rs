//! Watches the file of the scene, reads it again after a change, and saves it with its comments kept.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, SystemTime};

use anyhow::{bail, ensure};

use crate::output::{Output, write_numbered};
use crate::scene::{self, Scene, SceneRecord};

/// The time from one look at the file to the next.
pub const INTERVAL: Duration = Duration::from_millis(200);

/// The file's time and length; `None` while there is none.
type Stamp = Option<(SystemTime, u64)>;

/// A scene's file, or the text of a built-in scene.
pub struct SceneFile {
    pub path: Option<PathBuf>,
    /// The name of the next new file, without its ending.
    pub new_name: String,
    text: String,
    /// The scene as the file has it.
    pub saved: Arc<SceneRecord>,
    seen: Stamp,
    /// Whether the file holds no valid scene.
    is_wrong: bool,
    /// A new stamp, seen once. A second look confirms it.
    doubted: Option<Stamp>,
    next: Duration,
}

impl SceneFile {
    /// The file of a scene that was just read.
    pub fn of(scene: &Scene) -> Self {
        // Options may have changed the World already, so the saved scene is read from the text.
        let saved = Scene::parse(&scene.name, &scene.text);
        let saved = SceneRecord::of(saved.as_ref().map_or(&scene.world, |saved| &saved.world));
        SceneFile {
            path: scene.path.clone(),
            new_name: stem(Path::new(&scene.name)),
            text: scene.text.clone(),
            saved: Arc::new(saved),
            seen: scene.path.as_deref().and_then(stamp),
            is_wrong: false,
            doubted: None,
            next: Duration::ZERO,
        }
    }

    /// The scene or the error of a file that another program changed since the last look. A file that is gone or wrong is
    /// looked at twice: an editor may be writing it.
    pub fn look(&mut self, now: Duration) -> Option<Result<Scene, String>> {
        if now < self.next {
            return None;
        }
        self.next = now + INTERVAL;
        let path = self.path.as_deref()?;
        let present = stamp(path);
        if present == self.seen {
            self.doubted = None;
            return None;
        }
        let is_certain = self.doubted.replace(present) == Some(present);
        let news = match present {
            Some(_) => load(path),
            None => Err(format!("{} was deleted; the scene stays", path.display())),
        };
        (is_certain || news.is_ok()).then(|| {
            self.seen = present;
            self.is_wrong = news.is_err() && present.is_some();
            news
        })
    }

    /// Saves the scene to its file, or to a new one in `folder`; returns the file.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn save(
        &mut self,
        record: &Arc<SceneRecord>,
        folder: &Path,
        new: bool,
    ) -> anyhow::Result<PathBuf> {
        let text = scene::updated(&self.text, record);
        let path = match self.path.clone().filter(|_| !new) {
            Some(_) if self.is_wrong => {
                bail!(
                    "the file has an error, and saving would lose its text; Ctrl Shift S saves to a new one"
                )
            }
            Some(path) if stamp(&path) != self.seen => {
                bail!("the file is another one, or gone; it is read again first")
            }
            Some(path) => {
                Output::File(path.clone()).write(&text)?;
                path
            }
            None => {
                let name = self.new_name.trim();
                let name = name.strip_suffix(".toml").unwrap_or(name);
                ensure!(!name.is_empty(), "a new file needs a name");
                write_new(folder, name, &text)?
            }
        };
        self.seen = stamp(&path);
        self.is_wrong = false;
        self.path = Some(path.clone());
        self.text = text;
        self.saved = Arc::clone(record);
        Ok(path)
    }

    /// Writes edits that were never saved into a file beside the scene's.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn rescue(&self, record: &SceneRecord, folder: &Path) -> io::Result<PathBuf> {
        let text = scene::updated(&self.text, record);
        let name = Path::new(&self.new_name);
        let stem = stem(self.path.as_deref().unwrap_or(name));
        write_new(folder, &format!("{stem}-unsaved"), &text)
    }
}

/// The name of a file without its ending, for the names of others.
fn stem(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    stem.replace(char::is_control, "_")
}

/// The scene of a file. Another thing of that name, such as a pipe, could keep the window waiting.
///
/// # Errors
/// The error of the file or in the scene, in words.
fn load(path: &Path) -> Result<Scene, String> {
    if fs::metadata(path).is_ok_and(|found| !found.is_file()) {
        return Err(format!("{} is not a file", path.display()));
    }
    Scene::load_path(path).map_err(|error| error.to_string())
}

/// Writes `NAME.toml`, or `NAME-2.toml` and so on where that exists.
fn write_new(folder: &Path, stem: &str, text: &str) -> io::Result<PathBuf> {
    let name = |number| match number {
        1 => format!("{stem}.toml"),
        _ => format!("{stem}-{number}.toml"),
    };
    write_numbered(folder, name, text.as_bytes())
}

fn stamp(path: &Path) -> Stamp {
    let found = fs::metadata(path).ok()?;
    Some((found.modified().ok()?, found.len()))
}
