//! The real window on its own Xvfb, controlled from outside: `cargo test --test window -- --ignored`.
#![cfg(target_os = "linux")]

mod desktop;
mod display;
mod faults;
#[path = "../it/support/signal.rs"]
mod signal;
#[path = "../it/support/window.rs"]
mod support;
