//! Parts that a scene may not require in; the least scene that is proven to keep the tolerance out.
//!
//! Errors of parts add up, or make up for one another, so parts that are not required one by one may be so together.
//!
//! Rule: whatever is left out, the picture without all of it is proven to keep the tolerance against the full one.

use super::{Change, Part, changes, without};
use crate::components::View;
use crate::scene::Scene;

/// A scene with parts left out.
pub struct Least {
    pub left_out: Vec<Part>,
    /// What that does to the pictures, all views together.
    pub change: Change,
}

impl Least {
    /// Leaves out as many of `candidates`, those that err least first, as keep the tolerance of the views.
    ///
    /// All are tried at once; where that errs too much, the first half and then the second.
    pub fn find(
        scene: &Scene,
        views: &[View],
        candidates: &[Part],
        progress: &(dyn Fn(f64) + Sync),
    ) -> Self {
        let mut least = Least {
            left_out: Vec::new(),
            change: Change::default(),
        };
        least.leave_out(scene, views, candidates, progress);
        let all = least.left_out.clone();
        // What is not there is not shaded.
        least.left_out.retain(|part| match part {
            Part::EveryPixel(cuboid) => !all.contains(&Part::Cuboid(*cuboid)),
            _ => true,
        });
        least
    }

    fn leave_out(
        &mut self,
        scene: &Scene,
        views: &[View],
        candidates: &[Part],
        progress: &(dyn Fn(f64) + Sync),
    ) {
        if candidates.is_empty() {
            return;
        }
        let tried = [&self.left_out, candidates].concat();
        match kept(scene, views, &tried, progress) {
            Some(change) => (self.left_out, self.change) = (tried, change),
            None if candidates.len() > 1 => {
                let (first, second) = candidates.split_at(candidates.len() / 2);
                self.leave_out(scene, views, first, progress);
                self.leave_out(scene, views, second, progress);
            }
            None => {}
        }
    }
}

/// What the pictures err without these parts, if all are proven to keep their tolerance. A scene has at least one cuboid.
fn kept(
    scene: &Scene,
    views: &[View],
    parts: &[Part],
    progress: &(dyn Fn(f64) + Sync),
) -> Option<Change> {
    if without(scene, parts).cuboids.is_empty() {
        return None;
    }
    let mut sum = Change::default();
    for change in changes(scene, views, &[parts.to_vec()], progress).concat() {
        sum.append(change);
    }
    views
        .iter()
        .all(|view| sum.keeps(view.tolerance))
        .then_some(sum)
}
