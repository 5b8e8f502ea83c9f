//! Parts that a scene does not require one by one in; those that it does not require together out.
//!
//! Errors of parts add up, or make up for one another, so what is tried is the picture without all of them.
//!
//! Rule: the pictures without what is left out are proven to keep the tolerance against the full ones.

use super::{Change, Part, changes, without};
use crate::components::View;
use crate::scene::Scene;

/// Leaves out one candidate after the other, as long as every view keeps its tolerance and a cuboid remains; also what that
/// does to the pictures. `progress` is told which share of it is done.
pub fn least(
    scene: &Scene,
    views: &[View],
    candidates: &[Part],
    progress: &(dyn Fn(f64) + Sync),
) -> (Vec<Part>, Change) {
    let (mut left_out, mut change) = (Vec::new(), Change::default());
    let all = (candidates.len() * views.len()) as f64;
    for (index, part) in candidates.iter().enumerate() {
        let tried = [&left_out[..], &[*part]].concat();
        if without(scene, &tried).cuboids.is_empty() {
            continue;
        }
        let one = std::slice::from_ref(&tried);
        let tries = views.iter().enumerate().flat_map(|(number, view)| {
            let before = (index * views.len() + number) as f64;
            changes(scene, view, one, &|share| progress((before + share) / all))
        });
        let sum = Change::sum(tries);
        if views.iter().all(|view| sum.keeps(view.tolerance)) {
            (left_out, change) = (tried, sum);
        }
    }
    (left_out, change)
}
