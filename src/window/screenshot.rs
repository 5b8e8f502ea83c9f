//! A picture in, `shadetrade-001.png` out: the next free number, written whole or not at all, never over another file.

use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use crate::output::{buffered, encode_png, temporary_file};

/// No folder is searched for a free number further than this.
const LAST_NUMBER: u32 = 9999;

/// Writes `pixels`, rows of `size[0]` times 0x00RRGGBB from the top, into `folder`; returns the file made.
///
/// # Errors
/// When the folder cannot be written to or has no number left.
pub fn save(folder: &Path, pixels: &[u32], size: [usize; 2]) -> io::Result<PathBuf> {
    let mut file = temporary_file(folder)?;
    buffered(file.as_file(), |writer| encode_png(writer, pixels, size))?;
    for number in 1..=LAST_NUMBER {
        let path = folder.join(format!("shadetrade-{number:03}.png"));
        // The system refuses a name that is taken, so that two programs never get the same one.
        match file.persist_noclobber(&path) {
            Ok(_) => return Ok(path),
            Err(taken) if taken.error.kind() == ErrorKind::AlreadyExists => file = taken.file,
            Err(other) => return Err(other.error),
        }
    }
    Err(io::Error::new(
        ErrorKind::AlreadyExists,
        "every number is taken",
    ))
}
