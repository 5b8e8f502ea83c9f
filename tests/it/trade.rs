//! `trade`: statistics, errors and the front of hand-computed samples, every report of an invented measurement, and
//! real measurements of ordinary and degenerate views against the format of `trade.json`.

mod budget;
pub mod contract;
pub mod example;
mod exports;
mod measured;
mod metrics;
mod statistics;
mod words;
