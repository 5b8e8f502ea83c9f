//! `prove` and `extremes`: their JSON, their exit status, and pictures of other programs.

use std::path::Path;

use image::{DynamicImage, ImageFormat};
use serde::Deserialize;
use serde_json::json;

use super::{assert_works, folder, json, run, said};

const SMALL: &str = "--shading phong --tolerance 0";

/// The keys of the contract; the last two are ours.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(dead_code, reason = "the keys and their types are what counts")]
struct Proof {
    scene: String,
    camera: String,
    projection: String,
    size: [u32; 2],
    mode: String,
    tolerance: f64,
    limit: f64,
    pixels: u64,
    proven: u64,
    refuted: u64,
    undecided: u64,
    outline: u64,
    worst: f64,
    widest_enclosure: f64,
    reference_error: f64,
    seconds: f64,
    examples: Vec<Example>,
    covered: u64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(dead_code, reason = "the keys and their types are what counts")]
struct Example {
    pixel: [u32; 2],
    verdict: String,
    drawn: [f64; 3],
    enclosure: [[f64; 2]; 3],
    error: [f64; 2],
    #[serde(deserialize_with = "Option::deserialize")]
    face: Option<u32>,
}

fn proof(folder: &Path, line: &str) -> (Option<i32>, Proof) {
    let (status, json) = json(folder, line);
    (status, serde_json::from_value(json).expect("a proof"))
}

#[test]
fn a_picture_of_any_8_bit_colour_type_is_judged() {
    let folder = folder();
    let folder = folder.path();
    assert_works(folder, &format!("render {SMALL} --size 96x72 -o drawn.png"));
    let drawn = image::open(folder.join("drawn.png")).expect("a PNG");
    let pictures: [(&str, DynamicImage); 4] = [
        ("rgb.png", drawn.to_rgb8().into()),
        ("rgba.png", drawn.to_rgba8().into()),
        ("grey.png", drawn.to_luma8().into()),
        ("grey-alpha.png", drawn.to_luma_alpha8().into()),
    ];
    for (name, picture) in pictures {
        let saved = picture.save_with_format(folder.join(name), ImageFormat::Png);
        saved.expect("it is written");
        let line = format!("prove {SMALL} --picture {name} --json -o map.png");
        let (status, proof) = proof(folder, &line);
        assert_eq!((proof.size, proof.limit), ([96, 72], 0.55));
        if name.contains("grey") {
            assert!(status == Some(1) && proof.refuted > 100, "{name}");
            let errors: Vec<f64> = proof.examples.iter().map(|it| it.error[0]).collect();
            assert!(errors.len() == 10 && errors.is_sorted_by(|a, b| a >= b));
            // At a background level of 236, 238 and 240 grey errs in one channel at least.
            assert!(proof.examples.iter().all(|it| it.verdict == "refuted"));
        } else {
            assert_eq!((status, proof.proven), (Some(0), 96 * 72), "{name}");
        }
        let map = image::open(folder.join("map.png")).expect("a PNG");
        assert_eq!([map.width(), map.height()], proof.size);
    }
    // The picture of Gouraud is not that of Phong; as text, too.
    let line = "prove --shading gouraud --picture drawn.png";
    let output = run(folder, line);
    assert_eq!(output.status.code(), Some(1));
    assert!(said(&output).contains("are refuted"));
}

#[test]
fn a_drawn_picture_is_proven() {
    let folder = folder();
    let (status, proof) = proof(folder.path(), "prove --size 96x72 --json");
    assert_eq!((status, proof.proven), (Some(0), proof.pixels));
    let names = [&proof.scene, &proof.camera, &proof.projection, &proof.mode];
    assert_eq!(names, ["cuboid", "1", "perspective", "gouraud"]);
    assert!(proof.worst > 0.0 && proof.worst <= 0.5 && proof.covered > 1000);
    assert!(proof.reference_error > 0.0 && proof.reference_error < 1e-6);
}

#[test]
fn an_extreme_is_proven_and_drawn_by_its_name() {
    let folder = folder();
    let (status, outcomes) = json(folder.path(), "extremes picture-1x1 extremes/speck --json");
    assert_eq!(status, Some(0));
    let outcomes = outcomes.as_array().expect("a list");
    let names: Vec<_> = outcomes
        .iter()
        .map(|it| json!([it["name"], it["pass"]]))
        .collect();
    assert_eq!(
        names,
        [json!(["picture-1x1", true]), json!(["speck", true])]
    );
    assert_works(
        folder.path(),
        "render extremes/eye-on-an-edge --size 64x48 -o a.png",
    );
}
