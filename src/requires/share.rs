//! The share of a frame's time that a part of the model costs.
//!
//! Frames with and without the part are timed in turns, in random order, on one thread.

use std::time::Duration;

use fearless_simd::Level;

use super::{Part, without};
use crate::components::{Mesh, View, ordered};
use crate::frame::{Frame, Keep, Workers};
use crate::reference::Rule;
use crate::scene::Scene;
use crate::systems;
use crate::trade::timing;

/// Time spent on each part.
const TIME: Duration = Duration::from_millis(250);

/// 1 - (time without the part) / (time with it); negative if a frame without the part takes longer. `None` if the
/// renderer cannot draw without the part. The shortest time of each counts, because other programs only add to a time.
///
/// # Errors
/// If the picture does not fit in memory.
pub fn time_share(
    scene: &Scene,
    view: &View,
    part: Part,
    level: Level,
) -> anyhow::Result<Option<f64>> {
    match part {
        // A scene with one cuboid is drawn without a depth buffer.
        Part::Rule(Rule::DepthTest) if ordered::<Mesh>(&scene.world).len() == 1 => {
            return Ok(Some(0.0));
        }
        Part::Rule(_) | Part::F64SetUp => return Ok(None),
        Part::Light(_) | Part::EveryPixel(_) | Part::Cuboid(_) => {}
    }
    let batch = |number| {
        let mut drawn = [scene.snapshot(), without(scene, &[part])].map(|scene| {
            let frame = Frame::new(Keep::Display, Workers::alone(level));
            (scene.world, frame)
        });
        timing::batch(number, 2, TIME, |which| {
            let (world, frame) = &mut drawn[which];
            Ok(systems::draw(world, view, frame)?)
        })
    };
    let times = timing::of_batches(batch, |_| ())?;
    let [with, without] = [&times[0], &times[1]];
    Ok(Some(1.0 - without.min / with.min))
}
