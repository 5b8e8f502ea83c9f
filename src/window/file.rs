//! Watches the file of the scene, reads it again after a change, and saves it with its comments kept.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use anyhow::bail;

use crate::output::Output;
use crate::output::files::{self, Stamp, stamp, write_numbered};
use crate::scene::{self, Scene, SceneRecord};

/// The time from one look at the file to the next.
pub const INTERVAL: Duration = Duration::from_millis(200);

/// The stamp of the file; `None` while there is none.
type Seen = Option<Stamp>;

/// The state of the scene's file, as it was seen last; or of the text of a built-in scene.
pub struct SceneFile {
    /// The name of new files, without ending and number.
    stem: String,
    /// The scene as the file has it.
    pub saved: Arc<SceneRecord>,
    seen: Seen,
    /// Whether the file holds no valid scene.
    is_wrong: bool,
    /// A new stamp, seen once. A second look confirms it.
    doubted: Option<Seen>,
    next: Duration,
}

impl SceneFile {
    /// The file of a scene that was just read.
    pub fn of(scene: &Scene) -> Self {
        SceneFile {
            stem: stem(Path::new(&scene.name)),
            saved: Arc::clone(&scene.record),
            seen: scene.path.as_deref().and_then(stamp),
            is_wrong: false,
            doubted: None,
            next: Duration::ZERO,
        }
    }

    /// The scene or the error of a file that another program changed since the last look. A file that is gone or wrong is
    /// looked at twice: an editor may be writing it.
    pub fn look(&mut self, path: Option<&Path>, now: Duration) -> Option<Result<Scene, String>> {
        let path = path.filter(|_| now >= self.next)?;
        self.next = now + INTERVAL;
        let present = stamp(path);
        if present == self.seen {
            self.doubted = None;
            return None;
        }
        let is_certain = self.doubted.replace(present) == Some(present);
        let news = match present {
            None => Err(format!("{} was deleted; the scene stays", path.display())),
            // A pipe of that name could keep the window waiting.
            Some(_) if !files::is_file(path) => Err(format!("{} is not a file", path.display())),
            Some(_) => Scene::load_path(path).map_err(|error| error.to_string()),
        };
        (is_certain || news.is_ok()).then(|| {
            self.seen = present;
            self.is_wrong = news.is_err() && present.is_some();
            news
        })
    }

    /// The path of the next new file in `folder`.
    pub fn next_path(&self, folder: &Path) -> PathBuf {
        let mut paths = (1..).map(|number| folder.join(numbered(&self.stem, number)));
        paths.find(|it| !it.exists()).unwrap_or_default()
    }

    /// Saves the state of the scene to its file, or to a new one in `folder`, which is its file then.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn save(&mut self, scene: &mut Scene, folder: &Path, new: bool) -> anyhow::Result<()> {
        let record = Arc::new(SceneRecord::of(&scene.world));
        let text = scene::updated(&scene.text, &record);
        let path = match scene.path.clone().filter(|_| !new) {
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
                let name = |number| numbered(&self.stem, number);
                write_numbered(folder, name, text.as_bytes())?
            }
        };
        self.seen = stamp(&path);
        self.is_wrong = false;
        self.saved = Arc::clone(&record);
        scene.record = record;
        scene.name = path.to_string_lossy().into_owned();
        (scene.path, scene.text) = (Some(path), text);
        Ok(())
    }
}

/// The name of a file without its ending, for the names of others.
pub(super) fn stem(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    stem.replace(char::is_control, "_")
}

/// `NAME.toml`, or `NAME-2.toml` and so on.
pub(super) fn numbered(stem: &str, number: u32) -> String {
    match number {
        1 => format!("{stem}.toml"),
        _ => format!("{stem}-{number}.toml"),
    }
}
