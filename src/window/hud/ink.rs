//! The colours that boards and legends are drawn in.
//!
//! Rule: letters keep a contrast of at least 4.5 to 1 on every pane, whatever picture shines through it.

use crate::canvas::Ink;

/// Between the picture and the letters.
pub const PANE: Ink = Ink::glass(0x0010_1216, 222);
/// Between the letters of another board and these.
pub const THICK_PANE: Ink = Ink::glass(0x0010_1216, 246);
pub const EDGE: Ink = Ink::glass(0x00ff_ffff, 40);
pub const TEXT: Ink = Ink::solid(0x00e8_eaed);
/// What is wrong.
pub const ALARM: Ink = Ink::solid(0x00ff_7a6b);
/// What is off, and names of what matters more.
pub const DIM: Ink = Ink::solid(0x00a8_afb7);
