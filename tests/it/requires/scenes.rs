//! Random scenes: bounds proven for the picture without a part hold for the pictures in f64.
//!
//! `SHADETRADE_CASES` sets the number of scenes; the first n are always the same.

use hecs::World;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use shadetrade::components::{ShadingMode, View};
use shadetrade::reference::{Interval, Real, Reference, Rule, Seen};
use shadetrade::requires::{Part, parts, without};
use shadetrade::trade::metrics::displayed;

use super::{change, scene_of};
use crate::support::cases::cases;
use crate::support::random_scene::{Case, between, case};

const SIZE: [usize; 2] = [32, 24];

fn asked() -> impl Strategy<Value = (Case, f64)> {
    let mode = prop_oneof![Just(ShadingMode::Gouraud), Just(ShadingMode::Phong)];
    let tolerance = prop_oneof![1 => Just(0.0), 4 => between(1e-3, 8.0)];
    (mode.prop_flat_map(case), tolerance)
}

/// The displayed levels of every pixel, row by row.
fn levels<R: Real>(world: &World, view: &View, rule: Option<Rule>) -> Vec<[f64; 3]> {
    let of = |seen: &[Seen<R>]| seen[0].levels.map(|level| displayed(level.endpoints()[0]));
    pixels::<R, _>(world, view, rule, of)
}

/// Whether every pixel certainly shows one surface: no edge is near, and no gate is tied.
fn is_certain(world: &World, view: &View, rule: Option<Rule>) -> Vec<bool> {
    pixels::<Interval, _>(world, view, rule, |seen| seen.len() == 1)
}

fn pixels<R: Real, T>(
    world: &World,
    view: &View,
    rule: Option<Rule>,
    of: impl Fn(&[Seen<R>]) -> T,
) -> Vec<T> {
    let reference = Reference::<R>::without(world, view, rule);
    let mut pixels = Vec::new();
    for y in 0..view.size[1] {
        reference.row(y, |_, seen| pixels.push(of(seen)));
    }
    pixels
}

fn error(left: [f64; 3], right: [f64; 3]) -> f64 {
    let errors = left
        .iter()
        .zip(right)
        .map(|(left, right)| (left - right).abs());
    errors.fold(0.0, f64::max)
}

#[test]
fn no_proven_bound_of_random_scenes_is_contradicted_by_f64() {
    /// The error of f64 itself, in levels.
    const ROUNDING: f64 = 1e-6;
    let mut runner = TestRunner::new_with_rng(
        Config::default(),
        TestRng::deterministic_rng(RngAlgorithm::ChaCha),
    );
    let strategy = asked();
    let (mut all, mut required, mut false_alarms) = (0_u32, 0_u32, 0_u32);
    for number in 0..cases(16) {
        let tree = strategy.new_tree(&mut runner).expect("a scene is found");
        let (case, tolerance) = tree.current();
        let (world, view) = case.build(SIZE, tolerance);
        let scene = scene_of(world, &view);
        let limit = if tolerance > 0.0 { tolerance } else { 0.05 };
        let full = levels::<f64>(&scene.world, &view, None);
        let is_certain_in_full = is_certain(&scene.world, &view, None);
        for (part, name) in parts(&scene) {
            let change = change(&scene, &view, part);
            let [least, most] = change.largest_error;
            let rule = match part {
                Part::Rule(rule) => Some(rule),
                _ => None,
            };
            let other = without(&scene, &[part]).world;
            let levels = match part {
                Part::F64SetUp => levels::<f32>(&other, &view, rule),
                _ => levels::<f64>(&other, &view, rule),
            };
            let errors = || {
                full.iter()
                    .zip(&levels)
                    .map(|(full, other)| error(*full, *other))
            };
            let certain = is_certain_in_full
                .iter()
                .zip(is_certain(&other, &view, rule));
            let of_certain = errors()
                .zip(certain)
                .filter(|(_, (full, other))| **full && *other);
            let largest_of_certain = of_certain.map(|(error, _)| error).fold(0.0, f64::max);
            let largest = errors().fold(0.0, f64::max);
            let changed = errors().filter(|error| error + ROUNDING > limit).count();
            let what = format!(
                "scene {number}, {name}, tolerance {tolerance}: {change:?}, in f64 {largest_of_certain} and {largest}\n{case:?}",
            );
            assert!(largest_of_certain <= most + ROUNDING, "{what}");
            assert!(least <= largest + ROUNDING, "{what}");
            assert!(change.pixels <= changed as u64, "{changed} pixels: {what}");
            assert!(
                !change.keeps(tolerance) || largest_of_certain <= limit,
                "{what}"
            );
            all += 1;
            required += u32::from(!change.keeps(tolerance));
            false_alarms += u32::from(!change.keeps(tolerance) && largest <= limit);
        }
    }
    println!("{all} parts: {required} required, {false_alarms} of them not according to f64");
    assert!(
        required > all / 10 && required < all * 9 / 10,
        "{required} of {all}"
    );
    assert!(
        false_alarms * 50 <= required,
        "{false_alarms} of {required}"
    );
}
