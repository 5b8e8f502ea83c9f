//! The choice of a method for a time, on costs that nobody measured.

use shadetrade::components::ShadingMode::{Gouraud, Phong};
use shadetrade::shading::Method;
use shadetrade::trade::budget::{Hold, best_trades, fitting, held};

use super::example::live;
use crate::support::random::Random;

/// Milliseconds of a front, the fastest first.
const COSTS: [f64; 6] = [0.2, 0.31, 0.36, 0.41, 0.5, 1.0];
const BUDGET: f64 = 0.45;

/// Draws frames of a scene that is `load` times as dear as measured, with this share of noise; the places chosen, and
/// whether each frame was over the budget.
fn drawn(
    hold: &mut Hold,
    frames: usize,
    load: f64,
    noise: f64,
    random: &mut Random,
) -> Vec<(usize, bool)> {
    let mut frame = || {
        let place = hold.place;
        let time = COSTS[place] * load * (1.0 + noise * random.within(-1.0, 1.0));
        *hold = hold.after(time, &COSTS, BUDGET);
        (place, time > BUDGET)
    };
    (0..frames).map(|_| frame()).collect()
}

#[test]
fn at_rest_the_most_exact_method_that_fits_is_chosen() {
    for (budget, place) in [(5.0, 5), (1.0, 5), (0.99, 4), (0.36, 2), (0.2, 0), (0.1, 0)] {
        assert_eq!(fitting(&COSTS, budget), place, "{budget} ms");
    }
    assert_eq!(fitting(&[], 1.0), 0);
}

#[test]
fn no_frame_is_over_the_budget_twice_where_a_cheaper_one_fits() {
    let mut random = Random(1);
    for _ in 0..500 {
        let mut hold = Hold::at(random.within(0.0, 6.0) as usize);
        let load = random.within(0.3, 2.0);
        let frames = drawn(&mut hold, 200, load, 0.1, &mut random);
        let is_over = |pair: &[(usize, bool)]| pair[0].1 && pair[1].1;
        assert!(!frames.windows(2).any(is_over), "load {load}: {frames:?}");
    }
    // Nothing fits: the fastest is drawn.
    let mut hold = Hold::at(5);
    let frames = drawn(&mut hold, 10, 5.0, 0.1, &mut random);
    let mut frames = frames[1..].iter();
    assert!(frames.all(|frame| *frame == (0, true)));
    // Another scene may have fewer methods.
    assert!(Hold::at(5).after(1.0, &[1.0, 2.0], 9.0).place < 2);
}

#[test]
fn noise_makes_nothing_flicker() {
    let mut random = Random(2);
    for _ in 0..200 {
        let load = random.within(0.3, 3.0);
        for (noise, most) in [(0.1, 4), (0.4, 46)] {
            let mut hold = Hold::at(3);
            let frames = drawn(&mut hold, 1000, load, noise, &mut random);
            let changes = frames.windows(2).filter(|it| it[0].0 != it[1].0).count();
            assert!(changes <= most, "load {load}, noise {noise}: {changes}");
        }
    }
}

#[test]
fn a_method_that_was_given_up_comes_back_when_there_is_time_again() {
    let mut random = Random(3);
    for load in [1.6, 3.0, 20.0] {
        let mut hold = Hold::at(3);
        drawn(&mut hold, 20, load, 0.05, &mut random);
        assert!(hold.place < 3, "load {load}");
        drawn(&mut hold, 200, 0.8, 0.05, &mut random);
        assert!(hold.place >= 2, "load {load}: {hold:?}");
    }
    // A method that fits every second frame is not taken.
    let mut hold = Hold::at(3);
    for frame in 0..1000 {
        hold = hold.after([0.1, 0.4][frame % 2], &COSTS, BUDGET);
        assert_eq!(hold.place, 3, "frame {frame}");
    }
    // Every twentieth frame is interrupted, for longer than the budget.
    let mut hold = Hold::at(3);
    for _ in 0..15 {
        hold = hold.after(30.0, &COSTS, BUDGET);
        assert!(hold.place < 3);
        drawn(&mut hold, 19, 0.8, 0.05, &mut random);
    }
    assert!(hold.place >= 2, "{hold:?}");
}

#[test]
fn best_trades_are_ordered_from_the_fastest_on() {
    let mut measured = vec![
        live(Method::of(Phong, 0.0), 1.0, 0.0),
        live(Method::of(Gouraud, 0.5), 0.2, 165.0),
        live(Method::of(Phong, 4.0), 0.3, 3.9),
    ];
    measured[2].on_front = false;
    let methods = [Method::of(Gouraud, 0.5), Method::of(Phong, 0.0)];
    assert_eq!(best_trades(&measured), (methods.to_vec(), vec![0.2, 1.0]));
    let says = |budget| held(&measured, budget).expect("something is drawn");
    let (chosen, text) = says(1.5);
    assert_eq!(chosen.method, Method::of(Phong, 0.0));
    assert!(text.contains("1.00 ms") && !text.contains("over"), "{text}");
    let (chosen, text) = says(0.15);
    assert_eq!(chosen.method, Method::of(Gouraud, 0.5));
    assert!(text.contains("0.050 ms over the budget; nothing"), "{text}");
    assert!(text.contains("165"), "{text}");
    assert!(held(&[], 1.0).is_none());
}
