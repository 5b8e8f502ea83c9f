//! A scene file in, a [`World`] of validated components out; nothing else knows TOML.
//!
//! ```text
//! argument --file--> text --format (keys)--> records --spawn--> Scene
//!                      '--- error: one located message ---'
//! ```
//!
//! Rule: every number in a [`World`] spawned here is finite and within the range its key allows, every name is unique
//! within its kind, and the entities of a kind come in the order of the file. hecs iterates entities with the same
//! components in the order in which they were spawned, as long as none is despawned and no component is inserted or
//! removed: whoever keeps to that may take the n-th cuboid of a query for the n-th of the file.

mod error;
mod file;
mod format;
mod keys;

use std::path::Path;
use std::str::FromStr;

use glam::DVec3;
use hecs::{Entity, Query, World};

pub use self::error::SceneError;
use crate::components::{
    Camera, Illumination, Light, Material, Mesh, Name, Normals, Projected, ShadingMode, Transform,
    VertexColors, Viewpoint,
};

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

fn built_in(path: &Path) -> Option<&'static (&'static str, &'static str)> {
    BUILT_IN.iter().find(|(name, _)| path.as_os_str() == *name)
}

/// Whether `path` is the name of a built-in scene, which wins over a file.
pub fn is_built_in(path: &Path) -> bool {
    built_in(path).is_some()
}

/// A scene as it is drawn: entities, and their order in the file.
pub struct Scene {
    /// The built-in name, or the path as given.
    pub name: String,
    /// Everything; spawned once, in file order.
    pub world: World,
    /// Levels where nothing is drawn.
    pub background: DVec3,
    /// In file order; at least one.
    pub cuboids: Vec<Entity>,
    /// In file order.
    pub lights: Vec<Entity>,
    /// In file order; at least one.
    pub cameras: Vec<Entity>,
}

/// What a scene says, as components and in its order: what a file gives and what a [`Scene`] is spawned from.
pub(crate) struct Records {
    /// Levels where nothing is drawn.
    pub background: DVec3,
    /// At least one.
    pub cuboids: Vec<CuboidRecord>,
    pub lights: Vec<LightRecord>,
    /// At least one.
    pub cameras: Vec<CameraRecord>,
}

pub(crate) type CuboidRecord = (Name, Transform, Mesh, Material, ShadingMode);
pub(crate) type LightRecord = (Name, Transform, Light);
pub(crate) type CameraRecord = (Name, Transform, Camera);

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
        match built_in(path) {
            Some((name, text)) => Scene::parse(name, text),
            None => Scene::parse(&path.to_string_lossy(), &file::read(path)?),
        }
    }

    /// The scene that `text` describes; `name` is what the scene and its errors call it.
    ///
    /// # Errors
    /// When the text is no valid scene: the first thing wrong, with its place.
    pub fn parse(name: &str, text: &str) -> Result<Scene, SceneError> {
        // Some editors put a byte order mark before the text; it is in no line and no column.
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        match format::read(text) {
            Ok(records) => Ok(Scene::spawn(name.to_owned(), records)),
            Err(fault) => Err(fault.locate(name, text)),
        }
    }

    /// The scene of what `records` say, which must be within the ranges of the format.
    pub(crate) fn spawn(name: String, records: Records) -> Scene {
        let mut world = World::new();
        world.spawn((Illumination::default(),));
        Scene {
            name,
            background: records.background,
            cuboids: records
                .cuboids
                .into_iter()
                .map(|cuboid| spawn_cuboid(&mut world, cuboid))
                .collect(),
            lights: records
                .lights
                .into_iter()
                .map(|light| world.spawn(light))
                .collect(),
            cameras: records
                .cameras
                .into_iter()
                .map(|camera| world.spawn(camera))
                .collect(),
            world,
        }
    }

    /// A scene of its own, with the values the components have now; what a frame derives from them starts empty.
    #[must_use]
    pub fn snapshot(&self) -> Scene {
        Scene::spawn(self.name.clone(), self.records())
    }

    /// The text of a scene file that describes the scene as it stands now: read again it gives the same components, bit
    /// for bit. The assignment's shortcut, which no file can ask for, becomes Phong.
    pub fn to_toml(&self) -> String {
        format::write(self.records())
    }

    /// What the components say now.
    fn records(&self) -> Records {
        type Cuboid<'a> = (
            &'a Name,
            &'a Transform,
            &'a Mesh,
            &'a Material,
            &'a ShadingMode,
        );
        Records {
            background: self.background,
            cuboids: self.copies::<Cuboid, _>(&self.cuboids, |(name, at, mesh, material, mode)| {
                (name.clone(), *at, *mesh, *material, *mode)
            }),
            lights: self
                .copies::<(&Name, &Transform, &Light), _>(&self.lights, |(name, at, light)| {
                    (name.clone(), *at, *light)
                }),
            cameras: self
                .copies::<(&Name, &Transform, &Camera), _>(&self.cameras, |(name, at, camera)| {
                    (name.clone(), *at, *camera)
                }),
        }
    }

    /// Camera number `index` of the file, as it stands now.
    ///
    /// # Panics
    /// When there are no more than `index` cameras.
    pub fn viewpoint(&self, index: usize) -> Viewpoint {
        self.copy::<(&Transform, &Camera), _>(self.cameras[index], |(at, camera)| Viewpoint {
            position: at.position,
            camera: *camera,
        })
    }

    /// What the cameras are called, in file order.
    pub fn camera_names(&self) -> Vec<String> {
        self.copies::<&Name, _>(&self.cameras, |name| name.0.clone())
    }

    /// What the lights are called, in file order.
    pub fn light_names(&self) -> Vec<String> {
        self.copies::<&Name, _>(&self.lights, |name| name.0.clone())
    }

    /// The number of the camera of that name, counted from 0 in file order.
    pub fn find_camera(&self, name: &str) -> Option<usize> {
        self.camera_names().iter().position(|camera| camera == name)
    }

    /// Switches on the lights that are chosen and every other one off.
    ///
    /// # Errors
    /// When a chosen light does not exist; nothing is switched then.
    pub fn switch_lights(&mut self, which: &LightChoice) -> Result<(), UnknownLight> {
        if let LightChoice::Names(names) = which {
            let lights = self.light_names();
            if let Some(name) = names.iter().find(|&name| !lights.contains(name)) {
                let name = name.clone();
                return Err(UnknownLight { name, lights });
            }
        }
        for (Name(name), light) in self.world.query_mut::<(&Name, &mut Light)>() {
            light.on = match which {
                LightChoice::All => true,
                LightChoice::None => false,
                LightChoice::Names(names) => names.contains(name),
            };
        }
        Ok(())
    }

    fn copies<Q: Query, T>(&self, entities: &[Entity], copy: impl Fn(Q::Item<'_>) -> T) -> Vec<T> {
        entities
            .iter()
            .map(|&entity| self.copy::<Q, T>(entity, &copy))
            .collect()
    }

    fn copy<Q: Query, T>(&self, entity: Entity, copy: impl FnOnce(Q::Item<'_>) -> T) -> T {
        let mut query = self.world.query_one::<Q>(entity);
        copy(
            query
                .get()
                .expect("a scene's entities keep the components they were spawned with"),
        )
    }
}

/// The one place where a cuboid comes to be: what the scene says of it, and room for what a frame derives.
fn spawn_cuboid(
    world: &mut World,
    (name, transform, mesh, material, shading): CuboidRecord,
) -> Entity {
    world.spawn((
        name,
        transform,
        mesh,
        material,
        shading,
        Normals::default(),
        VertexColors::default(),
        Projected::default(),
    ))
}

/// Which lights are to be on; as text `all`, `none`, or names with commas between them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LightChoice {
    /// Every light.
    All,
    /// No light.
    None,
    /// These and no others.
    Names(Vec<String>),
}

impl FromStr for LightChoice {
    type Err = WrongChoice;

    /// Whether the names exist, [`Scene::switch_lights`] tells.
    fn from_str(text: &str) -> Result<Self, WrongChoice> {
        let names: Vec<String> = text.split(',').map(str::to_owned).collect();
        match names
            .iter()
            .find(|name| ["", "all", "none"].contains(&name.as_str()))
        {
            Some(name) if name.is_empty() => Err(WrongChoice::NoName),
            Some(name) if names.len() > 1 => Err(WrongChoice::NotAlone(name.clone())),
            Some(name) if name == "all" => Ok(LightChoice::All),
            Some(_) => Ok(LightChoice::None),
            None => Ok(LightChoice::Names(names)),
        }
    }
}

/// A choice of lights that no scene could understand.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum WrongChoice {
    /// Nothing stands where a name should.
    #[error(
        "a name is missing; it is `all`, `none`, or names with commas between them, such as white,ambient"
    )]
    NoName,
    /// One of the two words for a choice by themselves stands beside others.
    #[error("`{0}` stands by itself")]
    NotAlone(String),
}

/// A light was chosen that the scene does not have.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no light is named {name:?}; {}", there_are(lights))]
pub struct UnknownLight {
    /// The name that was asked for.
    pub name: String,
    /// The names there are, in file order.
    pub lights: Vec<String>,
}

fn there_are(lights: &[String]) -> String {
    if lights.is_empty() {
        return "the scene has no lights".to_owned();
    }
    format!("the scene's lights are {}", listed(lights))
}

/// The names for a message: quoted, and no more than a person reads.
pub fn listed(names: &[String]) -> String {
    const MOST: usize = 20;
    let quoted: Vec<String> = names
        .iter()
        .take(MOST)
        .map(|name| format!("{name:?}"))
        .collect();
    match names.len().saturating_sub(MOST) {
        0 => quoted.join(", "),
        more => format!("{} and {more} more", quoted.join(", ")),
    }
}
