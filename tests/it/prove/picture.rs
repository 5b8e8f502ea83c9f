//! Pictures of other programs: their bytes are judged without known faces.

use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};
use shadetrade::output::read_png;
use shadetrade::questions::prove::Verdict;
use shadetrade::scene::BUILT_IN;

use super::judged;
use crate::support::prelude::*;

const SIZE: [usize; 2] = [80, 60];

#[test]
fn the_renderers_own_bytes_are_proven_and_a_changed_one_is_refuted() {
    for (name, text) in BUILT_IN {
        for mode in [ShadingMode::Gouraud, ShadingMode::Phong] {
            for projection in Projection::ALL {
                let mut scene = Scene::parse(name, text).expect("a built-in scene");
                let view = View {
                    projection,
                    ..View::of(&scene.world, SIZE).with_tolerance(0.0)
                };
                let view = view.shaded(mode);
                let frame = draw(&mut scene.world, &view, Keep::Display);
                let mut picture = frame.pixels().to_vec();
                let proof = judged(&mut scene.world, &view, &picture);
                let what = format!("{name}, {mode:?}, {projection:?}");
                let open = [proof.refuted, proof.undecided];
                assert_eq!(open, [0, 0], "{what}: {:?}", proof.examples);

                let is_inside = |pixel: &usize| {
                    let mark = proof.marks[*pixel];
                    mark.is_covered && !mark.is_outline && picture[*pixel] & 0xff >= 2
                };
                let pixel = (0..picture.len()).find(is_inside);
                let pixel = pixel.expect("a cuboid is seen");
                picture[pixel] -= 2;
                let proof = judged(&mut scene.world, &view, &picture);
                assert_eq!(proof.refuted, 1, "{what}");
                let example = &proof.examples[0];
                assert_eq!(example.pixel, [pixel % SIZE[0], pixel / SIZE[0]], "{what}");
                assert_eq!(example.verdict, Verdict::Refuted);
                // A byte is at most half a level from its level.
                assert!((1.5..=2.5).contains(&example.error[0]), "{example:?}");
                assert!(example.face.is_some());
            }
        }
    }
}

#[test]
fn a_colour_profile_is_not_unpacked() {
    let mut file = Vec::new();
    let mut encoder = PngEncoder::new(&mut file);
    let profile = encoder.set_icc_profile(vec![0; 30 << 20]);
    profile.expect("a PNG may have one");
    let pixels = [1, 2, 3, 4, 5, 6];
    let written = encoder.write_image(&pixels, 2, 1, ExtendedColorType::Rgb8);
    written.expect("it fits");
    let folder = tempfile::tempdir().expect("there is room for a folder");
    let path = folder.path().join("a.png");
    std::fs::write(&path, file).expect("it is written");
    let mut picture = Vec::new();
    let used = allocation_counter::measure(|| picture = read_png(&path).expect("a PNG").0);
    assert_eq!(picture, [0x0001_0203, 0x0004_0506]);
    assert!(used.bytes_max < 10 << 20, "{used:?}");
}
