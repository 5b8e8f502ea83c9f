//! A frame drawn over another picture equals a fresh one: nothing of the old picture stays.

use fearless_simd::Level;
use glam::DVec3;
use hecs::World;
use shadetrade::components::{LightKind, Projection, ShadingMode, Transform, View};
use shadetrade::frame::{Frame, Keep, Workers};
use shadetrade::systems;

use super::life::Bits;
use crate::support::random::Random;
use crate::support::scene::{draw, empty, shine, spawn_cuboid, view, white};

/// One to three cuboids, also thin ones, whose faces snapping may turn over.
fn cuboids(random: &mut Random) -> World {
    let mut world = empty();
    for _ in 0..=random.below(3) {
        let thickness = 10.0_f64.powf(random.within(-5.0, 0.5));
        let place = Transform {
            position: random.around(0.5),
            rotation: random.around(180.0),
        };
        spawn_cuboid(
            &mut world,
            DVec3::new(2.0, 1.5, thickness),
            place,
            white(20.0),
        );
    }
    for kind in LightKind::ALL {
        shine(&mut world, kind, 60.0, random.around(5.0));
    }
    world
}

/// Views from afar, from nearby, with the near plane through the cuboids, with the eye inside one, along a face, and past
/// everything.
fn view_from_anywhere(random: &mut Random) -> View {
    let eye = random.around(1.0) * 10.0_f64.powf(random.within(-0.5, 1.0));
    let target = random.around(1.5);
    let projection = Projection::ALL[usize::from(random.below(3) == 0)];
    let size = [[70, 50], [50, 70]][usize::from(random.below(8) == 0)];
    let mut view = view(size, eye, target, projection);
    view.viewpoint.camera.near = Some(10.0_f64.powf(random.within(-2.0, 0.7)));
    view.viewpoint.camera.height = 10.0_f64.powf(random.within(-0.5, 1.2));
    view.shading = Some([ShadingMode::Phong, ShadingMode::Gouraud][random.below(2)]);
    view.tolerance = [0.0, 0.5][random.below(2)];
    view.background =
        [DVec3::splat(20.0), DVec3::new(255.0, 0.0, 90.0)][usize::from(random.below(8) == 0)];
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
                let (mut world, view) = (cuboids(random), view_from_anywhere(random));
                if random.below(8) == 0 {
                    systems::draw_rows(&mut world, &view, 11..40, &mut frame).expect("it fits");
                }
                systems::draw(&mut world, &view, &mut frame).expect("a small picture fits");
                let fresh = draw(&mut world, &view, keep);
                assert!(Bits::of(&frame) == Bits::of(&fresh), "{view:?}");
            }
        }
    }
}
