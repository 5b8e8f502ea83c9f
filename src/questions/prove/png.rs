//! The picture of another program, read from a PNG file.

use std::io::{self, Cursor};
use std::path::Path;

use anyhow::{Context, anyhow, ensure};
use png::{BitDepth, ColorType, Decoder, Info, Limits, Transformations};

use crate::output::memory;
use crate::output::one_line;
use crate::scene::{self, MAX_SIDE};

/// The pixels of a picture, 0x00RRGGBB row by row from the top, and its width and height.
pub type PngPicture = (Vec<u32>, [usize; 2]);

/// In MiB: room for the largest picture without compression.
const LARGEST: u64 = 1100;

const SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";

/// Reads a PNG with 8 bits a channel from a file or a pipe; `-` is standard input. A grey one has three equal channels.
///
/// # Errors
/// If there is no such file, it is no PNG, has 16 bits a channel or transparent pixels, or does not fit in memory.
pub fn read(path: &Path) -> anyhow::Result<PngPicture> {
    let name = one_line(path);
    let bytes = if path == "-" {
        scene::read_from(io::stdin().lock(), LARGEST)
    } else {
        scene::read(path, LARGEST)
    };
    let bytes = bytes.with_context(|| format!("cannot read {name}"))?;
    ensure!(bytes.starts_with(SIGNATURE), "{name} is not a PNG file");
    let damaged = || anyhow!("{name} is damaged");
    // The file is in memory, and the size of its pixels is checked below.
    let limits = Limits { bytes: usize::MAX };
    let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), limits);
    // They change no pixel, and could unpack to any size.
    decoder.set_ignore_iccp_chunk(true);
    decoder.set_ignore_text_chunk(true);
    let header = decoder.read_header_info().map_err(|_| damaged())?;
    let (width, height) = header.size();
    let size = [width, height].map(|side| side as usize);
    ensure!(
        size.iter().all(|side| (1..=MAX_SIDE).contains(side)),
        "{name} has {width}x{height} pixels; at most {MAX_SIDE}x{MAX_SIDE} are judged"
    );
    ensure!(
        header.bit_depth != BitDepth::Sixteen,
        "{name} has 16 bits a channel; 8 are judged"
    );
    // The decoder takes an entry that is missing in a palette for black.
    let transformations = match header.color_type {
        ColorType::Indexed => Transformations::IDENTITY,
        _ => Transformations::EXPAND,
    };
    decoder.set_transformations(transformations);
    // At most four bytes of the file and four of the result.
    memory::check(size, 8 * size[0] * size[1])?;
    let mut pixels = memory::reserve_pixels(size)?;
    let mut reader = decoder.read_info().map_err(|_| damaged())?;
    let palette = palette(reader.info());
    let mut samples = vec![0; reader.output_buffer_size().ok_or_else(damaged)?];
    let frame = reader.next_frame(&mut samples).map_err(|_| damaged())?;
    let (channels, depth) = (frame.color_type.samples(), frame.bit_depth as usize);
    for row in samples.chunks_exact(frame.line_size) {
        for x in 0..size[0] {
            let pixel = if palette.is_empty() {
                rgba(&row[channels * x..][..channels])
            } else {
                // The leftmost index is in the highest bits.
                let shift = 8 - depth - x * depth % 8;
                let index = row[x * depth / 8] >> shift & (u8::MAX >> (8 - depth));
                *palette.get(usize::from(index)).ok_or_else(damaged)?
            };
            let [red, green, blue, alpha] = pixel;
            ensure!(alpha == 255, "{name} has transparent pixels");
            pixels.push(u32::from_be_bytes([0, red, green, blue]));
        }
    }
    Ok((pixels, size))
}

/// The colours of the palette; none if there is no palette.
fn palette(info: &Info) -> Vec<[u8; 4]> {
    let colors = info.palette.as_deref().unwrap_or_default();
    let alphas = info.trns.as_deref().unwrap_or_default().iter().copied();
    let colors = colors.chunks_exact(3).zip(alphas.chain([255; 256]));
    let colors = colors.map(|(color, alpha)| [color[0], color[1], color[2], alpha]);
    colors.collect()
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
