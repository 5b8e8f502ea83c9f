//! A number of a scene in, the scenes of its whole range out.
//!
//! Rule: one number varies. Where it would take the cuboid out of the picture, the camera follows.

use glam::DVec3;

use crate::extremes::crowd::{spread, under_many_lights};
use crate::extremes::scene_spec::{SceneSpec, lights_at, scene};
use crate::extremes::{shape, strength};

/// Decades above which there is one value a decade instead of three.
const MANY_DECADES: f64 = 24.0;

const SIZE: [usize; 2] = [64, 48];

/// A number and its range.
pub struct Sweep {
    pub number: &'static str,
    /// Empty where it has none.
    pub unit: &'static str,
    pub range: [f64; 2],
    /// Whether only whole numbers make sense.
    pub is_whole: bool,
    pub(super) scene: fn(f64) -> SceneSpec,
}

const fn sweep(
    number: &'static str,
    unit: &'static str,
    range: [f64; 2],
    scene: fn(f64) -> SceneSpec,
) -> Sweep {
    Sweep {
        number,
        unit,
        range,
        is_whole: false,
        scene,
    }
}

/// Every number that is swept.
pub const SWEEPS: &[Sweep] = &[
    // A highlight is as wide as 1 / sqrt(shininess).
    sweep("shininess", "", [1e-3, 1e6], |shininess| {
        let fov = scene().camera.fov / shininess.sqrt().max(1.0);
        let scene = strength::mirroring(shininess, 255.0).size(SIZE);
        scene.target(strength::MIRRORING).fov(fov)
    }),
    // Lights and eye follow; the longest edge is 4 units long.
    sweep("edge length", "units", [1e-97, 1e97], |edge| {
        scene().size(SIZE).scaled(edge / 4.0)
    }),
    sweep(
        "aspect of a face",
        "times as long as wide",
        [1.0, 1e100],
        |aspect| shape::long(aspect)[0].clone().size(SIZE),
    ),
    sweep("distance from the origin", "units", [1.0, 1e15], |far| {
        let shift = DVec3::new(far, -0.5 * far, 0.25 * far);
        scene().size(SIZE).moved(shift)
    }),
    // From above and aside, the lens as narrow as keeps the cuboid in the picture.
    sweep("distance of the eye", "units", [1e-9, 1e15], |distance| {
        let target = DVec3::new(0.1, 0.2, 1.0);
        let eye = target + DVec3::new(0.48, 0.36, 0.8) * distance;
        let fov = 2.0 * (3.0 / distance).atan().to_degrees().min(30.0);
        scene().size(SIZE).target(target).eye(eye).fov(fov)
    }),
    // From near by.
    sweep(
        "height of a light over a face",
        "units",
        [f64::EPSILON, 1e6],
        |height| {
            let target = DVec3::new(0.3, 0.4, 1.0);
            let eye = target + DVec3::new(1.0, 0.9, 2.0);
            let lights = lights_at(target + DVec3::Z * height);
            scene().size(SIZE).target(target).eye(eye).lights(lights)
        },
    ),
    sweep("field of view", "degrees", [1e-9, 179.0], |fov| {
        let scene = scene().size(SIZE).eye([0.1, 0.2, 1.01]);
        scene.target([0.4, 0.3, 0.0]).fov(fov)
    }),
    sweep("intensity", "levels", [1e-30, 1e30], |intensity| {
        strength::with_intensity(intensity).size(SIZE)
    }),
    Sweep {
        is_whole: true,
        ..sweep("number of lights", "of each kind", [1.0, 1e3], |count| {
            under_many_lights(count as u32, spread)
        })
    },
];

impl Sweep {
    /// From the one end to the other, in even steps of the logarithm.
    pub fn values(&self) -> Vec<f64> {
        let [from, to] = self.range.map(f64::log10);
        let a_decade = if to - from > MANY_DECADES { 1.0 } else { 3.0 };
        let steps = ((to - from) * a_decade).ceil();
        let values = (0..=steps as u32).map(|step| {
            let share = f64::from(step) / steps;
            // The ends as they are written.
            let value = match share {
                0.0 => self.range[0],
                1.0 => self.range[1],
                _ => 10.0_f64.powf(from + (to - from) * share),
            };
            if self.is_whole { value.round() } else { value }
        });
        values.collect()
    }
}
