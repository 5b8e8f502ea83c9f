//! Pictures of other programs: their bytes are judged without known faces.

use fearless_simd::Level;
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};
use shadetrade::components::{Projection, ShadingMode, View};
use shadetrade::output::Monitor;
use shadetrade::output::finished;
use shadetrade::output::progress::bands;
use shadetrade::questions::prove::{PngPicture, Proof, Verdict, prove, read_png};
use shadetrade::scene::{BUILT_IN, Scene};
use shadetrade::systems::draw_rows;
use shadetrade::systems::frame::{Frame, Keep, Workers};

use crate::support::scene::draw;

const SIZE: [usize; 2] = [80, 60];

/// The renderer's bytes for a window.
fn drawn(scene: &mut Scene, view: &View) -> Vec<u32> {
    draw(&mut scene.world, view, Keep::Display)
        .pixels()
        .to_vec()
}

fn judged(scene: &mut Scene, view: &View, picture: &[u32]) -> Proof {
    let (level, monitor) = (Level::new(), Monitor::NONE);
    finished(prove(&mut scene.world, view, Some(picture), level, monitor))
        .expect("a small picture fits")
}

fn exact(scene: &Scene, mode: ShadingMode, projection: Projection) -> View {
    View {
        projection,
        ..View::of(&scene.world, SIZE)
            .shaded(mode)
            .with_tolerance(0.0)
    }
}

#[test]
fn the_renderers_own_bytes_are_proven_and_a_changed_one_is_refuted() {
    for (name, text) in BUILT_IN {
        for mode in [ShadingMode::Gouraud, ShadingMode::Phong] {
            for projection in Projection::ALL {
                let mut scene = Scene::parse(name, text).expect("a built-in scene");
                let view = exact(&scene, mode, projection);
                let mut picture = drawn(&mut scene, &view);
                let proof = judged(&mut scene, &view, &picture);
                let what = format!("{name}, {mode:?}, {projection:?}");
                assert_eq!(proof.refuted, 0, "{what}: {:?}", proof.examples);
                assert_eq!(proof.undecided, 0, "{what}: {:?}", proof.examples);

                let is_inside = |pixel: &usize| {
                    let mark = proof.marks[*pixel];
                    mark.is_covered && !mark.is_outline && picture[*pixel] & 0xff >= 2
                };
                let pixel = (0..picture.len())
                    .find(is_inside)
                    .expect("a cuboid is seen");
                picture[pixel] -= 2;
                let proof = judged(&mut scene, &view, &picture);
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

/// A proof draws the picture in bands of rows.
#[test]
fn the_bands_of_a_proof_have_the_bits_of_the_whole_picture() {
    let mut scene = Scene::load(None).expect("the built-in scene");
    for mode in [ShadingMode::Gouraud, ShadingMode::Phong] {
        for tolerance in [0.0, 0.5] {
            let view = View::of(&scene.world, [131, 197]).shaded(mode);
            let view = view.with_tolerance(tolerance);
            let whole = draw(&mut scene.world, &view, Keep::Levels);
            let mut band = Frame::new(Keep::Levels, Workers::alone(Level::new()));
            for rows in bands(197) {
                let pixels = 131 * rows.start..131 * rows.end;
                draw_rows(&mut scene.world, &view, rows, &mut band).expect("it fits");
                let bits = |levels: &[[f32; 3]]| {
                    levels
                        .as_flattened()
                        .iter()
                        .map(|it| it.to_bits())
                        .collect::<Vec<_>>()
                };
                assert_eq!(band.triangles(), &whole.triangles()[pixels.clone()]);
                assert!(bits(band.levels()) == bits(&whole.levels()[pixels]));
            }
        }
    }
}

#[test]
fn a_picture_moved_by_a_pixel_is_refuted_along_its_edges() {
    let mut scene = Scene::load(None).expect("the built-in scene");
    for projection in Projection::ALL {
        let view = exact(&scene, ShadingMode::Phong, projection);
        let picture = drawn(&mut scene, &view);
        for moved in [1, SIZE[0]] {
            for back in [0, 2 * moved] {
                let mut picture = picture.clone();
                picture.rotate_right(moved);
                picture.rotate_left(back);
                let proof = judged(&mut scene, &view, &picture);
                assert!(proof.refuted > 30, "{moved} {back}: {}", proof.refuted);
            }
        }
    }
}

#[test]
fn gouraud_is_refuted_as_phong_by_its_known_error() {
    let mut scene = Scene::load(None).expect("the built-in scene");
    let view = exact(&scene, ShadingMode::Phong, Projection::Perspective);
    let gouraud = view.shaded(ShadingMode::Gouraud);
    let picture = drawn(&mut scene, &gouraud);
    let proof = judged(&mut scene, &view, &picture);
    assert!(proof.refuted > 100, "{}", proof.refuted);
    let errors: Vec<f64> = proof.examples.iter().map(|it| it.error[0]).collect();
    assert!(errors.is_sorted_by(|one, other| one >= other), "{errors:?}");
    // The highlight is missing: 160 levels of red under Phong.
    assert!(errors[0] > 100.0, "{errors:?}");
    // Under the largest tolerance it is proven, and its errors and widths stand in the proof.
    let proof = judged(&mut scene, &view.with_tolerance(255.0), &picture);
    assert_eq!(proof.proven, (SIZE[0] * SIZE[1]) as u64);
    assert!(proof.worst >= errors[0], "{}", proof.worst);
    assert!(proof.widest_enclosure > 0.0 && proof.widest_enclosure < 1e-6);
}

/// Reads a PNG of another program.
fn read(file: &[u8]) -> PngPicture {
    let folder = tempfile::tempdir().expect("there is room for a folder");
    let path = folder.path().join("a.png");
    std::fs::write(&path, file).expect("it is written");
    read_png(&path).unwrap_or_else(|error| panic!("{error:#}"))
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
    let mut picture = Vec::new();
    let used = allocation_counter::measure(|| picture = read(&file).0);
    assert_eq!(picture, [0x0001_0203, 0x0004_0506]);
    assert!(used.bytes_max < 10 << 20, "{used:?}");
}
