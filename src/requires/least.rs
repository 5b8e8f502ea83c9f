//! Parts that a scene does not require one by one in; those that it does not require together out.
//!
//! Errors of parts add up, or make up for one another, so what is tried is the picture without all of them.
//!
//! Rule: the pictures without what is left out are proven to keep the tolerance against the full ones.

use super::{Change, Part, changes, without};
use crate::components::View;
use crate::scene::Scene;

/// Leaves out one candidate after the other, as long as every view keeps its tolerance and a cuboid remains; also what that
/// does to the pictures; `None` as soon as `cancelled` says yes. `progress` is told which share of it is done.
pub fn least(
    scene: &Scene,
    views: &[View],
    candidates: &[Part],
    cancelled: &(dyn Fn() -> bool + Sync),
    progress: &(dyn Fn(f64) + Sync),
) -> Option<(Vec<Part>, Change)> {
    let (mut left_out, mut change) = (Vec::new(), Change::default());
    let all = (candidates.len() * views.len()) as f64;
    for (index, part) in candidates.iter().enumerate() {
        let tried = [&left_out[..], &[*part]].concat();
        if without(scene, &tried).cuboids.is_empty() {
            continue;
        }
        let one = std::slice::from_ref(&tried);
        let of_view = |(number, view)| {
            let before = (index * views.len() + number) as f64;
            let progress = |share| progress((before + share) / all);
            changes(scene, view, one, cancelled, &progress)
        };
        let by_view = views.iter().enumerate().map(of_view);
        let by_view: Vec<Vec<Change>> = by_view.collect::<Option<_>>()?;
        let sum = Change::sum(by_view.concat());
        if views.iter().all(|view| sum.keeps(view.tolerance)) {
            (left_out, change) = (tried, sum);
        }
    }
    Some((left_out, change))
}
