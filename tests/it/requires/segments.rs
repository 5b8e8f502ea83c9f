//! The fewest segments of Gouraud: numbers known on paper, and a search of all numbers in f64.

use std::sync::Mutex;

use shadetrade::components::LightKind::{Ambient, Diffuse, Specular};
use shadetrade::output::CANCELLED;
use shadetrade::questions::metrics::pixel_error;
use shadetrade::questions::requires::Part;
use shadetrade::questions::requires::segments::{FewestSegments, fewest_segments};

use super::{change, cubes, from_z};
use crate::extremes::enlarged;
use crate::support::prelude::*;

fn of(scene: &Scene, view: &View) -> Vec<FewestSegments> {
    done(fewest_segments(scene, view, Monitor::NONE))
}

/// The largest error of each number of segments in f64, if only this cuboid has Gouraud shading.
fn errors(scene: &Scene, view: &View, cuboid: usize) -> Vec<f64> {
    let mut scene = scene.snapshot();
    let modes = scene.world.query_mut::<(&Mesh, &mut ShadingMode)>();
    for (number, (_, mode)) in modes.into_iter().enumerate() {
        let is_own = number == cuboid;
        *mode = if is_own {
            ShadingMode::Gouraud
        } else {
            ShadingMode::Phong
        };
    }
    let pixels = |view: &View| truth(&scene.world, view).levels;
    let exact = pixels(&view.shaded(ShadingMode::Phong));
    let error = |segments: u32| {
        let segments = Segments::new(segments);
        let drawn = pixels(&View { segments, ..*view });
        let pairs = drawn.iter().zip(&exact);
        let errors = pairs.map(|(one, other)| pixel_error(*one, *other));
        errors.fold(0.0, f64::max)
    };
    (1..=256).map(error).collect()
}

/// Asserts the number of segments, and that the largest error encloses the known one, narrowly.
#[track_caller]
fn assert_found(found: &FewestSegments, segments: Option<u32>, known: f64, what: &str) {
    assert_eq!(found.segments, segments, "{what}");
    let [least, most] = found.largest_error;
    let is_known = least <= known + 1e-9 && known <= most + 1e-9 && most - least < 1e-6;
    assert!(is_known, "{what}, {known}: {found:?}");
}

/// A pixel in the middle of a face, which the light above it lights fully. A vertex lies there if the number is even. The
/// corners have 1 / sqrt(3) of the light's 200 levels: with face normals at the height of the light, 1 above the face; with
/// their own if the light is far away.
#[test]
fn an_even_number_has_a_vertex_in_the_middle_of_a_face() {
    let mut view = from_z(8.0, Projection::Perspective);
    view.size = [1, 1];
    for (mode, height) in [(NormalMode::Face, 2.0), (NormalMode::Corner, 1e13)] {
        let light = (Diffuse, 200.0, DVec3::Z * height);
        let mut scene = cubes(&[at(DVec3::ZERO)], &[light], &view);
        overwrite(&mut scene.world, &mode);
        let off = 200.0 * (1.0 - 1.0 / 3.0_f64.sqrt());
        for (tolerance, segments, known) in [(0.5, 2, 0.0), (84.6, 1, off), (84.5, 2, 0.0)] {
            let [found] = &of(&scene, &view.with_tolerance(tolerance))[..] else {
                panic!("one cuboid")
            };
            assert_found(found, Some(segments), known, &format!("{mode:?}"));
        }
    }
}

#[test]
fn the_answer_is_that_of_a_search_of_all_numbers() {
    let mut view = from_z(9.0, Projection::Perspective);
    view.size = [33, 25];
    let turned = placed(DVec3::X * 1.5, [30.0, 50.0, 0.0]);
    let places = [at(DVec3::X * -1.5), turned];
    let lights = [
        (Ambient, 20.0, DVec3::ZERO),
        (Diffuse, 150.0, DVec3::new(1.0, 2.0, 4.0)),
        (Specular, 300.0, DVec3::new(-2.0, 1.0, 5.0)),
    ];
    let mut answers = Vec::new();
    for normals in NormalMode::ALL {
        let mut scene = cubes(&places, &lights, &view);
        overwrite(&mut scene.world, &normals);
        let errors = [0, 1].map(|cuboid| errors(&scene, &view, cuboid));
        for tolerance in [0.0, 0.02, 0.5, 4.0] {
            let view = view.with_tolerance(tolerance);
            let limit = limit(tolerance);
            let found = of(&scene, &view);
            for (found, errors) in found.iter().zip(&errors) {
                let fewest = errors.iter().position(|error| *error <= limit);
                let error = errors[fewest.unwrap_or(255)];
                let fewest = fewest.map(|it| it as u32 + 1);
                assert_found(found, fewest, error, &format!("{normals:?}, {tolerance}"));
                answers.push(found.segments);
            }
            // The shading and the segments of the scene do not matter.
            let mut other = scene.snapshot();
            overwrite(&mut other.world, &ShadingMode::Gouraud);
            overwrite(&mut other.world, &Segments::new(9).expect("a number"));
            assert_eq!(of(&other, &view), found);
        }
    }
    answers.sort();
    answers.dedup();
    assert!(answers.len() > 6 && answers[0].is_none(), "{answers:?}");
}

/// With smooth edges no vertex lies in the highlight until cells are as small as it. Linear interpolation then errs by the
/// square of a cell's size.
#[test]
fn the_error_of_the_default_scene_falls_by_four_a_doubling_once_cells_resolve_the_highlight() {
    let view = View::of(&built_in().world, enlarged([240, 180]));
    let error = |normals: NormalMode, segments: u32| {
        let scene = changed(|record| {
            let cuboid = &mut record.cuboid[0];
            (cuboid.shading, cuboid.normals) = (ShadingMode::Phong, normals);
            cuboid.segments = Segments::new(segments).expect("a number");
        });
        let [least, most] = change(&scene, &view, Part::EveryPixel(0)).largest_error;
        assert!(most - least < 1e-5, "{segments}: {least} to {most}");
        most
    };
    let smooth = [1, 2, 16, 64, 128, 192].map(|segments| error(NormalMode::Corner, segments));
    let sharp = [1, 2, 16].map(|segments| error(NormalMode::Face, segments));
    assert!(smooth[0] > 150.0 && smooth[1] > 150.0 && smooth[2] > 40.0);
    for (coarse, fine, falls) in [
        (smooth[3], smooth[4], 4.0),
        (smooth[3], smooth[5], 9.0),
        (sharp[1], sharp[2], 64.0),
    ] {
        let found: f64 = coarse / fine;
        assert!((found / falls - 1.0).abs() < 0.15, "{coarse} to {fine}");
    }
    assert!(sharp[0] < 1.0);
}

/// From this distance f64 cannot tell where on a cuboid a pixel lies.
#[test]
fn a_number_that_intervals_do_not_decide_is_no_answer() {
    let mut view = from_z(8.0, Projection::Perspective);
    view.size = [5, 3];
    view.camera.position = DVec3::new(1.0, 0.7, 1.3) * 1e22;
    view.camera.fov = 1e-20;
    let light = (Diffuse, 100.0, DVec3::Z * 8.0);
    let scene = cubes(&[at(DVec3::ZERO)], &[light], &view);
    let [found] = &of(&scene, &view)[..] else {
        panic!("one cuboid")
    };
    assert_eq!(found.segments, None, "{found:?}");
    assert_eq!(found.count(), "more than 256");
}

#[test]
fn progress_is_a_share_and_a_search_can_be_cancelled() {
    let scene = built_in();
    let view = view_from(&scene, 0, [24, 18]).with_tolerance(8.0);
    let shares = Mutex::new(Vec::new());
    let progress = |_, share| shares.lock().unwrap().push(share);
    let monitor = Monitor {
        progress: &progress,
        ..Monitor::NONE
    };
    assert!(finished(fewest_segments(&scene, &view, monitor)).is_ok());
    let shares = shares.into_inner().unwrap();
    assert!(shares.iter().all(|it| (0.0..=1.0).contains(it)) && shares.len() >= 18);
    let error = finished(fewest_segments(&scene, &view, CANCEL)).expect_err("it is cancelled");
    assert_eq!(error.to_string(), CANCELLED);
}
