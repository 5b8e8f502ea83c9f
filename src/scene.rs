//! Scene files. A TOML text is read into a [`SceneRecord`]; a record is spawned as a [`World`] and taken from one.
//!
//! ```text
//! argument --file--> text --read--> SceneRecord <--spawn, of--> World
//!                     ^ '--- error: one located message
//!                     '-- updated (comments kept) --'
//! ```
//! Every number in a [`World`] spawned here is finite and within the [`range`] of its key, and every name is unique within
//! its kind. Nothing else reads or writes scene files.

mod check;
mod error;
mod file;
pub mod range;
mod record;
mod save;
mod world;

use std::io;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use anyhow::{anyhow, bail};
use hecs::World;

pub use self::check::MAX_SIDE;
pub use self::error::{Mistake, SceneError};
pub use self::record::{CameraRecord, CuboidRecord, LightRecord, SceneRecord, ViewRecord};
pub use self::save::updated;
use crate::components::{ActiveCamera, Camera, Light, Name, names, ordered, overwrite};
use crate::memory;

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

/// The built-in scenes with numbers at the ends of their ranges, as name (`extremes/NAME`) and text, ordered by name.
pub const EXTREMES: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/extremes.rs"));

/// Bytes of memory that the parser takes for a byte of text. An array of one-digit numbers takes 95, a usual scene 45.
const BYTES_PER_BYTE: usize = 100;

fn built_in(path: &Path) -> Option<&'static (&'static str, &'static str)> {
    let mut all = BUILT_IN.iter().chain(EXTREMES);
    all.find(|(name, _)| path.as_os_str() == *name)
}

/// Whether `path` is the name of a built-in scene. Such a name wins over a file.
pub fn is_built_in(path: &Path) -> bool {
    built_in(path).is_some()
}

/// A world and its source.
pub struct Scene {
    /// The built-in name, or the path as given.
    pub name: String,
    /// The file of the scene, if it has one.
    pub path: Option<PathBuf>,
    /// The text of the scene; empty if it was spawned from a record.
    pub text: String,
    /// A probable mistake that the format allows, with its place.
    pub warning: Option<String>,
    /// The entities, spawned in file order.
    pub world: World,
}

impl Scene {
    /// Loads the built-in scene of this name, or else the file at this path. `None` is the default scene.
    ///
    /// # Errors
    /// If the file cannot be read or is not a valid scene.
    pub fn load(argument: Option<&str>) -> Result<Scene, SceneError> {
        Scene::load_path(Path::new(argument.unwrap_or(BUILT_IN[0].0)))
    }

    /// As [`Scene::load`], for a path that need not be UTF-8.
    ///
    /// # Errors
    /// As [`Scene::load`].
    pub fn load_path(path: &Path) -> Result<Scene, SceneError> {
        if let Some((name, text)) = built_in(path) {
            return Scene::parse(name, text);
        }
        let scene = Scene::parse(&path.to_string_lossy(), &file::read(path)?)?;
        Ok(Scene {
            path: Some(path.to_path_buf()),
            ..scene
        })
    }

    /// Reads a text. The scene and its errors carry `name`.
    ///
    /// # Errors
    /// If the text is not a valid scene: the first mistake, with its place. If memory does not suffice.
    pub fn parse(name: &str, text: &str) -> Result<Scene, SceneError> {
        let text = without_mark(text);
        memory::check_for("what it describes", text.len() * BYTES_PER_BYTE).map_err(|full| {
            SceneError::Unreadable {
                path: name.to_owned(),
                cause: io::Error::new(io::ErrorKind::OutOfMemory, full),
                hint: String::new(),
            }
        })?;
        let located = |span, message: &str| error::located(name, text, &span, message);
        let record = SceneRecord::read(text).map_err(|(span, why)| located(span, &why))?;
        let slip = record.slip();
        let slip = slip.map(|slip| located(slip.span(text), &slip.to_string()));
        Ok(Scene {
            text: text.to_owned(),
            warning: slip.map(|slip| slip.to_string()),
            ..Scene::spawn(name.to_owned(), &record)
        })
    }

    /// Spawns a [checked](SceneRecord::check) record.
    pub fn spawn(name: String, record: &SceneRecord) -> Scene {
        Scene {
            name,
            path: None,
            text: String::new(),
            warning: None,
            world: record.spawn(),
        }
    }

    /// A copy of the present state. The components that a frame derives start empty.
    #[must_use]
    pub fn snapshot(&self) -> Scene {
        Scene::spawn(self.name.clone(), &SceneRecord::of(&self.world))
    }

    /// Switches the chosen lights on and all others off.
    ///
    /// # Errors
    /// If a chosen light does not exist. No light is switched then.
    pub fn switch_lights(&mut self, which: &LightChoice) -> anyhow::Result<()> {
        if let LightChoice::Names(chosen) = which {
            let lights = names::<Light>(&self.world);
            if let Some(name) = chosen.iter().find(|&name| !lights.contains(name)) {
                return Err(unknown("light", name, &lights));
            }
        }
        for (Name(name), light) in self.world.query_mut::<(&Name, &mut Light)>() {
            light.on = match which {
                LightChoice::All => true,
                LightChoice::Names(names) => names.contains(name),
            };
        }
        Ok(())
    }

    /// Makes the camera of this name the active one.
    ///
    /// # Errors
    /// If there is no such camera.
    pub fn look_from(&mut self, name: &str) -> anyhow::Result<()> {
        let cameras = names::<Camera>(&self.world);
        let Some(place) = cameras.iter().position(|camera| camera == name) else {
            return Err(unknown("camera", name, &cameras));
        };
        let camera = ordered::<Camera>(&self.world)[place];
        overwrite(&mut self.world, &ActiveCamera(camera));
        Ok(())
    }
}

/// Removes the byte order mark that some editors write, so that it counts in no column.
fn without_mark(text: &str) -> &str {
    text.strip_prefix('\u{feff}').unwrap_or(text)
}

/// The lights to switch on. As text: `all`, `none`, or names separated by commas.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LightChoice {
    /// Every light.
    All,
    /// Only these; an empty list is no light.
    Names(Vec<String>),
}

impl FromStr for LightChoice {
    type Err = anyhow::Error;

    /// [`Scene::switch_lights`] checks that the names exist.
    fn from_str(text: &str) -> anyhow::Result<Self> {
        let names: Vec<&str> = text.split(',').collect();
        match names.iter().find(|name| ["", "all", "none"].contains(name)) {
            Some(&"") => bail!(
                "a name is missing; it is `all`, `none`, or names with commas between them, such as white,ambient"
            ),
            Some(name) if names.len() > 1 => bail!("`{name}` stands by itself"),
            Some(&"all") => Ok(LightChoice::All),
            Some(_) => Ok(LightChoice::Names(Vec::new())),
            None => Ok(LightChoice::Names(
                names.into_iter().map(str::to_owned).collect(),
            )),
        }
    }
}

/// The error for a `name` that is not among the `names` of a `kind`.
pub fn unknown(kind: &str, name: &str, names: &[String]) -> anyhow::Error {
    /// A person reads no more.
    const MAX_LISTED: usize = 20;
    if names.is_empty() {
        return anyhow!("no {kind} is named {name:?}; the scene has no {kind}s");
    }
    let quoted = names.iter().take(MAX_LISTED);
    let listed: Vec<String> = quoted.map(|name| format!("{name:?}")).collect();
    let listed = listed.join(", ");
    let more = match names.len().saturating_sub(MAX_LISTED) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    anyhow!("no {kind} is named {name:?}; the scene's {kind}s are {listed}{more}")
}
