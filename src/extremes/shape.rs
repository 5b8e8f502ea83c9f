//! How large things are, how far from the origin, and of what proportions.

use glam::DVec3;

use super::setting::{Body, Lamp, Setting, lights_at};
use super::{Case, Rule};
use crate::components::LightKind;

/// The cases.
pub const CASES: &[Case] = &[
    Case {
        name: "everything scaled by 2^-40 to 2^40",
        rule: Rule::SameBits(|| {
            let powers = (-40..=40).map(|power| still_life().scaled(2.0_f64.powi(power)));
            std::iter::once(still_life()).chain(powers).collect()
        }),
    },
    Case {
        name: "everything scaled by 2^-300 and 2^300",
        rule: Rule::SameBits(|| {
            [0, -300, 300]
                .map(|power| still_life().scaled(2.0_f64.powi(power)))
                .into()
        }),
    },
    Case {
        name: "everything scaled by 1e-30 and 1e30",
        rule: Rule::SamePicture(1.0, || {
            [1.0, 1e-30, 1e30]
                .map(|scale| still_life().scaled(scale))
                .into()
        }),
    },
    Case {
        name: "everything scaled to the ends of the format, 1e-98 and 1e98",
        rule: Rule::SamePicture(1.0, || {
            [1.0, 1e-98, 1e98]
                .map(|scale| still_life().scaled(scale))
                .into()
        }),
    },
    Case {
        name: "everything 1e3, 1e6, 1e9 and 1e12 from the origin",
        rule: Rule::SameBits(|| {
            [0.0, 1e3, -1e6, 1e9, -1e12]
                .map(|far| still_life().moved(DVec3::new(far, -0.5 * far, 0.25 * far)))
                .into()
        }),
    },
    Case {
        name: "everything 1e3, 1e6, 1e9 away in numbers that round",
        rule: Rule::SamePicture(1.0, || {
            let rounding = still_life().scaled(1.1);
            [0.0, 1e3, 1e6, 1e9]
                .map(|far| {
                    rounding
                        .clone()
                        .moved(DVec3::new(far, far / 3.0, -far / 7.0))
                })
                .into()
        }),
    },
    Case {
        name: "edges as 1 to 1e4",
        rule: Rule::Proven(|| long(1e4)),
    },
    Case {
        name: "edges as 1 to 1e6",
        rule: Rule::Proven(|| long(1e6)),
    },
    Case {
        name: "edges as 1 to 1e9",
        rule: Rule::Proven(|| long(1e9)),
    },
    Case {
        name: "edges as 1 to 1e12",
        rule: Rule::Proven(|| long(1e12)),
    },
    Case {
        name: "edges as 1 to 1e100",
        rule: Rule::Proven(|| long(1e100)),
    },
    Case {
        name: "the far end of a cuboid a million times longer than wide",
        rule: Rule::Proven(|| {
            let end = |rotation: DVec3| {
                let body = Body {
                    size: DVec3::new(1e6, 3.0, 2.0),
                    rotation,
                    ..Body::default()
                };
                let along = crate::components::Transform {
                    position: DVec3::ZERO,
                    rotation,
                }
                .axes();
                Setting::with(|setting| {
                    setting.cuboids = vec![body];
                    let end = along * DVec3::X * 5e5;
                    setting.eye = end + along * setting.eye;
                    setting.target = end;
                    setting.lights = lights_at(end + along * DVec3::splat(10.0));
                })
            };
            vec![end(DVec3::ZERO), end(DVec3::new(20.0, 30.0, 40.0))]
        }),
    },
    Case {
        name: "edges a million and a billion times longer look endless",
        rule: Rule::SamePicture(1.0, || {
            let endless = |length: f64| long(length).swap_remove(0);
            vec![endless(1e6), endless(1e9), endless(1e12)]
        }),
    },
    Case {
        name: "needles 1e-2, 1e-3 and 1e-6 thick",
        rule: Rule::Proven(|| {
            let needle = |thick: f64| {
                Setting::with(|setting| {
                    setting.cuboids[0].size = DVec3::new(4.0, thick, thick);
                    setting.cuboids[0].rotation = DVec3::new(0.0, 40.0, 7.0);
                    // Close enough for the thin ones to be seen at all.
                    setting.eye *= (3.0 * thick).min(1.0);
                    setting.height *= thick.min(1.0);
                })
            };
            [1e-2, 1e-3, 1e-6].map(needle).into()
        }),
    },
    Case {
        name: "sheets 1e-3, 1e-9 and 1e-100 thick",
        rule: Rule::Proven(|| {
            let sheet = |thick: f64, rotation: f64| {
                Setting::with(|setting| {
                    setting.cuboids[0].size.z = thick;
                    setting.cuboids[0].rotation = DVec3::new(0.0, rotation, 12.0);
                })
            };
            vec![
                sheet(1e-3, 0.0),
                sheet(1e-9, 20.0),
                sheet(1e-100, 40.0),
                sheet(1e-3, 131.0),
            ]
        }),
    },
    Case {
        name: "a sheet seen edge-on",
        rule: Rule::Proven(|| {
            let sheet = |tilt: f64| {
                Setting::with(|setting| {
                    setting.cuboids[0].size = DVec3::new(4.0, 3.0, 0.3);
                    setting.eye = DVec3::new(9.0, 0.0, 0.15 + tilt);
                    setting.target = DVec3::new(0.0, 0.0, 0.15 + tilt);
                })
            };
            [0.0, 1e-12, -1e-12, 1e-6, 1e-3].map(sheet).into()
        }),
    },
    Case {
        name: "a speck of 1e-100 beside the cuboid",
        rule: Rule::SameBits(|| {
            // Neither a speck nor the same cuboid once more can be seen.
            let lone = Setting::default();
            let with = lone.clone().and(|setting| {
                setting.cuboids.push(Body {
                    size: DVec3::splat(1e-100),
                    position: DVec3::new(0.3, 2.5, 0.1),
                    ..Body::default()
                });
            });
            let twice = lone.and(|setting| setting.cuboids.push(setting.cuboids[0]));
            vec![twice, with]
        }),
    },
];

/// Three cuboids that cross each other under five lights; places and lengths are multiples of 1/8, so moving it by an
/// integer and scaling it by a power of two is exact.
fn still_life() -> Setting {
    let body = |size: [f64; 3], position: [f64; 3], rotation: [f64; 3], shininess: f64| {
        let mut body = Body {
            size: size.into(),
            position: position.into(),
            rotation: rotation.into(),
            ..Body::default()
        };
        body.material.shininess = shininess;
        body
    };
    Setting::with(|setting| {
        setting.cuboids = vec![
            body([4.0, 3.0, 2.0], [0.0; 3], [10.0, 20.0, 30.0], 76.8),
            body([0.5, 9.0, 0.5], [1.0, 0.5, 0.5], [0.0, 0.0, -60.0], 9.0),
            body([3.0, 0.125, 3.0], [-1.0, 1.0, 0.75], [45.0, 0.0, 0.0], 1e3),
        ];
        setting.lights.extend([
            Lamp::new(LightKind::Diffuse, 300.0, DVec3::new(-6.0, 1.0, 2.0)),
            Lamp::new(LightKind::Specular, 90.0, DVec3::new(2.0, 2.0, 1.5)),
        ]);
        setting.eye = DVec3::new(4.0, 3.0, 9.0);
        setting.target = DVec3::new(0.0, 0.125, 0.0);
        setting.height = 6.0;
        // Cuts a corner off.
        setting.near = Some(8.0);
        setting.size = [64, 48];
    })
}

/// Cuboids one unit wide and high and so long, along each axis and askew.
pub fn long(length: f64) -> Vec<Setting> {
    let body = |size: [f64; 3], rotation: [f64; 3]| {
        Setting::with(|setting| {
            setting.cuboids[0].size = size.into();
            setting.cuboids[0].rotation = rotation.into();
        })
    };
    vec![
        body([length, 1.0, 1.0], [0.0; 3]),
        body([1.0, length, 1.0], [0.0; 3]),
        body([1.0, 1.0, length], [0.0; 3]),
        body([length, 2.0, 1.0], [20.0, 30.0, 40.0]),
        body([length, 1.0, length], [5.0, 0.0, 3.0]),
    ]
}
