//! The share of a frame's time that a part costs.
//!
//! Frames are drawn by the renderer on one thread, warm, with and without the part in turns. What the renderer cannot
//! draw without has no time of its own.

use std::time::Duration;

use fearless_simd::Level;

use super::{Part, without};
use crate::components::{Mesh, View, ordered};
use crate::frame::{Frame, Keep, Workers};
use crate::memory::OutOfMemory;
use crate::reference::Rule;
use crate::scene::Scene;
use crate::systems;
use crate::trade::timing;

/// How long each part is timed, and how often at least.
const TIME: Duration = Duration::from_millis(250);
const MIN_SAMPLES: usize = 16;

/// 1 less the time without the part over the time with it; negative where a frame without the part
/// takes longer. Of both the shortest time counts: what else runs on the machine only adds to a time. `None`: the renderer
/// cannot draw without the part.
///
/// # Errors
/// When the picture does not fit in memory.
pub fn time_share(
    scene: &Scene,
    view: &View,
    part: Part,
    level: Level,
) -> Result<Option<f64>, OutOfMemory> {
    match part {
        // The renderer has no depth buffer then.
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
        timing::batch(number, 2, MIN_SAMPLES, TIME, |which| {
            let (world, frame) = &mut drawn[which];
            systems::draw(world, view, frame)
        })
    };
    let times = timing::of_batches(batch, |_| ())?;
    let [with, without] = [&times[0], &times[1]];
    Ok(Some(1.0 - without.min / with.min))
}
