//! What colour a pixel gets.

mod agreement;
mod known;
mod powers;
#[path = "../support/scene.rs"]
mod scene;
mod truth;
