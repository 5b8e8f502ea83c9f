//! Files by their paths: those of the system, or in a browser a map in memory.

#[cfg(target_family = "wasm")]
mod browser;
#[cfg(not(target_family = "wasm"))]
mod system;

use std::ffi::OsStr;
use std::path::Path;

use web_time::SystemTime;

#[cfg(target_family = "wasm")]
pub use browser::*;
#[cfg(not(target_family = "wasm"))]
pub use system::*;

/// The time of the last change of a file, and its length.
pub type Stamp = (SystemTime, u64);

/// A name or path for a message: on one line, control characters as escapes.
pub fn one_line(name: impl AsRef<OsStr>) -> String {
    let mut line = String::new();
    for letter in name.as_ref().to_string_lossy().chars() {
        if letter.is_control() {
            line.extend(letter.escape_default());
        } else {
            line.push(letter);
        }
    }
    line
}

/// The folder of a file.
pub fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}
