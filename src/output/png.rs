//! PNG files of one picture, and animated ones, whose frames store only the rectangle that differs from the frame before.

use std::io;
use std::ops::Range;
use std::time::Duration;

use png::{BitDepth, BlendOp, ColorType, Compression, Encoder, Filter, Writer};

/// A PNG of 0x00RRGGBB pixels. A copy of 3 bytes per pixel is held meanwhile.
///
/// # Errors
/// If the copy does not fit in memory.
pub fn encode_png(pixels: &[u32], size: [usize; 2]) -> io::Result<Vec<u8>> {
    let mut file = Vec::new();
    let mut encoder = encoder(&mut file, size, Compression::Fast);
    encoder.set_filter(Filter::Adaptive);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&rgb(pixels)?)?;
    writer.finish()?;
    Ok(file)
}

/// An encoder of pictures with 8 bits for each of red, green and blue.
fn encoder(
    file: &mut Vec<u8>,
    [width, height]: [usize; 2],
    compression: Compression,
) -> Encoder<'static, &mut Vec<u8>> {
    let mut encoder = Encoder::new(file, width as u32, height as u32);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(compression);
    encoder
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

/// An animated PNG that is being written.
pub struct Animation<'a> {
    writer: Writer<&'a mut Vec<u8>>,
    size: [usize; 2],
    /// The last frame, 0x00RRGGBB; empty before the first.
    last: Vec<u32>,
}

impl<'a> Animation<'a> {
    /// Begins an animation of `frames` frames of `size` pixels. It is encoded into `file`.
    ///
    /// # Errors
    /// If the header cannot be written.
    pub fn new(file: &'a mut Vec<u8>, size: [usize; 2], frames: usize) -> io::Result<Self> {
        let mut encoder = encoder(file, size, Compression::High);
        encoder.set_animated(frames as u32, 0)?;
        encoder.set_blend_op(BlendOp::Source)?;
        Ok(Animation {
            writer: encoder.write_header()?,
            size,
            last: Vec::new(),
        })
    }

    /// Adds a frame that is shown for `time`, one minute at most.
    ///
    /// # Errors
    /// If the frame cannot be written.
    pub fn add(&mut self, pixels: &[u32], time: Duration) -> io::Result<()> {
        let [columns, rows] = self.changed(pixels);
        let mut part = Vec::with_capacity(columns.len() * rows.len());
        for row in rows.clone() {
            part.extend_from_slice(&pixels[row * self.size[0]..][columns.clone()]);
        }
        let milliseconds = time.as_millis().min(60_000) as u16;
        let [x, y] = [columns.start as u32, rows.start as u32];
        let [across, down] = [columns.len() as u32, rows.len() as u32];
        let writer = &mut self.writer;
        writer.reset_frame_position()?;
        writer.set_frame_dimension(across, down)?;
        writer.set_frame_position(x, y)?;
        writer.set_frame_delay(milliseconds, 1000)?;
        writer.write_image_data(&rgb(&part)?)?;
        pixels.clone_into(&mut self.last);
        Ok(())
    }

    /// Ends the file.
    ///
    /// # Errors
    /// If the end cannot be written or frames are missing.
    pub fn finish(self) -> io::Result<()> {
        Ok(self.writer.finish()?)
    }

    /// The columns and rows in which a frame differs from the last one; one pixel if it does not differ.
    fn changed(&self, pixels: &[u32]) -> [Range<usize>; 2] {
        let [width, height] = self.size;
        if self.last.is_empty() {
            return [0..width, 0..height];
        }
        let (mut columns, mut rows) = (width..0, height..0);
        for (index, (now, last)) in pixels.iter().zip(&self.last).enumerate() {
            if now != last {
                let [x, y] = [index % width, index / width];
                columns = columns.start.min(x)..columns.end.max(x + 1);
                rows = rows.start.min(y)..rows.end.max(y + 1);
            }
        }
        if rows.is_empty() {
            return [0..1, 0..1];
        }
        [columns, rows]
    }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::*;

    #[test]
    fn a_frame_stores_the_rectangle_that_changed_and_its_time() {
        let mut bytes = Vec::new();
        let mut animation = Animation::new(&mut bytes, [4, 3], 4).expect("a header");
        let mut pixels = vec![0; 12];
        for (changed, milliseconds) in [(0, 40), (9, 1500), (6, 70_000), (6, 1)] {
            pixels[changed] += u32::from(milliseconds != 1);
            let time = Duration::from_millis(milliseconds);
            animation.add(&pixels, time).expect("a frame");
        }
        animation.finish().expect("an end");
        let mut reader = png::Decoder::new(Cursor::new(&bytes))
            .read_info()
            .expect("a PNG");
        for expected in [
            ([0, 0, 4, 3], 40, 1),
            ([1, 2, 1, 1], 1500, 1),
            ([2, 1, 1, 1], 60_000, 1),
            ([0, 0, 1, 1], 1, 1),
        ] {
            let mut bytes = [0; 36];
            reader.next_frame(&mut bytes).expect("a frame");
            let frame = reader.info().frame_control.expect("it is animated");
            let place = [frame.x_offset, frame.y_offset, frame.width, frame.height];
            assert_eq!((place, frame.delay_num, bytes[2]), expected);
        }
    }
}
