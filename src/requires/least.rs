//! Finds parts that can be left out of a scene together.
//!
//! Errors of parts add up or cancel, so each candidate is tried together with the parts already left out. The picture
//! without the set is proven to keep the tolerance.

use super::{Change, Part, changes, without};
use crate::components::{Mesh, View, ordered};
use crate::report::Monitor;
use crate::scene::Scene;

/// Leaves out each candidate in turn if the picture then keeps its tolerance and a cuboid remains. Returns the parts
/// left out and the change of the picture.
///
/// # Errors
/// If the work is cancelled.
pub fn least(
    scene: &Scene,
    view: &View,
    candidates: &[Part],
    monitor: Monitor,
) -> anyhow::Result<(Vec<Part>, Change)> {
    let (mut left_out, mut change) = (Vec::new(), Change::default());
    let all = candidates.len() as f64;
    for (index, part) in candidates.iter().enumerate() {
        let tried = [&left_out[..], &[*part]].concat();
        if ordered::<Mesh>(&without(scene, &tried).world).is_empty() {
            continue;
        }
        let one = std::slice::from_ref(&tried);
        let progress = |_, share| {
            (monitor.progress)("looking for the least scene", (index as f64 + share) / all);
        };
        let monitor = Monitor {
            progress: &progress,
            ..monitor
        };
        let without_it = changes(scene, view, one, monitor)?[0];
        if without_it.keeps(view.tolerance) {
            (left_out, change) = (tried, without_it);
        }
    }
    Ok((left_out, change))
}
