//! Exponents, intensities and coefficients, from nothing to more than a float holds.

use glam::DVec3;

use super::bench::{Bench, Trouble, enough, ways, wrong};
use super::setting::{Lamp, Setting};
use super::{Case, Rule};
use crate::components::{LightKind, Material};
use crate::frame::NO_TRIANGLE;
use crate::shading::EXACT;

/// Every strength in the format's largest.
const MOST: f64 = 1e30;

/// The cases.
pub const CASES: &[Case] = &[
    Case {
        name: "shininess 0, 5e-324, 1e-3, 1, 76.8, 1000, 1e6",
        rule: Rule::Proven(|| {
            [0.0, 5e-324, 1e-3, 1.0, 76.8, 1e3, 1e6]
                .map(|shininess| mirroring(shininess, 255.0))
                .into()
        }),
    },
    Case {
        name: "shininess 1e6 under a highlight of 1e5 levels",
        rule: Rule::Proven(|| vec![mirroring(1e6, 1e5), mirroring(1e3, 1e5)]),
    },
    Case {
        name: "intensity 0",
        rule: Rule::Own("ambient light alone, without a power evaluated", |bench| {
            ambient_alone(bench, 0.0)
        }),
    },
    Case {
        name: "intensity 1e-38, and less than a float holds",
        rule: Rule::Own("ambient light alone", |bench| {
            ambient_alone(bench, 1e-38)?;
            ambient_alone(bench, 1e-300)
        }),
    },
    Case {
        name: "intensity 1e30",
        rule: Rule::Proven(|| vec![sending(MOST, 1.0, 1.0), sending(MOST, MOST, 1.0)]),
    },
    Case {
        name: "sums of 1e120 levels, more than a float holds",
        rule: Rule::Proven(|| {
            vec![
                sending(MOST, MOST, MOST),
                sending(MOST, MOST, MOST)
                    .and(|setting| setting.cuboids[0].material.shininess = 1e6),
                sending(MOST, MOST, MOST).and(|setting| setting.lights.truncate(2)),
            ]
        }),
    },
    Case {
        name: "one channel of 1e90 levels beside one of 1e-90",
        rule: Rule::Proven(|| {
            vec![Setting::with(|setting| {
                for light in &mut setting.lights[..2] {
                    light.color = DVec3::new(MOST, 1.0, 1e-90);
                    light.gain = MOST;
                    light.intensity = 1e-28;
                }
            })]
        }),
    },
    Case {
        name: "a light of 1e30 on a material of 1e-30",
        rule: Rule::SamePicture(EXACT, || {
            let split = |share: f64| {
                Setting::with(|setting| {
                    for light in &mut setting.lights {
                        light.gain = 1.0 / share;
                    }
                    let material = &mut setting.cuboids[0].material;
                    material.ambient *= share;
                    material.diffuse *= share;
                    material.specular *= share;
                })
            };
            vec![split(1.0), split(1e-28), split(1e-30)]
        }),
    },
    Case {
        name: "no light at all",
        rule: Rule::Own("0 levels, without a power evaluated", |bench| {
            flat(bench, &Setting::with(|setting| setting.lights.clear()), 0.0)
        }),
    },
    Case {
        name: "a black material",
        rule: Rule::Own("0 levels", |bench| {
            let black = Setting::with(|setting| {
                setting.cuboids[0].material = Material {
                    ambient: DVec3::ZERO,
                    diffuse: DVec3::ZERO,
                    specular: DVec3::ZERO,
                    shininess: 1.0,
                };
            });
            flat(bench, &black, 0.0)
        }),
    },
];

/// A point of the default cuboid's face z = 1.
pub const MIRRORING: DVec3 = DVec3::new(1.1, 0.7, 1.0);

/// A cuboid whose highlight of so many levels is in the picture, in the mirror direction of [`MIRRORING`].
pub fn mirroring(shininess: f64, levels: f64) -> Setting {
    Setting::with(|setting| {
        setting.cuboids[0].material.shininess = shininess;
        let point = MIRRORING;
        let normal = (point / DVec3::new(2.0, 1.5, 1.0)).normalize();
        let to_eye = (setting.eye - point).normalize();
        let mirrored = 2.0 * normal.dot(to_eye) * normal - to_eye;
        setting.lights.push(Lamp::new(
            LightKind::Specular,
            levels,
            point + 9.0 * mirrored,
        ));
    })
}

/// The default setting with lights and material of these strengths.
fn sending(intensity: f64, gain: f64, coefficient: f64) -> Setting {
    Setting::with(|setting| {
        for light in &mut setting.lights {
            light.intensity = intensity;
            light.gain = gain;
        }
        let material = &mut setting.cuboids[0].material;
        material.ambient *= coefficient;
        material.diffuse *= coefficient;
        material.specular *= coefficient;
    })
}

/// Only the ambient light of 100 levels keeps its strength.
fn ambient_alone(bench: &mut Bench, intensity: f64) -> Result<String, Trouble> {
    let setting = Setting::with(|setting| {
        for light in &mut setting.lights[..2] {
            light.intensity = intensity;
        }
    });
    flat(bench, &setting, 30.0)
}

/// Asserts that all that is seen of a setting has these levels, and that lights that send nothing cost nothing.
fn flat(bench: &mut Bench, setting: &Setting, levels: f64) -> Result<String, Trouble> {
    let mut scene = setting.scene()?;
    let dark = setting
        .lights
        .iter()
        .all(|light| light.kind == LightKind::Ambient || light.intensity == 0.0);
    let mut seen = 0;
    for way in ways() {
        let view = setting.view(&scene, way);
        let frame = bench.draw(&mut scene, &view)?;
        let mut pixels = frame.triangles().iter().zip(frame.levels()).enumerate();
        let other = pixels.find(|(_, (id, found))| {
            **id != NO_TRIANGLE
                && found
                    .iter()
                    .any(|level| (f64::from(*level) - levels).abs() > 1e-4)
        });
        if let Some((pixel, (_, found))) = other {
            let place = [pixel % view.size[0], pixel / view.size[0]];
            return Err(wrong(&view, place, &format!("has {found:?} levels")));
        }
        if dark && frame.counts().specular_evaluations > 0 {
            return Err(Trouble::Wrong("powers are evaluated".to_owned()));
        }
        seen += frame.counts().covered_pixels;
    }
    enough(seen)?;
    Ok(format!("{levels} levels at all of {seen} pixels"))
}
