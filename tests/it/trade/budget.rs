//! The choice of a method for a time, on costs that nobody measured.

use shadetrade::components::ShadingMode::{Gouraud, Phong, UnitVectors};
use shadetrade::questions::job::Drawing;
use shadetrade::questions::trade::Request;
use shadetrade::questions::trade::budget::{after, best_trades, choose, fitting, held};

use super::example::live;
use crate::support::prelude::*;

/// Milliseconds of a front, the fastest first.
const COSTS: [f64; 6] = [0.2, 0.31, 0.36, 0.41, 0.5, 1.0];
const BUDGET: f64 = 0.45;

#[test]
fn at_rest_the_most_exact_method_that_fits_is_chosen() {
    for (budget, place) in [(5.0, 5), (1.0, 5), (0.99, 4), (0.36, 2), (0.2, 0), (0.1, 0)] {
        assert_eq!(fitting(&COSTS, budget), place, "{budget} ms");
    }
    assert_eq!(fitting(&[], 1.0), 0);
}

#[test]
fn a_frame_over_the_budget_is_followed_by_one_that_fits_where_any_does() {
    for place in 0..COSTS.len() {
        for load in [0.3, 0.8, 1.2, 1.6, 2.0, 5.0] {
            let last = COSTS[place] * load;
            let next = after(place, last, &COSTS, BUDGET);
            let is_kept = |place: usize| COSTS[place] * load <= BUDGET;
            assert_eq!(next == place, is_kept(place) || place == 0);
            assert!(is_kept(next) || next == 0, "{place}, load {load}: {next}");
            // The most exact of those.
            let is_less_exact = (next + 1..place).any(is_kept);
            assert!(!is_less_exact, "{place}, load {load}: {next}");
        }
        assert_eq!(after(place, BUDGET, &COSTS, BUDGET), place);
        let next = after(place, BUDGET.next_up(), &COSTS, BUDGET);
        assert!(next < place || place == 0, "{place}: {next}");
    }
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
    let (chosen, text) = says(1.0);
    assert_eq!(chosen.method, Method::of(Phong, 0.0));
    assert!(text.contains("1.00 ms") && !text.contains("over"), "{text}");
    let (chosen, text) = says(0.15);
    assert_eq!(chosen.method, Method::of(Gouraud, 0.5));
    assert!(text.contains("0.050 ms over the budget; nothing"), "{text}");
    assert!(text.contains("165"), "{text}");
    assert!(held(&[], 1.0).is_none());
}

#[test]
fn only_methods_that_can_be_chosen_are_timed() {
    let drawing = Drawing {
        scene: built_in(),
        size: [40, 30],
        threads: 1,
        level: Level::new(),
    };
    let one_millisecond = async |request: &Request, _, _: Monitor<'_>| {
        let mut modes = request.methods.iter().map(|it| it.mode);
        let is_chosen = modes.all(|mode| mode != UnitVectors);
        assert!(is_chosen, "no budget chooses it");
        Ok(vec![vec![1.0; 4]; request.methods.len()])
    };
    let chosen = choose(&drawing, 2.0, &one_millisecond).expect("it is small");
    let (chosen, text) = chosen.expect("a cuboid is drawn");
    assert_eq!((chosen.method.mode, chosen.timing.median), (Phong, 1.0));
    assert!(text.contains("1.00 ms"), "{text}");
}
