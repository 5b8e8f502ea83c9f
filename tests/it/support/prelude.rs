//! The names that most tests use.

pub use fearless_simd::Level;
pub use glam::DVec3;
pub use hecs::World;
pub use shadetrade::components::*;
pub use shadetrade::output::{Monitor, finished};
pub use shadetrade::scene::{Scene, SceneRecord};
pub use shadetrade::shading::Method;
pub use shadetrade::systems::frame::{Frame, Keep, Workers};

pub use super::cases::{cases, values};
pub use super::random::Random;
pub use super::records;
pub use super::scene::*;
