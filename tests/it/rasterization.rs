//! Coverage: the pixels of a polygon.

mod bent;
pub mod counting;
mod cuboids;
mod drawings;
mod ends;
mod twins;
