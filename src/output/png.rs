//! PNG files.

use std::io;

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};

/// A PNG of 0x00RRGGBB pixels. A copy of 3 bytes per pixel is held meanwhile.
///
/// # Errors
/// If the copy does not fit in memory.
pub fn encode_png(pixels: &[u32], [width, height]: [usize; 2]) -> anyhow::Result<Vec<u8>> {
    let mut file = Vec::new();
    let encoder =
        PngEncoder::new_with_quality(&mut file, CompressionType::Fast, FilterType::Adaptive);
    let (width, height) = (width as u32, height as u32);
    encoder.write_image(&rgb(pixels)?, width, height, ExtendedColorType::Rgb8)?;
    Ok(file)
}

/// Red, green and blue of every pixel.
fn rgb(pixels: &[u32]) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    bytes.try_reserve_exact(3 * pixels.len())?;
    bytes.extend(pixels.iter().flat_map(|pixel| {
        let [_, red, green, blue] = pixel.to_be_bytes();
        [red, green, blue]
    }));
    Ok(bytes)
}
