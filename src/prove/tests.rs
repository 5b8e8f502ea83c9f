//! The order of the pixels that a proof lists.

use super::Verdict::{Refuted, Undecided};
use super::*;

#[test]
fn refuted_pixels_come_first_and_of_these_the_ones_that_err_most() {
    let mut proof = Proof::default();
    for (verdict, least) in [(Undecided, 9.0), (Refuted, 1.0), (Refuted, 2.0)] {
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
    assert_eq!(found, [(Refuted, 2.0), (Refuted, 1.0), (Undecided, 9.0)]);
}
