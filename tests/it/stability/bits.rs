//! A picture of small faces has the same bits with any number of threads, and any picture at any SIMD level. `rasterization`
//! compares threads and parts of pictures of large faces.

use shadetrade::shading::simd;
use shadetrade::systems;

use super::life::{Bits, still_life, views};
use crate::support::prelude::*;

const KEEPS: [Keep; 2] = [Keep::Levels, Keep::Display];

fn frame(keep: Keep, threads: usize, level: Level) -> Frame {
    let workers = Workers::new(threads, level).expect("the system gives threads");
    Frame::new(keep, workers)
}

#[test]
fn small_faces_across_the_bands_of_threads_are_counted_as_by_one_thread() {
    // 26 x 21 cuboids of about 15 pixels: many cross rows at which the picture may be cut.
    let mut world = still_life(1);
    for index in 0..26 * 21 {
        let [x, y] = [index % 26, index / 26].map(f64::from);
        let rotation = DVec3::splat(7.0 * f64::from(index));
        let transform = placed([x - 12.5, y - 10.0, 3.0], rotation);
        spawn_cuboid(&mut world, DVec3::splat(0.7), transform, white(20.0));
    }
    let eye = DVec3::new(0.0, 0.0, 30.0);
    let mut view = view([400, 320], eye, DVec3::ZERO, Projection::Orthographic);
    view.camera.height = 20.0;
    for mode in ShadingMode::ALL {
        let view = view.shaded(mode);
        let alone = draw(&mut world, &view, Keep::Display);
        assert!(alone.counts().covered_pixels > 60_000);
        for threads in [2, 5] {
            let mut frame = frame(Keep::Display, threads, Level::new());
            systems::draw(&mut world, &view, &mut frame).expect("a small picture fits");
            let drawn = [&frame, &alone].map(|it| (Bits::of(it), it.counts()));
            assert!(drawn[0] == drawn[1], "{threads} threads, {view:?}");
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
            for view in views([96, 80]) {
                let expected = Bits::of(&draw(&mut world, &view, keep));
                for &level in &levels {
                    let mut frame = frame(keep, 1, level);
                    systems::draw(&mut world, &view, &mut frame).expect("a small picture fits");
                    let same = Bits::of(&frame) == expected;
                    assert!(same, "{}, {view:?}", simd::name(level));
                }
            }
        }
    }
}

#[test]
fn silhouettes_do_not_depend_on_segments() {
    let mut world = still_life(3);
    for view in views([96, 80]) {
        let mut view = view.shaded(ShadingMode::Gouraud);
        let mut drawn = |cells| {
            view.segments = Segments::new(cells);
            Bits::of(&draw(&mut world, &view, Keep::Levels))
        };
        let one = drawn(1);
        for cells in [2, 7, 256] {
            let more = drawn(cells);
            assert!(more.triangles == one.triangles, "{cells}");
            assert!(more.levels != one.levels, "{cells}");
        }
    }
}
