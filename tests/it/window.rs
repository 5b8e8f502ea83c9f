//! The window without a display.

mod recording;
