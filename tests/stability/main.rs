//! What must not change a picture by one bit, and what must not break it.

mod bits;
#[path = "../support/cases.rs"]
mod cases;
mod depth;
mod extremes;
mod found;
mod life;
mod memory;
#[path = "../support/random.rs"]
mod random;
mod redrawing;
#[path = "../support/scene.rs"]
mod scene;
mod symmetries;
