//! The window: minifb opens it, egui lays it out, the World is its state.
//!
//! ```text
//! minifb --reports--> input --events of egui--> App::step --pixels, effects--> minifb
//!                                                  |
//!                   document, canvas, study, desk <--written and shown by-- keys, panel, inspector, viewport
//! ```
//! A step is taken when something happens; else nothing is laid out, drawn or painted. `display` and [`run`] need a display;
//! a page in a browser has its own, and the crate in `web/` runs the steps.

mod actions;
pub mod app;
mod ask;
pub mod canvas;
pub mod chart;
pub mod controls;
pub mod desk;
#[cfg(not(target_family = "wasm"))]
pub mod display;
pub mod document;
pub mod error_map;
pub mod facts;
pub mod file;
pub mod help;
#[cfg(not(target_family = "wasm"))]
pub mod input;
pub mod inspector;
pub mod keys;
pub mod labels;
mod layout;
pub mod lesson;
pub mod lights;
mod marks;
mod opening;
pub mod panel;
pub mod pictures;
#[cfg(not(target_family = "wasm"))]
mod run;
pub mod study;
pub mod unsaved;
mod viewport;
pub mod widgets;
pub mod work;

#[cfg(not(target_family = "wasm"))]
pub use display::NoWindow;
#[cfg(not(target_family = "wasm"))]
pub use run::{restart_in_fit_environment, run};
