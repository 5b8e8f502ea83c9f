//! PNG files.

use std::io;

use png::{BitDepth, ColorType, Compression, Encoder, Filter};

/// A PNG of 0x00RRGGBB pixels. A copy of 3 bytes per pixel is held meanwhile.
///
/// # Errors
/// If the copy does not fit in memory.
pub fn encode_png(pixels: &[u32], size: [usize; 2]) -> io::Result<Vec<u8>> {
    let mut file = Vec::new();
    let [width, height] = size.map(|side| side as u32);
    let mut encoder = Encoder::new(&mut file, width, height);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Fast);
    encoder.set_filter(Filter::Adaptive);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&rgb(pixels)?)?;
    writer.finish()?;
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
