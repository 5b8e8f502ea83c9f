//! The text of a scene file in, its records out; and back, as the same tables.
//!
//! ```text
//! [[camera]]                 CameraTable                 (Name, Transform, Camera)
//! name = "1"        <-->     name: Key<AnyName>   <-->
//! fov = 30.0                 fov: Key<FieldOfView>
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
use super::{CameraRecord, CuboidRecord, LightRecord, Records};
use crate::components::{
    Camera, Light, LightKind, Material, Mesh, Name, ShadingMode, Transform, length, unit,
};

/// An `up` is parallel to the view where the sine of the angle between them is smaller.
const PARALLEL: f64 = 1e-9;

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct SceneTable {
    background: Option<Key<Three<Level>>>,
    cuboid: Key<Tables<CuboidTable, 1>>,
    light: Option<Key<Tables<LightTable, 0>>>,
    camera: Key<Tables<CameraTable, 1>>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct CuboidTable {
    name: Key<AnyName>,
    size: Key<Three<Length>>,
    position: Option<Key<Three<Coordinate>>>,
    rotation: Option<Key<Three<Angle>>>,
    shading: Option<Key<ShadingMode>>,
    material: Key<Table<MaterialTable>>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct MaterialTable {
    ambient: Key<Three<Strength>>,
    diffuse: Key<Three<Strength>>,
    specular: Key<Three<Strength>>,
    shininess: Key<Shininess>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct LightTable {
    name: Key<LightName>,
    kind: Key<LightKind>,
    color: Key<Three<Strength>>,
    intensity: Key<Strength>,
    gain: Option<Key<Strength>>,
    position: Option<Key<Three<Coordinate>>>,
    on: Option<bool>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct CameraTable {
    name: Key<AnyName>,
    position: Key<Three<Coordinate>>,
    target: Key<Three<Coordinate>>,
    up: Option<Key<Three<Coordinate>>>,
    fov: Key<FieldOfView>,
    height: Key<Length>,
    near: Option<Key<Length>>,
}

impl Headed for CuboidTable {
    const HEADER: &str = "[[cuboid]]";
}

impl Headed for MaterialTable {
    const HEADER: &str = "[cuboid.material]";
}

impl Headed for LightTable {
    const HEADER: &str = "[[light]]";
}

impl Headed for CameraTable {
    const HEADER: &str = "[[camera]]";
}

/// What the text describes.
pub fn read(text: &str) -> Result<Records, Fault> {
    let scene: SceneTable = toml::from_str(text).map_err(|error| Fault::of_toml(text, error))?;
    let (cuboids, cameras) = (scene.cuboid.value, scene.camera.value);
    let lights = scene.light.map_or_else(Vec::new, |lights| lights.value);
    unique(text, "cuboid", cuboids.iter().map(|cuboid| &cuboid.name))?;
    unique(text, "light", lights.iter().map(|light| &light.name))?;
    unique(text, "camera", cameras.iter().map(|camera| &camera.name))?;
    Ok(Records {
        background: given_or(scene.background, DVec3::ZERO),
        cuboids: cuboids.into_iter().map(CuboidTable::record).collect(),
        lights: lights
            .into_iter()
            .map(LightTable::record)
            .collect::<Result<_, _>>()?,
        cameras: cameras
            .into_iter()
            .map(CameraTable::record)
            .collect::<Result<_, _>>()?,
    })
}

/// The text that describes `records`.
pub fn write(records: Records) -> String {
    let scene = SceneTable {
        background: Some(key(records.background)),
        cuboid: key(records.cuboids.into_iter().map(CuboidTable::of).collect()),
        light: Some(key(records
            .lights
            .into_iter()
            .map(LightTable::of)
            .collect())),
        camera: key(records.cameras.into_iter().map(CameraTable::of).collect()),
    };
    toml::to_string(&scene).expect("TOML has numbers, texts, arrays and tables")
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

fn given_or<F: Form>(key: Option<Key<F>>, default: F::Value) -> F::Value {
    key.map_or(default, |key| key.value)
}

impl CuboidTable {
    fn record(self) -> CuboidRecord {
        let transform = Transform {
            position: given_or(self.position, DVec3::ZERO),
            rotation: given_or(self.rotation, DVec3::ZERO),
        };
        let material = self.material.value;
        let material = Material {
            ambient: material.ambient.value,
            diffuse: material.diffuse.value,
            specular: material.specular.value,
            shininess: material.shininess.value,
        };
        (
            Name(self.name.value),
            transform,
            Mesh::cuboid(self.size.value),
            material,
            given_or(self.shading, ShadingMode::Gouraud),
        )
    }

    fn of((name, transform, mesh, material, shading): CuboidRecord) -> Self {
        CuboidTable {
            name: key(name.0),
            size: key(mesh.corners[7] - mesh.corners[0]),
            position: Some(key(transform.position)),
            rotation: Some(key(transform.rotation)),
            shading: Some(key(shading)),
            material: key(MaterialTable {
                ambient: key(material.ambient),
                diffuse: key(material.diffuse),
                specular: key(material.specular),
                shininess: key(material.shininess),
            }),
        }
    }
}

impl LightTable {
    fn record(self) -> Result<LightRecord, Fault> {
        let kind = self.kind.value;
        let position = match (kind, self.position) {
            (LightKind::Ambient, Some(position)) => {
                let message = "`light.position`: unknown field of an ambient light, which is everywhere alike";
                return Err(Fault::new(position.span, message.to_owned()));
            }
            (LightKind::Ambient, None) => DVec3::ZERO,
            (_, Some(position)) => position.value,
            (_, None) => {
                let words = <Three<Coordinate>>::words();
                let message = format!(
                    "`light`: missing field `position`, expected {words}; only an ambient light has none"
                );
                return Err(Fault::new(self.kind.span, message));
            }
        };
        let light = Light {
            kind,
            color: self.color.value,
            intensity: self.intensity.value,
            gain: given_or(self.gain, 1.0),
            on: self.on.unwrap_or(true),
        };
        Ok((Name(self.name.value), standing_at(position), light))
    }

    fn of((name, transform, light): LightRecord) -> Self {
        LightTable {
            name: key(name.0),
            kind: key(light.kind),
            color: key(light.color),
            intensity: key(light.intensity),
            gain: Some(key(light.gain)),
            position: (light.kind != LightKind::Ambient).then(|| key(transform.position)),
            on: Some(light.on),
        }
    }
}

impl CameraTable {
    fn record(self) -> Result<CameraRecord, Fault> {
        let (position, target) = (self.position.value, self.target.value);
        let wrong = |name: &str, Key { value, span }: Key<Three<Coordinate>>, expected: &str| {
            let message = format!(
                "`camera.{name}`: invalid value: `{:?}`, expected {expected}",
                value.to_array()
            );
            Err(Fault::new(span, message))
        };
        let view = target - position;
        // The default near plane, a thousandth of this distance, must not underflow.
        if length(view) < 1e-100 {
            let expected = "a point at least 1e-100 away from `camera.position`";
            return wrong("target", self.target, expected);
        }
        let parallel = |up: DVec3| unit(up).cross(unit(view)).length() < PARALLEL;
        let up = match self.up {
            Some(up) if parallel(up.value) => {
                let expected =
                    "a direction that is neither zero nor parallel to the view, target - position";
                return wrong("up", up, expected);
            }
            Some(up) => up.value,
            None if parallel(DVec3::Y) => {
                let expected = "a point off the vertical through `camera.position`, as `camera.up` is left out";
                return wrong("target", self.target, expected);
            }
            None => DVec3::Y,
        };
        let camera = Camera {
            target,
            up,
            fov: self.fov.value,
            height: self.height.value,
            near: self.near.map(|near| near.value),
        };
        Ok((Name(self.name.value), standing_at(position), camera))
    }

    fn of((name, transform, camera): CameraRecord) -> Self {
        CameraTable {
            name: key(name.0),
            position: key(transform.position),
            target: key(camera.target),
            up: Some(key(camera.up)),
            fov: key(camera.fov),
            height: key(camera.height),
            near: camera.near.map(key),
        }
    }
}

fn standing_at(position: DVec3) -> Transform {
    Transform {
        position,
        rotation: DVec3::ZERO,
    }
}
