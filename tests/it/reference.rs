//! The reference against values from paper. `prove` compares its formula with a second arithmetic, and the renderer with it.

mod invariance;
mod light;
mod scenes;
mod sight;
