//! Where the eye is, what it looks at and how wide: the near plane, the cuboid's own surface, lenses and turns.

use glam::DVec3;

use super::bench::{Bench, Trouble, enough, ways, wrong};
use super::setting::{Setting, Way, lights_at};
use super::{Case, Rule};
use crate::components::{Mesh, Projection, Transform, View};
use crate::frame::NO_TRIANGLE;
use crate::scene::Scene;

/// The cases.
pub const CASES: &[Case] = &[
    Case {
        name: "near plane through one, two or three corners of triangles",
        rule: Rule::Proven(|| {
            let depths = depths();
            // Beyond the sixth no more than a tip is left.
            let between = depths[..6].windows(2);
            between
                .map(|pair| near_at(f64::midpoint(pair[0], pair[1])))
                .collect()
        }),
    },
    Case {
        name: "near plane through each corner, and an ulp to either side",
        rule: Rule::Proven(|| {
            let depths = depths().into_iter().take(6);
            let around = depths.flat_map(|depth| [depth.next_down(), depth, depth.next_up()]);
            around.map(near_at).collect()
        }),
    },
    Case {
        name: "near plane in a face's own plane",
        rule: Rule::SameBits(|| {
            let at = |near: f64| frontal().and(|setting| setting.near = Some(near));
            vec![at(1.0), at(9.0_f64.next_down()), at(9.0)]
        }),
    },
    Case {
        name: "near plane an ulp beyond the only face in sight",
        rule: Rule::Nothing(&Projection::ALL, || {
            vec![frontal().and(|setting| setting.near = Some(9.0_f64.next_up()))]
        }),
    },
    Case {
        name: "near plane a billionth of the distance",
        rule: Rule::Proven(|| vec![near_at(1e-8), near_at(1e-100)]),
    },
    Case {
        name: "the assignment's own placement",
        rule: Rule::Own(
            "ambient light alone: 30 levels, from both cameras",
            assignment,
        ),
    },
    Case {
        name: "eye inside the cuboid",
        rule: Rule::Nothing(&[Projection::Perspective], || {
            looking_around_from(&[[0.0, 0.0, 0.0], [0.1, 0.2, 0.3], [1.99, 1.49, -0.99]])
        }),
    },
    Case {
        name: "eye on a face, an edge, a corner",
        rule: Rule::Nothing(&[Projection::Perspective], || {
            looking_around_from(&[[0.1, 0.2, 1.0], [2.0, 0.2, 1.0], [2.0, 1.5, 1.0]])
        }),
    },
    Case {
        name: "orthographic eye on an edge or a corner",
        rule: Rule::Proven(|| {
            let from = |eye: DVec3| {
                Setting::with(|setting| {
                    setting.eye = eye;
                    setting.near = Some(1e-9);
                })
            };
            vec![
                from(DVec3::new(2.0, 1.5, 1.0)),
                from(DVec3::new(2.0, 0.2, 1.0)),
            ]
        }),
    },
    Case {
        name: "eye 1e-3, 1e-6 and 1e-9 in front of a face",
        rule: Rule::Proven(|| {
            let before = |gap: f64| {
                Setting::with(|setting| {
                    setting.eye = DVec3::new(0.1, 0.2, 1.0 + gap);
                    setting.target = DVec3::new(0.4, 0.3, 0.0);
                    setting.near = Some(gap / 10.0);
                    setting.height = 2.0;
                })
            };
            [1e-3, 1e-6, 1e-9].map(before).into()
        }),
    },
    Case {
        name: "eye in the plane of a face, and an ulp to either side",
        rule: Rule::Proven(|| {
            let beside = |x: f64| Setting::with(|setting| setting.eye = DVec3::new(x, 3.0, 9.0));
            [2.0_f64.next_down(), 2.0, 2.0_f64.next_up()]
                .map(beside)
                .into()
        }),
    },
    Case {
        name: "eye at the lights",
        rule: Rule::Proven(|| {
            vec![
                Setting::with(|setting| setting.lights = lights_at(setting.eye)),
                Setting::with(|setting| {
                    setting.lights = lights_at(setting.eye);
                    setting.cuboids[0].material.shininess = 1e6;
                }),
            ]
        }),
    },
    Case {
        name: "a face whose depths are as 1 to a million",
        rule: Rule::Proven(|| {
            let floor = |rotation: f64| {
                Setting::with(|setting| {
                    setting.cuboids[0].size = DVec3::new(20.0, 2.0, 2e6);
                    setting.cuboids[0].rotation = DVec3::Z * rotation;
                    setting.lights = lights_at(DVec3::new(3.0, 8.0, 999_990.0));
                    setting.eye = DVec3::new(0.0, 2.0, 1e6 + 1.0);
                    setting.target = DVec3::new(0.0, 1.0, 1e6 - 4.0);
                    setting.near = Some(1.0);
                })
            };
            vec![floor(0.0), floor(7.0)]
        }),
    },
    Case {
        name: "field of view of 1e-3 and of 1e-9 degrees",
        rule: Rule::Proven(|| {
            [1e-3, 1e-9]
                .map(|fov| Setting::with(|setting| setting.fov = fov))
                .into()
        }),
    },
    Case {
        name: "a cuboid as large as the picture from 1e4 to 1e9 units away",
        rule: Rule::Proven(|| [1e3, 1e5, 1e8].map(from_afar).into()),
    },
    Case {
        name: "perspective from 1e4 times as far against orthographic",
        rule: Rule::Own(
            "within 1 level, the same faces off their edges",
            far_perspective,
        ),
    },
    Case {
        name: "field of view of 179 degrees",
        rule: Rule::Proven(|| {
            [DVec3::new(1.0, 1.0, 2.0), DVec3::new(0.1, 0.1, 1.01)]
                .map(|eye| {
                    Setting::with(|setting| {
                        setting.fov = 179.0;
                        setting.eye = eye;
                        setting.near = Some(1e-3);
                    })
                })
                .into()
        }),
    },
    Case {
        name: "orthographic height of 1e-6",
        rule: Rule::Proven(|| vec![Setting::with(|setting| setting.height = 1e-6)]),
    },
    Case {
        name: "orthographic height of 1e6",
        rule: Rule::Proven(|| {
            vec![
                Setting::with(|setting| setting.height = 1e6),
                Setting::with(|setting| {
                    setting.height = 1e6;
                    setting.cuboids[0].size *= 1e5;
                    setting.eye *= 1e6;
                }),
            ]
        }),
    },
    Case {
        name: "up almost parallel to the view",
        rule: Rule::SamePicture(1.0, || {
            let forward = Setting::default().eye * -0.1;
            let upwards =
                |share: f64| Setting::with(|setting| setting.up = forward + DVec3::Y * share);
            vec![
                Setting::default(),
                upwards(1.0),
                upwards(1e-3),
                upwards(1e-7),
            ]
        }),
    },
    Case {
        name: "up of any length from 1e-100 to 1e100",
        rule: Rule::SamePicture(0.01, || {
            let long = |length: f64| Setting::with(|setting| setting.up = DVec3::Y * length);
            vec![Setting::default(), long(1e-100), long(1e100)]
        }),
    },
    Case {
        name: "rotation by 1e9 degrees",
        // 1e9 = 2777777 turns and 280 degrees.
        rule: Rule::SameBits(|| {
            let turned = |x: f64, y: f64, z: f64| {
                Setting::with(|setting| setting.cuboids[0].rotation = DVec3::new(x, y, z))
            };
            vec![
                turned(280.0, -280.0, 10.0),
                turned(1e9, -1e9, 1e9 + 90.0),
                turned(280.0 + 360.0 * 7.0, -280.0 - 360.0 * 9.0, 370.0),
            ]
        }),
    },
    Case {
        name: "rotation by 1e100 degrees",
        // The double nearest to 1e100 is a whole number and leaves 64 when divided by 360, in integers of any length.
        rule: Rule::SameBits(|| {
            let turned = |x: f64| {
                Setting::with(|setting| setting.cuboids[0].rotation = DVec3::new(x, 3.0, 4.0))
            };
            vec![turned(64.0), turned(1e100)]
        }),
    },
];

/// The default cuboid, turned so that its corners have eight depths, and cut at this one.
fn near_at(depth: f64) -> Setting {
    Setting::with(|setting| {
        setting.cuboids[0].rotation = TURN;
        setting.near = Some(depth);
        setting.size = [192, 144];
    })
}

/// In degrees.
const TURN: DVec3 = DVec3::new(10.0, 20.0, 30.0);

/// The depths of that cuboid's corners, in order.
fn depths() -> Vec<f64> {
    let Setting { eye, target, .. } = Setting::default();
    let axes = Transform {
        position: DVec3::ZERO,
        rotation: TURN,
    }
    .axes();
    let forward = (target - eye).normalize();
    let corners = Mesh::cuboid(Setting::default().cuboids[0].size).corners;
    let mut depths: Vec<f64> = corners
        .iter()
        .map(|corner| forward.dot(axes * *corner - eye))
        .collect();
    depths.sort_by(f64::total_cmp);
    depths
}

/// The default cuboid from straight before its face z = 1, which is 9 away.
fn frontal() -> Setting {
    Setting::with(|setting| setting.eye = DVec3::Z * 10.0)
}

/// From each of these places into six directions along the axes and two askew.
fn looking_around_from(places: &[[f64; 3]]) -> Vec<Setting> {
    let askew = [DVec3::new(1.0, 2.0, 3.0), DVec3::new(-3.0, 1.0, -2.0)];
    let straight = DVec3::AXES.into_iter().flat_map(|axis| [axis, -axis]);
    let directions: Vec<DVec3> = straight.chain(askew).collect();
    let all = places.iter().flat_map(|place| {
        directions.iter().map(|direction| {
            Setting::with(|setting| {
                setting.eye = DVec3::from(*place);
                setting.target = setting.eye + *direction;
                setting.up = if direction.x == 0.0 {
                    DVec3::X
                } else {
                    DVec3::Y
                };
                setting.near = Some(1e-6);
                setting.fov = 90.0;
            })
        })
    });
    all.collect()
}

/// The default setting from so many times as far, the field of view as much narrower.
fn from_afar(times: f64) -> Setting {
    Setting::with(|setting| {
        setting.eye *= times;
        setting.fov = 2.0
            * (setting.height / 2.0 / setting.eye.length())
                .atan()
                .to_degrees();
    })
}

/// Orthographic pictures from where the perspective ones are taken.
fn far_perspective(bench: &mut Bench) -> Result<String, Trouble> {
    let setting = from_afar(1e4);
    let mut worst = 0.0_f64;
    for way in ways().filter(|way| way.projection == Projection::Perspective) {
        let parallel = Way {
            projection: Projection::Orthographic,
            ..way
        };
        let difference = bench.difference([(&setting, parallel), (&setting, way)], 1.0)?;
        worst = worst.max(difference);
    }
    Ok(format!("{worst:.2e} levels"))
}

/// The built-in scene, whose lights lie on the cuboid: n.l is negative wherever either camera looks.
fn assignment(bench: &mut Bench) -> Result<String, Trouble> {
    let mut scene = Scene::load(Some("assignment"))?;
    let mut seen = 0;
    for camera in 0..2 {
        for way in ways() {
            let view = View {
                size: [160, 120],
                viewpoint: scene.viewpoint(camera),
                ..Setting::default().view(&scene, way)
            };
            let frame = bench.draw(&mut scene, &view)?;
            let mut pixels = frame.triangles().iter().zip(frame.levels()).enumerate();
            let lit = pixels.find(|(_, (id, levels))| {
                **id != NO_TRIANGLE && levels.iter().any(|level| (level - 30.0).abs() > 0.05)
            });
            if let Some((pixel, (_, levels))) = lit {
                let what = format!("has {levels:?} levels, camera {}", camera + 1);
                return Err(wrong(&view, [pixel % 160, pixel / 160], &what));
            }
            seen += frame.counts().covered_pixels;
        }
    }
    enough(seen)?;
    Ok(format!("30 levels at all of {seen} pixels"))
}
