//! Whole pictures within a tolerance against exact ones.

use glam::DVec3;
use hecs::World;
use shadetrade::components::{LightKind, Material, Projection, ShadingMode, Transform, View};
use shadetrade::frame::{Keep, NO_TRIANGLE};

use super::SCENES;
use crate::support::cases::cases;
use crate::support::random::Random;
use crate::support::scene::{at, draw, empty, spawn_cuboid, spawn_light, view};

/// A cuboid, up to five lights (some close to a face, some at one position) and a camera (some close).
fn scene(random: &mut Random) -> (World, View) {
    let mut world = empty();
    let size = DVec3::new(
        random.decade(-0.5, 0.5),
        random.decade(-0.5, 0.5),
        random.decade(-0.5, 0.5),
    ) * 2.0;
    let transform = Transform {
        position: random.vector(-1.0, 1.0),
        rotation: random.vector(-180.0, 180.0),
    };
    let material = Material {
        ambient: random.vector(0.0, 1.0),
        diffuse: random.vector(0.0, 1.0),
        specular: random.vector(0.0, 1.0),
        shininess: random.decade(-0.301, 3.0),
    };
    spawn_cuboid(&mut world, size, transform, material);
    let mut position = DVec3::ZERO;
    for index in 0..=random.one_of(&[0, 1, 2, 3, 4]) {
        if index == 0 || random.one_of(&[true, true, false]) {
            position = if random.one_of(&[true, false, false]) {
                // A tenth above a face, anywhere over it or just outside it.
                let axis = random.one_of(&[0, 1, 2]);
                let mut local = random.vector(-0.6, 0.6) * size;
                local[axis] = (0.5 * size[axis] + 0.1) * random.one_of(&[-1.0, 1.0]);
                transform.position + transform.axes() * local
            } else {
                random.vector(-12.0, 12.0)
            };
        }
        let kind = random.one_of(&[
            LightKind::Ambient,
            LightKind::Diffuse,
            LightKind::Diffuse,
            LightKind::Specular,
            LightKind::Specular,
        ]);
        let levels = random.vector(0.0, 1.0) * random.decade(0.0, 3.0);
        spawn_light(&mut world, kind, levels, position);
    }
    let direction = loop {
        let direction = random.vector(-1.0, 1.0);
        if direction.length() > 0.1 {
            break direction.normalize();
        }
    };
    let distance = size.length() * random.decade(-0.25, 0.8);
    let target = transform.position + random.vector(-0.3, 0.3) * size;
    let fov = random.within(10.0, 100.0);
    let height = size.length() * random.within(0.2, 1.5);
    let pixels = [
        random.one_of(&[64, 150, 320]),
        random.one_of(&[48, 100, 240]),
    ];
    let projection = random.one_of(&[Projection::Perspective, Projection::Orthographic]);
    let mut view = view(pixels, target + direction * distance, target, projection);
    view.viewpoint.camera.up = direction.any_orthonormal_vector();
    view.viewpoint.camera.fov = fov;
    view.viewpoint.camera.height = height;
    (world, view)
}

#[test]
fn no_pixel_exceeds_the_tolerance_on_random_scenes() {
    let shown = |level: f32| f64::from(level).clamp(0.0, 255.0);
    let (mut worst_share, mut most_excess, mut covered, mut cheap) = (0.0_f64, f64::MIN, 0, 0);
    let first = std::env::var("SHADETRADE_FIRST")
        .ok()
        .and_then(|seed| seed.parse().ok())
        .unwrap_or(0);
    for seed in first..first + cases(SCENES) as u64 {
        let mut random = Random(seed);
        let (mut world, view) = scene(&mut random);
        let mode = random.one_of(&[ShadingMode::Phong, ShadingMode::Phong, ShadingMode::Gouraud]);
        let mut view = view.shaded(mode);
        let exact = draw(&mut world, &view, Keep::Levels);
        let tolerance = random.one_of(&[0.1, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0]);
        view.tolerance = tolerance;
        let certified = draw(&mut world, &view, Keep::Levels);
        let counts = certified.counts();
        covered += counts.covered_pixels;
        cheap += counts.tiles[0] + counts.tiles[1] + counts.tiles[2];
        for (pixel, (a, b)) in exact.levels().iter().zip(certified.levels()).enumerate() {
            assert_eq!(
                exact.triangles()[pixel],
                certified.triangles()[pixel],
                "the tolerance does not move edges"
            );
            if exact.triangles()[pixel] == NO_TRIANGLE {
                continue;
            }
            for channel in 0..3 {
                let error = (shown(a[channel]) - shown(b[channel])).abs();
                assert!(
                    error <= tolerance + 0.05,
                    "seed {seed}, {mode:?}, {:?}: {error} levels at pixel {pixel}, tolerance {tolerance}",
                    view.projection
                );
                worst_share = worst_share.max(error / tolerance);
                most_excess = most_excess.max(error - tolerance);
            }
        }
    }
    println!(
        "{} scenes, {covered} pixels, {cheap} polynomial tiles, worst error {worst_share:.4} of the tolerance, {most_excess:.6} levels from it",
        cases(SCENES)
    );
    assert!(
        covered > 0 && cheap > 0,
        "cuboids are visible and some of their tiles are interpolated"
    );
}

#[test]
fn under_many_lights_half_a_level_takes_no_more_squares_than_every_pixel() {
    let mut world = empty();
    let material = Material {
        ambient: DVec3::splat(0.3),
        diffuse: DVec3::new(0.08, 0.61, 0.08),
        specular: DVec3::splat(0.7),
        shininess: 76.8,
    };
    let size = DVec3::new(4.0, 3.0, 2.0);
    spawn_cuboid(&mut world, size, at(DVec3::ZERO), material);
    for index in 0..32 {
        let step = f64::from(index);
        let place = DVec3::new(
            (step % 7.0 - 3.0) * 1.5,
            step % 5.0 + 2.0,
            step % 11.0 - 1.0,
        ) * 1.7;
        let aside = DVec3::new(0.5, 0.0, 0.3);
        let [diffuse, specular] = [12.5, 31.0].map(DVec3::splat);
        spawn_light(&mut world, LightKind::Diffuse, diffuse, place);
        spawn_light(&mut world, LightKind::Specular, specular, place + aside);
    }
    let eye = DVec3::new(7.0, 5.0, 8.0);
    let mut view = view([480, 360], eye, DVec3::ZERO, Projection::Perspective);
    view.viewpoint.camera.fov = 30.0;
    let [exact, half] = [0.0, 0.5].map(|tolerance| {
        let view = view.shaded(ShadingMode::Phong).with_tolerance(tolerance);
        let frame = draw(&mut world, &view, Keep::Display);
        frame.counts().tiles.iter().sum::<u64>()
    });
    assert!(exact > 50, "{exact} squares");
    assert!(
        half * 10 <= exact * 11,
        "{half} squares, {exact} exact ones"
    );
}
