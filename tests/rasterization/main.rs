//! Which pixels a polygon covers.

mod bent;
mod counting;
mod cuboids;
mod drawings;
mod ends;
#[path = "../support/random.rs"]
mod random;
mod twins;
