//! Builds in the version of the compiler, for the reports of `trade`, and the extremes of `assets`.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let compiler = env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let version = Command::new(compiler)
        .arg("--version")
        .output()
        .ok()
        .and_then(|output| String::from_utf8(output.stdout).ok())
        .unwrap_or_else(|| "unknown".to_owned());
    println!("cargo::rustc-env=SHADETRADE_RUSTC={}", version.trim());
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=assets/extremes");
    let folder = |name| PathBuf::from(env::var_os(name).unwrap_or_default());
    let texts = folder("CARGO_MANIFEST_DIR").join("assets/extremes");
    fs::write(folder("OUT_DIR").join("extremes.rs"), table(&texts)?)?;
    Ok(())
}

/// A Rust array of the names and texts of the TOML files in a folder, sorted by name. The index of the extremes is not one.
fn table(folder: &Path) -> io::Result<String> {
    let entries = fs::read_dir(folder)?.map(|entry| Ok(entry?.path()));
    let mut paths = entries.collect::<io::Result<Vec<_>>>()?;
    paths.sort();
    let mut table = String::from("&[");
    for path in paths {
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        if name != "index" && path.extension().is_some_and(|it| it == "toml") {
            let text = path.to_string_lossy();
            let _ = writeln!(table, "(\"extremes/{name}\", include_str!({text:?})),");
        }
    }
    Ok(table + "]")
}
