//! A number of a scene in, the scenes of its whole range out.
//!
//! Rule: one number varies. Where it would take the cuboid out of the picture, the camera follows.

use glam::DVec3;

use crate::extremes::crowd::under_many_lights;
use crate::extremes::setting::{Setting, lights_at};
use crate::extremes::{shape, strength};

/// Decades above which there is one value a decade instead of three.
const MANY_DECADES: f64 = 24.0;

/// A number and its range.
pub struct Sweep {
    pub number: &'static str,
    /// Empty where it has none.
    pub unit: &'static str,
    pub range: [f64; 2],
    /// Whether only whole numbers make sense.
    pub is_whole: bool,
    pub setting: fn(f64) -> Setting,
}

/// Every number that is swept.
pub const SWEEPS: &[Sweep] = &[
    Sweep {
        number: "shininess",
        unit: "",
        range: [1e-3, 1e6],
        is_whole: false,
        // A highlight is as wide as 1 / sqrt(shininess).
        setting: |shininess| {
            small(strength::mirroring(shininess, 255.0)).and(|setting| {
                setting.target = strength::MIRRORING;
                setting.fov /= shininess.sqrt().max(1.0);
            })
        },
    },
    Sweep {
        number: "edge length",
        unit: "units",
        range: [1e-97, 1e97],
        is_whole: false,
        // Lights and eye follow; the longest edge is 4 units long.
        setting: |edge| small(Setting::default().scaled(edge / 4.0)),
    },
    Sweep {
        number: "aspect of a face",
        unit: "times as long as wide",
        range: [1.0, 1e100],
        is_whole: false,
        setting: |aspect| small(shape::long(aspect).swap_remove(0)),
    },
    Sweep {
        number: "distance from the origin",
        unit: "units",
        range: [1.0, 1e15],
        is_whole: false,
        setting: |far| small(Setting::default().moved(DVec3::new(far, -0.5 * far, 0.25 * far))),
    },
    Sweep {
        number: "distance of the eye",
        unit: "units",
        range: [1e-9, 1e15],
        is_whole: false,
        setting: |distance| small(seen_from(distance)),
    },
    Sweep {
        number: "height of a light over a face",
        unit: "units",
        range: [f64::EPSILON, 1e6],
        is_whole: false,
        setting: |height| small(lit_from_above(height)),
    },
    Sweep {
        number: "field of view",
        unit: "degrees",
        range: [1e-9, 179.0],
        is_whole: false,
        setting: |fov| {
            small(Setting::with(|setting| {
                setting.eye = DVec3::new(0.1, 0.2, 1.01);
                setting.target = DVec3::new(0.4, 0.3, 0.0);
                setting.fov = fov;
            }))
        },
    },
    Sweep {
        number: "intensity",
        unit: "levels",
        range: [1e-30, 1e30],
        is_whole: false,
        setting: |intensity| {
            small(Setting::with(|setting| {
                for light in &mut setting.lights[..2] {
                    light.intensity = intensity;
                }
            }))
        },
    },
    Sweep {
        number: "number of lights",
        unit: "of each kind",
        range: [1.0, 1e3],
        is_whole: true,
        setting: |count| {
            under_many_lights(count as u32, |index| {
                let step = f64::from(index);
                DVec3::new(step % 7.0 - 3.0, step % 5.0 + 2.0, step % 11.0 - 1.0) * 1.7
            })
        },
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

fn small(setting: Setting) -> Setting {
    setting.and(|setting| setting.size = [64, 48])
}

/// A point of the face z = 1, from above and aside, the lens as narrow as keeps the cuboid in the picture.
fn seen_from(distance: f64) -> Setting {
    Setting::with(|setting| {
        setting.target = DVec3::new(0.1, 0.2, 1.0);
        setting.eye = setting.target + DVec3::new(0.48, 0.36, 0.8) * distance;
        setting.fov = 2.0 * (3.0 / distance).atan().to_degrees().min(30.0);
    })
}

/// Lights over a point of the face z = 1, from near by.
fn lit_from_above(height: f64) -> Setting {
    Setting::with(|setting| {
        setting.target = DVec3::new(0.3, 0.4, 1.0);
        setting.lights = lights_at(setting.target + DVec3::Z * height);
        setting.eye = setting.target + DVec3::new(1.0, 0.9, 2.0);
    })
}
