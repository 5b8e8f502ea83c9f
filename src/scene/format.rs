//! A scene's text in, its components out: the keys of the format, what each allows, and what it is when left out.
//!
//! Rule: this is the whole format; what is not named here is refused.

use glam::DVec3;
use toml::de::DeTable;

use super::error::Fault;
use super::section::{Choice, NameForm, Number, Section, Switch, Three};
use super::{CameraRecord, CuboidRecord, LightRecord, Records};
use crate::components::{
    Camera, Light, LightKind, Material, Mesh, Name, ShadingMode, Transform, length, unit,
};

/// Levels of the display.
const LEVEL: Number = Number {
    words: "from 0 to 255",
    range: 0.0..=255.0,
};
/// World units.
const LENGTH: Number = Number {
    words: "from 1e-100 to 1e100",
    range: 1e-100..=1e100,
};
/// World units.
const COORDINATE: Number = Number {
    words: "from -1e100 to 1e100",
    range: -1e100..=1e100,
};
/// Degrees, any number of turns.
const ANGLE: Number = Number {
    words: "finite (degrees)",
    range: f64::MIN..=f64::MAX,
};
/// Coefficients, colours, intensities and gains.
const STRENGTH: Number = Number {
    words: "from 0 to 1e30",
    range: 0.0..=1e30,
};
/// The exponent rho.
const SHININESS: Number = Number {
    words: "from 0 to 1e6",
    range: 0.0..=1e6,
};
/// Degrees; the lower bound is the smallest number above 0.
const FIELD_OF_VIEW: Number = Number {
    words: "above 0 and at most 179 (degrees)",
    range: 5e-324..=179.0,
};

const NAME: NameForm = NameForm {
    words: "a name that is not empty",
    allowed: |name| !name.is_empty(),
};
/// As the command line can write it in its list of lights.
const LIGHT_NAME: NameForm = NameForm {
    words: "a name that is not empty, holds no comma and is not \"all\" or \"none\"",
    allowed: |name| !name.is_empty() && !name.contains(',') && name != "all" && name != "none",
};
const SHADING: Choice<ShadingMode> = Choice(&[
    (ShadingMode::Gouraud.name(), ShadingMode::Gouraud),
    (ShadingMode::Phong.name(), ShadingMode::Phong),
]);
const KIND: Choice<LightKind> = Choice(&[
    ("ambient", LightKind::Ambient),
    ("diffuse", LightKind::Diffuse),
    ("specular", LightKind::Specular),
]);

const SCENE_KEYS: [&str; 4] = ["background", "cuboid", "light", "camera"];
const CUBOID_KEYS: [&str; 6] = [
    "name", "size", "position", "rotation", "shading", "material",
];
const MATERIAL_KEYS: [&str; 4] = ["ambient", "diffuse", "specular", "shininess"];
const LIGHT_KEYS: [&str; 7] = [
    "name",
    "kind",
    "color",
    "intensity",
    "gain",
    "position",
    "on",
];
const CAMERA_KEYS: [&str; 7] = ["name", "position", "target", "up", "fov", "height", "near"];

/// An `up` is parallel to the view where the sine of the angle between them is smaller.
const PARALLEL: f64 = 1e-9;

/// What the text describes.
pub fn read(text: &str) -> Result<Records, Fault> {
    let document = DeTable::parse(text).map_err(|error| Fault::syntax(text, &error))?;
    let scene = Section::top(text, document.get_ref(), &SCENE_KEYS)?;
    let background = scene.optional("background", &Three(&LEVEL))?;
    let cuboids = scene.named("cuboid", 1, &NAME, &CUBOID_KEYS)?;
    let lights = scene.named("light", 0, &LIGHT_NAME, &LIGHT_KEYS)?;
    let cameras = scene.named("camera", 1, &NAME, &CAMERA_KEYS)?;
    Ok(Records {
        background: background.unwrap_or(DVec3::ZERO),
        cuboids: cuboids.into_iter().map(cuboid).collect::<Result<_, _>>()?,
        lights: lights.into_iter().map(light).collect::<Result<_, _>>()?,
        cameras: cameras.into_iter().map(camera).collect::<Result<_, _>>()?,
    })
}

fn cuboid((name, section): (Name, Section)) -> Result<CuboidRecord, Fault> {
    let size = section.required("size", &Three(&LENGTH))?;
    let position = section.optional("position", &Three(&COORDINATE))?;
    let rotation = section.optional("rotation", &Three(&ANGLE))?;
    let shading = section.optional("shading", &SHADING)?;
    let material = material(&section.section("material", &MATERIAL_KEYS)?)?;
    let transform = Transform {
        position: position.unwrap_or(DVec3::ZERO),
        rotation: rotation.unwrap_or(DVec3::ZERO),
    };
    let shading = shading.unwrap_or(ShadingMode::Gouraud);
    Ok((name, transform, Mesh::cuboid(size), material, shading))
}

fn material(section: &Section) -> Result<Material, Fault> {
    Ok(Material {
        ambient: section.required("ambient", &Three(&STRENGTH))?,
        diffuse: section.required("diffuse", &Three(&STRENGTH))?,
        specular: section.required("specular", &Three(&STRENGTH))?,
        shininess: section.required("shininess", &SHININESS)?,
    })
}

fn light((name, section): (Name, Section)) -> Result<LightRecord, Fault> {
    let kind = section.required("kind", &KIND)?;
    let position = if kind == LightKind::Ambient {
        section.absent("position", "an ambient light, which is everywhere alike")?;
        DVec3::ZERO
    } else {
        section.required("position", &Three(&COORDINATE))?
    };
    let light = Light {
        kind,
        color: section.required("color", &Three(&STRENGTH))?,
        intensity: section.required("intensity", &STRENGTH)?,
        gain: section.optional("gain", &STRENGTH)?.unwrap_or(1.0),
        on: section.optional("on", &Switch)?.unwrap_or(true),
    };
    Ok((name, standing_at(position), light))
}

fn camera((name, section): (Name, Section)) -> Result<CameraRecord, Fault> {
    let position = section.required("position", &Three(&COORDINATE))?;
    let target = section.required("target", &Three(&COORDINATE))?;
    let up = section.optional("up", &Three(&COORDINATE))?;
    let view = target - position;
    // The default near plane, a thousandth of this distance, must not underflow.
    if length(view) < *LENGTH.range.start() {
        return Err(section.wrong("target", "at least 1e-100 away from `camera.position`"));
    }
    let parallel = |up: DVec3| unit(up).cross(unit(view)).length() < PARALLEL;
    if up.is_some_and(parallel) {
        return Err(section.wrong(
            "up",
            "neither zero nor parallel to the view, target - position",
        ));
    }
    if up.is_none() && parallel(DVec3::Y) {
        let words = "off the vertical through `camera.position`, as `camera.up` is left out";
        return Err(section.wrong("target", words));
    }
    let camera = Camera {
        target,
        up: up.unwrap_or(DVec3::Y),
        fov: section.required("fov", &FIELD_OF_VIEW)?,
        height: section.required("height", &LENGTH)?,
        near: section.optional("near", &LENGTH)?,
    };
    Ok((name, standing_at(position), camera))
}

fn standing_at(position: DVec3) -> Transform {
    Transform {
        position,
        rotation: DVec3::ZERO,
    }
}
