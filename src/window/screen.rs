//! The size of letters: the dots per inch of the screen, and the factor that the user chose. The depth of the screen.

use std::path::Path;

use anyhow::Context;
use x11rb::connection::Connection;
use x11rb::protocol::xproto::{AtomEnum, ConnectionExt};
use x11rb::rust_connection::RustConnection;

use crate::output::Output;
use crate::output::files::make_folders;

/// The dots per inch at which a point of egui is a pixel.
const USUAL_DPI: f32 = 96.0;
/// The length of the longest table of resources that is read, in units of four bytes.
const MOST: u32 = 1 << 18;
/// The file of the factor that the user chose with `Ctrl +`, in the folder of the program's state.
const ZOOM: &str = "zoom";

/// The screen of an X server. It holds a connection: a server without other clients resets once the last one leaves, and refuses
/// a window that is opened meanwhile.
pub struct Screen {
    _connection: RustConnection,
    /// Bits a pixel.
    pub depth: u8,
    /// Pixels in a point of egui.
    pub scale: f32,
    /// Width and height in pixels.
    pub size: [usize; 2],
}

/// Asks the X server that `DISPLAY` names. minifb crashes on a screen whose depth it does not know, and does not tell the
/// dots per inch.
pub fn x_screen() -> Option<Screen> {
    let (connection, index) = x11rb::connect(None).ok()?;
    let screen = connection.setup().roots.get(index)?;
    let (table, text) = (AtomEnum::RESOURCE_MANAGER, AtomEnum::STRING);
    let asked = connection.get_property(false, screen.root, table, text, 0, MOST);
    let resources = asked.ok()?.reply().ok()?.value;
    let depth = screen.root_depth;
    let size = [screen.width_in_pixels, screen.height_in_pixels].map(usize::from);
    Some(Screen {
        _connection: connection,
        depth,
        scale: scale(&String::from_utf8_lossy(&resources)),
        size,
    })
}

/// The pixels in a point, by the `Xft.dpi` among the resources of an X server.
pub fn scale(resources: &str) -> f32 {
    let mut values = resources
        .lines()
        .filter_map(|it| it.strip_prefix("Xft.dpi:"));
    let dpi = values.find_map(|it| it.trim().parse().ok());
    (dpi.unwrap_or(USUAL_DPI) / USUAL_DPI).clamp(0.5, 4.0)
}

/// The factor of the letters' size that is kept in `folder`, else 1.
pub fn kept_zoom(folder: &Path) -> f32 {
    let text = std::fs::read_to_string(folder.join(ZOOM)).unwrap_or_default();
    let zoom = text.trim().parse().ok();
    zoom.filter(|zoom| (0.2..=5.0).contains(zoom))
        .unwrap_or(1.0)
}

/// Keeps the factor of the letters' size in `folder`.
///
/// # Errors
/// If it cannot be written.
pub fn keep_zoom(folder: &Path, zoom: f32) -> anyhow::Result<()> {
    make_folders(folder)
        .map_err(anyhow::Error::from)
        .and_then(|()| Output::File(folder.join(ZOOM)).write(zoom.to_string()))
        .context("the size of the letters is not kept")
}
