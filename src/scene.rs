//! A scene file in, a [`World`] of validated components out; nothing else knows TOML.
//!
//! ```text
//! argument --file--> text --records (keys)--> SceneRecord --spawn--> Scene
//!                      '--- error: one located message ---'
//! ```
//!
//! Rule: every number in a [`World`] spawned here is finite and within the range its key allows, every name is unique
//! within its kind, cuboids carry their order in the file as a component, and exactly one camera is active.

pub mod edit;
mod error;
mod file;
mod keys;
mod records;

use std::io;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use anyhow::{anyhow, bail};
use glam::DVec3;
use hecs::{Component, Entity, Query, World};

pub use self::error::SceneError;
pub(crate) use self::keys::key;
pub(crate) use self::records::{CameraRecord, CuboidRecord, EMERALD, LightRecord, SceneRecord};
use crate::components::{
    ActiveCamera, Camera, FileOrder, Light, Material, Mesh, Name, Orbit, Projection, SceneShading,
    ShadingMode, Spin, Transform, View, Viewpoint, cuboid,
};
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

/// Memory that parsing takes for a byte of text: of an array of numbers of one digit, the densest text there is, 95; of
/// usual scenes 45.
const BYTES_PER_BYTE: usize = 100;

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
    /// The file it was read from, if any.
    pub path: Option<PathBuf>,
    /// Everything; spawned once, in file order.
    pub world: World,
    /// Levels where nothing is drawn.
    pub background: DVec3,
    /// What the format allows and is probably a slip, with its place.
    pub warning: Option<String>,
    /// In file order; at least one.
    pub cuboids: Vec<Entity>,
    /// In file order.
    pub lights: Vec<Entity>,
    /// In file order; at least one.
    pub cameras: Vec<Entity>,
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
        // Some editors put a byte order mark before the text; it is in no line and no column.
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        memory::check_for("what it describes", text.len() * BYTES_PER_BYTE).map_err(|full| {
            SceneError::Unreadable {
                path: name.to_owned(),
                cause: io::Error::new(io::ErrorKind::OutOfMemory, full),
                hint: String::new(),
            }
        })?;
        let record = SceneRecord::read(text).map_err(|fault| fault.locate(name, text))?;
        let slip = record.slip().map(|slip| slip.locate(name, text));
        Ok(Scene {
            warning: slip.map(|slip| slip.to_string()),
            ..Scene::spawn(name.to_owned(), &record)
        })
    }

    /// The scene of what `record` says, which must be within the ranges of the format.
    pub(crate) fn spawn(name: String, record: &SceneRecord) -> Scene {
        let mut world = World::new();
        let cuboids = record.cuboid.iter().enumerate().map(|(order, it)| {
            let transform = Transform {
                position: *it.position,
                rotation: *it.rotation,
            };
            let (mesh, material) = (Mesh::cuboid(*it.size), Material::from(&*it.material));
            let name = Name(it.name.to_string());
            world.spawn(cuboid(order, name, transform, mesh, material, *it.shading))
        });
        let cuboids = cuboids.collect();
        let lights = record.light.iter().enumerate();
        let lights = lights.map(|(order, it)| {
            let (name, order) = (Name(it.name.to_string()), FileOrder(order as u32));
            world.spawn((name, order, Transform::at(it.place()), it.light()))
        });
        let lights = lights.collect();
        let cameras = record.camera.iter().map(|it| {
            let place = Transform::at(*it.position);
            let name = Name(it.name.to_string());
            world.spawn((name, place, it.camera(), Orbit::default()))
        });
        let cameras = cameras.collect();
        let mut scene = Scene {
            name,
            path: None,
            world,
            background: *record.background,
            warning: None,
            cuboids,
            lights,
            cameras,
        };
        scene.look_from(0);
        scene
    }

    /// A scene of its own that has cuboids, lights and cameras where they are now: spins and orbits are part of its
    /// transforms, and what a frame derives starts empty.
    #[must_use]
    pub fn snapshot(&self) -> Scene {
        let mut copy = Scene::spawn(self.name.clone(), &self.to_record());
        copy.look_from(self.active_camera());
        copy
    }

    /// The text of a scene file that describes the scene as it stands now: read again it gives the same components, bit
    /// for bit. The assignment's shortcut, which no file can ask for, becomes Phong.
    pub fn to_toml(&self) -> String {
        self.to_record().write()
    }

    /// The same as the tables of a file.
    pub(crate) fn to_record(&self) -> SceneRecord {
        self.record(Scene::viewpoint)
    }

    /// The same with the view of the active camera, as it is now, as the first camera, and the others where the file has
    /// them.
    pub fn to_toml_with_view(&self) -> String {
        let mut record = self.record(|scene, camera| scene.camera(camera).0);
        let (mut name, mut number) = ("view".to_owned(), 1);
        while self.find_camera(&name).is_some() {
            number += 1;
            name = format!("view-{number}");
        }
        let view = CameraRecord::of(name, self.viewpoint(self.active_camera()));
        record.camera.value.insert(0, view);
        record.write()
    }

    /// What the components say now, cameras where `viewpoint` has them.
    fn record(&self, viewpoint: impl Fn(&Scene, usize) -> Viewpoint) -> SceneRecord {
        let cuboids = self.copies::<(&Name, &Transform, &Spin, &Mesh, &Material, &ShadingMode), _>(
            &self.cuboids,
            |(name, at, spin, mesh, material, mode)| {
                let at = at.spun(*spin);
                CuboidRecord {
                    name: key(name.0.clone()),
                    size: key(mesh.size()),
                    position: key(at.position),
                    rotation: key(at.rotation),
                    shading: key(*mode),
                    material: key((*material).into()),
                }
            },
        );
        let light = |(name, at, light): (&Name, &Transform, &Light)| LightRecord {
            color: key(light.color),
            gain: key(light.gain),
            on: light.on,
            ..LightRecord::new(&name.0, light.kind, light.intensity, at.position)
        };
        let camera = |index: usize| {
            let name = self.copy::<&Name, _>(self.cameras[index], Name::clone);
            CameraRecord::of(name.0, viewpoint(self, index))
        };
        SceneRecord {
            background: key(self.background),
            cuboid: key(cuboids),
            light: key(self.copies::<(&Name, &Transform, &Light), _>(&self.lights, light)),
            camera: key((0..self.cameras.len()).map(camera).collect()),
        }
    }

    /// Camera number `index` of the file, from where its [`Orbit`] has moved it.
    ///
    /// # Panics
    /// When there are no more than `index` cameras.
    pub fn viewpoint(&self, index: usize) -> Viewpoint {
        let (own, orbit) = self.camera(index);
        own.orbited(&orbit)
    }

    /// What camera number `index` of the file sees in perspective, each cuboid shaded as the scene says, exactly.
    ///
    /// # Panics
    /// When there are no more than `index` cameras.
    pub fn view(&self, index: usize, size: [usize; 2]) -> View {
        View {
            size,
            viewpoint: self.viewpoint(index),
            projection: Projection::Perspective,
            background: self.background,
            shading: None,
            tolerance: 0.0,
        }
    }

    /// Camera number `index` of the file at its own place, and how far it has been moved from there.
    ///
    /// # Panics
    /// When there are no more than `index` cameras.
    pub fn camera(&self, index: usize) -> (Viewpoint, Orbit) {
        self.copy::<(&Transform, &Camera, &Orbit), _>(self.cameras[index], |(at, camera, orbit)| {
            let own = Viewpoint {
                position: at.position,
                camera: *camera,
            };
            (own, *orbit)
        })
    }

    /// The number of the [`ActiveCamera`] in the file.
    ///
    /// # Panics
    /// When somebody has removed the component: a scene is spawned with it.
    pub fn active_camera(&self) -> usize {
        let is_active = |&camera: &Entity| self.world.satisfies::<&ActiveCamera>(camera);
        let mut cameras = self.cameras.iter();
        cameras
            .position(is_active)
            .expect("a scene is spawned with an active camera")
    }

    /// Makes camera number `index` of the file the [`ActiveCamera`].
    ///
    /// # Panics
    /// When there are no more than `index` cameras.
    pub fn look_from(&mut self, index: usize) {
        for &camera in &self.cameras {
            // Only one of them has it.
            let _ = self.world.remove_one::<ActiveCamera>(camera);
        }
        let looked_from = self.world.insert_one(self.cameras[index], ActiveCamera);
        looked_from.expect("a scene's cameras are never despawned");
    }

    /// Moves camera number `index` of the file so far from its own place.
    ///
    /// # Panics
    /// When there are no more than `index` cameras.
    pub fn set_orbit(&mut self, index: usize, orbit: Orbit) {
        self.copy::<&mut Orbit, _>(self.cameras[index], |own| *own = orbit);
    }

    /// Whether a cuboid is shaded in another way than the file says.
    pub fn is_shaded_otherwise(&self) -> bool {
        let mut modes = self.world.query::<(&SceneShading, &ShadingMode)>();
        modes.iter().any(|(own, mode)| own.0 != *mode)
    }

    /// Shades every cuboid so, or each as the file says.
    pub fn shade(&mut self, mode: Option<ShadingMode>) {
        for (own, shading) in self.world.query_mut::<(&SceneShading, &mut ShadingMode)>() {
            *shading = mode.unwrap_or(own.0);
        }
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
    pub fn switch_lights(&mut self, which: &LightChoice) -> anyhow::Result<()> {
        if let LightChoice::Names(names) = which {
            let lights = self.light_names();
            if let Some(name) = names.iter().find(|&name| !lights.contains(name)) {
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

    /// A component of an entity, where it has one such.
    pub fn get<T: Component + Copy>(&self, entity: Entity) -> Option<T> {
        self.world.get::<&T>(entity).ok().map(|it| *it)
    }

    fn copies<Q: Query, T>(&self, entities: &[Entity], copy: impl Fn(Q::Item<'_>) -> T) -> Vec<T> {
        entities
            .iter()
            .map(|&entity| self.copy::<Q, T>(entity, &copy))
            .collect()
    }

    fn copy<Q: Query, T>(&self, entity: Entity, copy: impl FnOnce(Q::Item<'_>) -> T) -> T {
        let mut query = self.world.query_one::<Q>(entity);
        let components = query.get();
        copy(components.expect("a scene's entities keep the components they were spawned with"))
    }
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
