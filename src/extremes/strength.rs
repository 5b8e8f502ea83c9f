//! Exponents, intensities and coefficients, from nothing to more than a float holds.

use glam::DVec3;

use super::Case;
use super::judge::{Fact, known, proven, same_picture};
use super::scene_spec::{SceneSpec, default_cuboid, light, lights_at, scene};
use crate::components::LightKind;
use crate::shading::EXACT;

/// Every strength in the format's largest.
const MAX: f64 = 1e30;

/// The cases.
pub fn cases() -> Vec<Case> {
    let overflowing = sending(MAX, MAX, MAX);
    let shining = default_cuboid().reflecting(MAX).shininess(1e6);
    let without_ambient = overflowing.lights[..2].to_vec();
    vec![
        proven(
            "shininess 0, 5e-324, 1e-3, 1, 76.8, 1000, 1e6",
            [0.0, 5e-324, 1e-3, 1.0, 76.8, 1e3, 1e6].map(|shininess| mirroring(shininess, 255.0)),
        ),
        proven(
            "shininess 1e6 under a highlight of 1e5 levels",
            [1e6, 1e3].map(|shininess| mirroring(shininess, 1e5)),
        ),
        known(
            "intensity 0",
            "ambient light alone, without a power evaluated",
            Fact::Unlit(30.0),
            [with_intensity(0.0)],
        ),
        known(
            "intensity 1e-38, and less than a float holds",
            "ambient light alone",
            Fact::Everywhere(30.0),
            [1e-38, 1e-300].map(with_intensity),
        ),
        proven(
            "intensity 1e30",
            [sending(MAX, 1.0, 1.0), sending(MAX, MAX, 1.0)],
        ),
        proven(
            "one corner of a face under 1e9, 1e14, 1e18 and 1e29 levels",
            [1e9, 1e14, 1e18, 1e29].into_iter().flat_map(corner_lit),
        ),
        proven(
            "sums of 1e120 levels, more than a float holds",
            [
                overflowing.clone(),
                overflowing.clone().cuboid(shining),
                overflowing.lights(without_ambient),
            ],
        ),
        proven(
            "one channel of 1e90 levels beside one of 1e-90",
            [scene().with_lights(|light| {
                if light.kind != LightKind::Ambient {
                    light.color = DVec3::new(MAX, 1.0, 1e-90);
                    light.gain = MAX;
                    light.intensity = 1e-28;
                }
            })],
        ),
        same_picture(
            "a light of 1e30 on a material of 1e-30",
            EXACT,
            [1.0, 1e-28, 1e-30].map(|share| {
                let scene = scene().with_lights(|light| light.gain = 1.0 / share);
                scene.cuboid(default_cuboid().reflecting(share))
            }),
        ),
        known(
            "no light at all",
            "0 levels, without a power evaluated",
            Fact::Unlit(0.0),
            [scene().lights([])],
        ),
        known(
            "a black material",
            "0 levels",
            Fact::Everywhere(0.0),
            [scene().cuboid(default_cuboid().reflecting(0.0).shininess(1.0))],
        ),
    ]
}

/// A point of the default cuboid's face z = 1.
pub const MIRRORING: DVec3 = DVec3::new(1.1, 0.7, 1.0);

/// A cuboid whose highlight of so many levels is in the picture, in the mirror direction of [`MIRRORING`].
pub fn mirroring(shininess: f64, levels: f64) -> SceneSpec {
    let normal = (MIRRORING / DVec3::new(2.0, 1.5, 1.0)).normalize();
    let to_eye = (scene().camera.position - MIRRORING).normalize();
    let mirrored = 2.0 * normal.dot(to_eye) * normal - to_eye;
    let place = MIRRORING + 9.0 * mirrored;
    let mut lights = lights_at([10.0; 3]);
    lights.push(light(LightKind::Specular, levels, place));
    let cuboid = default_cuboid().shininess(shininess);
    scene().cuboid(cuboid).lights(lights)
}

/// The default scene, its diffuse and specular light of this intensity.
pub fn with_intensity(intensity: f64) -> SceneSpec {
    scene().with_lights(|light| {
        if light.kind != LightKind::Ambient {
            light.intensity = intensity;
        }
    })
}

/// The default scene with a light of so many levels beside each corner of the face z = 1 in turn, which lights no other.
fn corner_lit(levels: f64) -> [SceneSpec; 4] {
    [(2.1, 1.6), (2.1, -1.6), (-2.1, 1.6), (-2.1, -1.6)].map(|(x, y)| {
        let mut lights = lights_at([10.0; 3]);
        lights.push(light(LightKind::Diffuse, levels, [x, y, 1.1]));
        scene().lights(lights).eye([3.0, 2.0, 9.0])
    })
}

/// The default scene with lights and material of these strengths.
fn sending(intensity: f64, gain: f64, coefficient: f64) -> SceneSpec {
    let scene = scene().with_lights(|light| {
        light.intensity = intensity;
        light.gain = gain;
    });
    scene.cuboid(default_cuboid().reflecting(coefficient))
}
