//! Helpers of several test modules.

pub mod cases;
pub mod extreme;
pub mod prelude;
pub mod random;
pub mod random_scene;
pub mod records;
pub mod scene;
#[cfg(unix)]
pub mod signal;
pub mod window;
