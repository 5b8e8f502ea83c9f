//! Random scenes at random tolerances: every pixel is proven. With numbers of any magnitude no pixel is refuted.
//!
//! `SHADETRADE_CASES` sets the number of scenes; the first n are always the same.

use proptest::prelude::*;

use super::proof;
use crate::support::extreme::{exaggerated, flatten, graze};
use crate::support::prelude::*;
use crate::support::random_scene::{Case, between, case};

/// A scene and a tolerance in levels.
fn asked() -> impl Strategy<Value = (Case, f64)> {
    let mode = proptest::sample::select(ShadingMode::ALL.to_vec());
    let tolerance = prop_oneof![1 => Just(0.0), 4 => between(1e-4, 8.0)];
    (mode.prop_flat_map(case), tolerance)
}

#[test]
fn every_pixel_of_random_scenes_is_proven() {
    let (mut covered, mut outline, mut proven, mut error) = (0, 0, 0, 0.0_f64);
    for (case, tolerance) in values(&asked(), cases(25)) {
        let (mut world, view) = case.build([96, 72], tolerance);
        let proof = proof(&mut world, &view);
        let what = format!("tolerance {tolerance}: {proof:?}\n{case:?}");
        assert_eq!([proof.refuted, proof.undecided], [0, 0], "{what}");
        // The possible error holds the enclosure's width.
        let expected = proof.widest_enclosure.max(1e-6);
        assert!(proof.reference_error < expected, "{what}");
        let outlines = proof.marks.iter().filter(|mark| mark.is_outline).count();
        assert_eq!(proof.outline, outlines as u64, "{what}");
        error = error.max(proof.reference_error);
        covered += proof.covered;
        outline += proof.outline;
        proven += proof.proven;
    }
    assert!(covered * 10 > proven, "{covered} of {proven} are covered");
    assert!(0 < outline && outline * 10 < covered, "{outline}");
    assert!(error > 0.0, "f64 rounds");
}

/// The distance of the farthest cuboid in multiples of its smallest edge. Beyond 1e10 f64 may not suffice to tell where a pixel
/// lies on it, the only reason here to leave the pixel undecided.
fn distance(world: &mut World, eye: DVec3) -> f64 {
    let cuboids = world.query_mut::<(&Transform, &Mesh)>().into_iter();
    let distances = cuboids.map(|(transform, mesh)| {
        length(transform.position - eye) / (2.0 * mesh.corners[7].min_element())
    });
    distances.fold(0.0, f64::max)
}

#[test]
fn no_pixel_of_random_scenes_with_numbers_of_any_magnitude_is_refuted_or_undefined() {
    let mut sum = [0; 3];
    let random = &mut Random(9);
    for (case, tolerance) in values(&asked(), cases(30)) {
        let mut record = case.record(tolerance);
        for _ in 0..=random.below(2) {
            record = exaggerated(&record, random);
        }
        match random.below(4) {
            0 => graze(&mut record, random),
            1 => flatten(&mut record, random),
            _ => (),
        }
        if record.check().is_err() {
            continue;
        }
        let mut world = record.spawn();
        // In a picture with odd sides the middle line of sight is exact.
        let view = View::of(&world, [97, 73]);
        let proof = proof(&mut world, &view);
        let is_far = distance(&mut world, view.camera.position) > 1e10;
        let is_right = proof.refuted == 0 && (proof.undecided == 0 || is_far);
        assert!(is_right, "{record:?}\n{:?}", proof.examples);
        for mode in [ShadingMode::UnitVectors, ShadingMode::BlinnPhong] {
            let shortcut = truth(&world, &view.shaded(mode));
            let mut levels = shortcut.levels.as_flattened().iter();
            assert!(!levels.any(|it| it.is_nan()), "{mode:?}: {record:?}");
        }
        let counts = [proof.proven, proof.covered, proof.undecided];
        sum = [0, 1, 2].map(|i| sum[i] + counts[i]);
    }
    let [proven, covered, undecided] = sum;
    assert!(covered * 10 > proven, "{covered} of {proven} are covered");
    assert!(undecided * 100 < proven, "{undecided} are undecided");
}
