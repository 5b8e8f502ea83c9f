//! A picture in, `shadetrade-001.png` out: the next free number, written whole or not at all, never over another file.

use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};

/// No folder is searched for a free number further than this.
const LAST_NUMBER: u32 = 9999;

/// Writes `pixels`, rows of `size[0]` times 0x00RRGGBB from the top, into `folder`; returns the file made.
///
/// # Errors
/// When the folder cannot be written to or has no number left.
pub fn save(folder: &Path, pixels: &[u32], size: [usize; 2]) -> io::Result<PathBuf> {
    let mut bytes = Vec::with_capacity(pixels.len() * 3);
    for pixel in pixels {
        let [_, red, green, blue] = pixel.to_be_bytes();
        bytes.extend([red, green, blue]);
    }
    let mut file = temporary_file(folder)?;
    let mut writer = BufWriter::new(file.as_file_mut());
    PngEncoder::new(&mut writer)
        .write_image(
            &bytes,
            size[0] as u32,
            size[1] as u32,
            ExtendedColorType::Rgb8,
        )
        .map_err(io::Error::other)?;
    writer.flush()?;
    drop(writer);
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

fn temporary_file(folder: &Path) -> io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".shadetrade-");
    // As readable as any other file the user makes; the system takes away what the user's mask says.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder)
}
