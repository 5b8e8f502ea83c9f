//! What the window shows in, a new file out: a picture, or a scene file that draws it.
//!
//! Rule: a file is written whole or not at all, under the next free number, never over another file.

use std::io;
use std::path::{Path, PathBuf};

use super::session::Session;
use crate::output::{encode_png, quoted, write_numbered};

/// Writes `pixels`, rows of `size[0]` times 0x00RRGGBB from the top, into `folder`; returns the file made.
///
/// # Errors
/// When the folder cannot be written to or has no number left.
pub fn save_picture(folder: &Path, pixels: &[u32], size: [usize; 2]) -> io::Result<PathBuf> {
    write_numbered(
        folder,
        |number| format!("shadetrade-{number:03}.png"),
        |writer| encode_png(writer, pixels, size),
    )
}

/// Writes the scene as it is now into `folder`, the view as its first camera; returns the file made.
///
/// # Errors
/// When the folder cannot be written to or has no number left.
pub fn save_scene(folder: &Path, session: &Session) -> io::Result<PathBuf> {
    let scene = &session.scene;
    let stem = Path::new(&scene.name).file_stem().unwrap_or_default();
    let stem = stem.to_string_lossy().replace(char::is_control, "_");
    let text = scene.to_toml_with_view();
    write_numbered(
        folder,
        |number| format!("{stem}-{number}.toml"),
        |writer| writer.write_all(text.as_bytes()),
    )
}

/// The command that draws what the session shows from the scene file that was saved as `name`, in so many pixels.
pub fn command(session: &Session, name: &str, [width, height]: [usize; 2]) -> String {
    format!(
        "shadetrade render {} --projection {} --tolerance {} --size {width}x{height} -o {}",
        quoted(&format!("./{name}")),
        session.projection.name(),
        session.tolerance,
        quoted(&Path::new(name).with_extension("png").to_string_lossy()),
    )
}
