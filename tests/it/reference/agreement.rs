//! The renderer against the reference, on random scenes.
//!
//! `SHADETRADE_CASES` sets the number of scenes (default 64); the first n are always the same.

use std::cell::RefCell;

use fearless_simd::Level;
use hecs::World;
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use shadetrade::components::{Projection, ShadingMode, View};
use shadetrade::frame::{Frame, Keep, Workers};
use shadetrade::reference::at_pixel;
use shadetrade::systems;
use shadetrade::trade::metrics::{Picture, compare, pixel_error};

use super::invariance::mixed_scene;
use super::scenes::draw;
use crate::support::cases::cases;
use crate::support::random_scene::case;

const SIZE: [usize; 2] = [64, 48];

/// The largest error at tolerance 0, in levels of 255.
const EXACT: f64 = 0.05;

/// Tolerances below [`EXACT`], from the least permitted one, in levels.
const FINE: [f64; 5] = [1e-4, 3e-4, 1e-3, 5e-3, 0.02];

/// The number of pixels whose centre may change sides when snapping moves vertices by up to 1/512 pixel: a few on each
/// of some 30 edges.
const SNAPPED: u64 = 60;

/// Whether a light grazes the surface at this pixel, so that the gate of its highlight is ambiguous.
fn is_exact_tie(world: &World, view: &View, x: usize, y: usize) -> bool {
    at_pixel(world, view, x, y).is_some_and(|seen| {
        seen.lights
            .iter()
            .filter_map(|light| light.to_light)
            .any(|l| seen.normal.dot(l).abs() < 1e-6)
    })
}

#[test]
fn gouraud_keeps_its_tolerance_where_both_show_one_face() {
    check(ShadingMode::Gouraud, 0.0);
    for tolerance in FINE.into_iter().chain([0.5]) {
        check(ShadingMode::Gouraud, tolerance);
    }
}

#[test]
fn phong_keeps_its_tolerance_where_both_show_one_face() {
    check(ShadingMode::Phong, 0.0);
    for tolerance in FINE.into_iter().chain([0.5, 4.0]) {
        check(ShadingMode::Phong, tolerance);
    }
}

#[test]
fn unit_vectors_keep_their_tolerance_where_both_show_one_face() {
    check(ShadingMode::UnitVectors, 0.0);
}

#[test]
fn scenes_far_from_the_origin_or_at_the_limits_of_length_keep_the_tolerance() {
    let workers = Workers::new(1, Level::new()).expect("one thread is always there");
    let mut frame = Frame::new(Keep::Levels, workers);
    for projection in [Projection::Perspective, Projection::Orthographic] {
        for (offset, scale) in [(1e9, 1.0), (0.0, 1e98), (0.0, 1e-98)] {
            for mode in [ShadingMode::Gouraud, ShadingMode::Phong] {
                let (mut world, view) = mixed_scene(offset, scale, projection);
                let view = view.shaded(mode);
                let truth = draw(&world, &view);
                systems::draw(&mut world, &view, &mut frame).expect("a small picture fits");
                let difference = compare(Picture::from(&frame), Picture::from(&truth));
                let error = difference.error.expect("something is seen");
                assert!(error.max <= EXACT, "{error:?} at {offset} {scale} {mode:?}");
                assert!(
                    difference.edge_pixels <= 3,
                    "{difference:?} at {offset} {scale} {mode:?}"
                );
            }
        }
    }
}

/// Compares random scenes of the renderer with the reference. No pixel may err by more than the tolerance, or by 0.05
/// level at tolerance 0, and no byte by more than half a level more.
fn check(mode: ShadingMode, tolerance: f64) {
    let promise = if tolerance > 0.0 { tolerance } else { EXACT };
    let config = Config {
        cases: cases(64) as u32,
        failure_persistence: None,
        ..Config::default()
    };
    let mut runner =
        TestRunner::new_with_rng(config, TestRng::deterministic_rng(RngAlgorithm::ChaCha));
    let workers = Workers::new(1, Level::new()).expect("one thread is always there");
    let frame = RefCell::new(Frame::new(Keep::Levels, workers));
    let display = RefCell::new(Frame::new(Keep::Display, Workers::alone(Level::new())));
    let worst = RefCell::new((0.0, None));
    let compared = RefCell::new([0, 0]);
    runner
        .run(&case(mode), |case| {
            let (mut world, view) = case.build(SIZE, tolerance);
            let truth = draw(&world, &view);
            let mut frame = frame.borrow_mut();
            systems::draw(&mut world, &view, &mut frame).expect("a small picture fits");
            let mut display = display.borrow_mut();
            systems::draw(&mut world, &view, &mut display).expect("a small picture fits");
            let (drawn, expected) = (Picture::from(&*frame), Picture::from(&truth));
            for pixel in (0..SIZE[0] * SIZE[1]).filter(|pixel| drawn.shows_as(&expected, *pixel)) {
                let [x, y] = [pixel % SIZE[0], pixel / SIZE[0]];
                let [_, bytes @ ..] = display.pixels()[pixel].to_be_bytes();
                let shown = pixel_error(bytes.map(f64::from), expected.levels[pixel]) - 0.5;
                let error = pixel_error(drawn.levels[pixel], expected.levels[pixel]).max(shown);
                let noteworthy = error > promise || error > worst.borrow().0;
                if noteworthy && !is_exact_tie(&world, &view, x, y) {
                    prop_assert!(
                        error <= promise,
                        "pixel ({x}, {y}) errs by {error}: {:?}, shown as {bytes:?}, not {:?}",
                        drawn.levels[pixel],
                        expected.levels[pixel]
                    );
                    *worst.borrow_mut() = (error, Some(case.clone()));
                }
            }
            let difference = compare(drawn, expected);
            prop_assert!(
                difference.edge_pixels <= SNAPPED,
                "{} edge pixels",
                difference.edge_pixels
            );
            let mut compared = compared.borrow_mut();
            compared[0] += difference.compared_pixels;
            compared[1] += difference.edge_pixels;
            Ok(())
        })
        .unwrap_or_else(|failure| panic!("{failure}"));
    println!("{mode:?}: worst error {:?}", worst.borrow());
    println!(
        "{mode:?}: compared pixels, edge pixels {:?}",
        compared.borrow()
    );
}
