//! Scene files. A TOML text is read into a [`SceneRecord`]; a record is spawned as a [`World`] and taken from one.
//!
//! ```text
//! argument --file--> text --read--> SceneRecord <--spawn, of--> World
//!                     ^ '--- error: one located message
//!                     '-- updated (comments kept) --'
//! ```
//! | question | where |
//! |---|---|
//! | What is in a scene file? | `record` |
//! | How is a text read, and how is a mistake told? | `read`; `check` has what must go together |
//! | How does a scene become a world? | `world` |
//! | How is a change saved, comments kept? | `save` |
//! | How is one value addressed? | [`key`] |
//! | What is a lesson? | `lesson` |
//! | Why is nothing seen in a picture? | [`unseen`] |
//!
//! Every number in a [`World`] spawned here is finite and within the range of its key in [`crate::components::numbers`],
//! and every name is unique within its kind. Nothing else reads or writes scene files.

mod check;
pub mod key;
mod lesson;
mod read;
mod record;
mod save;
pub mod unseen;
mod world;

use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::{anyhow, bail, ensure};
use hecs::World;

pub use self::lesson::{Control, LESSONS, Question, Step, title};
pub use self::read::Mistake;
use self::read::located;
pub use self::record::{CameraRecord, CuboidRecord, LightRecord, SceneRecord};
pub use self::save::updated;
use crate::components::{Camera, Light, Name, names, viewer_mut};
use crate::output::files;

/// In MiB: room for fifty thousand cuboids, whose parsing takes 1.6 GB at most.
pub const LARGEST: u64 = 16;

/// The built-in scenes, as name and text. The first is the default.
pub const BUILT_IN: [(&str, &str); 4] = [
    ("cuboid", include_str!("../assets/scenes/cuboid.toml")),
    ("bench-far", include_str!("../assets/scenes/bench-far.toml")),
    (
        "bench-close",
        include_str!("../assets/scenes/bench-close.toml"),
    ),
    (
        "assignment",
        include_str!("../assets/scenes/assignment.toml"),
    ),
];

/// The built-in scenes with extreme numbers, as name (`extremes/NAME`) and text, ordered by name.
pub const EXTREMES: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/extremes.rs"));

/// A world and its source.
pub struct Scene {
    /// The built-in name, or the path as given.
    pub name: String,
    /// The file of the scene, if it has one.
    pub path: Option<PathBuf>,
    /// The text of the scene; empty if it was spawned from a record.
    pub text: String,
    /// The scene as it was read. Keys and options change the world alone.
    pub record: Arc<SceneRecord>,
    /// The entities, spawned in file order.
    pub world: World,
    /// The steps, if it is a lesson.
    pub lesson: Arc<[Step]>,
}

impl Scene {
    /// Loads the built-in scene of this name, or else the file at this path. `None` is the default scene.
    ///
    /// # Errors
    /// If the file cannot be read or is not a valid scene.
    pub fn load(argument: Option<&str>) -> anyhow::Result<Scene> {
        Scene::load_path(Path::new(argument.unwrap_or(BUILT_IN[0].0)))
    }

    /// As [`Scene::load`], for a path that need not be UTF-8.
    ///
    /// # Errors
    /// As [`Scene::load`].
    pub fn load_path(path: &Path) -> anyhow::Result<Scene> {
        // A built-in name wins over a file.
        if let Some((name, text)) = built_in(path) {
            return Scene::parse(name, text);
        }
        if LESSONS.iter().any(|(name, _)| path.as_os_str() == *name) {
            return Scene::load_lesson(path);
        }
        let text = read_text(path, "scene", &BUILT_IN)?;
        let name = path.to_string_lossy();
        let scene = Scene::parse(&name, &text)?;
        Ok(Scene {
            path: Some(path.to_path_buf()),
            ..scene
        })
    }

    /// Reads a text. The scene and its errors carry `name`.
    ///
    /// # Errors
    /// If the text is not a valid scene: the first mistake, with its place.
    pub fn parse(name: &str, text: &str) -> anyhow::Result<Scene> {
        // Some editors write a byte order mark, which counts in no column.
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let record = SceneRecord::read(name, text)?;
        Ok(Scene {
            text: text.to_owned(),
            ..Scene::spawn(name.to_owned(), &record)
        })
    }

    /// Spawns a [checked](SceneRecord::check) record.
    pub fn spawn(name: String, record: &SceneRecord) -> Scene {
        Scene {
            name,
            path: None,
            text: String::new(),
            record: Arc::new(record.clone()),
            world: record.spawn(),
            lesson: Arc::default(),
        }
    }

    /// A copy of the present state. The components that a frame derives start empty.
    #[must_use]
    pub fn snapshot(&self) -> Scene {
        Scene::spawn(self.name.clone(), &SceneRecord::of(&self.world))
    }

    /// Switches the chosen lights on and all others off: `all`, `none`, or names separated by commas.
    ///
    /// # Errors
    /// If a chosen light does not exist. No light is switched then.
    pub fn switch_lights(&mut self, chosen: &str) -> anyhow::Result<()> {
        let lights = names::<Light>(&self.world);
        // A name may begin or end with a blank.
        let known = |name: &str| {
            let is_whole = lights.iter().any(|it| it == name);
            if is_whole { name } else { name.trim() }.to_owned()
        };
        let chosen = match chosen {
            "all" => lights.clone(),
            "none" => Vec::new(),
            chosen => chosen.split(',').map(known).collect(),
        };
        for name in &chosen {
            check_known("light", name, &lights)?;
        }
        for (Name(name), light) in self.world.query_mut::<(&Name, &mut Light)>() {
            light.on = chosen.contains(name);
        }
        Ok(())
    }

    /// Makes the camera of this name the active one.
    ///
    /// # Errors
    /// If there is no such camera.
    pub fn look_from(&mut self, name: &str) -> anyhow::Result<()> {
        check_known("camera", name, &names::<Camera>(&self.world))?;
        viewer_mut(&mut self.world).camera = Some(name.to_owned());
        Ok(())
    }
}

/// The built-in scene of this name.
fn built_in(path: &Path) -> Option<&'static (&'static str, &'static str)> {
    let mut scenes = BUILT_IN.iter().chain(EXTREMES);
    scenes.find(|(name, _)| path.as_os_str() == *name)
}

/// Reads the file of a scene or a lesson. If it is not there, the error has the names of those built in.
fn read_text(path: &Path, kind: &str, built_in: &[(&str, &str)]) -> anyhow::Result<String> {
    let name = path.to_string_lossy();
    let bytes = files::read(path, LARGEST).map_err(|cause| {
        let names: Vec<&str> = built_in.iter().map(|(name, _)| *name).collect();
        let hint = match (cause.kind(), kind) {
            (ErrorKind::NotFound, "scene") => {
                let names = names.join(", ");
                format!("; built in are {names} and what `shadetrade extremes --list` names")
            }
            (ErrorKind::NotFound, _) => format!("; built in are {}", names.join(", ")),
            _ => String::new(),
        };
        anyhow!("cannot read the {kind} {name:?}: {cause}{hint}")
    })?;
    String::from_utf8(bytes).map_err(|error| {
        let start = error.utf8_error().valid_up_to();
        let text = String::from_utf8_lossy(error.as_bytes());
        let mark = start..start + char::REPLACEMENT_CHARACTER.len_utf8();
        let message = "not UTF-8, expected a text in UTF-8";
        located(&name, &text, &mark, message)
    })
}

/// The first sentence of the comment at the head of a file.
pub fn first_sentence(text: &str) -> String {
    let head = text.lines().map_while(|line| line.strip_prefix("# "));
    let comment = head.collect::<Vec<_>>().join(" ");
    let sentence = comment.split_inclusive(". ").next();
    sentence.unwrap_or_default().trim_end().to_owned()
}

/// Fails unless `name` is among the `names` of a `kind`, and then lists them.
fn check_known(kind: &str, name: &str, names: &[String]) -> anyhow::Result<()> {
    if names.iter().any(|known| known == name) {
        return Ok(());
    }
    ensure!(
        !names.is_empty(),
        "no {kind} is named {name:?}; the scene has no {kind}s"
    );
    let quoted: Vec<String> = names.iter().map(|name| format!("{name:?}")).collect();
    let listed = listed(&quoted);
    bail!("no {kind} is named {name:?}; the scene's {kind}s are {listed}")
}

/// A list of at most twenty names.
fn listed(names: &[String]) -> String {
    const MOST: usize = 20;
    match names.len().checked_sub(MOST) {
        None | Some(0) => names.join(", "),
        Some(more) => format!("{}, {more} more", names[..MOST].join(", ")),
    }
}
