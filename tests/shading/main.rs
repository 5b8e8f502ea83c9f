//! What colour a pixel gets.

mod agreement;
mod known;
mod lanes;
mod patches;
mod powers;
#[path = "../support/random.rs"]
mod random;
#[path = "../support/scene.rs"]
mod scene;
#[path = "../support/tile.rs"]
mod tile;
mod truth;
