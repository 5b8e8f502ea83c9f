//! The enclosures against a second arithmetic: the textbook's formula in floats of 256 bits.
//!
//! The value with 256 bits stands for the exact one: its relative error is some 1e-70.

use shadetrade::reference::{Interval, Real, Seen};

use super::naive::{Big, Scene, big, power, sine_and_cosine};
use super::{enclosures, known};
use crate::support::prelude::*;
use crate::support::random_scene::case;

/// Whether an enclosure holds a value.
fn holds(enclosure: Interval, value: &Big) -> bool {
    let [least, largest] = enclosure.endpoints();
    (least.is_infinite() || big(least) <= *value)
        && (largest.is_infinite() || *value <= big(largest))
}

/// Compares every `stride`-th pixel with a single possible surface; returns the largest width of an enclosure and the
/// number of pixels.
pub fn compare(
    scene: &Scene,
    width: usize,
    pixels: &[Vec<Seen<Interval>>],
    stride: usize,
) -> (f64, usize) {
    let mut widest = 0.0_f64;
    let mut compared = 0;
    for (pixel, seen) in pixels.iter().enumerate().step_by(stride) {
        let [seen] = &seen[..] else { continue };
        let Some(face) = seen.face() else { continue };
        let at = [pixel % width, pixel / width];
        let exact = scene.levels(face, at);
        for (level, exact) in seen.levels.into_iter().zip(&exact) {
            let [least, largest] = level.endpoints();
            assert!(holds(level, exact), "{at:?}: {exact:?} is not in {level:?}");
            // Outside of the displayed range the width is not in levels of 255.
            if largest < 1000.0 {
                widest = widest.max(largest - least);
            }
        }
        compared += 1;
    }
    (widest, compared)
}

#[test]
fn enclosures_of_random_scenes_hold_the_value_and_are_narrow() {
    const SIZE: [usize; 2] = [48, 36];
    let mut sum = (0.0_f64, 0);
    let count = cases(4);
    for mode in [ShadingMode::Gouraud, ShadingMode::Phong] {
        for case in values(&case(mode), count) {
            let (world, view) = case.build(SIZE, 0.0);
            let pixels = enclosures(&world, &view);
            let (widest, compared) = compare(&Scene::new(&world, &view), SIZE[0], &pixels, 37);
            sum = (sum.0.max(widest), sum.1 + compared);
        }
    }
    println!("{} pixels, widest enclosure {:.1e}", sum.1, sum.0);
    assert!(sum.1 > 15 * count, "{} pixels were compared", sum.1);
    assert!(sum.0 < 1e-6, "an enclosure {} wide", sum.0);
}

#[test]
fn a_corner_of_a_cuboid_of_2e14_units_has_a_narrow_enclosure() {
    for projection in Projection::ALL {
        for mode in [ShadingMode::Gouraud, ShadingMode::Phong] {
            let (world, view) = known::vast_cuboid(projection, mode);
            let pixels = enclosures(&world, &view);
            let (widest, compared) = compare(&Scene::new(&world, &view), view.size[0], &pixels, 1);
            println!("{mode:?} {projection:?}: {compared} pixels, widest {widest:.1e}");
            assert!(compared > 100, "{compared} pixels were compared");
            assert!(widest < 1e-3, "an enclosure {widest} wide");
        }
    }
}

/// Whether the result of an operation holds the value and is at most a few units in the last place wide.
fn assert_sharp(name: &str, at: f64, enclosure: Interval, value: &Big) {
    let what = format!("{name} at {at:e}: {enclosure:?}");
    assert!(holds(enclosure, value), "{what}, not {value:?}");
    let [least, largest] = enclosure.endpoints();
    let size = least.abs().max(largest.abs());
    assert!(largest - least <= 1e-14 * size, "{what} is wide");
}

#[test]
fn sines_cosines_and_powers_enclose_the_value_of_the_second_arithmetic() {
    let mut random = Random(7);
    for _ in 0..cases(200) {
        let degrees = random.within(-45.0, 45.0);
        let [found_sin, found_cos] = Interval::sin_cos(degrees);
        let [sin, cos] = sine_and_cosine(degrees);
        assert_sharp("sine", degrees, found_sin, &sin);
        assert_sharp("cosine", degrees, found_cos, &cos);
        let half = random.within(1e-3, 89.5);
        let [found_sin, found_cos] = Interval::sin_cos(half);
        let [sin, cos] = sine_and_cosine(half);
        let tan = found_sin / found_cos;
        assert!(holds(tan, &(sin / cos)), "tangent of {half}: {tan:?}");

        let base = 1.0 - 10.0_f64.powf(random.within(-15.0, 0.0));
        let exponent = 10.0_f64.powf(random.within(-3.0, 6.0));
        let found = Interval::of(base).power(exponent);
        let exact = power(&big(base), exponent);
        assert!(holds(found, &exact), "{base}^{exponent}: {found:?}");
        let [least, largest] = found.endpoints();
        assert!(largest - least < 1e-9, "{base}^{exponent}: {found:?}");
    }
}
