//! The numbers that are swept, each over many powers of ten.
//!
//! One number varies. Where that would take the cuboid out of the picture, the camera follows.

use glam::DVec3;

use crate::scene::{LightRecord, Scene, SceneRecord};

/// A range of more decades has one value for each of them instead of three.
const MANY_DECADES: f64 = 24.0;

/// A number and its range.
pub struct Sweep {
    pub number: &'static str,
    /// Empty if it has none.
    pub unit: &'static str,
    range: [f64; 2],
    set: fn(&mut SceneRecord, f64),
}

/// Over these ranges f32 or f64 does not always keep the tolerance.
pub const SWEEPS: &[Sweep] = &[
    Sweep {
        number: "shininess",
        unit: "",
        range: [1e-3, 1e6],
        set: set_shininess,
    },
    Sweep {
        number: "edge length",
        unit: "units",
        range: [1e-97, 1e97],
        set: set_edge,
    },
    Sweep {
        number: "distance from the origin",
        unit: "units",
        range: [1.0, 1e15],
        set: move_from_origin,
    },
    Sweep {
        number: "distance of the eye",
        unit: "units",
        range: [1e-9, 1e15],
        set: move_eye,
    },
];

impl Sweep {
    /// The values from one end to the other, in even steps of the logarithm. The ends are exact.
    pub fn values(&self) -> Vec<f64> {
        let [first, last] = self.range;
        let [from, to] = self.range.map(f64::log10);
        let a_decade = if to - from > MANY_DECADES { 1.0 } else { 3.0 };
        let steps = ((to - from) * a_decade).ceil();
        let between = (1..steps as u32).map(|step| {
            let share = f64::from(step) / steps;
            10.0_f64.powf(from + (to - from) * share)
        });
        [first].into_iter().chain(between).chain([last]).collect()
    }

    /// The swept scene with this value of the number.
    ///
    /// # Errors
    /// If the scene, which is built in, is wrong.
    pub fn scene(&self, value: f64) -> anyhow::Result<SceneRecord> {
        let text = include_str!("../../../assets/stability/scene.toml");
        let mut scene = SceneRecord::of(&Scene::parse("the swept scene", text)?.world);
        (self.set)(&mut scene, value);
        Ok(scene)
    }
}

/// Moves the cuboid, the lights and the camera.
fn change_places(scene: &mut SceneRecord, change: impl Fn(DVec3) -> DVec3) {
    let lights = scene.light.iter_mut();
    let camera = &mut scene.camera[0];
    let others = [
        &mut scene.cuboid[0].position,
        &mut camera.position,
        &mut camera.target,
    ];
    for place in lights.filter_map(|it| it.position.as_mut()).chain(others) {
        *place = change(*place);
    }
}

/// Adds a light with its mirror image in the face z = 1, and looks at its highlight, which is 1 / sqrt(shininess) wide.
fn set_shininess(scene: &mut SceneRecord, shininess: f64) {
    scene.cuboid[0].material.shininess = shininess;
    let camera = &mut scene.camera[0];
    let point = DVec3::new(1.1, 0.7, 1.0);
    let normal = (point / DVec3::new(2.0, 1.5, 1.0)).normalize();
    let to_eye = (camera.position - point).normalize();
    let place = point + 9.0 * (2.0 * normal.dot(to_eye) * normal - to_eye);
    let specular = scene.light[1].clone();
    scene.light.push(LightRecord {
        name: "mirrored".to_owned(),
        position: Some(place),
        ..specular
    });
    camera.target = point;
    camera.fov /= shininess.sqrt().max(1.0);
}

/// Lights and eye follow. The longest edge is 4 units long.
fn set_edge(scene: &mut SceneRecord, edge: f64) {
    scene.cuboid[0].size *= edge / 4.0;
    scene.camera[0].height *= edge / 4.0;
    change_places(scene, |place| place * (edge / 4.0));
}

fn move_from_origin(scene: &mut SceneRecord, far: f64) {
    let shift = DVec3::new(far, -0.5 * far, 0.25 * far);
    change_places(scene, |place| place + shift);
}

/// The farther the eye, the narrower the lens.
fn move_eye(scene: &mut SceneRecord, distance: f64) {
    let camera = &mut scene.camera[0];
    camera.target = DVec3::new(0.1, 0.2, 1.0);
    camera.position = camera.target + DVec3::new(0.48, 0.36, 0.8) * distance;
    camera.fov = 2.0 * (3.0 / distance).atan().to_degrees().min(30.0);
}
