//! The colour of pixels.

mod agreement;
mod known;
mod powers;
mod truth;
