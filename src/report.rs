//! Pieces of output that several commands share: numbers in words, tables, charts, and progress.

pub mod chart;
pub mod progress;
pub mod tables;
pub mod words;

pub use progress::{CANCELLED, Monitor, finished};
