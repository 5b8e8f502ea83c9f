//! `prove --picture`: PNG files of other programs, and files that cannot be judged.

use std::fs;
use std::path::Path;

use image::{DynamicImage, ImageFormat};
use serde_json::Value;

use super::{assert_fails, assert_works, folder, run, said};

const SMALL: &str = "--shading phong --tolerance 0";

/// Writes the picture of the built-in scene as a PNG of another colour type.
fn write(folder: &Path, name: &str, kind: impl Fn(DynamicImage) -> DynamicImage) {
    let picture = image::open(folder.join("drawn.png")).expect("a PNG");
    let path = folder.join(name);
    kind(picture)
        .save_with_format(path, ImageFormat::Png)
        .expect("written");
}

fn judged(folder: &Path, name: &str) -> (Option<i32>, Value) {
    let output = run(folder, &format!("prove {SMALL} --picture {name} --json"));
    let json =
        serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{}", said(&output)));
    (output.status.code(), json)
}

#[test]
fn a_picture_of_any_8_bit_colour_type_is_judged() {
    let folder = folder();
    let folder = folder.path();
    assert_works(folder, &format!("render {SMALL} --size 96x72 -o drawn.png"));
    write(folder, "alpha.png", |it| it.into_rgba8().into());
    write(folder, "grey.png", |it| it.into_luma8().into());
    for name in ["drawn.png", "alpha.png"] {
        let (status, json) = judged(folder, name);
        assert_eq!(status, Some(0), "{name}");
        assert_eq!(json["size"], serde_json::json!([96, 72]));
        assert_eq!(json["proven"], 96 * 72, "{name}");
        assert_eq!(json["limit"], 0.55);
    }
    let (status, json) = judged(folder, "grey.png");
    assert_eq!(status, Some(1));
    assert!(json["refuted"].as_u64() > Some(100), "{json}");
    assert_works(
        folder,
        &format!("prove {SMALL} --picture drawn.png -o map.png"),
    );
    let map = image::open(folder.join("map.png")).expect("a PNG");
    assert_eq!([map.width(), map.height()], [96, 72]);
}

#[test]
fn a_file_that_cannot_be_judged_is_an_error_with_the_reason() {
    let folder = folder();
    let folder = folder.path();
    assert_works(folder, &format!("render {SMALL} --size 96x72 -o drawn.png"));
    write(folder, "deep.png", |it| it.into_rgb16().into());
    write(folder, "clear.png", |it| {
        let mut picture = it.into_rgba8();
        picture.get_pixel_mut(3, 4).0[3] = 254;
        picture.into()
    });
    let png = fs::read(folder.join("drawn.png")).expect("a PNG");
    fs::write(folder.join("half.png"), &png[..png.len() / 2]).expect("written");
    fs::write(folder.join("text.png"), "no picture").expect("written");
    for (words, reason) in [
        ("--picture deep.png", "16 bits"),
        ("--picture clear.png", "transparent"),
        ("--picture half.png", "damaged"),
        ("--picture text.png", "not a PNG"),
        ("--picture absent.png", "cannot read"),
        ("--picture .", "not a file"),
        ("--picture drawn.png --size 96x72", "--size"),
        ("--picture drawn.png -o drawn.png", "the picture itself"),
    ] {
        assert_fails(folder, &format!("prove {words}"), 2, &[reason]);
    }
    assert_eq!(fs::read(folder.join("drawn.png")).expect("kept"), png);
}
