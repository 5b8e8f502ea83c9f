//! Changes that must keep every bit of a picture, and extreme scenes that must keep it defined.

mod bits;
mod depth;
mod extremes;
mod found;
pub mod life;
mod memory;
mod redrawing;
mod symmetries;
