//! Files by their paths: those of the system, or in a browser a map in memory.

#[cfg(target_family = "wasm")]
mod browser;
#[cfg(not(target_family = "wasm"))]
mod system;

use std::ffi::OsStr;
use std::io::{self, ErrorKind, Read};
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

/// Reads a file of at most `largest` MiB. An endless device is refused, too.
///
/// # Errors
/// If it is larger or cannot be read.
pub fn read(path: &Path, largest: u64) -> io::Result<Vec<u8>> {
    read_from(open(path)?, largest)
}

/// Reads at most `largest` MiB to the end.
///
/// # Errors
/// If there are more, or they cannot be read.
pub fn read_from(source: impl Read, largest: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    source.take((largest << 20) + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > largest << 20 {
        let message = format!("it is larger than {largest} MiB");
        return Err(io::Error::new(ErrorKind::FileTooLarge, message));
    }
    Ok(bytes)
}
