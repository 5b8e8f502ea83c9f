//! Coverage: the pixels of a polygon.

pub mod counting;
mod cuboids;
mod drawings;
mod twins;
