//! PNG files of pixels.

use std::io::{self, Write};

use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder, ImageError};

/// Writes a PNG of 0x00RRGGBB pixels. A copy of 3 bytes per pixel is held meanwhile.
///
/// # Errors
/// If the copy does not fit in memory or the file cannot be written.
pub fn encode_png(
    writer: &mut dyn Write,
    pixels: &[u32],
    [width, height]: [usize; 2],
) -> io::Result<()> {
    PngEncoder::new(writer)
        .write_image(
            &rgb(pixels)?,
            width as u32,
            height as u32,
            ExtendedColorType::Rgb8,
        )
        .map_err(|error| match error {
            ImageError::IoError(error) => error,
            other => io::Error::other(other),
        })
}

/// Red, green and blue of every pixel.
pub fn rgb(pixels: &[u32]) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    bytes.try_reserve_exact(3 * pixels.len())?;
    bytes.extend(pixels.iter().flat_map(|pixel| {
        let [_, red, green, blue] = pixel.to_be_bytes();
        [red, green, blue]
    }));
    Ok(bytes)
}
