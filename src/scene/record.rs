//! The tables of a scene file. A [`World`](hecs::World) is saved, compared and copied as a record.
//!
//! These tables are the whole format; other keys are errors. Optional keys have their defaults in the record, so that equal
//! scenes have equal records.

use glam::DVec3;
use serde::{Deserialize, Serialize};
use toml::Value;

use super::read::{Mistake, from_value, has, read};
use crate::components::numbers::{some_three, three};
use crate::components::{LightKind, Material, NormalMode, Orbit, Segments, ShadingMode, Viewer};

/// The whole file, in its order.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub struct SceneRecord {
    #[serde(default, deserialize_with = "three")]
    pub background: DVec3,
    /// One or more.
    pub cuboid: Vec<CuboidRecord>,
    #[serde(default)]
    pub light: Vec<LightRecord>,
    /// One or more.
    pub camera: Vec<CameraRecord>,
    #[serde(default)]
    pub view: Viewer,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
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
    #[serde(default)]
    pub normals: NormalMode,
    #[serde(default)]
    pub segments: Segments,
    pub material: Material,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub struct LightRecord {
    pub name: String,
    pub kind: LightKind,
    #[serde(deserialize_with = "three")]
    pub color: DVec3,
    pub intensity: f64,
    #[serde(default = "one")]
    pub gain: f64,
    /// `None` for an ambient light.
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
#[serde(deny_unknown_fields, expecting = "a table")]
pub struct CameraRecord {
    pub name: String,
    #[serde(deserialize_with = "three")]
    pub position: DVec3,
    #[serde(deserialize_with = "three")]
    pub target: DVec3,
    #[serde(default = "y", deserialize_with = "three")]
    pub up: DVec3,
    pub fov: f64,
    pub height: f64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub near: Option<f64>,
    #[serde(default)]
    pub orbit: Orbit,
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

impl SceneRecord {
    /// The active camera; `None` if there is no camera of that name.
    pub(super) fn active_camera(&self) -> Option<&CameraRecord> {
        let mut cameras = self.camera.iter();
        match &self.view.camera {
            None => cameras.next(),
            Some(name) => cameras.find(|camera| camera.name == *name),
        }
    }

    /// Removes all cameras of a checked record but the active one.
    pub(crate) fn keep_active_camera(&mut self) {
        self.camera = self.active_camera().into_iter().cloned().collect();
        self.view.camera = None;
    }

    /// Reads and checks a record as TOML.
    ///
    /// # Errors
    /// The first mistake.
    pub fn from_tree(tree: Value) -> Result<Self, Mistake> {
        let record: SceneRecord = from_value(tree)?;
        record.check()?;
        Ok(record)
    }

    /// Reads and checks a text. Errors carry `name`.
    ///
    /// # Errors
    /// The first mistake, with its place.
    pub(super) fn read(name: &str, text: &str) -> anyhow::Result<Self> {
        let record: SceneRecord = read(name, text)?;
        let located = |mistake: Mistake| mistake.located(name, text);
        // serde does not say whether the tolerance is in the text.
        if record.view.budget.is_some() && has(text, "view", "tolerance") {
            let why = "beside a tolerance, expected one of the two";
            return Err(located(Mistake::new("view.budget", why)));
        }
        record.check().map_err(located)?;
        Ok(record)
    }
}
