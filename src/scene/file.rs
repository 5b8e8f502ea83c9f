//! Reads the text of a scene file. Reading ends for every path, devices and pipes included.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use anyhow::anyhow;

use super::BUILT_IN;

/// In bytes: room for fifty thousand cuboids, whose parsing takes 1.6 GB at most. Reading an endless device stops here.
const LARGEST: u64 = 16 << 20;

/// The text of the file at `path`.
pub fn read(path: &Path) -> anyhow::Result<String> {
    read_text(path).map_err(|cause| {
        // A bare name without a file is probably a misspelt built-in scene.
        let is_plain = path.components().count() == 1 && path.extension().is_none();
        let hint = if cause.kind() == io::ErrorKind::NotFound && is_plain {
            let names = BUILT_IN.map(|(name, _)| name).join(", ");
            format!("; built in are {names} and what `shadetrade extremes` lists")
        } else {
            String::new()
        };
        anyhow!(
            "cannot read the scene {:?}: {cause}{hint}",
            path.to_string_lossy()
        )
    })
}

fn read_text(path: &Path) -> io::Result<String> {
    let mut bytes = Vec::new();
    File::open(path)?
        .take(LARGEST + 1)
        .read_to_end(&mut bytes)?;
    if bytes.len() as u64 > LARGEST {
        let kind = io::ErrorKind::FileTooLarge;
        return Err(io::Error::new(kind, "it is larger than 16 MiB"));
    }
    String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        let before = String::from_utf8_lossy(&error.as_bytes()[..valid]);
        let line = before.matches('\n').count() + 1;
        let column = before.chars().rev().take_while(|it| *it != '\n').count() + 1;
        let cause = format!("line {line}, column {column} is not UTF-8");
        io::Error::new(io::ErrorKind::InvalidData, cause)
    })
}
