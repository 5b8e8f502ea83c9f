//! PNG files with a palette, which `image` does not write.

use png::{BitDepth, ColorType, Encoder, Info};

/// A file with this palette and these rows of packed indices. Without rows it ends after the palette.
pub fn indexed(size: [u32; 2], depth: BitDepth, palette: &[[u8; 3]], rows: &[u8]) -> Vec<u8> {
    let mut info = Info::with_size(size[0], size[1]);
    (info.color_type, info.bit_depth) = (ColorType::Indexed, depth);
    info.palette = Some(palette.concat().into());
    with_info(info, rows)
}

/// A file of these rows.
pub fn with_info(info: Info, rows: &[u8]) -> Vec<u8> {
    let mut file = Vec::new();
    let encoder = Encoder::with_info(&mut file, info).expect("it is no animation");
    let mut writer = encoder.write_header().expect("a header");
    if !rows.is_empty() {
        writer
            .write_image_data(rows)
            .expect("as many as the size has");
    }
    drop(writer);
    file
}
