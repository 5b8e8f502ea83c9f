//! The reference: against values computed on paper, and the renderer against the reference.

mod agreement;
mod invariance;
mod light;
mod scenes;
mod sight;
mod triangles;
