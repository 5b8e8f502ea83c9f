//! Scene files: what they say and may not say, what they become, and that they are saved without loss.

mod errors;
mod read;
mod saved;

/// A scene with nothing but the keys that must be there.
const LEAST: &str = include_str!("support/least.toml");
