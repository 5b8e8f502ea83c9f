//! The trade: statistics, errors and the front on hand-computed samples, every report of a made-up measurement, and real
//! measurements of ordinary and degenerate views held against the contract of `trade.json`.

mod budget;
mod contract;
pub mod example;
mod exports;
mod measured;
mod metrics;
mod requests;
mod statistics;
mod words;
