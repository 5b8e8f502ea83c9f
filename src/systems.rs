//! The stages of a frame, in the order in which they run: [`FRAME`].

pub mod coverage;
pub mod frame;
pub mod lighting;
pub mod normals;
pub mod projection;
pub mod rasterization;
pub mod spin;

use std::ops::Range;

use hecs::World;

use crate::components::{Segments, ShadingMode, View};
use crate::output::memory::OutOfMemory;
use crate::shading::grid::Grids;
use crate::systems::frame::Frame;

/// A system: reads components, and overwrites derived ones or the frame.
pub type Stage = fn(&mut World, &View, &mut Frame);

/// The stages of a frame, in order.
pub const FRAME: [Stage; 5] = [
    spin::run,
    normals::run,
    projection::run,
    lighting::run,
    rasterization::run,
];

/// Draws one frame of `view.size`: every stage in order.
///
/// # Errors
/// If the picture, or the grids of its faces, do not fit in memory.
///
/// # Panics
/// If a cuboid is to be shaded in a mode that the reference alone draws; see [`ShadingMode::is_drawn`].
pub fn draw(world: &mut World, view: &View, frame: &mut Frame) -> Result<(), OutOfMemory> {
    draw_rows(world, view, 0..view.size[1], frame)
}

/// Draws one frame with other stages than [`FRAME`], such as one more between two of them; `examples/own_system.rs` does so.
///
/// # Errors
/// As [`draw`].
///
/// # Panics
/// As [`draw`].
pub fn draw_with(
    stages: &[Stage],
    world: &mut World,
    view: &View,
    rows: Range<usize>,
    frame: &mut Frame,
) -> Result<(), OutOfMemory> {
    let (mut cuboids, mut grids) = (0, [0_usize; 2]);
    for (own, segments) in world.query_mut::<(&ShadingMode, &Segments)>() {
        let mode = view.mode(*own);
        assert!(mode.is_drawn(), "the reference alone draws {mode:?}");
        cuboids += 1;
        if mode == ShadingMode::Gouraud {
            let points = Grids::points(view.segments(*segments));
            grids[0] += usize::from(points > 0);
            grids[1] = grids[1].saturating_add(points);
        }
    }
    frame.begin(view.size, rows, cuboids > 1, grids)?;
    for run in stages {
        run(world, view, frame);
    }
    Ok(())
}

/// The same, but only these rows of the picture are drawn and held; their pixels are the same bits as in the whole.
///
/// # Errors
/// As [`draw`].
///
/// # Panics
/// As [`draw`].
pub fn draw_rows(
    world: &mut World,
    view: &View,
    rows: Range<usize>,
    frame: &mut Frame,
) -> Result<(), OutOfMemory> {
    draw_with(&FRAME, world, view, rows, frame)
}
