//! The picture of another program, read from a PNG file.

use std::io::Cursor;
use std::path::Path;

use anyhow::{Context, ensure};
use image::codecs::png::PngDecoder;
use image::{DynamicImage, ImageDecoder};

use crate::memory;
use crate::scene::{self, MAX_SIDE};

/// The pixels of a picture, 0x00RRGGBB row by row from the top, and its width and height.
pub type PngPicture = (Vec<u32>, [usize; 2]);

/// In MiB: room for the largest picture without compression.
const LARGEST: u64 = 1100;

/// Reads a PNG with 8 bits a channel from a file or a pipe; `-` is standard input. A grey one has three equal channels.
///
/// # Errors
/// If there is no such file, it is no PNG, has 16 bits a channel or transparent pixels, or does not fit in memory.
pub fn read(path: &Path) -> anyhow::Result<PngPicture> {
    let name = path.display();
    let source = if path == "-" {
        "/dev/stdin".as_ref()
    } else {
        path
    };
    let bytes = scene::read(source, LARGEST).with_context(|| format!("cannot read {name}"))?;
    let decoder = PngDecoder::new(Cursor::new(bytes))
        .with_context(|| format!("{name} is not a PNG file that can be read"))?;
    let (width, height) = decoder.dimensions();
    let size = [width, height].map(|side| side as usize);
    ensure!(
        size.iter().all(|side| (1..=MAX_SIDE).contains(side)),
        "{name} has {width}x{height} pixels; at most {MAX_SIDE}x{MAX_SIDE} are judged"
    );
    let color = decoder.color_type();
    ensure!(
        color.bytes_per_pixel() == color.channel_count(),
        "{name} has 16 bits a channel; 8 are judged"
    );
    // The file's pixels, those with four channels and the result take four bytes each.
    memory::check(size, 12 * size[0] * size[1])?;
    let mut pixels = memory::reserve_pixels(size)?;
    let picture = DynamicImage::from_decoder(decoder);
    let picture = picture.with_context(|| format!("{name} is damaged"))?;
    for pixel in picture.into_rgba8().pixels() {
        let [red, green, blue, alpha] = pixel.0;
        ensure!(alpha == 255, "{name} has transparent pixels");
        pixels.push(u32::from_be_bytes([0, red, green, blue]));
    }
    Ok((pixels, size))
}
