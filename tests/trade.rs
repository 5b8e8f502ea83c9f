//! The trade: statistics and front on hand-computed samples, every report of a made-up measurement, and real
//! measurements of ordinary and degenerate views held against the contract of `trade.json`.

#[path = "trade/contract.rs"]
mod contract;
#[path = "trade/example.rs"]
mod example;
#[path = "trade/exports.rs"]
mod exports;
#[path = "trade/measured.rs"]
mod measured;
#[path = "trade/requests.rs"]
mod requests;
#[path = "trade/scaling.rs"]
mod scaling;
#[path = "trade/statistics.rs"]
mod statistics;
#[path = "trade/words.rs"]
mod words;
