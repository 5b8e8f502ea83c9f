//! What colour a pixel gets.

mod agreement;
mod known;
mod powers;
mod truth;
