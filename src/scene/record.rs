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

use super::error::{Fault, Mistake};
use super::range::{
    Angle, Coordinate, FieldOfView, LENGTH, Length, Level, OrbitAngle, Share, Shininess, Strength,
    Zoom, array, number, some_number, some_three, table, tables, three,
};
use crate::components::{
    ActiveCamera, Background, Camera, FileOrder, Inspector, Light, LightKind, Magnifier, Material,
    Mesh, Name, Orbit, Probed, Projection, ShadingMode, Show, Side, Spin, Tab, Tolerance,
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
    #[serde(default, deserialize_with = "three::<Level, _>")]
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
    #[serde(deserialize_with = "name")]
    pub name: String,
    #[serde(deserialize_with = "three::<Length, _>")]
    pub size: DVec3,
    #[serde(default, deserialize_with = "three::<Coordinate, _>")]
    pub position: DVec3,
    #[serde(default, deserialize_with = "three::<Angle, _>")]
    pub rotation: DVec3,
    #[serde(default)]
    pub shading: ShadingMode,
    #[serde(deserialize_with = "table")]
    pub material: MaterialRecord,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MaterialRecord {
    #[serde(deserialize_with = "three::<Strength, _>")]
    pub ambient: DVec3,
    #[serde(deserialize_with = "three::<Strength, _>")]
    pub diffuse: DVec3,
    #[serde(deserialize_with = "three::<Strength, _>")]
    pub specular: DVec3,
    #[serde(deserialize_with = "number::<Shininess, _>")]
    pub shininess: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LightRecord {
    #[serde(deserialize_with = "light_name")]
    pub name: String,
    pub kind: LightKind,
    #[serde(deserialize_with = "three::<Strength, _>")]
    pub color: DVec3,
    #[serde(deserialize_with = "number::<Strength, _>")]
    pub intensity: f64,
    #[serde(default = "one", deserialize_with = "number::<Strength, _>")]
    pub gain: f64,
    /// None of an ambient light.
    #[serde(
        default,
        skip_serializing_if = "Option::is_none",
        deserialize_with = "some_three::<Coordinate, _>"
    )]
    pub position: Option<DVec3>,
    #[serde(default = "yes")]
    pub on: bool,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CameraRecord {
    #[serde(deserialize_with = "name")]
    pub name: String,
    #[serde(deserialize_with = "three::<Coordinate, _>")]
    pub position: DVec3,
    #[serde(deserialize_with = "three::<Coordinate, _>")]
    pub target: DVec3,
    #[serde(default = "y", deserialize_with = "three::<Coordinate, _>")]
    pub up: DVec3,
    #[serde(deserialize_with = "number::<FieldOfView, _>")]
    pub fov: f64,
    #[serde(deserialize_with = "number::<Length, _>")]
    pub height: f64,
    #[serde(
        default,
        skip_serializing_if = "Option::is_none",
        deserialize_with = "some_number::<Length, _>"
    )]
    pub near: Option<f64>,
    #[serde(default, deserialize_with = "orbit")]
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
    #[serde(deserialize_with = "tolerance")]
    pub tolerance: f64,
    pub show: ViewMode,
    #[serde(deserialize_with = "array")]
    pub sides: [Side; 2],
    #[serde(deserialize_with = "number::<Share, _>")]
    pub divider: f64,
    /// Degrees by which all cuboids have turned, 0..360.
    #[serde(deserialize_with = "turned")]
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

/// `value` if it `is_legal`, else an error that says what is expected.
fn checked<T, E: serde::de::Error>(
    value: T,
    is_legal: impl Fn(&T) -> bool,
    expected: &str,
) -> Result<T, E>
where
    T: Serialize,
{
    if is_legal(&value) {
        return Ok(value);
    }
    let found = serde_json::to_string(&value).map_err(E::custom)?;
    Err(E::custom(format!(
        "invalid value: {found}, expected {expected}"
    )))
}

fn name<'de, D: Deserializer<'de>>(from: D) -> Result<String, D::Error> {
    let is_name = |name: &String| !name.is_empty();
    checked(
        String::deserialize(from)?,
        is_name,
        "a name that is not empty",
    )
}

/// The command line writes lists of lights with commas between them.
fn light_name<'de, D: Deserializer<'de>>(from: D) -> Result<String, D::Error> {
    let is_name = |name: &String| !["", "all", "none"].contains(&&**name) && !name.contains(',');
    let expected = "a name that is not empty, holds no comma and is not \"all\" or \"none\"";
    checked(String::deserialize(from)?, is_name, expected)
}

fn tolerance<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    let levels = f64::deserialize(from)?;
    let is_legal = |levels: &f64| Tolerance::is_legal(*levels);
    checked(levels + 0.0, is_legal, "0 or a number from 0.0001 to 255")
}

fn turned<'de, D: Deserializer<'de>>(from: D) -> Result<u32, D::Error> {
    let is_turn = |degrees: &u32| *degrees < 360;
    let expected = "a whole number of degrees from 0 to 359";
    checked(u32::deserialize(from)?, is_turn, expected)
}

fn pixel<'de, D: Deserializer<'de>>(from: D) -> Result<Option<[usize; 2]>, D::Error> {
    let is_pixel = |pixel: &[usize; 2]| pixel.iter().all(|it| *it < MAX_SIDE);
    let expected = "two whole numbers from 0 to 16383";
    checked(array(from)?, is_pixel, expected).map(Some)
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
    let magnifier = Magnifier {
        scale: scale.unwrap_or(1),
        corner,
    };
    let is_legal = |it: &Magnifier| {
        let is_scale = it.scale.is_power_of_two() && it.scale <= Magnifier::MAX_SCALE;
        is_scale && it.corner.iter().all(|it| *it < MAX_SIDE)
    };
    let expected =
        "a scale that is a power of two from 1 to 64, and a corner of two numbers from 0 to 16383";
    checked(magnifier, is_legal, expected)
}

fn orbit<'de, D: Deserializer<'de>>(from: D) -> Result<Orbit, D::Error> {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct OrbitRecord {
        #[serde(default, deserialize_with = "number::<OrbitAngle, _>")]
        azimuth: f64,
        #[serde(default, deserialize_with = "number::<OrbitAngle, _>")]
        elevation: f64,
        #[serde(default = "one", deserialize_with = "number::<Zoom, _>")]
        zoom: f64,
    }
    let OrbitRecord {
        azimuth,
        elevation,
        zoom,
    } = table(from)?;
    Ok(Orbit {
        azimuth,
        elevation,
        zoom,
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
        let mut looks = world.query::<(&Magnifier, &Probed, &Inspector)>();
        let looks = looks.iter().next().expect("a scene has a viewer");
        let (magnifier, probed, inspector) = looks;
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

    /// Whether what is said in several places goes together.
    ///
    /// # Errors
    /// The first thing that does not.
    pub fn check(&self) -> Result<(), Mistake> {
        if self.cuboid.is_empty() {
            return Err(Mistake::new(
                "cuboid",
                0,
                &[],
                "expected one or more tables, each headed `[[cuboid]]`",
            ));
        }
        if self.camera.is_empty() {
            return Err(Mistake::new(
                "camera",
                0,
                &[],
                "expected one or more tables, each headed `[[camera]]`",
            ));
        }
        unique("cuboid", self.cuboid.iter().map(|it| &it.name))?;
        unique("light", self.light.iter().map(|it| &it.name))?;
        unique("camera", self.camera.iter().map(|it| &it.name))?;
        let check = |(index, light): (usize, &LightRecord)| light.check(index);
        self.light.iter().enumerate().try_for_each(check)?;
        let check = |(index, camera): (usize, &CameraRecord)| camera.check(index);
        self.camera.iter().enumerate().try_for_each(check)?;
        if self.active_camera().is_none() {
            let names: Vec<&str> = self.camera.iter().map(|it| &*it.name).collect();
            let name = self.view.camera.as_deref().unwrap_or_default();
            let message = format!(
                "invalid value: string {name:?}, expected the name of a camera: {}",
                names.join(", ")
            );
            return Err(Mistake::new("view", 0, &["camera"], message));
        }
        Ok(())
    }

    /// The first light whose colour is written in levels, which makes it some 255 times as bright as was meant.
    pub(super) fn slip(&self) -> Option<Mistake> {
        let lights = self.light.iter();
        let index = lights.clone().position(|it| it.color.max_element() > 1.0)?;
        let most = self.light[index].color.max_element();
        let message = format!(
            "{most:?} is above 1; a colour is usually from 0 to 1, and `intensity` says how bright it is"
        );
        Some(Mistake::new("light", index, &["color"], message))
    }
}

fn unique<'a>(kind: &'static str, names: impl Iterator<Item = &'a String>) -> Result<(), Mistake> {
    let mut known = HashSet::new();
    for (index, name) in names.enumerate() {
        if !known.insert(name) {
            let message =
                format!("invalid value: string {name:?}, expected a name that no other {kind} has");
            return Err(Mistake::new(kind, index, &["name"], message));
        }
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

    fn check(&self, index: usize) -> Result<(), Mistake> {
        match (self.kind, self.position) {
            (LightKind::Ambient, Some(_)) => Err(Mistake::new(
                "light",
                index,
                &["position"],
                "unknown field of an ambient light, which is everywhere alike",
            )),
            (LightKind::Diffuse | LightKind::Specular, None) => Err(Mistake::new(
                "light",
                index,
                &["position", "kind"],
                "missing, expected three numbers; only an ambient light has none",
            )),
            _ => Ok(()),
        }
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

    fn check(&self, index: usize) -> Result<(), Mistake> {
        let view = self.target - self.position;
        let parallel = unit(self.up).cross(unit(view)).length() < PARALLEL;
        // The default near plane, a thousandth of this distance, must not underflow.
        let (keys, found, expected): (&[_], _, _) = if length(view) < 1e-100 {
            let expected = "a point at least 1e-100 away from `camera.position`";
            (
                &["target"],
                format!("{:?}", self.target.to_array()),
                expected,
            )
        } else if parallel {
            let expected = "a direction that is neither zero nor parallel to the view, target - position (left out, it is +y)";
            (
                &["up", "target"],
                format!("{:?}", self.up.to_array()),
                expected,
            )
        } else if self.orbit.zoom != 1.0
            && ![length(view), self.height]
                .iter()
                .all(|it| LENGTH.contains(&(it * self.orbit.zoom)))
        {
            let expected = "one that leaves distance and height from 1e-100 to 1e100";
            (&["orbit"], format!("zoom {:?}", self.orbit.zoom), expected)
        } else {
            return Ok(());
        };
        let message = format!("invalid value: {found}, expected {expected}");
        Err(Mistake::new("camera", index, keys, message))
    }
}
