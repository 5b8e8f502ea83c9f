//! Scene files: a TOML text is read into a [`SceneRecord`], and a record is spawned as a [`World`] and taken from one.
//!
//! ```text
//! argument --file--> text --read--> SceneRecord <--spawn, of--> World
//!                     ^ '--- error: one located message
//!                     '-- updated (comments kept) --'
//! ```
//! Every number in a [`World`] spawned here is finite and within the [`range`] of its key, and every name is unique within its
//! kind. Nothing else reads or writes scene files.

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

/// The scenes the program carries, as name and text; the first is the default.
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

/// The scenes at the ends of what numbers can be, as name and text: `extremes/NAME`, ordered by name.
pub const EXTREMES: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/extremes.rs"));

/// Memory that parsing takes for a byte of text: of an array of numbers of one digit, the densest text there is, 95; of
/// usual scenes 45.
const BYTES_PER_BYTE: usize = 100;

fn built_in(path: &Path) -> Option<&'static (&'static str, &'static str)> {
    let mut all = BUILT_IN.iter().chain(EXTREMES);
    all.find(|(name, _)| path.as_os_str() == *name)
}

/// Whether `path` is the name of a built-in scene, which wins over a file.
pub fn is_built_in(path: &Path) -> bool {
    built_in(path).is_some()
}

/// A scene: where it comes from, and its world.
pub struct Scene {
    /// The built-in name, or the path as given.
    pub name: String,
    /// The file it was read from, if any.
    pub path: Option<PathBuf>,
    /// The text it was read from; empty where it was not.
    pub text: String,
    /// What the format allows and is probably a slip, with its place.
    pub warning: Option<String>,
    /// Everything; spawned in file order.
    pub world: World,
}

impl Scene {
    /// The scene that `argument` names: a built-in one or else the file at that path; the default when there is none.
    ///
    /// # Errors
    /// When the file cannot be read or is no valid scene.
    pub fn load(argument: Option<&str>) -> Result<Scene, SceneError> {
        Scene::load_path(Path::new(argument.unwrap_or(BUILT_IN[0].0)))
    }

    /// The same of a path, which need not be UTF-8.
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

    /// The scene that `text` describes; `name` is what the scene and its errors call it.
    ///
    /// # Errors
    /// When the text is no valid scene: the first thing wrong, with its place. When there is no memory to parse it in.
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

    /// The scene of what `record` says, which must be [checked](SceneRecord::check).
    pub fn spawn(name: String, record: &SceneRecord) -> Scene {
        Scene {
            name,
            path: None,
            text: String::new(),
            warning: None,
            world: record.spawn(),
        }
    }

    /// A scene of its own that has everything as it is now; what a frame derives starts empty.
    #[must_use]
    pub fn snapshot(&self) -> Scene {
        Scene::spawn(self.name.clone(), &SceneRecord::of(&self.world))
    }

    /// Switches on the lights that are chosen and every other one off.
    ///
    /// # Errors
    /// When a chosen light does not exist; nothing is switched then.
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

    /// Looks through the camera of that name.
    ///
    /// # Errors
    /// When there is none.
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

/// Some editors put a byte order mark before the text; it is in no line and no column.
fn without_mark(text: &str) -> &str {
    text.strip_prefix('\u{feff}').unwrap_or(text)
}

/// Which lights are to be on; as text `all`, `none`, or names with commas between them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LightChoice {
    /// Every light.
    All,
    /// These and no others; none of them is no light.
    Names(Vec<String>),
}

impl FromStr for LightChoice {
    type Err = anyhow::Error;

    /// Whether the names exist, [`Scene::switch_lights`] tells.
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

/// What is wrong when none of `names`, which are those of a `kind`, is `name`.
pub fn unknown(kind: &str, name: &str, names: &[String]) -> anyhow::Error {
    /// No more than a person reads.
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
