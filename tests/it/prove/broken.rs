//! Deliberately wrong pictures are refuted, and the right one is proven.

use shadetrade::components::{LightKind, Projection, ShadingMode, View};
use shadetrade::prove::{Shown, judge};
use shadetrade::reference::{Interval, Seen};
use shadetrade::scene::Scene;

use crate::support::scene::view_from;

use super::enclosures;
use super::naive::{self, Model, RIGHT};

const SIZE: [usize; 2] = [64, 48];

/// The permitted error at tolerance 0, in levels of 255.
const EXACT: f64 = 0.05;

/// The built-in scene in both modes and projections, and the surfaces that its pixels may show.
fn check(each: impl Fn(&naive::Scene<f64>, ShadingMode, Projection, &[Vec<Seen<Interval>>])) {
    let scene = Scene::load(None).expect("the built-in scene is right");
    for mode in [ShadingMode::Gouraud, ShadingMode::Phong] {
        for projection in Projection::ALL {
            let view = View {
                projection,
                ..view_from(&scene, 0, SIZE).shaded(mode)
            };
            let seen = enclosures(&scene.world, &view);
            let naive = naive::Scene::new(&scene.world, &view);
            each(&naive, mode, projection, &seen);
        }
    }
}

/// A pixel as a wrong model draws it.
fn shown(scene: &naive::Scene<f64>, pixel: usize, face: Option<usize>, model: Model) -> Shown {
    let at = [pixel % SIZE[0], pixel / SIZE[0]];
    Shown {
        face,
        levels: face.map_or([236.0, 238.0, 240.0], |face| scene.levels(face, at, model)),
        bytes: None,
    }
}

/// The numbers of proven, undecided and refuted pixels of a picture.
fn count(
    pixels: impl Iterator<Item = Shown>,
    seen: &[Vec<Seen<Interval>>],
    limit: f64,
) -> [usize; 3] {
    let mut counts = [0; 3];
    for (shown, seen) in pixels.zip(seen) {
        counts[judge(shown, seen, limit).0.verdict as usize] += 1;
    }
    counts
}

/// The numbers of proven, undecided and refuted pixels that `model` draws.
fn evaluated(scene: &naive::Scene<f64>, seen: &[Vec<Seen<Interval>>], model: Model) -> [usize; 3] {
    let faces = seen.iter().map(|seen| seen[0].face()).enumerate();
    let pixels = faces.map(|(pixel, face)| shown(scene, pixel, face, model));
    count(pixels, seen, EXACT)
}

#[test]
fn the_model_is_proven_and_every_wrong_one_is_refuted() {
    check(|scene, mode, projection, seen| {
        let right = evaluated(scene, seen, RIGHT);
        assert_eq!(right, [SIZE[0] * SIZE[1], 0, 0], "{mode:?} {projection:?}");
        let is_phong = mode == ShadingMode::Phong;
        let is_perspective = projection == Projection::Perspective;
        let without = |kind| Model {
            without: Some(kind),
            ..RIGHT
        };
        let [mut affine, mut short, mut exponent] = [RIGHT; 3];
        affine.is_affine = true;
        short.is_short = true;
        exponent.exponent = 1.001;
        let wrong = [
            (true, without(LightKind::Ambient)),
            (true, without(LightKind::Diffuse)),
            // No corner is in a highlight.
            (is_phong, without(LightKind::Specular)),
            // In orthographic projection both are equal.
            (is_perspective, affine),
            (is_phong, short),
            (is_phong, exponent),
        ];
        for (_, model) in wrong.iter().filter(|(matters, _)| *matters) {
            let [_, undecided, refuted] = evaluated(scene, seen, *model);
            println!("{mode:?} {projection:?} {model:?}: {refuted} refuted");
            assert_eq!(undecided, 0, "{model:?}");
            assert!(refuted > 0, "{mode:?} {projection:?} {model:?}");
        }
    });
}

#[test]
fn a_picture_moved_by_a_pixel_is_refuted_along_every_edge_that_it_leaves() {
    check(|scene, mode, projection, seen| {
        let width = SIZE[0] as isize;
        for moved in [1, -1, width, -width] {
            let from = |pixel: usize| (pixel as isize + moved).rem_euclid(seen.len() as isize);
            let faces: Vec<_> = (0..seen.len())
                .map(|pixel| seen[from(pixel) as usize][0].face())
                .collect();
            // Only coverage is moved; the levels are those of the visible plane.
            let pixels = (0..seen.len()).map(|pixel| shown(scene, pixel, faces[pixel], RIGHT));
            let [_, _, refuted] = count(pixels, seen, EXACT);
            let left = (seen.iter().zip(&faces))
                .filter(|(seen, face)| seen.iter().all(|seen| seen.face() != **face));
            assert_eq!(refuted, left.count(), "{mode:?} {projection:?} {moved}");
            assert!(refuted > SIZE[1] / 2, "{refuted} at {moved}");
        }
    });
}
