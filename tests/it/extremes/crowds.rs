//! Extremes that need a generator: thousands of lights and cuboids, and the largest picture.

use shadetrade::questions::prove::{nearest, prove_at};
use shadetrade::reference::{Interval, Reference, Seen};
use shadetrade::shading::SquareKind;
use shadetrade::systems;

use super::{MATERIAL, is_full};
use crate::support::prelude::*;

const EYE: DVec3 = DVec3::new(7.0, 5.0, 8.0);

const TOLERANCES: [f64; 2] = [0.0, 0.5];

/// Views of the origin in both projections and modes.
fn views(size: [usize; 2], eye: DVec3) -> Vec<View> {
    let mut views = Vec::new();
    for projection in Projection::ALL {
        for mode in ShadingMode::ALL {
            views.push(view(size, eye, DVec3::ZERO, projection).shaded(mode));
        }
    }
    views
}

fn at_both_tolerances(views: &[View]) -> impl Iterator<Item = View> {
    let both = |view: &View| TOLERANCES.map(|tolerance| view.with_tolerance(tolerance));
    views.iter().flat_map(both)
}

fn one_cuboid() -> World {
    let mut world = empty();
    let size = DVec3::new(4.0, 3.0, 2.0);
    spawn_cuboid(&mut world, size, at(DVec3::ZERO), MATERIAL);
    world
}

fn light_all(world: &mut World, place: DVec3) {
    for (kind, levels) in [
        (LightKind::Diffuse, 170.0),
        (LightKind::Specular, 255.0),
        (LightKind::Ambient, 100.0),
    ] {
        shine(world, kind, levels, place);
    }
}

/// Asserts that every pixel of a view is proven at both tolerances, and that at least this many show a cuboid.
fn assert_proven(world: &mut World, view: &View, least: u64) {
    let (level, monitor) = (Level::new(), Monitor::NONE);
    let proofs = done(prove_at(TOLERANCES, world, view, None, level, monitor));
    assert_eq!(proofs.each_ref().map(|proof| proof.limit), [0.05, 0.5]);
    for proof in proofs {
        let open = (proof.refuted, proof.undecided);
        assert_eq!(open, (0, 0), "{view:?}: {:?}", proof.examples);
        assert!(proof.covered >= least, "{} pixels", proof.covered);
    }
}

#[test]
fn a_thousand_lights_are_proven() {
    let mut world = one_cuboid();
    for step in (0..1000).map(f64::from) {
        let place = DVec3::new(step % 7.0 - 3.0, step % 5.0 + 2.0, step % 11.0 - 1.0) * 1.7;
        shine(&mut world, LightKind::Diffuse, 0.2, place);
        shine(&mut world, LightKind::Specular, 0.5, place);
    }
    for view in views([32, 24], EYE) {
        assert_proven(&mut world, &view, 100);
    }
}

/// A block of 25 x 20 x 20 cuboids, each with its own rotation; its last layer alone, unless everything is drawn.
#[test]
fn ten_thousand_cuboids_are_proven() {
    let mut world = empty();
    for index in if is_full() { 0 } else { 9_750 }..10_000 {
        let [x, y, z] = [index % 25, index / 25 % 20, index / 500].map(f64::from);
        let position = [0.3 * x - 3.6, 0.3 * y - 2.85, 0.3 * z - 3.0];
        let transform = placed(position, DVec3::new(7.0, 13.0, 29.0) * f64::from(index));
        spawn_cuboid(&mut world, DVec3::new(0.3, 0.2, 0.25), transform, MATERIAL);
    }
    light_all(&mut world, DVec3::splat(10.0));
    // Both projections and both modes.
    let some = if is_full() { 0..4 } else { 1..3 };
    for mut view in views([96, 72], EYE).drain(some) {
        view.camera.fov = 45.0;
        assert_proven(&mut world, &view, 1000);
    }
}

/// Over a whole face the normals turn by more than a right angle. Speed is lost if such a face needs f64.
#[test]
fn faces_of_a_few_pixels_are_evaluated_in_f32() {
    let mut world = one_cuboid();
    light_all(&mut world, DVec3::splat(10.0));
    for view in at_both_tolerances(&views([20, 16], EYE)) {
        let counts = draw(&mut world, &view, Keep::Display).counts();
        assert!(counts.covered_pixels > 30, "{counts:?}");
        assert_eq!(counts.squares[SquareKind::InF64 as usize], 0, "{view:?}");
        assert_eq!(counts.squares.iter().sum::<u64>(), 3, "faces: {view:?}");
    }
}

/// The bytes of one pixel in a hundred thousand.
#[test]
fn the_largest_picture_is_proven_in_samples() {
    let side = if is_full() { 16_384 } else { 1024 };
    let mut world = one_cuboid();
    light_all(&mut world, DVec3::splat(10.0));
    let view = view([side, side], EYE, DVec3::ZERO, Projection::Perspective);
    let view = view.shaded(ShadingMode::Phong).with_tolerance(0.5);
    let workers = Workers::new(2, Level::new()).expect("the system gives threads");
    let mut frame = Frame::new(Keep::Display, workers);
    systems::draw(&mut world, &view, &mut frame).expect("there is a gigabyte");
    let reference = Reference::<Interval>::new(&world, &view);
    let mut covered = 0;
    for step in 0..2_000 {
        // Multiples of the golden ratio and its square are evenly distributed (Roberts 2018).
        let place @ [x, y] = [0.754_877_666, 0.569_840_291]
            .map(|share: f64| (share * f64::from(step)).fract() * side as f64)
            .map(|coordinate| coordinate as usize);
        let [_, bytes @ ..] = frame.pixels()[y * side + x].to_be_bytes();
        // The bytes are known, but not the face, so any possible face counts.
        let all = reference.at(place);
        let face = all.iter().map(Seen::face).find(|face| {
            let error = nearest(*face, bytes.map(f64::from), &all);
            error.is_some_and(|[_, most]| most <= view.tolerance + 0.5)
        });
        let face = face.unwrap_or_else(|| panic!("{place:?} is {bytes:?}, not {all:?}"));
        covered += u64::from(face.is_some());
    }
    assert!(covered > 500, "{covered} samples show the cuboid");
}
