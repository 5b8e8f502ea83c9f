//! FRAME: the ordered table of stages.

use std::ops::Range;

use hecs::World;

use crate::components::View;
use crate::frame::{Frame, OutOfMemory};

/// Draws one frame of `view.size`: every stage in order.
///
/// # Errors
/// When the picture does not fit in memory.
pub fn draw(_world: &mut World, _view: &View, _frame: &mut Frame) -> Result<(), OutOfMemory> {
    unimplemented!()
}

/// The same, but only these rows of the picture are drawn and held.
///
/// # Errors
/// As [`draw`].
pub fn draw_rows(_world: &mut World, _view: &View, _rows: Range<usize>, _frame: &mut Frame) -> Result<(), OutOfMemory> {
    unimplemented!()
}
