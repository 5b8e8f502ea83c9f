//! A scene written down: the tables of its file, and the one form in which a [`World`] is saved, compared and copied.
//!
//! ```text
//! text --read--> SceneRecord <--spawn, of--> World
//!      <--save--
//! ```
//! These tables are the whole format; what is not named here is refused. Optional keys have their defaults in the record, so
//! that two records are equal where their scenes are.

use std::collections::HashSet;

use glam::DVec3;
use hecs::World;
use serde::{Deserialize, Deserializer, Serialize};

use super::error::{Fault, Mistake, Place};
use super::form::{array, number, some_three, table, tables, three};
use super::range::{
    ANGLE, COORDINATE, FIELD_OF_VIEW, LENGTH, LEVEL, ORBIT, SHARE, SHININESS, STRENGTH, ZOOM,
};
use crate::components::{
    ActiveCamera, Background, Budget, Camera, FileOrder, Inspector, Light, LightKind, Magnifier,
    Material, Mesh, Name, Orbit, Probed, Projection, ShadingMode, Show, Side, Spin, Tab, Tolerance,
    Transform, ViewMode, active_camera, cuboid, get, in_file_order, length, ordered, unit,
};

/// An `up` is parallel to the view where the sine of the angle between them is smaller.
const PARALLEL: f64 = 1e-9;

/// The longest side of a picture, in pixels.
pub const MAX_SIDE: usize = 16_384;

/// The material of the built-in default scene.
pub(crate) const EMERALD: Material = Material {
    ambient: DVec3::splat(0.3),
    diffuse: DVec3::new(0.07568, 0.61424, 0.07568),
    specular: DVec3::new(0.633, 0.72811, 0.66),
    shininess: 76.8,
};

/// The whole file, everything in its order.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneRecord {
    #[serde(default, deserialize_with = "three")]
    pub background: DVec3,
    /// One or more.
    #[serde(deserialize_with = "tables")]
    pub cuboid: Vec<CuboidRecord>,
    #[serde(default, deserialize_with = "tables")]
    pub light: Vec<LightRecord>,
    /// One or more.
    #[serde(deserialize_with = "tables")]
    pub camera: Vec<CameraRecord>,
    #[serde(default, deserialize_with = "table")]
    pub view: ViewRecord,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CuboidRecord {
    pub name: String,
    #[serde(deserialize_with = "three")]
    pub size: DVec3,
    #[serde(default, deserialize_with = "three")]
    pub position: DVec3,
    #[serde(default, deserialize_with = "three")]
    pub rotation: DVec3,
    #[serde(default)]
    pub shading: ShadingMode,
    #[serde(deserialize_with = "table")]
    pub material: MaterialRecord,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MaterialRecord {
    #[serde(deserialize_with = "three")]
    pub ambient: DVec3,
    #[serde(deserialize_with = "three")]
    pub diffuse: DVec3,
    #[serde(deserialize_with = "three")]
    pub specular: DVec3,
    #[serde(deserialize_with = "number")]
    pub shininess: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LightRecord {
    pub name: String,
    pub kind: LightKind,
    #[serde(deserialize_with = "three")]
    pub color: DVec3,
    #[serde(deserialize_with = "number")]
    pub intensity: f64,
    #[serde(default = "one", deserialize_with = "number")]
    pub gain: f64,
    /// None of an ambient light.
    #[serde(
        default,
        skip_serializing_if = "Option::is_none",
        deserialize_with = "some_three"
    )]
    pub position: Option<DVec3>,
    #[serde(default = "yes")]
    pub on: bool,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CameraRecord {
    pub name: String,
    #[serde(deserialize_with = "three")]
    pub position: DVec3,
    #[serde(deserialize_with = "three")]
    pub target: DVec3,
    #[serde(default = "y", deserialize_with = "three")]
    pub up: DVec3,
    #[serde(deserialize_with = "number")]
    pub fov: f64,
    #[serde(deserialize_with = "number")]
    pub height: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub near: Option<f64>,
    #[serde(default, deserialize_with = "table")]
    pub orbit: Orbit,
}

/// How the scene is looked at.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ViewRecord {
    /// `None` is the first camera.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub camera: Option<String>,
    pub projection: Projection,
    #[serde(deserialize_with = "number")]
    pub tolerance: f64,
    /// In place of the tolerance, in milliseconds a frame.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub budget: Option<f64>,
    pub show: ViewMode,
    #[serde(deserialize_with = "array")]
    pub sides: [Side; 2],
    #[serde(deserialize_with = "number")]
    pub divider: f64,
    /// Degrees by which all cuboids have turned, 0..360.
    pub turned: u32,
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "pixel")]
    pub pixel: Option<[usize; 2]>,
    #[serde(deserialize_with = "magnifier")]
    pub magnifier: Magnifier,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inspector: Option<Tab>,
}

impl Default for ViewRecord {
    fn default() -> Self {
        let Show {
            mode,
            sides,
            divider,
        } = Show::default();
        ViewRecord {
            camera: None,
            projection: Projection::default(),
            tolerance: Tolerance::default().0,
            budget: None,
            show: mode,
            sides,
            divider,
            turned: 0,
            pixel: None,
            magnifier: Magnifier::default(),
            inspector: None,
        }
    }
}

fn one() -> f64 {
    1.0
}

fn yes() -> bool {
    true
}

fn y() -> DVec3 {
    DVec3::Y
}

fn pixel<'de, D: Deserializer<'de>>(from: D) -> Result<Option<[usize; 2]>, D::Error> {
    array(from).map(Some)
}

fn magnifier<'de, D: Deserializer<'de>>(from: D) -> Result<Magnifier, D::Error> {
    #[derive(Default, Deserialize)]
    #[serde(default, deny_unknown_fields)]
    struct MagnifierRecord {
        scale: Option<usize>,
        #[serde(deserialize_with = "array")]
        corner: [usize; 2],
    }
    let MagnifierRecord { scale, corner } = table(from)?;
    Ok(Magnifier {
        scale: scale.unwrap_or(1),
        corner,
    })
}

impl SceneRecord {
    /// What the components say now, whether the cuboids go on turning apart.
    ///
    /// # Panics
    /// When the world has no viewer or no camera: a scene is spawned with them.
    pub fn of(world: &World) -> SceneRecord {
        let mut cuboids = world.query::<(
            &FileOrder,
            &Name,
            &Transform,
            &Mesh,
            &Material,
            &ShadingMode,
        )>();
        let cuboid = cuboids
            .iter()
            .map(|(order, name, at, mesh, material, shading)| {
                let cuboid = CuboidRecord {
                    name: name.0.clone(),
                    size: mesh.size(),
                    position: at.position,
                    rotation: at.rotation,
                    shading: *shading,
                    material: (*material).into(),
                };
                (*order, cuboid)
            });
        let mut lights = world.query::<(&FileOrder, &Name, &Transform, &Light)>();
        let light = lights.iter().map(|(order, name, at, light)| {
            let light = LightRecord {
                color: light.color,
                gain: light.gain,
                on: light.on,
                ..LightRecord::new(&name.0, light.kind, light.intensity, at.position)
            };
            (*order, light)
        });
        let mut cameras = world.query::<(&FileOrder, &Name, &Transform, &Camera, &Orbit)>();
        let camera = cameras.iter().map(|(order, name, at, camera, orbit)| {
            let camera = CameraRecord {
                name: name.0.clone(),
                position: at.position,
                target: camera.target,
                up: camera.up,
                fov: camera.fov,
                height: camera.height,
                near: camera.near,
                orbit: *orbit,
            };
            (*order, camera)
        });
        let mut viewers = world.query::<(&Background, &Projection, &Tolerance, &Spin, &Show)>();
        let viewer = viewers.iter().next().expect("a scene has a viewer");
        let (background, projection, tolerance, spin, show) = viewer;
        let mut looks = world.query::<(&Budget, &Magnifier, &Probed, &Inspector)>();
        let looks = looks.iter().next().expect("a scene has a viewer");
        let (budget, magnifier, probed, inspector) = looks;
        let active = active_camera(world);
        let is_first = ordered::<Camera>(world).first() == Some(&active);
        let name = get(world, active).map(|Name(name)| name);
        SceneRecord {
            background: background.0,
            cuboid: in_file_order(cuboid),
            light: in_file_order(light),
            camera: in_file_order(camera),
            view: ViewRecord {
                camera: name.filter(|_| !is_first),
                projection: *projection,
                tolerance: tolerance.0,
                budget: budget.0,
                show: show.mode,
                sides: show.sides,
                divider: show.divider,
                turned: spin.degrees,
                pixel: probed.0,
                magnifier: *magnifier,
                inspector: inspector.0,
            },
        }
    }

    /// The world that is written down here: its own record is this one again.
    ///
    /// # Panics
    /// When there is no camera.
    pub fn spawn(&self) -> World {
        let mut world = World::new();
        for (order, it) in self.cuboid.iter().enumerate() {
            let transform = Transform {
                position: it.position,
                rotation: it.rotation,
            };
            let (mesh, material) = (Mesh::cuboid(it.size), it.material.into());
            let name = Name(it.name.clone());
            world.spawn(cuboid(order, name, transform, mesh, material, it.shading));
        }
        for (order, it) in (0..).map(FileOrder).zip(&self.light) {
            let name = Name(it.name.clone());
            world.spawn((name, order, Transform::at(it.place()), it.light()));
        }
        let mut cameras = Vec::with_capacity(self.camera.len());
        for (order, it) in (0..).map(FileOrder).zip(&self.camera) {
            let name = Name(it.name.clone());
            let place = Transform::at(it.position);
            cameras.push(world.spawn((name, order, place, it.camera(), it.orbit)));
        }
        let view = &self.view;
        world.spawn((
            ActiveCamera(cameras[self.active_camera().unwrap_or(0)]),
            Background(self.background),
            view.projection,
            Tolerance(view.tolerance),
            Budget(view.budget),
            Spin {
                degrees: view.turned,
                on: false,
            },
            Show {
                mode: view.show,
                sides: view.sides,
                divider: view.divider,
            },
            view.magnifier,
            Probed(view.pixel),
            Inspector(view.inspector),
        ));
        world
    }

    /// The name of the camera that is looked through, which is one of the record's.
    pub(super) fn active_camera_name(&self) -> Option<&str> {
        let first = self.camera.first().map(|camera| &*camera.name);
        self.view.camera.as_deref().or(first)
    }

    /// The place in the file of the camera that is looked through; `None` where there is none of that name.
    pub(super) fn active_camera(&self) -> Option<usize> {
        match &self.view.camera {
            None => Some(0),
            Some(name) => self.camera.iter().position(|camera| camera.name == *name),
        }
    }

    /// Leaves out the cameras that are not looked through.
    pub(crate) fn keep_active_camera(&mut self) {
        let active = self.active_camera().unwrap_or(0);
        self.camera = vec![self.camera.swap_remove(active)];
        self.view.camera = None;
    }

    /// What the text describes.
    pub(super) fn read(text: &str) -> Result<Self, Fault> {
        let mut record: SceneRecord = toml::from_str(text)?;
        record.check()?;
        if record.active_camera() == Some(0) {
            record.view.camera = None;
        }
        Ok(record)
    }

    /// Whether everything is within its range and goes together.
    ///
    /// # Errors
    /// The first thing that is not.
    pub fn check(&self) -> Result<(), Mistake> {
        for (index, level) in self.background.to_array().into_iter().enumerate() {
            Place::new("background", index).number("", level, &LEVEL)?;
        }
        let counts = [("cuboid", self.cuboid.len()), ("camera", self.camera.len())];
        for (kind, count) in counts {
            Place::new(kind, 0).is("", count, count > 0, || {
                format!("one or more tables, each headed `[[{kind}]]`")
            })?;
        }
        unique("cuboid", self.cuboid.iter().map(|it| &it.name))?;
        unique("light", self.light.iter().map(|it| &it.name))?;
        unique("camera", self.camera.iter().map(|it| &it.name))?;
        for (index, cuboid) in self.cuboid.iter().enumerate() {
            cuboid.check(&Place::new("cuboid", index))?;
        }
        for (index, light) in self.light.iter().enumerate() {
            light.check(&Place::new("light", index))?;
        }
        for (index, camera) in self.camera.iter().enumerate() {
            camera.check(&Place::new("camera", index))?;
        }
        let place = Place::new("view", 0);
        self.view.check(&place)?;
        let camera = self.view.camera.as_deref().unwrap_or_default();
        place.is("camera", camera, self.active_camera().is_some(), || {
            let names: Vec<&str> = self.camera.iter().map(|it| &*it.name).collect();
            format!("the name of a camera: {}", names.join(", "))
        })
    }

    /// The first light whose colour is written in levels, which makes it some 255 times as bright as was meant.
    pub(super) fn slip(&self) -> Option<Mistake> {
        let is_slip = |light: &LightRecord| light.color.max_element() > 1.0;
        let index = self.light.iter().position(is_slip)?;
        let most = self.light[index].color.max_element();
        let message = format!(
            "{most:?} is above 1; a colour is usually from 0 to 1, and `intensity` says how bright it is"
        );
        Some(Mistake::new(Place::new("light", index), "color", message))
    }
}

fn unique<'a>(kind: &'static str, names: impl Iterator<Item = &'a String>) -> Result<(), Mistake> {
    let mut known = HashSet::new();
    for (index, name) in names.enumerate() {
        let place = Place::new(kind, index);
        let expected = || format!("a name that no other {kind} has");
        place.is("name", name, known.insert(name), expected)?;
        place.is("name", name, !name.is_empty(), || {
            "a name that is not empty".to_owned()
        })?;
    }
    Ok(())
}

impl CuboidRecord {
    /// An emerald of these edges at this place, not rotated, shaded by Phong.
    pub fn new(
        name: impl Into<String>,
        size: impl Into<DVec3>,
        position: impl Into<DVec3>,
    ) -> CuboidRecord {
        CuboidRecord {
            name: name.into(),
            size: size.into(),
            position: position.into(),
            rotation: DVec3::ZERO,
            shading: ShadingMode::Phong,
            material: EMERALD.into(),
        }
    }

    fn check(&self, place: &Place) -> Result<(), Mistake> {
        let material = &self.material;
        place.three("size", self.size, &LENGTH)?;
        place.three("position", self.position, &COORDINATE)?;
        place.three("rotation", self.rotation, &ANGLE)?;
        place.three("material.ambient", material.ambient, &STRENGTH)?;
        place.three("material.diffuse", material.diffuse, &STRENGTH)?;
        place.three("material.specular", material.specular, &STRENGTH)?;
        place.number("material.shininess", material.shininess, &SHININESS)
    }
}

impl From<Material> for MaterialRecord {
    fn from(material: Material) -> Self {
        MaterialRecord {
            ambient: material.ambient,
            diffuse: material.diffuse,
            specular: material.specular,
            shininess: material.shininess,
        }
    }
}

impl From<MaterialRecord> for Material {
    fn from(record: MaterialRecord) -> Self {
        Material {
            ambient: record.ambient,
            diffuse: record.diffuse,
            specular: record.specular,
            shininess: record.shininess,
        }
    }
}

impl LightRecord {
    /// A white light that sends so many levels, from `position` unless it is ambient.
    pub fn new(
        name: impl Into<String>,
        kind: LightKind,
        levels: f64,
        position: impl Into<DVec3>,
    ) -> LightRecord {
        LightRecord {
            name: name.into(),
            kind,
            color: DVec3::ONE,
            intensity: levels,
            gain: 1.0,
            position: (kind != LightKind::Ambient).then(|| position.into()),
            on: true,
        }
    }

    /// The component; it stands at [`LightRecord::place`].
    pub fn light(&self) -> Light {
        Light {
            kind: self.kind,
            color: self.color,
            intensity: self.intensity,
            gain: self.gain,
            on: self.on,
        }
    }

    /// The origin for an ambient light.
    pub fn place(&self) -> DVec3 {
        self.position.unwrap_or_default()
    }

    fn check(&self, place: &Place) -> Result<(), Mistake> {
        // The command line writes lists of lights with commas between them.
        let is_name = !["all", "none"].contains(&&*self.name) && !self.name.contains(',');
        place.is("name", &self.name, is_name, || {
            "a name that holds no comma and is not \"all\" or \"none\"".to_owned()
        })?;
        place.three("color", self.color, &STRENGTH)?;
        place.number("intensity", self.intensity, &STRENGTH)?;
        place.number("gain", self.gain, &STRENGTH)?;
        let position = self.position.unwrap_or_default();
        place.three("position", position, &COORDINATE)?;
        let message = match (self.kind, self.position) {
            (LightKind::Ambient, Some(_)) => {
                "unknown field of an ambient light, which is everywhere alike"
            }
            (LightKind::Diffuse | LightKind::Specular, None) => {
                "missing, expected three numbers; only an ambient light has none"
            }
            _ => return Ok(()),
        };
        Err(Mistake::new(*place, "position", message.to_owned()))
    }
}

impl CameraRecord {
    /// From `position` towards `target`, with +y up: `fov` degrees in perspective, `height` units in orthographic
    /// projection.
    pub fn new(
        name: impl Into<String>,
        position: impl Into<DVec3>,
        target: impl Into<DVec3>,
        [fov, height]: [f64; 2],
    ) -> CameraRecord {
        CameraRecord {
            name: name.into(),
            position: position.into(),
            target: target.into(),
            up: DVec3::Y,
            fov,
            height,
            near: None,
            orbit: Orbit::default(),
        }
    }

    /// The component; it stands at `position`.
    pub fn camera(&self) -> Camera {
        Camera {
            target: self.target,
            up: self.up,
            fov: self.fov,
            height: self.height,
            near: self.near,
        }
    }

    fn check(&self, place: &Place) -> Result<(), Mistake> {
        let Orbit {
            azimuth,
            elevation,
            zoom,
        } = self.orbit;
        place.three("position", self.position, &COORDINATE)?;
        place.three("target", self.target, &COORDINATE)?;
        place.three("up", self.up, &COORDINATE)?;
        place.number("fov", self.fov, &FIELD_OF_VIEW)?;
        place.number("height", self.height, &LENGTH)?;
        place.number("near", self.near.unwrap_or(1.0), &LENGTH)?;
        place.number("orbit.azimuth", azimuth, &ORBIT)?;
        place.number("orbit.elevation", elevation, &ORBIT)?;
        place.number("orbit.zoom", zoom, &ZOOM)?;

        let view = self.target - self.position;
        let (target, up) = (self.target.to_array(), self.up.to_array());
        // The default near plane, a thousandth of this distance, must not underflow.
        place.is("target", target, length(view) >= 1e-100, || {
            "a point at least 1e-100 away from `camera.position`".to_owned()
        })?;
        let is_parallel = unit(self.up).cross(unit(view)).length() < PARALLEL;
        // A usual `up` is hardly ever said, nor is it what is wrong.
        let (key, found, expected) = if self.up == DVec3::Y {
            (
                "target",
                target,
                "a point that is not above or below `camera.position`, as `camera.up` is +y",
            )
        } else {
            (
                "up",
                up,
                "a direction that is neither zero nor parallel to the view, target - position",
            )
        };
        place.is(key, found, !is_parallel, || expected.to_owned())?;
        let seen = [length(view), self.height].map(|it| it * zoom);
        let is_seen = seen.iter().all(|it| LENGTH.contains(it));
        place.is("orbit", zoom, zoom == 1.0 || is_seen, || {
            "a zoom that leaves distance and height from 1e-100 to 1e100".to_owned()
        })
    }
}

impl ViewRecord {
    fn check(&self, place: &Place) -> Result<(), Mistake> {
        let is_tolerance = Tolerance::is_legal(self.tolerance);
        place.is("tolerance", self.tolerance, is_tolerance, || {
            "0 or a number from 0.0001 to 255".to_owned()
        })?;
        if let Some(budget) = self.budget {
            place.number("budget", budget, &Budget::RANGE)?;
            let is_alone = self.tolerance == Tolerance::default().0;
            place.is("budget", budget, is_alone, || {
                "either a budget or a tolerance".to_owned()
            })?;
        }
        place.number("divider", self.divider, &SHARE)?;
        place.is("turned", self.turned, self.turned < 360, || {
            "a whole number of degrees from 0 to 359".to_owned()
        })?;
        let Magnifier { scale, corner } = self.magnifier;
        let is_scale = scale.is_power_of_two() && scale <= Magnifier::MAX_SCALE;
        place.is("magnifier.scale", scale, is_scale, || {
            "a power of two from 1 to 64".to_owned()
        })?;
        let pixels = [
            ("magnifier.corner", corner),
            ("pixel", self.pixel.unwrap_or_default()),
        ];
        pixels.into_iter().try_for_each(|(key, pixel)| {
            let is_pixel = pixel.iter().all(|it| *it < MAX_SIDE);
            place.is(key, pixel, is_pixel, || {
                "two whole numbers from 0 to 16383".to_owned()
            })
        })
    }
}
