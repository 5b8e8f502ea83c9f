//! Changes that must keep every bit of a picture, and faults found earlier.

mod bits;
mod found;
pub mod life;
mod memory;
mod symmetries;
