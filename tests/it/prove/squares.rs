//! Squares of pixels that are enclosed at once: their enclosures hold those of each pixel by itself.

use shadetrade::questions::prove::{nearest, shown};
use shadetrade::reference::{Interval, MAX_ENCLOSED_SIDE, Real, Reference};

use super::{enclosures, proof};
use crate::support::prelude::*;
use crate::support::random_scene::case;

/// Asserts that every pixel of the squares with at most this error shows one surface, and that its levels lie within those of its
/// square. Returns the number of such pixels, and the largest distance of a level from the middle of its square's enclosure, as
/// a share of the largest allowed.
fn compare(world: &World, view: &View, error: f64) -> (usize, f64) {
    let reference = Reference::<Interval>::new(world, view);
    let (mut pixels, mut share) = (0, 0.0_f64);
    for start in (0..view.size[1]).step_by(MAX_ENCLOSED_SIDE) {
        let strip = start..(start + MAX_ENCLOSED_SIDE).min(view.size[1]);
        for square in reference.squares(&strip, error) {
            for y in square.rows.clone() {
                for (x, levels) in square.columns.clone().zip(square.row(y)) {
                    // Several where a gate is tied.
                    for alone in reference.at([x, y]) {
                        let triangle = alone.triangle.unwrap_or(TriangleId::NONE);
                        assert_eq!(triangle.face_id(), square.triangle.face_id(), "{x},{y}");
                        for channel in 0..3 {
                            let [least, largest] = alone.levels[channel].endpoints();
                            let (level, error) = (levels[channel], square.error[channel]);
                            let what = format!("{x},{y}: {least}..{largest} in {level}±{error}");
                            let is_inside = level - error <= least && largest <= level + error;
                            assert!(is_inside, "{what}");
                            // The background has no error.
                            let distance = (least.midpoint(largest) - level).abs();
                            share = share.max(distance / error.max(f64::MIN_POSITIVE));
                        }
                    }
                    pixels += 1;
                }
            }
        }
    }
    (pixels, share)
}

#[test]
fn a_square_encloses_each_of_its_pixels() {
    for name in ["cuboid", "bench-far", "bench-close"] {
        let scene = Scene::load(Some(name)).expect("built in");
        let view = view_from(&scene, 0, [160, 120]).shaded(ShadingMode::Phong);
        let (all, share) = compare(&scene.world, &view, f64::INFINITY);
        assert!(all > 2000, "{name}: {all} pixels");
        assert!((0.05..=1.0).contains(&share), "{name}: {share}");
        let (close, _) = compare(&scene.world, &view, 0.125);
        assert!((500..=all).contains(&close), "{name}: {close} of {all}");
    }
}

#[test]
fn squares_of_random_scenes_enclose_each_of_their_pixels() {
    let (mut pixels, mut share) = (0, 0.0_f64);
    for case in values(&case(ShadingMode::Phong), cases(25)) {
        // In a small picture vectors change much over a square.
        for size in [[96, 72], [40, 30]] {
            let (world, view) = case.build(size, 0.5);
            let (more, largest) = compare(&world, &view, f64::INFINITY);
            pixels += more;
            share = share.max(largest);
        }
    }
    assert!(pixels > 5000, "{pixels} pixels");
    assert!((0.1..=1.0).contains(&share), "{share}");
}

#[test]
fn a_proof_in_squares_finds_the_error_of_a_proof_of_each_pixel() {
    let (mut in_squares, mut covered) = (0, 0);
    for case in values(&case(ShadingMode::Phong), cases(25)) {
        let (mut world, view) = case.build([96, 72], 0.5);
        let proof = proof(&mut world, &view);
        let frame = draw(&mut world, &view, Keep::Levels);
        let alone = enclosures(&world, &view);
        let errors = alone.iter().enumerate().map(|(pixel, seen)| {
            let (face, levels) = shown(&frame, pixel);
            nearest(face, levels, seen)
        });
        let mut each = errors.clone();
        let is_proven = each.all(|error| error.is_some_and(|[_, most]| most <= 0.5));
        assert!(is_proven, "{case:?}");
        assert_eq!(proof.proven, alone.len() as u64, "{case:?}");
        let most = errors.flatten().map(|[_, most]| most);
        let worst = most.fold(0.0, f64::max);
        assert_eq!(proof.worst, worst, "{case:?}");
        in_squares += proof.in_squares;
        covered += proof.covered;
    }
    assert!(3 * in_squares > covered, "{in_squares} of {covered} pixels");
}
