//! FRAME: the ordered table of stages, the one place that shows a frame in order.

pub mod coverage;
pub mod lighting;
pub mod normals;
pub mod projection;
pub mod rasterization;

use std::ops::Range;

use hecs::World;

use crate::components::{Mesh, View};
use crate::frame::Frame;
use crate::memory::OutOfMemory;

/// One step of a frame: a system and the name people see.
#[derive(Clone, Copy)]
pub struct Stage {
    /// For panels and reports.
    pub name: &'static str,
    /// Reads components, overwrites derived ones or the frame.
    pub run: fn(&mut World, &View, &mut Frame),
}

/// A frame, in order. Projection comes before lighting because it gives the corners that are lit.
pub const FRAME: [Stage; 4] = [
    Stage {
        name: "normals",
        run: normals::run,
    },
    Stage {
        name: "projection",
        run: projection::run,
    },
    Stage {
        name: "lighting",
        run: lighting::run,
    },
    Stage {
        name: "rasterization",
        run: rasterization::run,
    },
];

/// Draws one frame of `view.size`: every stage in order.
///
/// # Errors
/// When the picture does not fit in memory.
pub fn draw(world: &mut World, view: &View, frame: &mut Frame) -> Result<(), OutOfMemory> {
    draw_rows(world, view, 0..view.size[1], frame)
}

/// The same, but only these rows of the picture are drawn and held; their pixels are the same bits as in the whole.
///
/// # Errors
/// As [`draw`].
pub fn draw_rows(
    world: &mut World,
    view: &View,
    rows: Range<usize>,
    frame: &mut Frame,
) -> Result<(), OutOfMemory> {
    draw_in_stages(world, view, rows, frame, |_| ())
}

/// The same; `after_stage` is called with a stage's name when it is done, first of all with "clear".
///
/// # Errors
/// As [`draw`].
pub fn draw_in_stages(
    world: &mut World,
    view: &View,
    rows: Range<usize>,
    frame: &mut Frame,
    mut after_stage: impl FnMut(&'static str),
) -> Result<(), OutOfMemory> {
    let cuboids = world.query_mut::<&Mesh>().into_iter().count();
    frame.begin(view.size, rows, cuboids > 1)?;
    after_stage("clear");
    for stage in FRAME {
        (stage.run)(world, view, frame);
        after_stage(stage.name);
    }
    Ok(())
}
