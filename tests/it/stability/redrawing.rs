//! A frame drawn over another picture equals a fresh one: nothing of the old picture stays.

use fearless_simd::Level;
use glam::DVec3;
use shadetrade::components::{LightKind, Material, Projection, ShadingMode, Transform, View};
use shadetrade::frame::{Frame, Keep, Workers};
use shadetrade::systems;

use crate::support::random::Random;
use crate::support::scene::{draw, empty, spawn_cuboid, spawn_light, view};

fn vector(random: &mut Random, size: f64) -> DVec3 {
    DVec3::from_array([0; 3].map(|_| random.within(-size, size)))
}

/// Views from afar, from nearby, with the near plane through the cuboid, with the eye inside it, along a face, and past
/// everything.
fn view_from_anywhere(random: &mut Random) -> View {
    let eye = vector(random, 1.0) * 10.0_f64.powf(random.within(-0.5, 1.0));
    let target = vector(random, 1.5);
    let projection = if random.within(0.0, 1.0) < 0.7 {
        Projection::Perspective
    } else {
        Projection::Orthographic
    };
    let mut view = view([70, 50], eye, target, projection);
    view.viewpoint.camera.near = Some(10.0_f64.powf(random.within(-2.0, 0.7)));
    view.viewpoint.camera.height = 10.0_f64.powf(random.within(-0.5, 1.2));
    view.shading = Some(ShadingMode::Phong);
    view.tolerance = if random.within(0.0, 1.0) < 0.5 {
        0.5
    } else {
        0.0
    };
    view.background = DVec3::splat(if random.within(0.0, 1.0) < 0.9 {
        20.0
    } else {
        200.0
    });
    view
}

#[test]
fn nothing_of_an_old_picture_stays() {
    let random = &mut Random(7);
    for keep in [Keep::Display, Keep::Levels] {
        for threads in [1, 3] {
            let workers = Workers::new(threads, Level::new()).expect("threads are there");
            let mut frame = Frame::new(keep, workers);
            for _ in 0..400 {
                // Thin cuboids, too, whose faces snapping may turn over.
                let thickness = 10.0_f64.powf(random.within(-5.0, 0.5));
                let mut world = empty();
                let place = Transform {
                    position: vector(random, 0.5),
                    rotation: vector(random, 180.0),
                };
                let material = Material {
                    ambient: DVec3::ONE,
                    diffuse: DVec3::ONE,
                    specular: DVec3::ONE,
                    shininess: 20.0,
                };
                spawn_cuboid(&mut world, DVec3::new(2.0, 1.5, thickness), place, material);
                for kind in [LightKind::Ambient, LightKind::Diffuse, LightKind::Specular] {
                    spawn_light(&mut world, kind, DVec3::splat(60.0), vector(random, 5.0));
                }
                let view = view_from_anywhere(random);
                systems::draw(&mut world, &view, &mut frame).expect("a small picture fits");
                let fresh = draw(&mut world, &view, keep);
                assert_eq!(frame.pixels(), fresh.pixels(), "{view:?}");
                assert_eq!(frame.levels(), fresh.levels(), "{view:?}");
                assert_eq!(frame.triangles(), fresh.triangles(), "{view:?}");
            }
        }
    }
}
