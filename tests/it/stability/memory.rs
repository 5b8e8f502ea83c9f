//! A frame that has been drawn once allocates no more memory for further pictures of that size. Saving it allocates
//! little more than its bytes.

use allocation_counter::measure;
use shadetrade::output::Output;
use shadetrade::output::memory::Content;
use shadetrade::systems;

use super::life::{still_life, views};
use crate::support::prelude::*;

#[test]
fn a_warm_frame_on_one_thread_allocates_nothing() {
    for keep in [Keep::Display, Keep::Levels] {
        for cuboids in [1, 3] {
            let mut world = still_life(cuboids);
            let mut frame = Frame::new(keep, Workers::alone(Level::new()));
            let views = views([160, 120]);
            // The first frame of each mode allocates the memory that is kept for later ones.
            for view in &views {
                systems::draw(&mut world, view, &mut frame).expect("a small picture fits");
            }
            for view in &views {
                let taken = measure(|| {
                    systems::draw(&mut world, view, &mut frame).expect("it fitted before");
                });
                let what = format!("{keep:?}, {cuboids} cuboids, {view:?}");
                assert_eq!(taken.count_total, 0, "{what}");
            }
        }
    }
}

#[test]
fn a_warm_frame_on_several_threads_allocates_nothing() {
    let mut world = still_life(1);
    let workers = Workers::new(2, Level::new()).expect("the system gives threads");
    let mut frame = Frame::new(Keep::Display, workers);
    let mut view = views([400, 320]).swap_remove(0);
    // The cuboid is so large on the screen that several threads draw it.
    view.camera.fov = 10.0;
    systems::draw(&mut world, &view, &mut frame).expect("a small picture fits");
    assert!(frame.counts().covered_pixels > 100_000);
    let taken = measure(|| {
        for _ in 0..20 {
            systems::draw(&mut world, &view, &mut frame).expect("it fitted before");
        }
    });
    // One block of rayon's queue of work, which holds some dozens of entries.
    assert!(taken.count_total <= 1, "{taken:?}");
}

#[test]
fn a_picture_that_memory_cannot_hold_names_its_bytes() {
    // Pixels take 4 bytes, levels 12, kinds 1 and triangles 4.
    let (display, levels) = (Keep::Display, Keep::Levels);
    for (keep, cuboids, bytes) in [
        (display, 1, 4),
        (display, 2, 8),
        (levels, 1, 17),
        (levels, 2, 17),
    ] {
        let mut frame = Frame::new(keep, Workers::alone(Level::new()));
        let view = views([1 << 20, 1 << 20]).swap_remove(0);
        let refused = systems::draw(&mut still_life(cuboids), &view, &mut frame);
        let needed = refused.expect_err("no machine has a terabyte left").needed;
        assert_eq!(needed, bytes << 40, "{keep:?}, {cuboids} cuboids");
    }
}

#[test]
fn grids_that_memory_cannot_hold_name_their_cuboids_and_leave_an_empty_frame() {
    let view = views([40, 30]).swap_remove(0).shaded(ShadingMode::Gouraud);
    let mut frame = Frame::new(Keep::Display, Workers::alone(Level::new()));
    systems::draw(&mut still_life(1), &view, &mut frame).expect("a small picture fits");
    assert_eq!(frame.pixels().len(), 40 * 30);
    let mut crowd = World::new();
    let segments = Segments::new(256).expect("it is legal");
    crowd.spawn_batch((0..1_000_000).map(|_| (ShadingMode::Gouraud, segments)));
    crowd.spawn((ShadingMode::Phong, segments));
    crowd.spawn((ShadingMode::Gouraud, Segments::default()));
    let view = View {
        shading: None,
        ..view
    };
    let refused = systems::draw(&mut crowd, &view, &mut frame).expect_err("it takes terabytes");
    assert_eq!(refused.content, Content::Grids(1_000_000));
    // Three faces are seen at most, and a point has three numbers of eight bytes.
    assert_eq!(refused.needed, 1_000_000 * 3 * 257 * 257 * 24);
    assert_eq!((frame.size(), frame.pixels().len()), ([0, 0], 0));
}

#[test]
fn saving_a_picture_allocates_its_bytes_and_the_file() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let output = Output::File(folder.path().join("a.png"));
    let size = [1000, 2000];
    // Noise, which cannot be compressed.
    let noise = |pixel: u32| pixel.wrapping_mul(0x9e37_79b9) >> 8;
    let pixels: Vec<u32> = (0..2_000_000).map(noise).collect();
    let taken = measure(|| output.write_png(&pixels, size).expect("written"));
    let bytes = 3 * pixels.len() as u64;
    assert!(taken.bytes_max < 6 * bytes, "{taken:?} for {bytes}");
}
