//! What a scene says, as the tables of its file: what is read, spawned, saved, and built by the program itself.
//!
//! ```text
//! text <--read, write--> records <--spawn, Scene::records--> World
//! ```
//! Rule: these tables are the whole format; what is not named here is refused. What is written is read again as the same
//! records, bit for bit.

use std::collections::HashMap;

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::error::{Fault, line_and_column};
use super::keys::{
    Angle, AnyName, Coordinate, FieldOfView, Form, Headed, Key, Length, Level, LightName,
    Shininess, Strength, Table, Tables, Three, key,
};
use crate::components::{Camera, Light, LightKind, Material, ShadingMode, Viewpoint, length, unit};

/// An `up` is parallel to the view where the sine of the angle between them is smaller.
const PARALLEL: f64 = 1e-9;

/// The material of the built-in default scene.
pub const EMERALD: Material = Material {
    ambient: DVec3::splat(0.3),
    diffuse: DVec3::new(0.07568, 0.61424, 0.07568),
    specular: DVec3::new(0.633, 0.72811, 0.66),
    shininess: 76.8,
};

/// The whole file, everything in its order.
#[derive(Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneRecord {
    #[serde(default)]
    pub background: Key<Three<Level>>,
    pub cuboid: Key<Tables<CuboidRecord, 1>>,
    #[serde(default)]
    pub light: Key<Tables<LightRecord, 0>>,
    pub camera: Key<Tables<CameraRecord, 1>>,
}

#[derive(Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CuboidRecord {
    pub name: Key<AnyName>,
    pub size: Key<Three<Length>>,
    #[serde(default)]
    pub position: Key<Three<Coordinate>>,
    #[serde(default)]
    pub rotation: Key<Three<Angle>>,
    #[serde(default)]
    pub shading: Key<ShadingMode>,
    pub material: Key<Table<MaterialRecord>>,
}

#[derive(Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MaterialRecord {
    pub ambient: Key<Three<Strength>>,
    pub diffuse: Key<Three<Strength>>,
    pub specular: Key<Three<Strength>>,
    pub shininess: Key<Shininess>,
}

#[derive(Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LightRecord {
    pub name: Key<LightName>,
    pub kind: Key<LightKind>,
    pub color: Key<Three<Strength>>,
    pub intensity: Key<Strength>,
    #[serde(default = "one")]
    pub gain: Key<Strength>,
    /// None of an ambient light.
    pub position: Option<Key<Three<Coordinate>>>,
    #[serde(default = "yes")]
    pub on: bool,
}

#[derive(Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CameraRecord {
    pub name: Key<AnyName>,
    pub position: Key<Three<Coordinate>>,
    pub target: Key<Three<Coordinate>>,
    /// Left out, it is +y.
    pub up: Option<Key<Three<Coordinate>>>,
    pub fov: Key<FieldOfView>,
    pub height: Key<Length>,
    pub near: Option<Key<Length>>,
}

fn one() -> Key<Strength> {
    key(1.0)
}

fn yes() -> bool {
    true
}

impl Headed for CuboidRecord {
    const HEADER: &str = "[[cuboid]]";
}

impl Headed for MaterialRecord {
    const HEADER: &str = "[cuboid.material]";
}

impl Headed for LightRecord {
    const HEADER: &str = "[[light]]";
}

impl Headed for CameraRecord {
    const HEADER: &str = "[[camera]]";
}

impl SceneRecord {
    /// What the text describes.
    pub fn read(text: &str) -> Result<Self, Fault> {
        let scene: SceneRecord =
            toml::from_str(text).map_err(|error| Fault::of_toml(text, error))?;
        unique(text, "cuboid", scene.cuboid.iter().map(|it| &it.name))?;
        unique(text, "light", scene.light.iter().map(|it| &it.name))?;
        unique(text, "camera", scene.camera.iter().map(|it| &it.name))?;
        scene.light.iter().try_for_each(LightRecord::check)?;
        scene.camera.iter().try_for_each(CameraRecord::check)?;
        Ok(scene)
    }

    /// The first light whose colour is written in levels, which makes it some 255 times as bright as was meant.
    pub fn slip(&self) -> Option<Fault> {
        let light = self.light.iter().find(|it| it.color.max_element() > 1.0)?;
        let message = format!(
            "`light.color`: {:?} is above 1; a colour is usually from 0 to 1, and `intensity` says how bright it is",
            light.color.max_element()
        );
        Some(Fault::new(light.color.span.clone(), message))
    }

    /// The text that is read again as these records.
    pub fn write(&self) -> String {
        toml::to_string(self).expect("TOML has numbers, texts, arrays and tables")
    }
}

fn unique<'a, F: Form<Value = String> + 'a>(
    text: &str,
    kind: &str,
    names: impl Iterator<Item = &'a Key<F>>,
) -> Result<(), Fault> {
    let mut places = HashMap::new();
    for Key { value, span } in names {
        if let Some(first) = places.insert(value, span) {
            let (line, _) = line_and_column(text, first.start);
            let message = format!(
                "`{kind}.name`: invalid value: string {value:?}, expected a name that no other {kind} has, and line {line} has it"
            );
            return Err(Fault::new(span.clone(), message));
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
            name: key(name.into()),
            size: key(size.into()),
            position: key(position.into()),
            rotation: Key::default(),
            shading: key(ShadingMode::Phong),
            material: key(EMERALD.into()),
        }
    }
}

impl From<Material> for MaterialRecord {
    fn from(material: Material) -> Self {
        MaterialRecord {
            ambient: key(material.ambient),
            diffuse: key(material.diffuse),
            specular: key(material.specular),
            shininess: key(material.shininess),
        }
    }
}

impl From<&MaterialRecord> for Material {
    fn from(record: &MaterialRecord) -> Self {
        Material {
            ambient: *record.ambient,
            diffuse: *record.diffuse,
            specular: *record.specular,
            shininess: *record.shininess,
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
            name: key(name.into()),
            kind: key(kind),
            color: key(DVec3::ONE),
            intensity: key(levels),
            gain: one(),
            position: (kind != LightKind::Ambient).then(|| key(position.into())),
            on: true,
        }
    }

    /// The component; it stands at [`LightRecord::place`].
    pub fn light(&self) -> Light {
        Light {
            kind: *self.kind,
            color: *self.color,
            intensity: *self.intensity,
            gain: *self.gain,
            on: self.on,
        }
    }

    /// The origin for an ambient light.
    pub fn place(&self) -> DVec3 {
        self.position.as_deref().copied().unwrap_or_default()
    }

    fn check(&self) -> Result<(), Fault> {
        match (*self.kind, &self.position) {
            (LightKind::Ambient, Some(position)) => {
                let message = "`light.position`: unknown field of an ambient light, which is everywhere alike";
                Err(Fault::new(position.span.clone(), message.to_owned()))
            }
            (LightKind::Diffuse | LightKind::Specular, None) => {
                let words = <Three<Coordinate>>::words();
                let message = format!(
                    "`light`: missing field `position`, expected {words}; only an ambient light has none"
                );
                Err(Fault::new(self.kind.span.clone(), message))
            }
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
            name: key(name.into()),
            position: key(position.into()),
            target: key(target.into()),
            up: None,
            fov: key(fov),
            height: key(height),
            near: None,
        }
    }

    /// A camera that stands where `viewpoint` is.
    pub fn of(name: String, viewpoint: Viewpoint) -> CameraRecord {
        let Viewpoint { position, camera } = viewpoint;
        let sees = [camera.fov, camera.height];
        CameraRecord {
            up: Some(key(camera.up)),
            near: camera.near.map(key),
            ..CameraRecord::new(name, position, camera.target, sees)
        }
    }

    /// The component; it stands at `position`.
    pub fn camera(&self) -> Camera {
        Camera {
            target: *self.target,
            up: self.up.as_deref().copied().unwrap_or(DVec3::Y),
            fov: *self.fov,
            height: *self.height,
            near: self.near.as_deref().copied(),
        }
    }

    fn check(&self) -> Result<(), Fault> {
        let view = *self.target - *self.position;
        let parallel = unit(self.camera().up).cross(unit(view)).length() < PARALLEL;
        // The default near plane, a thousandth of this distance, must not underflow.
        let (name, found, expected) = if length(view) < 1e-100 {
            let expected = "a point at least 1e-100 away from `camera.position`";
            ("target", &self.target, expected)
        } else if !parallel {
            return Ok(());
        } else if let Some(up) = &self.up {
            let expected =
                "a direction that is neither zero nor parallel to the view, target - position";
            ("up", up, expected)
        } else {
            let expected =
                "a point off the vertical through `camera.position`, as `camera.up` is left out";
            ("target", &self.target, expected)
        };
        let message = format!(
            "`camera.{name}`: invalid value: `{:?}`, expected {expected}",
            found.to_array()
        );
        Err(Fault::new(found.span.clone(), message))
    }
}
