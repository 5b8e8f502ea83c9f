//! The numbers that are swept, each over its whole range.
//!
//! One number varies. Where that would take the cuboid out of the picture, the camera follows.

use glam::DVec3;

use crate::components::LightKind;
use crate::scene::{CameraRecord, CuboidRecord, LightRecord, SceneRecord};

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

const fn sweep(
    number: &'static str,
    unit: &'static str,
    range: [f64; 2],
    set: fn(&mut SceneRecord, f64),
) -> Sweep {
    Sweep {
        number,
        unit,
        range,
        set,
    }
}

/// Every number that is swept.
pub const SWEEPS: &[Sweep] = &[
    sweep("shininess", "", [1e-3, 1e6], set_shininess),
    sweep("edge length", "units", [1e-97, 1e97], set_edge),
    sweep(ASPECT, "times as long as wide", [1.0, 1e100], set_aspect),
    sweep(FROM_ORIGIN, "units", [1.0, 1e15], move_from_origin),
    sweep("distance of the eye", "units", [1e-9, 1e15], move_eye),
    sweep(OVER_A_FACE, "units", [f64::EPSILON, 1e6], set_light),
    sweep("field of view", "degrees", [1e-9, 179.0], set_lens),
    sweep("intensity", "levels", [1e-30, 1e30], set_intensity),
];
const ASPECT: &str = "aspect of a face";
const FROM_ORIGIN: &str = "distance from the origin";
const OVER_A_FACE: &str = "height of a light over a face";

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

    /// A cuboid under a white light of each kind, with the number set.
    pub fn scene(&self, value: f64) -> SceneRecord {
        let camera = CameraRecord::new("camera", [7.0, 5.0, 8.0], DVec3::ZERO, [30.0, 6.3]);
        let mut scene = SceneRecord {
            cuboid: vec![CuboidRecord::new("cuboid", [4.0, 3.0, 2.0], DVec3::ZERO)],
            light: lights_at(DVec3::splat(10.0)),
            camera: vec![camera],
            ..SceneRecord::default()
        };
        (self.set)(&mut scene, value);
        scene
    }
}

/// A light of every kind at one place, the ambient one last.
fn lights_at(place: DVec3) -> Vec<LightRecord> {
    vec![
        LightRecord::new("diffuse", LightKind::Diffuse, 170.0, place),
        LightRecord::new("specular", LightKind::Specular, 255.0, place),
        LightRecord::new("ambient", LightKind::Ambient, 100.0, place),
    ]
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
    let light = LightRecord::new("mirrored", LightKind::Specular, 255.0, place);
    scene.light.push(light);
    camera.target = point;
    camera.fov /= shininess.sqrt().max(1.0);
}

/// Lights and eye follow. The longest edge is 4 units long.
fn set_edge(scene: &mut SceneRecord, edge: f64) {
    scene.cuboid[0].size *= edge / 4.0;
    scene.camera[0].height *= edge / 4.0;
    change_places(scene, |place| place * (edge / 4.0));
}

fn set_aspect(scene: &mut SceneRecord, aspect: f64) {
    scene.cuboid[0].size = DVec3::new(aspect, 1.0, 1.0);
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

/// The eye is near the face.
fn set_light(scene: &mut SceneRecord, height: f64) {
    let target = DVec3::new(0.3, 0.4, 1.0);
    scene.camera[0].target = target;
    scene.camera[0].position = target + DVec3::new(1.0, 0.9, 2.0);
    scene.light = lights_at(target + DVec3::Z * height);
}

fn set_lens(scene: &mut SceneRecord, degrees: f64) {
    let camera = &mut scene.camera[0];
    camera.position = DVec3::new(0.1, 0.2, 1.01);
    camera.target = DVec3::new(0.4, 0.3, 0.0);
    camera.fov = degrees;
}

fn set_intensity(scene: &mut SceneRecord, intensity: f64) {
    for light in &mut scene.light[..2] {
        light.intensity = intensity;
    }
}
