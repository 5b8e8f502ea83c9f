//! Numbers at the limits of the scene format: the picture stays defined.

use glam::DVec3;
use hecs::World;
use shadetrade::components::{LightKind, Material, Projection, ShadingMode, Transform, View};
use shadetrade::frame::{Keep, NO_TRIANGLE};

use crate::support::random::Random;
use crate::support::scene::{draw, empty, spawn_cuboid, spawn_light, view, white};

const MODES: [ShadingMode; 3] = [
    ShadingMode::Gouraud,
    ShadingMode::Phong,
    ShadingMode::UnitVectors,
];

/// Every term has at most 100 levels, each in its own channel.
fn one_term_a_channel(size: DVec3, transform: Transform, light: DVec3) -> World {
    let mut world = empty();
    let material = white(2.0);
    spawn_cuboid(&mut world, size, transform, material);
    spawn_light(&mut world, LightKind::Diffuse, DVec3::X * 100.0, light);
    spawn_light(&mut world, LightKind::Specular, DVec3::Y * 100.0, light);
    spawn_light(&mut world, LightKind::Ambient, DVec3::Z * 100.0, light);
    world
}

#[test]
fn the_near_plane_removes_pixels_and_changes_none() {
    let mut random = Random(9);
    let mut taken = 0;
    for _ in 0..60 {
        let transform = Transform {
            position: random.around(0.5),
            rotation: random.around(180.0),
        };
        let light = random.around(9.0);
        let mut world = one_term_a_channel(DVec3::new(4.0, 3.0, 2.0), transform, light);
        for projection in Projection::ALL {
            for mode in [ShadingMode::Gouraud, ShadingMode::Phong] {
                let mut picture = |near: f64| {
                    let mut view = view([64, 48], DVec3::Z * 4.0, DVec3::ZERO, projection);
                    view.viewpoint.camera.near = Some(near);
                    draw(&mut world, &view.shaded(mode), Keep::Levels)
                };
                let whole = picture(0.01);
                for near in [1.5, 3.0, 4.0, 5.0] {
                    let cut = picture(near);
                    let mut astray = 0;
                    for (pixel, id) in cut.triangles().iter().enumerate() {
                        if *id == NO_TRIANGLE {
                            taken += u32::from(whole.triangles()[pixel] != NO_TRIANGLE);
                        } else if *id == whole.triangles()[pixel] {
                            // Both are within 0.05 level of the truth.
                            let pairs = cut.levels()[pixel].iter().zip(whole.levels()[pixel]);
                            let differ = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
                            assert!(
                                differ < 0.1,
                                "{differ} levels at {pixel}, near plane {near}"
                            );
                        } else {
                            astray += 1;
                        }
                    }
                    assert!(
                        astray <= 2,
                        "{astray} pixels beyond the whole face, near plane {near}"
                    );
                }
            }
        }
    }
    assert!(taken > 10_000, "{taken} pixels were removed");
}

#[test]
fn needles_and_sheets_have_colours_within_the_range_of_their_lights() {
    let mut random = Random(10);
    let mut covered = 0;
    for _ in 0..1000 {
        let thin = 10.0_f64.powf(random.within(-6.0, 0.0));
        let size =
            [DVec3::new(4.0, thin, thin), DVec3::new(4.0, 3.0, thin)][(thin * 1e9) as usize % 2];
        let transform = Transform {
            position: random.around(0.5),
            rotation: random.around(180.0),
        };
        let light = random.around(10.0);
        let eye = random.around(10.0) + DVec3::Z * 14.0;
        let mut world = one_term_a_channel(size, transform, light);
        for projection in Projection::ALL {
            let view = view([64, 48], eye, DVec3::ZERO, projection);
            for mode in MODES {
                let frame = draw(&mut world, &view.shaded(mode), Keep::Levels);
                covered += frame.counts().covered_pixels;
                let drawn = frame.levels().iter().zip(frame.triangles());
                for (levels, _) in drawn.filter(|(_, id)| **id != NO_TRIANGLE) {
                    // Snapping may put a pixel centre outside the face, by at most a 128th of the face.
                    let within = levels.iter().all(|level| (-0.8..=100.8).contains(level));
                    assert!(
                        within,
                        "{levels:?}, {mode:?}, {size} {transform:?} from {eye}"
                    );
                }
            }
        }
    }
    assert!(covered > 100_000, "{covered} pixels were looked at");
}

#[test]
fn no_level_is_ever_undefined() {
    for seed in 0..3000 {
        let (mut world, view) = extreme_scene(&mut Random(seed));
        for mode in MODES {
            for tolerance in [0.0, 0.5] {
                let view = view.shaded(mode).with_tolerance(tolerance);
                let frame = draw(&mut world, &view, Keep::Levels);
                let defined = frame.levels().iter().flatten().all(|level| !level.is_nan());
                assert!(defined, "seed {seed}, {mode:?} at tolerance {tolerance}");
            }
        }
    }
}

/// One to three cuboids and up to four lights, with sizes, positions, materials, lights and cameras from the limits of
/// the scene format.
fn extreme_scene(random: &mut Random) -> (World, View) {
    fn pick<T: Copy>(random: &mut Random, choices: &[T]) -> T {
        choices[random.within(0.0, choices.len() as f64) as usize]
    }
    let scale = pick(random, &[1.0, 1.0, 1e90, 1e-90]);
    let ratio = pick(random, &[0.0, 0.5, 3.0, 9.0]);
    let mut world = empty();
    for _ in 0..pick(random, &[1, 2, 3]) {
        let size: DVec3 =
            std::array::from_fn(|_| 10.0_f64.powf(random.within(-ratio, ratio))).into();
        let material = Material {
            ambient: DVec3::splat(pick(random, &[0.0, 0.3, 1e30])),
            diffuse: DVec3::new(pick(random, &[0.0, 0.5, 1e30]), 0.5, 0.1),
            specular: DVec3::splat(pick(random, &[0.0, 0.5, 1e30])),
            shininess: pick(random, &[0.0, 1e-3, 0.5, 1.0, 76.8, 1e3, 1e6]),
        };
        let reach = pick(random, &[0.0, 3.0]);
        let transform = Transform {
            position: random.around(reach) * scale,
            rotation: random.around(1.0) * pick(random, &[0.0, 180.0, 1e9]),
        };
        spawn_cuboid(&mut world, size * scale, transform, material);
    }
    for _ in 0..pick(random, &[0, 1, 2, 3, 4]) {
        let kind = pick(
            random,
            &[LightKind::Ambient, LightKind::Diffuse, LightKind::Specular],
        );
        let strength = pick(random, &[0.0, 1e-38, 100.0, 1e30, 1e60, 1e90]);
        let reach = pick(random, &[0.0, 1e-8, 1.0, 10.0, 1e8]);
        let place = random.around(reach) * scale;
        spawn_light(&mut world, kind, DVec3::new(strength, 100.0, 1e-300), place);
    }
    let distance = pick(random, &[0.0, 0.3, 1.0, 5.0, 100.0, 1e6]);
    let eye = (random.around(1.0) + DVec3::Z * distance) * scale;
    let target = random.around(1.0) * scale;
    let mut view = view([33, 21], eye, target, pick(random, &Projection::ALL));
    view.viewpoint.camera.fov = pick(random, &[1e-3, 10.0, 60.0, 120.0, 179.0]);
    view.viewpoint.camera.height = pick(random, &[1e-6, 1.0, 10.0, 1e6]) * scale;
    view.viewpoint.camera.near = pick(random, &[None, Some(1e-6 * scale), Some(scale)]);
    (world, view)
}
