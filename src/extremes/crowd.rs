//! Many things, and things in one place: lights by the thousand, cuboids by the ten thousand, depths that tie.

use glam::DVec3;

use super::judge::{Fact, known, prove_scenes, proven, same_bits, same_picture};
use super::renderer::Renderer;
use super::scene_spec::{SceneSpec, cuboid, default_cuboid, light, lights_at, scene};
use super::{Case, case};
use crate::components::LightKind;

/// The cases.
pub fn cases() -> Vec<Case> {
    let plain = default_cuboid();
    let rotated = plain.clone().rotation([20.0, 30.0, 40.0]);
    let rod = cuboid([0.5, 9.0, 0.5], [1.0, 0.0, 0.3]);
    let low = cuboid([3.0, 2.0, 2.0], [-1.0, 0.0, 0.0]);
    let high = cuboid([3.0, 2.0, 4.0], [1.0, 0.0, -1.0]);
    let floor = cuboid([1e6, 2.0, 1e6], [0.0, -2.5, 0.0]);
    vec![
        proven("a thousand lights", [under_many_lights(1000, spread)]),
        same_picture(
            "a thousand lights at one place against their sum",
            crate::shading::EXACT,
            [1, 1000].map(|count| under_many_lights(count, |_| DVec3::splat(10.0))),
        ),
        case(
            "ten thousand cuboids",
            "every pixel proven",
            many_cuboids_are_proven,
        ),
        proven(
            "cuboids that touch in faces, edges and corners",
            [
                [1.0, 0.0, 0.0],
                [1.0, 0.0, 2.0],
                [1.0, 2.0, 2.0],
                [1.0, 1.0, 0.0],
            ]
            .map(|place| {
                let left = cuboid([2.0; 3], [-1.0, 0.0, 0.0]);
                scene().cuboids([left, cuboid([2.0; 3], place)])
            }),
        ),
        proven(
            "cuboids that interpenetrate",
            [[&plain, &rotated, &rod], [&rod, &rotated, &plain]]
                .map(|order| scene().cuboids(order)),
        ),
        proven(
            "cuboids with a face in one plane: the earlier is seen",
            [[&low, &high], [&high, &low]].map(|order| scene().cuboids(order)),
        ),
        known(
            "cuboids that coincide: only the first is seen",
            "cuboid 0 wherever anything is seen, however the others are written",
            Fact::Cuboid(0),
            coinciding(),
        ),
        known(
            "faces 1e-3 apart, 10 to 1e5 units away",
            "the nearer, cuboid 1, wherever anything is seen",
            Fact::Cuboid(1),
            [10.0, 1e2, 1e3, 1e4, 1e5].map(two_plates),
        ),
        known(
            "a bar 100 long, edge-on behind a sheet",
            "the sheet, cuboid 1, wherever anything is seen",
            Fact::Cuboid(1),
            (0..50).map(bar_behind_a_sheet),
        ),
        same_bits(
            "a cuboid inside another",
            [0.1, 0.999_999, 1.0].map(|share| {
                let inner = cuboid(plain.size * share, [0.0; 3]);
                scene().cuboids([&plain, &inner])
            }),
        ),
        proven(
            "a floor of 1e6 units under a cuboid",
            [[&floor, &plain], [&plain, &floor]].map(|order| scene().cuboids(order)),
        ),
    ]
}

/// So many lights of one sum, half diffuse and half specular.
pub fn under_many_lights(count: u32, place: impl Fn(u32) -> DVec3) -> SceneSpec {
    let mut lights = lights_at([0.0; 3]).split_off(2);
    for index in 0..count {
        for (kind, levels) in [(LightKind::Diffuse, 200.0), (LightKind::Specular, 500.0)] {
            lights.push(light(kind, levels / f64::from(count), place(index)));
        }
    }
    scene().size([32, 24]).lights(lights)
}

/// Places of lights around the default cuboid.
pub fn spread(index: u32) -> DVec3 {
    let step = f64::from(index);
    DVec3::new(step % 7.0 - 3.0, step % 5.0 + 2.0, step % 11.0 - 1.0) * 1.7
}

/// A block of 25 x 20 x 20 cuboids, all rotated differently; unless everything is to be drawn, its two last layers.
fn many_cuboids_are_proven(renderer: &mut Renderer) -> anyhow::Result<String> {
    let first = if renderer.full { 0 } else { 9_000 };
    let cuboids = (first..10_000).map(|index| {
        let [x, y, z] = [index % 25, index / 25 % 20, index / 500].map(f64::from);
        let place = [0.3 * x - 3.6, 0.3 * y - 2.85, 0.3 * z - 3.0];
        cuboid([0.3, 0.2, 0.25], place).rotation(DVec3::new(7.0, 13.0, 29.0) * f64::from(index))
    });
    let scene = scene().fov(45.0).cuboids(cuboids.collect::<Vec<_>>());
    prove_scenes(renderer, &[scene])
}

/// One cuboid written in three ways, in several orders and places.
fn coinciding() -> Vec<SceneSpec> {
    let ways = [
        ([2.0, 1.0, 3.0], [0.0, 0.0, 30.0]),
        ([2.0, 1.0, 3.0], [360.0, -720.0, 390.0]),
        ([1.0, 2.0, 3.0], [0.0, 0.0, 120.0]),
    ]
    .map(|(size, rotation)| cuboid(size, [0.0; 3]).rotation(rotation));
    let mut scenes = Vec::new();
    for order in [[0, 1, 2], [2, 0, 1], [1, 2, 0], [2, 1, 0]] {
        for far in [0.0, 1e3, -1e6] {
            let scene = scene().cuboids(order.map(|way| &ways[way]));
            scenes.push(scene.moved(DVec3::splat(far)));
        }
    }
    scenes
}

/// Two plates, the first one 1e-3 behind the second, which fill the same part of the picture at any distance.
fn two_plates(distance: f64) -> SceneSpec {
    let plate = |depth: f64| {
        let plate = cuboid([4.0, 3.0, 0.5], [0.0, 0.0, -depth]);
        plate.rotation([0.0, 0.0, 20.0])
    };
    scene()
        .cuboids([plate(1e-3), plate(0.0)])
        .eye(DVec3::Z * distance)
        .fov(2.0 * (3.0 / distance).atan().to_degrees())
}

fn bar_behind_a_sheet(step: i32) -> SceneSpec {
    let step = f64::from(step);
    let place = [-0.5 - 1e-5 * step, 0.56 + 0.004 * step, -60.0];
    let bar = cuboid([1.0, 1.0, 100.0], place).rotation([-1.2e-6 * step, 0.7e-6 * step, 0.0]);
    let sheet = cuboid([9.0, 9.0, 0.1], [0.0; 3]);
    scene().cuboids([bar, sheet]).eye(DVec3::Z * 30.0)
}
