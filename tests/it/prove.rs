//! Proofs: right pictures are proven, wrong ones refuted, and the enclosures hold the exact values.

mod arithmetic;
mod cause;
mod gaps;
mod judge;
mod known;
mod naive;
mod picture;
mod scenes;
mod search;
mod segments;
mod squares;

use shadetrade::questions::prove::{Proof, prove};
use shadetrade::reference::{Interval, Reference, Rule, Seen};

use crate::support::prelude::*;

/// The proof of the renderer's picture.
pub fn proof(world: &mut World, view: &View) -> Proof {
    done(prove(world, view, None, Level::new(), Monitor::NONE))
}

/// The proof of a picture of another program.
fn judged(world: &mut World, view: &View, picture: &[u32]) -> Proof {
    let (level, monitor) = (Level::new(), Monitor::NONE);
    done(prove(world, view, Some(picture), level, monitor))
}

/// The surfaces that each pixel may show, row by row from the top.
fn enclosures(world: &World, view: &View) -> Vec<Vec<Seen<Interval>>> {
    enclosures_without(world, view, None)
}

/// The surfaces that each pixel may show without a rule of the model.
fn enclosures_without(world: &World, view: &View, rule: Option<Rule>) -> Vec<Vec<Seen<Interval>>> {
    let reference = Reference::<Interval>::without(world, view, rule);
    let mut pixels = Vec::new();
    for y in 0..view.size[1] {
        reference.row(y, |_, seen| pixels.push(seen.to_vec()));
    }
    pixels
}
