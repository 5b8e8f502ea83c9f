//! The picture of another program, read from a PNG file.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use anyhow::{Context, ensure};
use image::codecs::png::PngDecoder;
use image::{DynamicImage, ImageDecoder};

use crate::memory;
use crate::scene::MAX_SIDE;

/// The pixels of a picture, 0x00RRGGBB row by row from the top, and its width and height.
pub type PngPicture = (Vec<u32>, [usize; 2]);

/// Reads a PNG with 8 bits a channel. A grey one has three equal channels.
///
/// # Errors
/// If there is no such file, it is no PNG, has 16 bits a channel or transparent pixels, or does not fit in memory.
pub fn read(path: &Path) -> anyhow::Result<PngPicture> {
    let name = path.display();
    let file = File::open(path).with_context(|| format!("cannot read {name}"))?;
    let is_file = file.metadata().is_ok_and(|found| found.is_file());
    ensure!(is_file, "{name} is not a file");
    let decoder = PngDecoder::new(BufReader::new(file))
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
