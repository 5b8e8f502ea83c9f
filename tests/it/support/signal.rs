//! Signals, sent by the shell's builtin `kill`: not every machine has the program `kill`.

use std::process::{Child, Command};

/// Sends a signal. Returns whether the process existed.
pub fn send(signal: &str, program: &Child) -> bool {
    let kill = format!("kill -s {signal} {}", program.id());
    let sent = Command::new("sh").args(["-c", &kill]).status();
    sent.expect("there is a shell").success()
}
