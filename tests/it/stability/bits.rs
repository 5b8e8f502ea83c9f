//! A picture has the same bits with any number of threads, in any parts, and after any other picture.

use std::ops::Range;

use fearless_simd::Level;
use glam::DVec3;
use hecs::World;
use shadetrade::components::{Light, Projection, ShadingMode, Transform, View};
use shadetrade::frame::{Frame, Keep, Workers};
use shadetrade::{simd, systems};

use super::life::{Bits, still_life, views};
use crate::support::scene::{at, draw, spawn_cuboid, view, white};

const KEEPS: [Keep; 2] = [Keep::Levels, Keep::Display];

fn frame(keep: Keep, threads: usize, level: Level) -> Frame {
    Frame::new(
        keep,
        Workers::new(threads, level).expect("the system gives threads"),
    )
}

fn bits(world: &mut World, view: &View, frame: &mut Frame) -> Bits {
    systems::draw(world, view, frame).expect("a small picture fits");
    Bits::of(frame)
}

fn rows_of(world: &mut World, view: &View, rows: Range<usize>, frame: &mut Frame) -> Bits {
    systems::draw_rows(world, view, rows, frame).expect("a small picture fits");
    Bits::of(frame)
}

#[test]
fn any_number_of_threads_draws_the_same_bits_with_the_same_counts() {
    for cuboids in [1, 3] {
        let mut world = still_life(cuboids);
        for keep in KEEPS {
            let mut alone = frame(keep, 1, Level::new());
            let mut together: Vec<Frame> = [2, 3, 4, 7]
                .map(|threads| frame(keep, threads, Level::new()))
                .into();
            for mut view in views([400, 320]).into_iter().step_by(2) {
                // So near that the frame is drawn on several threads.
                view.viewpoint.camera.fov = 10.0;
                view.viewpoint.camera.height = 2.0;
                let view = &view;
                let expected = bits(&mut world, view, &mut alone);
                assert!(alone.counts().covered_pixels > 100_000);
                for frame in &mut together {
                    let same = bits(&mut world, view, frame) == expected;
                    assert!(same, "{} threads, {view:?}", frame.workers().threads());
                    assert_eq!(frame.counts(), alone.counts());
                }
            }
        }
    }
}

#[test]
fn small_faces_across_the_bands_of_threads_are_counted_as_by_one_thread() {
    // 26 x 21 cuboids of about 15 pixels: many cross rows at which the picture may be cut.
    let mut world = still_life(1);
    for index in 0..26 * 21 {
        let place = DVec3::new(
            f64::from(index % 26) - 12.5,
            f64::from(index / 26) - 10.0,
            3.0,
        );
        let material = white(20.0);
        let transform = Transform {
            rotation: DVec3::splat(7.0 * f64::from(index)),
            ..at(place)
        };
        spawn_cuboid(&mut world, DVec3::splat(0.7), transform, material);
    }
    for mode in [ShadingMode::Gouraud, ShadingMode::Phong] {
        let eye = DVec3::new(0.0, 0.0, 30.0);
        let mut view = view([400, 320], eye, DVec3::ZERO, Projection::Orthographic).shaded(mode);
        view.viewpoint.camera.height = 20.0;
        let mut alone = frame(Keep::Display, 1, Level::new());
        let expected = bits(&mut world, &view, &mut alone);
        assert!(alone.counts().covered_pixels > 60_000);
        for threads in [2, 5] {
            let mut together = frame(Keep::Display, threads, Level::new());
            assert!(bits(&mut world, &view, &mut together) == expected);
            assert_eq!(together.counts(), alone.counts(), "{threads} threads");
        }
    }
}

#[test]
fn every_simd_level_of_this_machine_draws_the_same_bits() {
    let levels: Vec<Level> = simd::NAMES.into_iter().filter_map(simd::named).collect();
    assert!(levels.len() > 1, "the fallback and what this machine has");
    for cuboids in [1, 3] {
        let mut world = still_life(cuboids);
        for keep in KEEPS {
            for view in views([160, 120]) {
                let expected = bits(&mut world, &view, &mut frame(keep, 1, Level::new()));
                for &level in &levels {
                    let same = bits(&mut world, &view, &mut frame(keep, 1, level)) == expected;
                    assert!(same, "{}, {view:?}", simd::name(level));
                }
            }
        }
    }
}

#[test]
fn some_rows_of_a_picture_have_the_bits_of_the_whole() {
    for cuboids in [1, 3] {
        let mut world = still_life(cuboids);
        for keep in KEEPS {
            let mut part = frame(keep, 1, Level::new());
            for view in views([160, 131]) {
                let whole = bits(&mut world, &view, &mut frame(keep, 1, Level::new()));
                for rows in [
                    0..1,
                    3..17,
                    15..16,
                    16..48,
                    31..97,
                    60..61,
                    33..131,
                    130..131,
                ] {
                    let found = rows_of(&mut world, &view, rows.clone(), &mut part);
                    let pixels = 160 * rows.start..160 * rows.end;
                    let same = match keep {
                        Keep::Display => found.pixels == whole.pixels[pixels],
                        Keep::Levels => {
                            found.levels == whole.levels[pixels.clone()]
                                && found.triangles == whole.triangles[pixels]
                        }
                    };
                    assert!(same, "rows {rows:?} of {cuboids}, {keep:?}, {view:?}");
                }
            }
        }
    }
}

#[test]
fn a_light_switched_off_and_on_again_leaves_the_same_bits() {
    let mut world = still_life(3);
    for view in views([160, 120]) {
        let expected = Bits::of(&draw(&mut world, &view, Keep::Levels));
        let mut matter = 0;
        for light in 0..5 {
            let mut switch = |on: bool| {
                let lights = world.query_mut::<&mut Light>().into_iter();
                lights
                    .enumerate()
                    .for_each(|(index, other)| other.on = on || index != light);
                Bits::of(&draw(&mut world, &view, Keep::Levels))
            };
            matter += u32::from(switch(false) != expected);
            assert!(switch(true) == expected, "light {light}, {view:?}");
        }
        assert!(
            matter >= 4,
            "every light changes the picture except a highlight that the vertices miss: {matter}"
        );
    }
}

#[test]
fn a_mode_of_their_own_or_of_the_view_gives_the_same_bits() {
    for view in views([160, 120]) {
        let mut world = still_life(3);
        let expected = Bits::of(&draw(&mut world, &view, Keep::Levels));
        for own in world.query_mut::<&mut ShadingMode>() {
            *own = view.shading.expect("every view has a mode");
        }
        let view = View {
            shading: None,
            ..view
        };
        assert!(
            Bits::of(&draw(&mut world, &view, Keep::Levels)) == expected,
            "{view:?}"
        );
    }
}
