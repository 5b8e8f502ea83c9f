//! The reference against values from paper, and the renderer against the reference.

mod agreement;
mod invariance;
mod light;
mod scenes;
mod sight;
mod triangles;
