//! The parts that a scene does not require together, of those that it does not require one by one.
//!
//! Errors of parts add up, or make up for one another, so what is tried is the picture without all of them.
//!
//! The picture without what is left out is proven to keep the tolerance against the full one.

use super::{Change, Part, changes, without};
use crate::components::{Mesh, View, ordered};
use crate::scene::Scene;

/// Leaves out one candidate after the other, as long as the picture keeps its tolerance and a cuboid remains; also what that
/// does to the picture; `None` as soon as `cancelled` says yes. `progress` is told which share of it is done.
pub fn least(
    scene: &Scene,
    view: &View,
    candidates: &[Part],
    cancelled: &(dyn Fn() -> bool + Sync),
    progress: &(dyn Fn(f64) + Sync),
) -> Option<(Vec<Part>, Change)> {
    let (mut left_out, mut change) = (Vec::new(), Change::default());
    let all = candidates.len() as f64;
    for (index, part) in candidates.iter().enumerate() {
        let tried = [&left_out[..], &[*part]].concat();
        if ordered::<Mesh>(&without(scene, &tried).world).is_empty() {
            continue;
        }
        let one = std::slice::from_ref(&tried);
        let progress = |share| progress((index as f64 + share) / all);
        let without_it = changes(scene, view, one, cancelled, &progress)?[0];
        if without_it.keeps(view.tolerance) {
            (left_out, change) = (tried, without_it);
        }
    }
    Some((left_out, change))
}
