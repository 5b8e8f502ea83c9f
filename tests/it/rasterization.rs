//! Which pixels a polygon covers.

mod bent;
mod counting;
mod cuboids;
mod drawings;
mod ends;
mod twins;
