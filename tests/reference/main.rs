//! The reference: against values computed on paper, and the renderer against the reference.

mod agreement;
#[path = "../support/cases.rs"]
mod cases;
mod invariance;
mod light;
#[path = "../support/random_scene.rs"]
mod random_scene;
mod scenes;
mod sight;
mod triangles;
