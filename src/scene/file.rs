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
    let mut text = String::new();
    File::open(path)?
        .take(LARGEST + 1)
        .read_to_string(&mut text)?;
    if text.len() as u64 > LARGEST {
        let kind = io::ErrorKind::FileTooLarge;
        return Err(io::Error::new(kind, "it is larger than 16 MiB"));
    }
    Ok(text)
}
