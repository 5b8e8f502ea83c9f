//! Random scenes at random tolerances: every pixel is proven. With numbers of any magnitude no pixel is refuted.
//!
//! `SHADETRADE_CASES` sets the number of scenes; the first n are always the same.

use glam::DVec3;
use hecs::World;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use shadetrade::components::{Mesh, ShadingMode, Transform, length};
use shadetrade::prove::Proof;

use super::proof;
use crate::support::cases::cases;
use crate::support::extreme::{Number, extreme, is_legal};
use crate::support::random_scene::{Case, between, case};

const SIZE: [usize; 2] = [48, 36];

/// A scene and a tolerance in levels.
fn asked() -> impl Strategy<Value = (Case, f64)> {
    let mode = prop_oneof![Just(ShadingMode::Gouraud), Just(ShadingMode::Phong)];
    let tolerance = prop_oneof![1 => Just(0.0), 4 => between(1e-4, 8.0)];
    (mode.prop_flat_map(case), tolerance)
}

#[test]
fn every_pixel_of_random_scenes_is_proven() {
    let mut runner = TestRunner::new_with_rng(
        Config::default(),
        TestRng::deterministic_rng(RngAlgorithm::ChaCha),
    );
    let strategy = asked();
    let mut sum = Proof::default();
    let mut worst_share = 0.0_f64;
    let mut unproven = Vec::new();
    let cases = cases(100);
    for number in 0..cases {
        let tree = strategy.new_tree(&mut runner).expect("a scene is found");
        let (case, tolerance) = tree.current();
        let (mut world, view) = case.build(SIZE, tolerance);
        let proof = proof(&mut world, &view);
        if proof.refuted + proof.undecided > 0 {
            let examples = proof.examples.iter();
            let examples = examples.map(|example| {
                let [x, y] = example.pixel;
                let mark = proof.marks[y * SIZE[0] + x];
                let outline = if mark.is_outline { "outline " } else { "" };
                format!("{outline}{example:?}")
            });
            unproven.push(format!(
                "scene {number}, tolerance {tolerance}: {} refuted, {} undecided\n{case:?}\n{}",
                proof.refuted,
                proof.undecided,
                examples.collect::<Vec<_>>().join("\n")
            ));
        }
        let limit = if tolerance > 0.0 { tolerance } else { 0.05 };
        worst_share = worst_share.max(proof.worst / limit);
        sum.proven += proof.proven;
        sum.outline += proof.outline;
        sum.covered += proof.covered;
        sum.widest_enclosure = sum.widest_enclosure.max(proof.widest_enclosure);
        sum.reference_error = sum.reference_error.max(proof.reference_error);
    }
    println!(
        "{cases} scenes: {} proven, {} covered, {} outline; worst {worst_share:.4} of the limit, widest enclosure {:.1e}, \
         reference {:.1e}",
        sum.proven, sum.covered, sum.outline, sum.widest_enclosure, sum.reference_error
    );
    assert!(unproven.is_empty(), "{}", unproven.join("\n\n"));
    assert!(sum.covered * 10 > sum.proven, "cuboids are visible");
    assert!(
        sum.outline * 10 < sum.covered,
        "most covered pixels are proven to be covered"
    );
}

/// The distance of the farthest cuboid in multiples of its smallest edge. Beyond 1e10 f64 may not suffice to tell where a pixel
/// lies on it, the only reason to leave the pixel undecided.
fn distance(world: &mut World, eye: DVec3) -> f64 {
    let cuboids = world.query_mut::<(&Transform, &Mesh)>().into_iter();
    let distances = cuboids.map(|(transform, mesh)| {
        length(transform.position - eye) / (2.0 * mesh.corners[7].min_element())
    });
    distances.fold(0.0, f64::max)
}

#[test]
fn no_pixel_of_random_scenes_with_numbers_of_any_magnitude_is_refuted() {
    let mut runner = TestRunner::new_with_rng(
        Config::default(),
        TestRng::deterministic_rng(RngAlgorithm::ChaCha),
    );
    let strategy = (asked(), prop::collection::vec(extreme(), 1..3));
    let (mut sum, mut legal, mut far) = (Proof::default(), 0, 0);
    let mut wrong = Vec::new();
    let cases = cases(200);
    for number in 0..cases {
        let tree = strategy.new_tree(&mut runner).expect("a scene is found");
        let ((case, tolerance), mut extremes) = tree.current();
        extremes.sort_by_key(|extreme| extreme.number == Number::Gap);
        // In a picture with odd sides the middle line of sight is exact.
        let (mut world, mut view) = case.build([49, 37], tolerance);
        for extreme in &extremes {
            extreme.apply(&mut world, &mut view);
        }
        if !is_legal(&view) {
            continue;
        }
        legal += 1;
        let proof = proof(&mut world, &view);
        let distance = distance(&mut world, view.viewpoint.position);
        if proof.undecided > 0 {
            far += 1;
            println!(
                "scene {number}: {} pixels undecided, {distance:.1e} edges away, tolerance {tolerance:.1e}, {extremes:?}",
                proof.undecided
            );
        }
        if proof.refuted > 0 || proof.undecided > 0 && distance <= 1e10 {
            wrong.push(format!(
                "scene {number}, tolerance {tolerance}, {extremes:?}: {} refuted, {} undecided\n{case:?}\n{:?}",
                proof.refuted, proof.undecided, proof.examples
            ));
        }
        sum.proven += proof.proven;
        sum.undecided += proof.undecided;
        sum.covered += proof.covered;
    }
    println!(
        "{legal} of {cases} scenes: {} proven, {} covered, {} undecided in {far} scenes from afar",
        sum.proven, sum.covered, sum.undecided
    );
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
    assert!(sum.covered * 10 > sum.proven, "cuboids are visible");
    assert!(
        sum.undecided * 100 < sum.proven,
        "hardly any pixel is undecided"
    );
}
