//! The six figures of the assignment equal the stored ones, which a person has looked at.
//!
//! To accept a change after looking at it: `SHADETRADE_BLESS=1 cargo test --test it golden`.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use image::RgbImage;

/// A byte may differ by this much, because the libm of another machine may round differently.
const MAX_LEVELS: u8 = 1;
/// This many pixels may differ by more: for the same reason coverage may differ at an edge.
const MAX_EDGE_PIXELS: usize = 12;

const FIGURES: [&str; 6] = [
    "gouraud-camera-1",
    "gouraud-camera-2",
    "phong-camera-1",
    "phong-camera-2",
    "phong-white-camera-1",
    "phong-white-camera-2",
];

fn golden(figure: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("assets/golden")
        .join(format!("{figure}.png"))
}

fn open(path: &Path) -> RgbImage {
    image::open(path)
        .unwrap_or_else(|error| panic!("{}: {error}", path.display()))
        .into_rgb8()
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
        sheet.put_pixel(x, y, *pixel);
        sheet.put_pixel(width + x, y, *other);
        sheet.put_pixel(
            2 * width + x,
            y,
            image::Rgb(difference.map(|levels| levels.saturating_mul(32))),
        );
    }
    (wrong, sheet)
}

#[test]
fn the_figures_equal_the_stored_ones() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("figures");
    let output = Command::new(env!("CARGO_BIN_EXE_shadetrade"))
        .args(["figures", "-o"])
        .arg(&folder)
        .output()
        .expect("the program runs");
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let mut changed = Vec::new();
    for figure in FIGURES {
        let drawn = folder.join(format!("{figure}.png"));
        if std::env::var_os("SHADETRADE_BLESS").is_some() {
            fs::copy(&drawn, golden(figure)).expect("assets/golden can be written");
        }
        let (wrong, sheet) = compare(&open(&golden(figure)), &open(&drawn));
        if wrong > MAX_EDGE_PIXELS {
            let path = folder.join(format!("{figure}-difference.png"));
            sheet
                .save(&path)
                .expect("the folder of the figures can be written");
            changed.push(format!(
                "{wrong} pixels of {figure}, see {}",
                path.display()
            ));
        }
    }
    assert!(changed.is_empty(), "changed:\n{}", changed.join("\n"));
}

#[test]
fn a_changed_figure_is_noticed() {
    let expected = open(&golden("phong-camera-1"));
    assert_eq!(compare(&expected, &expected).0, 0);
    assert!(compare(&expected, &open(&golden("gouraud-camera-1"))).0 > MAX_EDGE_PIXELS);
}
