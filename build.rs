//! Sets `SHADETRADE_RUSTC` to the version of the compiler, for the reports of `trade`.

use std::process::Command;

fn main() {
    let compiler = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let version = Command::new(compiler)
        .arg("--version")
        .output()
        .ok()
        .and_then(|output| String::from_utf8(output.stdout).ok())
        .unwrap_or_else(|| "unknown".to_owned());
    println!("cargo::rustc-env=SHADETRADE_RUSTC={}", version.trim());
    println!("cargo::rerun-if-changed=build.rs");
}
