//! What a shading method saves and what it costs in accuracy.

pub mod flip;
pub mod metrics;
