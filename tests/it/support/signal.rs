//! Signals sent by the shell's own `kill`: not every machine has the program.

use std::process::{Child, Command};

/// Sends a signal; whether the program was still there.
pub fn send(signal: &str, program: &Child) -> bool {
    let kill = format!("kill -s {signal} {}", program.id());
    let sent = Command::new("sh").args(["-c", &kill]).status();
    sent.expect("there is a shell").success()
}
