//! Many things, and things in one place: lights by the thousand, cuboids by the ten thousand, depths that tie.

use glam::DVec3;

use super::bench::{Bench, Trouble, enough, ways, wrong};
use super::setting::{Body, Lamp, Setting, lights_at};
use super::{Case, Rule};
use crate::components::LightKind;
use crate::frame::NO_TRIANGLE;
use crate::shading::EXACT;

/// The cases.
pub const CASES: &[Case] = &[
    Case {
        name: "a thousand lights",
        rule: Rule::Proven(|| {
            vec![under_many_lights(1000, |index| {
                let step = f64::from(index);
                DVec3::new(step % 7.0 - 3.0, step % 5.0 + 2.0, step % 11.0 - 1.0) * 1.7
            })]
        }),
    },
    Case {
        name: "a thousand lights at one place against their sum",
        rule: Rule::SamePicture(EXACT, || {
            [1, 1000]
                .map(|lights| under_many_lights(lights, |_| DVec3::splat(10.0)))
                .into()
        }),
    },
    Case {
        name: "ten thousand cuboids",
        rule: Rule::Proven(|| vec![many_cuboids()]),
    },
    Case {
        name: "cuboids that touch in faces, edges and corners",
        rule: Rule::Proven(|| {
            let left = cuboid([2.0, 2.0, 2.0], [-1.0, 0.0, 0.0]);
            let touching = [
                [1.0, 0.0, 0.0],
                [1.0, 0.0, 2.0],
                [1.0, 2.0, 2.0],
                [1.0, 1.0, 0.0],
            ];
            touching
                .map(|place| of(vec![left, cuboid([2.0; 3], place)]))
                .into()
        }),
    },
    Case {
        name: "cuboids that interpenetrate",
        rule: Rule::Proven(|| {
            let turned = Body {
                rotation: DVec3::new(20.0, 30.0, 40.0),
                ..Body::default()
            };
            let rod = cuboid([0.5, 9.0, 0.5], [1.0, 0.0, 0.3]);
            vec![
                of(vec![Body::default(), turned, rod]),
                of(vec![rod, turned, Body::default()]),
            ]
        }),
    },
    Case {
        name: "cuboids with a face in one plane: the earlier is seen",
        rule: Rule::Proven(|| {
            let (low, high) = (
                cuboid([3.0, 2.0, 2.0], [-1.0, 0.0, 0.0]),
                cuboid([3.0, 2.0, 4.0], [1.0, 0.0, -1.0]),
            );
            vec![of(vec![low, high]), of(vec![high, low])]
        }),
    },
    Case {
        name: "cuboids that coincide: only the first is seen",
        rule: Rule::Own(
            "cuboid 0 wherever anything is seen, however the others are written",
            |bench| {
                let turned = |size: [f64; 3], rotation: [f64; 3]| Body {
                    size: size.into(),
                    rotation: rotation.into(),
                    ..Body::default()
                };
                let one = [
                    turned([2.0, 1.0, 3.0], [0.0, 0.0, 30.0]),
                    turned([2.0, 1.0, 3.0], [360.0, -720.0, 390.0]),
                    turned([1.0, 2.0, 3.0], [0.0, 0.0, 120.0]),
                ];
                let [a, b, c] = one;
                let mut seen = 0;
                for order in [[a, b, c], [c, a, b], [b, c, a], [c, b, a]] {
                    for far in [0.0, 1e3, -1e6] {
                        let setting = of(order.to_vec()).moved(DVec3::splat(far));
                        seen += expect_only(bench, &setting, 0)?;
                    }
                }
                Ok(format!("cuboid 0 at all of {seen} pixels"))
            },
        ),
    },
    Case {
        name: "faces 1e-3 apart, 10 to 1e5 units away",
        rule: Rule::Own("the nearer, cuboid 1, wherever anything is seen", |bench| {
            let mut seen = 0;
            for distance in [10.0, 1e2, 1e3, 1e4, 1e5_f64] {
                let plate = |depth: f64| Body {
                    rotation: DVec3::Z * 20.0,
                    ..cuboid([4.0, 3.0, 0.5], [0.0, 0.0, -depth])
                };
                let setting = of(vec![plate(1e-3), plate(0.0)]).and(|setting| {
                    setting.eye = DVec3::Z * distance;
                    setting.fov = 2.0 * (3.0 / distance).atan().to_degrees();
                });
                seen += expect_only(bench, &setting, 1)?;
            }
            Ok(format!("cuboid 1 at all of {seen} pixels"))
        }),
    },
    Case {
        name: "a bar 100 long, edge-on behind a sheet",
        rule: Rule::Own("the sheet, cuboid 1, wherever anything is seen", |bench| {
            let mut seen = 0;
            for step in 0..50 {
                let step = f64::from(step);
                let bar = Body {
                    rotation: DVec3::new(-1.2e-6 * step, 0.7e-6 * step, 0.0),
                    ..cuboid(
                        [1.0, 1.0, 100.0],
                        [-0.5 - 1e-5 * step, 0.56 + 0.004 * step, -60.0],
                    )
                };
                let sheet = cuboid([9.0, 9.0, 0.1], [0.0; 3]);
                let setting = of(vec![bar, sheet]).and(|setting| setting.eye = DVec3::Z * 30.0);
                seen += expect_only(bench, &setting, 1)?;
            }
            Ok(format!("cuboid 1 at all of {seen} pixels"))
        }),
    },
    Case {
        name: "a cuboid inside another",
        rule: Rule::SameBits(|| {
            let inner = |share: f64| Body {
                size: Body::default().size * share,
                ..Body::default()
            };
            [0.1, 0.999_999, 1.0]
                .map(|share| of(vec![Body::default(), inner(share)]))
                .into()
        }),
    },
    Case {
        name: "a floor of 1e6 units under a cuboid",
        rule: Rule::Proven(|| {
            let floor = cuboid([1e6, 2.0, 1e6], [0.0, -2.5, 0.0]);
            vec![
                of(vec![floor, Body::default()]),
                of(vec![Body::default(), floor]),
            ]
        }),
    },
];

fn of(cuboids: Vec<Body>) -> Setting {
    Setting::with(|setting| setting.cuboids = cuboids)
}

fn cuboid(size: [f64; 3], position: [f64; 3]) -> Body {
    Body {
        size: size.into(),
        position: position.into(),
        ..Body::default()
    }
}

/// So many lights of one sum, half diffuse and half specular.
pub fn under_many_lights(count: u32, place: impl Fn(u32) -> DVec3) -> Setting {
    Setting::with(|setting| {
        setting.size = [32, 24];
        setting.lights = lights_at(DVec3::ZERO).split_off(2);
        for index in 0..count {
            for (kind, levels) in [(LightKind::Diffuse, 200.0), (LightKind::Specular, 500.0)] {
                let lamp = Lamp::new(kind, levels / f64::from(count), place(index));
                setting.lights.push(lamp);
            }
        }
    })
}

/// A block of 25 x 20 x 20 cuboids, all turned differently.
fn many_cuboids() -> Setting {
    let cuboids = (0..10_000).map(|index| {
        let [x, y, z] = [index % 25, index / 25 % 20, index / 500].map(f64::from);
        let turn = f64::from(index);
        Body {
            rotation: DVec3::new(7.0 * turn, 13.0 * turn, 29.0 * turn),
            ..cuboid(
                [0.3, 0.2, 0.25],
                [0.3 * x - 3.6, 0.3 * y - 2.85, 0.3 * z - 3.0],
            )
        }
    });
    of(cuboids.collect()).and(|setting| setting.fov = 45.0)
}

/// Asserts that wherever anything is seen it is this cuboid; how many pixels that is.
fn expect_only(bench: &mut Bench, setting: &Setting, cuboid: u32) -> Result<u64, Trouble> {
    let mut scene = setting.scene()?;
    let mut seen = 0;
    for way in ways() {
        let view = setting.view(&scene, way);
        let frame = bench.draw(&mut scene, &view)?;
        for (pixel, id) in frame.triangles().iter().enumerate() {
            if *id != NO_TRIANGLE {
                if id / 12 != cuboid {
                    let place = [pixel % view.size[0], pixel / view.size[0]];
                    return Err(wrong(&view, place, &format!("shows cuboid {}", id / 12)));
                }
                seen += 1;
            }
        }
    }
    enough(seen)?;
    Ok(seen)
}
