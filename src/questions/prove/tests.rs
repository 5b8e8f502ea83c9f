//! The order of the pixels that a proof lists, and a tied gate.

use super::Verdict::{Gap, Refuted, Undecided};
use super::*;
use crate::components::{Projection, ShadingMode};
use crate::reference::{Interval, Real, Reference, Seen};
use crate::scene::Scene;

#[test]
fn refuted_pixels_come_first_then_gaps_and_of_each_the_ones_that_err_most() {
    let mut proof = Proof::default();
    for (verdict, least) in [(Undecided, 9.0), (Gap, 5.0), (Refuted, 1.0), (Refuted, 2.0)] {
        let example = Example {
            pixel: [0; 2],
            verdict,
            drawn: [0.0; 3],
            enclosure: [[0.0; 2]; 3],
            error: [least, 255.0],
            face: None,
            drawn_face: None,
        };
        proof.append(Proof {
            examples: vec![example],
            ..Proof::default()
        });
    }
    let found: Vec<_> = proof
        .examples
        .iter()
        .map(|it| (it.verdict, it.error[0]))
        .collect();
    let expected = [(Refuted, 2.0), (Refuted, 1.0), (Gap, 5.0), (Undecided, 9.0)];
    assert_eq!(found, expected);
}

/// n.l is 4e-7 at pixel 5,5, which is tied: the gate of the shortcut is open there in floats.
#[test]
fn a_tied_gate_of_the_shortcut_may_be_open() {
    let text = include_str!("../../../assets/extremes/gate-open-by-1e-5.toml");
    let text = text.replace("2.0001", "2.000004");
    let world = Scene::parse("tied", &text).expect("a scene").world;
    let view = View {
        projection: Projection::Orthographic,
        ..View::of(&world, [11, 11]).shaded(ShadingMode::UnitVectors)
    };
    let seen = Reference::<Interval>::new(&world, &view).at([5, 5]);
    let level = Reference::<f64>::new(&world, &view).at([5, 5])[0].levels[0];
    let holds = |it: &Seen<Interval>| {
        let [least, most] = it.levels[0].endpoints();
        (least..=most).contains(&level)
    };
    assert!(seen.iter().any(holds), "{level}: {seen:?}");
}
