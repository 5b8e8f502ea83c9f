//! How large things are, how far from the origin, and of what proportions.

use std::iter::once;

use glam::DVec3;

use super::Case;
use super::judge::{proven, same_bits, same_picture};
use super::scene_spec::{SceneSpec, cuboid, default_cuboid, light, lights_at, scene};
use crate::components::{LightKind, Transform};

/// The cases.
pub fn cases() -> Vec<Case> {
    let still_life_scaled = |scale| still_life().scaled(scale);
    let powers = once(0).chain(-40..=40).map(|power| 2.0_f64.powi(power));
    vec![
        same_bits(
            "everything scaled by 2^-40 to 2^40",
            powers.map(still_life_scaled),
        ),
        same_bits(
            "everything scaled by 2^-300 and 2^300",
            [0, -300, 300].map(|power| still_life_scaled(2.0_f64.powi(power))),
        ),
        same_picture(
            "everything scaled by 1e-30 and 1e30",
            1.0,
            [1.0, 1e-30, 1e30].map(still_life_scaled),
        ),
        same_picture(
            "everything scaled to the ends of the format, 1e-98 and 1e98",
            1.0,
            [1.0, 1e-98, 1e98].map(still_life_scaled),
        ),
        same_bits(
            "everything 1e3, 1e6, 1e9 and 1e12 from the origin",
            [0.0, 1e3, -1e6, 1e9, -1e12]
                .map(|far| still_life().moved(DVec3::new(far, -0.5 * far, 0.25 * far))),
        ),
        same_picture(
            "everything 1e3, 1e6, 1e9 away in numbers that round",
            1.0,
            [0.0, 1e3, 1e6, 1e9].map(|far| {
                let shift = DVec3::new(far, far / 3.0, -far / 7.0);
                still_life_scaled(1.1).moved(shift)
            }),
        ),
        proven("edges as 1 to 1e4", long(1e4)),
        proven("edges as 1 to 1e6", long(1e6)),
        proven("edges as 1 to 1e9", long(1e9)),
        proven("edges as 1 to 1e12", long(1e12)),
        proven("edges as 1 to 1e100", long(1e100)),
        proven(
            "the far end of a cuboid a million times longer than wide",
            [[0.0; 3], [20.0, 30.0, 40.0]].map(far_end),
        ),
        same_picture(
            "edges a million and a billion times longer look endless",
            1.0,
            [1e6, 1e9, 1e12].map(|length| long(length)[0].clone()),
        ),
        proven(
            "needles 1e-2, 1e-3 and 1e-6 thick",
            [1e-2, 1e-3, 1e-6].map(|thick| {
                let needle = cuboid([4.0, thick, thick], [0.0; 3]).rotation([0.0, 40.0, 7.0]);
                // Close enough for the thin ones to be seen at all.
                let eye = scene().camera.position * (3.0 * thick).min(1.0);
                scene()
                    .cuboid(needle)
                    .eye(eye)
                    .height(scene().camera.height * thick)
            }),
        ),
        proven(
            "sheets 1e-3, 1e-9 and 1e-100 thick",
            [(1e-3, 0.0), (1e-9, 20.0), (1e-100, 40.0), (1e-3, 131.0)].map(|(thick, angle)| {
                let sheet = cuboid([4.0, 3.0, thick], [0.0; 3]);
                scene().cuboid(sheet.rotation([0.0, angle, 12.0]))
            }),
        ),
        proven(
            "a sheet seen edge-on",
            [0.0, 1e-12, -1e-12, 1e-6, 1e-3].map(|tilt| {
                let sheet = cuboid([4.0, 3.0, 0.3], [0.0; 3]);
                let eye = DVec3::new(9.0, 0.0, 0.15 + tilt);
                scene().cuboid(sheet).eye(eye).target(eye.with_x(0.0))
            }),
        ),
        // Neither a speck nor the same cuboid once more can be seen.
        same_bits(
            "a speck of 1e-100 beside the cuboid",
            [default_cuboid(), cuboid([1e-100; 3], [0.3, 2.5, 0.1])]
                .map(|other| scene().cuboids([default_cuboid(), other])),
        ),
    ]
}

/// Three cuboids that cross each other under five lights; places and lengths are multiples of 1/8, so moving it by an
/// integer and scaling it by a power of two is exact.
fn still_life() -> SceneSpec {
    let mut lights = lights_at([10.0; 3]);
    lights.push(light(LightKind::Diffuse, 300.0, [-6.0, 1.0, 2.0]));
    lights.push(light(LightKind::Specular, 90.0, [2.0, 2.0, 1.5]));
    let block = cuboid([4.0, 3.0, 2.0], [0.0; 3]).rotation([10.0, 20.0, 30.0]);
    let rod = cuboid([0.5, 9.0, 0.5], [1.0, 0.5, 0.5]).rotation([0.0, 0.0, -60.0]);
    let plate = cuboid([3.0, 0.125, 3.0], [-1.0, 1.0, 0.75]).rotation([45.0, 0.0, 0.0]);
    scene()
        .cuboids([block, rod.shininess(9.0), plate.shininess(1e3)])
        .lights(lights)
        .eye([4.0, 3.0, 9.0])
        .target([0.0, 0.125, 0.0])
        .height(6.0)
        // Cuts a corner off.
        .near(8.0)
        .size([64, 48])
}

/// Cuboids one unit wide and high and so long, along each axis and askew.
pub fn long(length: f64) -> [SceneSpec; 5] {
    [
        ([length, 1.0, 1.0], [0.0; 3]),
        ([1.0, length, 1.0], [0.0; 3]),
        ([1.0, 1.0, length], [0.0; 3]),
        ([length, 2.0, 1.0], [20.0, 30.0, 40.0]),
        ([length, 1.0, length], [5.0, 0.0, 3.0]),
    ]
    .map(|(size, rotation)| scene().cuboid(cuboid(size, [0.0; 3]).rotation(rotation)))
}

/// The default view of the end of a cuboid a million units long.
fn far_end(rotation: [f64; 3]) -> SceneSpec {
    let transform = Transform {
        position: DVec3::ZERO,
        rotation: rotation.into(),
    };
    let axes = transform.axes();
    let end = axes * DVec3::X * 5e5;
    scene()
        .cuboid(cuboid([1e6, 3.0, 2.0], [0.0; 3]).rotation(rotation))
        .eye(end + axes * scene().camera.position)
        .target(end)
        .lights(lights_at(end + axes * DVec3::splat(10.0)))
}
