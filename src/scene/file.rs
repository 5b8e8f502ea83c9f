//! A path in, the scene's text out.
//!
//! Rule: whatever the path leads to, reading it ends, and what cannot be a scene is one [`SceneError`].

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use super::BUILT_IN;
use super::error::{SceneError, not_utf8};

/// In bytes. Room for two hundred thousand cuboids; an endless device stops here too.
const LARGEST: u64 = 64 << 20;

/// The text of the file at `path`.
pub fn read(path: &Path) -> Result<String, SceneError> {
    let bytes = read_bytes(path).map_err(|cause| SceneError::Unreadable {
        path: path.to_string_lossy().into_owned(),
        hint: hint(path, &cause),
        cause,
    })?;
    String::from_utf8(bytes).map_err(|error| not_utf8(&path.to_string_lossy(), &error))
}

fn read_bytes(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    File::open(path)?
        .take(LARGEST + 1)
        .read_to_end(&mut bytes)?;
    if bytes.len() as u64 > LARGEST {
        let kind = io::ErrorKind::FileTooLarge;
        return Err(io::Error::new(kind, "it is larger than 64 MiB"));
    }
    Ok(bytes)
}

/// A bare name that is no file was probably meant as a built-in scene.
fn hint(path: &Path, cause: &io::Error) -> String {
    let is_plain = path.components().count() == 1 && path.extension().is_none();
    if cause.kind() != io::ErrorKind::NotFound || !is_plain {
        return String::new();
    }
    let names = BUILT_IN.map(|(name, _)| name).join(", ");
    format!("; built in are {names} and what `shadetrade extremes` lists")
}
