//! PNG files: writes the program's own, and reads those of any program.

use std::io::{self, Cursor};
use std::path::Path;

use anyhow::{Context, anyhow, bail, ensure};
use image::codecs::png::{CompressionType, FilterType, PngDecoder, PngEncoder};
use image::error::LimitErrorKind::DimensionError;
use image::{ExtendedColorType, ImageDecoder, ImageEncoder, ImageError, Limits};

use super::{files, memory, one_line};

/// The longest side of a picture, in pixels.
pub const MAX_PICTURE_SIDE: usize = 16_384;

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

/// The pixels of a picture, 0x00RRGGBB row by row from the top, and its width and height.
pub type PngPicture = (Vec<u32>, [usize; 2]);

/// In MiB: room for the largest picture without compression.
const LARGEST: u64 = 1100;

/// Bytes for the texts and the colour profile of a file. They change no pixel, and could unpack to any size.
const TEXTS: u64 = 4 << 20;

const SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";
/// The name of the last chunk and its checksum.
const END: &[u8] = b"IEND\xae\x42\x60\x82";

/// Reads a PNG with 8 bits a channel from a file or a pipe; `-` is standard input. A grey one has three equal channels.
///
/// # Errors
/// If there is no such file, it is no PNG, has 16 bits a channel or transparent pixels, or does not fit in memory.
pub fn read_png(path: &Path) -> anyhow::Result<PngPicture> {
    let name = one_line(path);
    let read = if path == "-" {
        files::read_from(io::stdin().lock(), LARGEST)
    } else {
        files::read(path, LARGEST)
    };
    let bytes = read.with_context(|| format!("cannot read {name}"))?;
    ensure!(bytes.starts_with(SIGNATURE), "{name} is not a PNG file");
    let damaged = || anyhow!("{name} is damaged");
    // The decoder does not look for it. Some programs append to it.
    let mut ends = bytes.windows(END.len()).rev();
    ensure!(ends.any(|end| end == END), damaged());
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(TEXTS);
    limits.max_image_width = Some(MAX_PICTURE_SIDE as u32);
    limits.max_image_height = limits.max_image_width;
    let decoder = match PngDecoder::with_limits(Cursor::new(&bytes), limits) {
        Ok(decoder) => decoder,
        Err(ImageError::Limits(error)) if error.kind() == DimensionError => {
            bail!(
                "{name} has more than {MAX_PICTURE_SIDE}x{MAX_PICTURE_SIDE} pixels, which are the most that are judged"
            )
        }
        Err(_) => return Err(damaged()),
    };
    let color = decoder.color_type();
    ensure!(
        color.bytes_per_pixel() == color.channel_count(),
        "{name} has 16 bits a channel; 8 are judged"
    );
    let (width, height) = decoder.dimensions();
    let size = [width, height].map(|side| side as usize);
    // At most four bytes of the file and four of the result.
    memory::check(size, 8 * size[0] * size[1])?;
    let mut pixels = memory::reserve_pixels(size)?;
    let mut samples = vec![0; decoder.total_bytes() as usize];
    decoder.read_image(&mut samples).map_err(|_| damaged())?;
    let channels = usize::from(color.channel_count());
    for [red, green, blue, alpha] in samples.chunks_exact(channels).map(rgba) {
        ensure!(alpha == 255, "{name} has transparent pixels");
        pixels.push(u32::from_be_bytes([0, red, green, blue]));
    }
    Ok((pixels, size))
}

/// Red, green, blue and alpha of a pixel with one to four channels.
fn rgba(samples: &[u8]) -> [u8; 4] {
    match *samples {
        [grey] => [grey, grey, grey, 255],
        [grey, alpha] => [grey, grey, grey, alpha],
        [red, green, blue] => [red, green, blue, 255],
        _ => [samples[0], samples[1], samples[2], samples[3]],
    }
}
