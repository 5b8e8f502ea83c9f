//! The tolerance: no pixel errs by more than it against the reference in f64.
//!
//! `SHADETRADE_CASES` sets the number of random scenes (default 20) in each mode, each seen in twenty close views.

mod derivatives;
mod overshoot;

use shadetrade::questions::metrics::pixel_error;
use shadetrade::shading::SquareKind;
use shadetrade::shading::simd::{NAMES, name, named};
use shadetrade::systems;
use shadetrade::systems::frame::SQUARE_EDGE;

use crate::stability::life::Bits;
use crate::support::prelude::*;
use crate::support::random_scene::case;

/// The used share of the permitted error at every pixel in which both pictures show the same triangle, with the kind of
/// its square. No share may exceed 1.
#[track_caller]
fn shares(world: &mut World, view: &View) -> Vec<(SquareKind, f64)> {
    let limit = limit(view.tolerance);
    let [frame, shown] = [Keep::Levels, Keep::Display].map(|keep| draw(world, view, keep));
    let truth = truth(world, view);
    let pixels = frame.triangles().iter().zip(&truth.triangles).enumerate();
    let pixels = pixels.filter(|(_, (id, other))| id == other && id.cuboid() == 0);
    let shares = pixels.map(|(pixel, _)| {
        let kind = SquareKind::ALL[usize::from(frame.kinds()[pixel] & !SQUARE_EDGE)];
        let [_, bytes @ ..] = shown.pixels()[pixel].to_be_bytes();
        let exact = truth.levels[pixel];
        let rounded = pixel_error(bytes.map(f64::from), exact);
        assert!(rounded <= limit + 0.5, "{kind:?}: {rounded} of {limit}");
        let share = pixel_error(frame.levels()[pixel], exact) / limit;
        assert!(share <= 1.0, "{kind:?}: {share} of {limit}");
        (kind, share)
    });
    shares.collect()
}

#[test]
fn no_pixel_exceeds_its_tolerance_and_every_kind_of_square_comes_near_it() {
    let (mut most, mut pixels) = ([0.0_f64; SquareKind::ALL.len()], [0; SquareKind::ALL.len()]);
    let (random, scenes) = (&mut Random(5), cases(20));
    for mode in [ShadingMode::Gouraud, ShadingMode::Phong] {
        for case in values(&case(mode), scenes) {
            for _ in 0..20 {
                let tolerance = random.between(0.01, 8.0) * random.one_of(&[0.0, 1.0, 1.0, 1.0]);
                let (mut world, mut view) = case.build([32, 32], tolerance);
                let camera = &mut view.camera;
                let part = random.between(1e-4, 1.0);
                (camera.fov, camera.height) = (camera.fov * part, camera.height * part);
                for (kind, share) in shares(&mut world, &view) {
                    most[kind as usize] = most[kind as usize].max(share);
                    pixels[kind as usize] += 1;
                }
            }
        }
    }
    println!("{most:.3?} of the tolerance, {pixels:?} pixels");
    for kind in SquareKind::ALL {
        // Few scenes have a terminator that needs most of its bound, and few a highlight in the middle of the picture.
        let is_tight = match kind {
            SquareKind::PerPixel | SquareKind::InF64 | SquareKind::Highlight => true,
            SquareKind::Terminator if scenes < 50 => true,
            _ => most[kind as usize] > 0.15,
        };
        assert!(is_tight, "{kind:?} is too loose: {most:?}");
        // A quarter of the cuboids have face normals; most of their squares are linear.
        let is_seen = pixels[kind as usize] > 40 * scenes || kind == SquareKind::Highlight;
        assert!(is_seen, "{kind:?}: {pixels:?}");
    }
}

/// A cuboid on the z axis under one light, seen along `forward` from ten units before the point (0, 0, 1): one square
/// of 32 x 32 pixels of this size.
fn face(
    size: DVec3,
    forward: DVec3,
    pitch: f64,
    shininess: f64,
    (kind, place): (LightKind, DVec3),
) -> (World, View) {
    let mut world = empty();
    spawn_cuboid(&mut world, size, at(DVec3::ZERO), white(shininess));
    shine(&mut world, kind, 255.0, place);
    let eye = DVec3::Z - 10.0 * forward;
    let mut view = view([32, 32], eye, DVec3::Z, Projection::Orthographic);
    view.camera.height = 32.0 * pitch;
    (world, view.shaded(ShadingMode::Phong))
}

#[test]
fn quadratic_squares_come_near_the_tolerance_where_the_bound_is_tight() {
    // The normal rotates along x alone, towards a light that is far away and nearly in the plane of the face.
    let light = (LightKind::Diffuse, DVec3::new(1e6, 0.0, 1.5e5));
    let size = DVec3::new(2.0, 2e3, 2.0);
    let (mut world, view) = face(size, DVec3::NEG_Z, 0.1 / 15.5, 1.0, light);
    let mut most = 0.0_f64;
    for step in 0..60 {
        let view = view.with_tolerance(1e-3 * 1.1_f64.powi(step));
        for (kind, share) in shares(&mut world, &view) {
            if kind == SquareKind::Quadratic {
                most = most.max(share);
            }
        }
    }
    assert!(most > 0.6, "{most} is too loose to show a mistake");
}

/// A square with a highlight in its middle; `mirror` is where the light is from there.
fn highlight(forward: DVec3, pitch: f64, shininess: f64, mirror: DVec3) -> (World, View) {
    let light = (LightKind::Specular, DVec3::Z + mirror);
    face(DVec3::splat(2.0), forward, pitch, shininess, light)
}

#[test]
fn a_highlight_is_a_power_at_each_pixel_where_a_polynomial_bends_too_much() {
    let random = &mut Random(31);
    let (mut most, mut drawn) = (0.0_f64, 0);
    for _ in 0..10 * cases(30) {
        let [x, y] = [(); 2].map(|()| random.within(-0.6, 0.6));
        let forward = DVec3::new(x, y, -1.0).normalize();
        let away = DVec3::new(x, y, 1.0) + random.around(0.1);
        let light = away * random.between(2.0, 1e5);
        let [pitch, shininess] = [random.between(3e-4, 1e-2), random.between(2.0, 1e3)];
        let (mut world, view) = highlight(forward, pitch, shininess, light);
        let view = view.with_tolerance(random.between(0.01, 8.0));
        let counts = draw(&mut world, &view, Keep::Display).counts();
        let [.., exact, in_f64] = counts.squares;
        assert_eq!(exact + in_f64 == 0, counts.model_evaluations == 0);
        for (kind, share) in shares(&mut world, &view) {
            if kind == SquareKind::Highlight {
                most = most.max(share);
                drawn += 1;
            }
        }
    }
    println!("{drawn} pixels, {most:.3} of the tolerance");
    assert!(drawn > 500 * cases(30), "{drawn}");
    // The bound adds what the rotations of n, l and o can do together. `derivatives` shows that it is not too loose.
    assert!(most > 0.02, "{most}");
}

#[test]
fn at_every_simd_level_the_power_of_a_highlight_is_near_the_model_and_counted_once_a_pixel() {
    let [forward, light] = [-1.0, 1e6].map(|z| DVec3::new(0.3, 0.2, 1.0) * z);
    let (mut world, view) = highlight(forward.normalize(), 0.1 / 15.5, 20.0, light);
    let view = view.with_tolerance(4.0);
    let truth = truth(&world, &view);
    let mut first = None;
    for level in NAMES.into_iter().filter_map(named) {
        let mut frame = Frame::new(Keep::Levels, Workers::alone(level));
        systems::draw(&mut world, &view, &mut frame).expect("a small picture fits");
        let counts = frame.counts();
        let highlights = counts.squares[SquareKind::Highlight as usize];
        assert!(highlights > 0 && counts.model_evaluations == 0);
        assert_eq!(counts.specular_evaluations, 256 * highlights);
        for (found, exact) in frame.levels().iter().zip(&truth.levels) {
            assert!(pixel_error(*found, *exact) <= 4.0);
        }
        let bits = Bits::of(&frame).levels;
        let first = first.get_or_insert_with(|| bits.clone());
        assert_eq!(*first, bits, "{}", name(level));
    }
    // Of two such highlights only one can be the fourth channel.
    shine(&mut world, LightKind::Specular, 255.0, light);
    shares(&mut world, &view);
}

#[test]
fn the_error_of_samples_is_subtracted_from_the_tolerance() {
    // The slope of s^1 in |r - o| is at most sqrt(2). |r - o| has 50 roundings and 12 of its directions, 1 - s has four more
    // at this slope and at its own size, the power six, the sum seven: 110. Interpolation enlarges each up to 25/9 times,
    // which makes 307. Rows have fourteen.
    let light = (LightKind::Specular, DVec3::Z * 1e6);
    let (mut world, view) = face(DVec3::splat(2.0), DVec3::NEG_Z, 1e-8, 1.0, light);
    for (roundings, expected) in [(315.0, false), (330.0, true)] {
        let view = view.with_tolerance(roundings * 2.0_f64.powi(-24) * 255.0);
        for (kind, _) in shares(&mut world, &view) {
            assert_eq!(kind == SquareKind::Linear, expected, "{kind:?}");
        }
    }
}

#[test]
fn where_a_highlight_ends_at_the_gate_each_pixel_is_on_its_own_side() {
    // The middle of the picture shows u = 0.3 and v = 0.2, where the normal is (0.3, 0.2, 1) and the light's direction
    // (20, 0, -6): n.l is zero, and the highlight is as bright as can be. In the fine pixels f32 has no sign of n.l.
    let forward = DVec3::new(20.0, 0.0, -6.0).normalize();
    for (pitch, higher) in [(1e-10, 0.0), (1e-3, 0.2), (1e-3, -0.2), (1e-2, 2.0)] {
        let light = (LightKind::Specular, DVec3::new(20.0, 0.0, higher - 5.0));
        // The steepest bends too much for a polynomial.
        for shininess in [0.5, 1.0, 2.0, 4.0, 500.0] {
            let (mut world, view) = face(DVec3::splat(2.0), forward, pitch, shininess, light);
            for transform in world.query_mut::<&mut Transform>().with::<&Mesh>() {
                transform.position = DVec3::new(-0.3, -0.2, 0.0);
            }
            for tolerance in [0.0, 4.0] {
                let shares = shares(&mut world, &view.with_tolerance(tolerance));
                assert_eq!(shares.len(), 1024);
                let is_exact = |(kind, _): &(SquareKind, f64)| *kind == SquareKind::PerPixel;
                assert!(shares.iter().all(is_exact) || pitch > 1e-10);
            }
        }
    }
}

#[test]
fn squares_drawn_together_may_each_have_the_terminator_of_another_light() {
    // n is (u, v, 1), and 256 pixels lie between u = 0 and u = 1: n.l of (1, 0, -u) is 0 at u.
    let light = (LightKind::Diffuse, DVec3::new(1e6, 0.0, -0.1e6));
    let size = DVec3::splat(2.0);
    let (mut world, mut view) = face(size, DVec3::NEG_Z, 1.0 / 256.0, 1.0, light);
    let place = DVec3::new(1e6, 0.0, -0.3e6);
    spawn_light(&mut world, LightKind::Diffuse, DVec3::Z * 200.0, place);
    view.size = [512, 32];
    let mut shares = shares(&mut world, &view.with_tolerance(0.5));
    shares.retain(|(kind, _)| *kind == SquareKind::Terminator);
    assert!(shares.len() >= 512);
}

#[test]
fn a_highlight_on_a_face_that_fills_a_wide_angle_keeps_its_tolerance() {
    let light = (LightKind::Specular, DVec3::new(12.0, 3.0, 60.0));
    let size = DVec3::new(100.0, 100.0, 2.0);
    let (mut world, mut view) = face(size, DVec3::NEG_Z, 1.0, 3.3, light);
    view.projection = Projection::Perspective;
    (view.camera.fov, view.camera.near) = (150.0, Some(1e-3));
    for step in 0..40 {
        view.camera.position = DVec3::Z * (1.0 + 0.02 * 1.2_f64.powi(step));
        shares(&mut world, &view.with_tolerance(0.5));
    }
}

#[test]
fn a_light_close_above_a_face_keeps_the_tolerance() {
    // One square of 2 x 2 units, and a light from a fifth of a pixel to four units above its middle.
    let size = DVec3::new(20.0, 20.0, 2.0);
    for step in 0..40 {
        for kind in [LightKind::Diffuse, LightKind::Specular] {
            let light = (kind, DVec3::Z * (1.0 + 0.0125 * 1.16_f64.powi(step)));
            let (mut world, view) = face(size, DVec3::NEG_Z, 1.0 / 16.0, 3.0, light);
            shares(&mut world, &view.with_tolerance(0.5));
        }
    }
}

#[test]
fn where_the_reflected_light_is_perpendicular_to_the_eye_a_steep_power_keeps_the_tolerance() {
    // In the middle of the picture n is (0, 0, 1), and the light's direction (5, 0, 9) is reflected to (-5, 0, 9).
    let forward = DVec3::new(-9.0, 0.0, -5.0).normalize();
    let light = (LightKind::Specular, DVec3::new(50.0, 0.0, 91.0));
    for pitch in [1e-9, 1e-6, 1e-3] {
        for shininess in [0.1, 0.5, 0.9] {
            let size = DVec3::splat(2.0);
            let (mut world, view) = face(size, forward, pitch, shininess, light);
            for tolerance in [0.0, 0.5, 4.0] {
                shares(&mut world, &view.with_tolerance(tolerance));
            }
        }
    }
}

#[test]
fn every_channel_of_gouraud_keeps_the_tolerance_in_steep_perspective() {
    for levels in DVec3::AXES {
        let size = DVec3::new(40.0, 40.0, 2.0);
        let below = (LightKind::Diffuse, DVec3::Z * -9.0);
        let (mut world, mut view) = face(size, DVec3::NEG_Z, 1.0, 1.0, below);
        let place = DVec3::new(20.0, -20.0, 4.0);
        spawn_light(&mut world, LightKind::Diffuse, levels * 255.0, place);
        (view.projection, view.camera.fov) = (Projection::Perspective, 20.0);
        view.camera.target = DVec3::new(5.0, -12.0, 1.0);
        view = view.shaded(ShadingMode::Gouraud).with_tolerance(0.5);
        for step in 0..40 {
            view.camera.position = DVec3::new(2.0 - 0.5 * f64::from(step), -12.0, 3.0);
            shares(&mut world, &view);
        }
    }
}

#[test]
fn a_highlight_is_evaluated_and_counted_only_on_the_squares_that_it_reaches() {
    // Over four squares side by side n is (u, 0, 1), and u = -3/8 in the middle of the first, where n mirrors the light.
    let n = DVec3::new(-0.375, 0.0, 1.0).normalize();
    let mirrored = 2.0 * n.z * n - DVec3::Z;
    let light = (LightKind::Specular, mirrored * 1e6);
    let size = DVec3::new(2.0, 2e3, 2.0);
    let (mut world, mut view) = face(size, DVec3::NEG_Z, 1.0 / 128.0, 1e4, light);
    view.size = [128, 32];
    let frame = draw(&mut world, &view, Keep::Display);
    assert_eq!(frame.counts().model_evaluations, 4 * 1024);
    assert_eq!(frame.counts().specular_evaluations, 1024);
    // Lights that send nothing change no count, however close they are.
    let counts = |world: &mut World| {
        let views = [0.0, 0.5].map(|tolerance| view.with_tolerance(tolerance));
        views.map(|view| draw(world, &view, Keep::Display).counts())
    };
    let before = counts(&mut world);
    shine(&mut world, LightKind::Diffuse, 0.0, DVec3::Z * 1.01);
    shine(&mut world, LightKind::Specular, 0.0, DVec3::Z * 1.02);
    assert_eq!(counts(&mut world), before);
}

#[test]
fn the_outline_of_a_square_is_its_upper_and_left_edge() {
    let light = (LightKind::Diffuse, DVec3::Z * 9.0);
    let (mut world, view) = face(DVec3::splat(2.0), DVec3::NEG_Z, 1e-3, 1.0, light);
    let frame = draw(&mut world, &view.with_tolerance(4.0), Keep::Levels);
    for (pixel, kind) in frame.kinds().iter().enumerate() {
        let is_edge = pixel < 32 || pixel % 32 == 0;
        assert_eq!(kind & SQUARE_EDGE != 0, is_edge, "pixel {pixel}");
    }
}
