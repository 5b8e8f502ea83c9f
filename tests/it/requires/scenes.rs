//! Random scenes: bounds proven for the picture without a part hold for the pictures in f64.
//!
//! `SHADETRADE_CASES` sets the number of scenes; the first n are always the same.

use proptest::prelude::*;
use shadetrade::questions::metrics::pixel_error;
use shadetrade::questions::requires::{Part, parts, without};
use shadetrade::reference::{Interval, Real, Reference, Rule, Seen};

use super::change;
use crate::support::prelude::*;
use crate::support::random_scene::{between, case};

const SIZE: [usize; 2] = [32, 24];

/// The levels of every pixel, row by row.
fn levels<R: Real>(world: &World, view: &View, rule: Option<Rule>) -> Vec<[f64; 3]> {
    pixels::<R, _>(world, view, rule, |seen| {
        seen[0].levels.map(|level| level.endpoints()[0])
    })
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

#[test]
fn no_proven_bound_of_random_scenes_is_contradicted_by_f64() {
    /// The error of f64 itself, in levels.
    const ROUNDING: f64 = 1e-6;
    let mode = proptest::sample::select(ShadingMode::ALL.to_vec());
    let tolerance = prop_oneof![1 => Just(0.0), 4 => between(1e-3, 8.0)];
    let asked = (mode.prop_flat_map(case), tolerance);
    let (mut all, mut required, mut false_alarms) = (0_u32, 0_u32, 0_u32);
    for (number, (case, tolerance)) in values(&asked, cases(5)).enumerate() {
        let scene = Scene::spawn("random".to_owned(), &case.record(tolerance));
        let view = View::of(&scene.world, SIZE);
        let limit = limit(tolerance);
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
                Part::F64 => levels::<f32>(&other, &view, rule),
                _ => levels::<f64>(&other, &view, rule),
            };
            let is_certain = is_certain(&other, &view, rule);
            let (mut largest, mut certain, mut changed) = (0.0_f64, 0.0_f64, 0);
            for (pixel, full) in full.iter().enumerate() {
                let error = pixel_error(*full, levels[pixel]);
                largest = largest.max(error);
                changed += u64::from(error + ROUNDING > limit);
                if is_certain_in_full[pixel] && is_certain[pixel] {
                    certain = certain.max(error);
                }
            }
            let keeps = change.keeps(tolerance);
            let what = format!(
                "scene {number}, {name}, tolerance {tolerance}: {change:?}, in f64 {certain} and {largest}\n{case:?}",
            );
            assert!(certain <= most + ROUNDING, "{what}");
            assert!(least <= largest + ROUNDING, "{what}");
            assert!(change.pixels <= changed, "{changed} pixels: {what}");
            assert!(!keeps || certain <= limit, "{what}");
            // Only a pixel that may show several surfaces makes a part required that f64 does not require.
            let all_certain = is_certain_in_full.iter().chain(&is_certain).all(|it| *it);
            assert!(keeps || largest > limit || !all_certain, "{what}");
            all += 1;
            required += u32::from(!keeps);
            false_alarms += u32::from(!keeps && largest <= limit);
        }
    }
    println!("{all} parts: {required} required, {false_alarms} of them not according to f64");
    assert!(required > all / 10 && required < all * 9 / 10);
    assert!(false_alarms * 20 <= required);
}
