//! Records of a cuboid, a light and a camera: those of the built-in scene with other places and sizes.

use std::sync::LazyLock;

use shadetrade::scene::{CameraRecord, CuboidRecord, LightRecord};

use super::prelude::*;

static BUILT_IN: LazyLock<SceneRecord> =
    LazyLock::new(|| SceneRecord::of(&Scene::load(None).expect("it is built in").world));

/// An emerald, not rotated, with Phong shading.
pub fn cuboid(
    name: impl Into<String>,
    size: impl Into<DVec3>,
    position: impl Into<DVec3>,
) -> CuboidRecord {
    CuboidRecord {
        name: name.into(),
        size: size.into(),
        position: position.into(),
        shading: ShadingMode::Phong,
        ..BUILT_IN.cuboid[0].clone()
    }
}

/// A white light of these levels; an ambient light has no position.
pub fn light(
    name: impl Into<String>,
    kind: LightKind,
    levels: f64,
    position: impl Into<DVec3>,
) -> LightRecord {
    LightRecord {
        name: name.into(),
        kind,
        intensity: levels,
        gain: 1.0,
        position: (kind != LightKind::Ambient).then(|| position.into()),
        ..BUILT_IN.light[0].clone()
    }
}

/// A camera with +y up that sees `fov` degrees in perspective, `height` units in orthographic projection.
pub fn camera(
    name: impl Into<String>,
    position: impl Into<DVec3>,
    target: impl Into<DVec3>,
    [fov, height]: [f64; 2],
) -> CameraRecord {
    CameraRecord {
        name: name.into(),
        position: position.into(),
        target: target.into(),
        fov,
        height,
        ..BUILT_IN.camera[0].clone()
    }
}
