//! The stages of a frame, in the order in which they run: [`FRAME`].

pub mod coverage;
pub mod lighting;
pub mod normals;
pub mod projection;
pub mod rasterization;
pub mod spin;
pub mod viewpoint;

use std::ops::Range;

use hecs::World;

use crate::components::{Mesh, View};
use crate::frame::Frame;
use crate::memory::OutOfMemory;

/// The stages of a frame, in order. Each reads components, and overwrites derived ones or the frame.
pub const FRAME: [fn(&mut World, &View, &mut Frame); 6] = [
    spin::run,
    viewpoint::run,
    normals::run,
    projection::run,
    lighting::run,
    rasterization::run,
];

/// Draws one frame of `view.size`: every stage in order.
///
/// # Errors
/// If the picture does not fit in memory.
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
    let cuboids = world.query_mut::<&Mesh>().into_iter().count();
    frame.begin(view.size, rows, cuboids > 1)?;
    for run in FRAME {
        run(world, view, frame);
    }
    Ok(())
}
