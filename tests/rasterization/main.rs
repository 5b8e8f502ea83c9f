//! Which pixels a polygon covers.

mod counting;
mod cuboids;
mod drawings;
#[path = "../support/random.rs"]
mod random;
mod tiles;
mod twins;
