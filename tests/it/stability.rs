//! What must not change a picture by one bit, and what must not break it.

mod bits;
mod depth;
mod extremes;
mod found;
pub mod life;
mod memory;
mod redrawing;
mod symmetries;
