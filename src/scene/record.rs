//! A scene written down: the tables of its file, and the one form in which a [`World`](hecs::World) is saved, compared and
//! copied.
//!
//! These tables are the whole format; what is not named here is refused. Optional keys have their defaults in the record, so
//! that two records are equal where their scenes are.

use std::ops::Range;

use glam::DVec3;
use serde::{Deserialize, Deserializer, Serialize};

use super::error::told;
use crate::components::form::{array, number, some_three, table, tables, three};
use crate::components::{
    LightKind, Magnifier, Material, Orbit, Projection, ShadingMode, Show, Side, Tab, Tolerance,
    ViewMode,
};

/// The material of the built-in default scene.
const EMERALD: Material = Material {
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
    pub material: Material,
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
    #[serde(deserialize_with = "table")]
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

impl SceneRecord {
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
    ///
    /// # Errors
    /// The bytes of the text that are wrong, and why they are.
    pub(super) fn read(text: &str) -> Result<Self, (Range<usize>, String)> {
        let mut record: SceneRecord = toml::from_str(text).map_err(told)?;
        record
            .check()
            .map_err(|mistake| (mistake.span(text), mistake.to_string()))?;
        if record.active_camera() == Some(0) {
            record.view.camera = None;
        }
        Ok(record)
    }
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
            material: EMERALD,
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
}
