//! The six figures of the assignment equal the stored ones, which a person has looked at.
//!
//! To accept a change after looking at it: `SHADETRADE_BLESS=1 cargo test --test it golden`.

use std::fs;
use std::path::{Path, PathBuf};

use image::RgbImage;
use shadetrade::questions::figures::figures;

/// A byte may differ by this much, because the libm of another machine may round differently.
const MAX_LEVELS: u8 = 1;
/// This many pixels may differ by more: for the same reason coverage may differ at an edge.
const MAX_EDGE_PIXELS: usize = 12;

pub const FIGURES: [&str; 6] = [
    "gouraud-camera-1",
    "gouraud-camera-2",
    "phong-camera-1",
    "phong-camera-2",
    "phong-white-camera-1",
    "phong-white-camera-2",
];

fn golden(figure: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/golden");
    folder.join(figure).with_extension("png")
}

fn open(path: &Path) -> RgbImage {
    let picture = image::open(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    picture.into_rgb8()
}

/// The number of pixels that differ by more than allowed, and a picture of expected, actual and difference side by
/// side.
fn compare(expected: &RgbImage, actual: &RgbImage) -> (usize, RgbImage) {
    assert_eq!(expected.dimensions(), actual.dimensions());
    let (width, height) = expected.dimensions();
    let mut sheet = RgbImage::new(3 * width, height);
    let mut wrong = 0;
    for (x, y, pixel) in expected.enumerate_pixels() {
        let other = actual.get_pixel(x, y);
        let difference = [0, 1, 2].map(|channel| pixel[channel].abs_diff(other[channel]));
        wrong += usize::from(difference.iter().any(|&levels| levels > MAX_LEVELS));
        let amplified = difference.map(|levels| levels.saturating_mul(32));
        for (part, color) in (0..).zip([*pixel, *other, image::Rgb(amplified)]) {
            sheet.put_pixel(part * width + x, y, color);
        }
    }
    (wrong, sheet)
}

#[test]
fn the_figures_equal_the_stored_ones() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("figures");
    figures(&folder).expect("they are drawn");
    let mut changed = Vec::new();
    for figure in FIGURES {
        let drawn = folder.join(figure).with_extension("png");
        if std::env::var_os("SHADETRADE_BLESS").is_some() {
            fs::copy(&drawn, golden(figure)).expect("assets/golden can be written");
        }
        let (wrong, sheet) = compare(&open(&golden(figure)), &open(&drawn));
        if wrong > MAX_EDGE_PIXELS {
            let path = folder.join(format!("{figure}-difference.png"));
            sheet.save(&path).expect("the folder can be written");
            changed.push(format!("{wrong} pixels of {figure}, see {path:?}"));
        }
    }
    assert!(changed.is_empty(), "changed:\n{}", changed.join("\n"));
}
