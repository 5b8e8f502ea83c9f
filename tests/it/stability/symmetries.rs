//! Random scenes whose pictures must be equal: in another order of the cuboids, upside down, at another place and of another
//! size, and drawn over another picture.
//!
//! `SHADETRADE_CASES` sets the number of scenes in each mode (default 40).

use shadetrade::systems;

use super::life::Bits;
use crate::support::prelude::*;
use crate::support::random_scene::case;

/// Random scenes in every mode, exact and within half a level.
fn scenes() -> impl Iterator<Item = (World, View)> {
    let all = ShadingMode::ALL.map(|mode| values(&case(mode), cases(40)).collect::<Vec<_>>());
    let all = all.into_iter().flatten();
    let tolerances = [0.0, 0.5].into_iter().cycle();
    all.zip(tolerances)
        .map(|(case, tolerance)| case.build([65, 48], tolerance))
}

#[test]
fn the_order_of_cuboids_changes_no_bit() {
    for (mut world, view) in scenes() {
        let first = Bits::of(&draw(&mut world, &view, Keep::Levels));
        let cuboids = world.query_mut::<(&mut FileOrder, &Mesh)>();
        let mut cuboids: Vec<_> = cuboids.into_iter().collect();
        let last = cuboids.len() as u32 - 1;
        for (order, _) in &mut cuboids {
            order.0 = last - order.0;
        }
        let mut second = Bits::of(&draw(&mut world, &view, Keep::Levels));
        let ids = second.triangles.iter_mut();
        for id in ids.filter(|id| **id != TriangleId::NONE) {
            // The depths of random cuboids do not tie.
            *id = TriangleId::new(last - id.cuboid(), id.triangle());
        }
        assert!(first == second, "{view:?}");
    }
}

#[test]
fn a_picture_upside_down_has_the_same_squares() {
    let random = &mut Random(9);
    for (mut world, mut view) in scenes() {
        view.size = [128; 2];
        view.tolerance = 10_f64.powf(random.between(-4.0, 1.0));
        let upright = draw(&mut world, &view, Keep::Display).counts();
        // What grew to the right and down now grows to the left and up.
        view.camera.up *= -1.0;
        let counts = draw(&mut world, &view, Keep::Display).counts();
        assert_eq!(counts, upright, "{view:?}");
    }
}

/// Points on this grid have differences that f64 holds exactly, even a billion units away.
const GRID: f64 = 1_048_576.0;

/// Maps every point and every length of a scene.
fn map(world: &mut World, view: &mut View, point: impl Fn(DVec3) -> DVec3, scale: f64) {
    for transform in world.query_mut::<&mut Transform>() {
        transform.position = point(transform.position);
    }
    for mesh in world.query_mut::<&mut Mesh>() {
        mesh.corners = mesh.corners.map(|corner| corner * scale);
    }
    let camera = &mut view.camera;
    (camera.position, camera.target) = (point(camera.position), point(camera.target));
    camera.height *= scale;
    camera.near = camera.near.map(|near| near * scale);
}

#[test]
fn at_another_place_and_of_another_size_a_scene_has_the_same_bits() {
    let random = &mut Random(11);
    for (mut world, mut view) in scenes() {
        // On a grid all differences of points are exact.
        let snap = |it: DVec3| (it * GRID).round() / GRID;
        map(&mut world, &mut view, snap, 1.0);
        let here = Bits::of(&draw(&mut world, &view, Keep::Levels));
        let exact = truth(&world, &view);
        let shift = random.around(1e9).round();
        let scale = 2.0_f64.powi(random.within(-300.0, 300.0) as i32);
        map(&mut world, &mut view, |it| (it + shift) * scale, scale);
        let there = Bits::of(&draw(&mut world, &view, Keep::Levels));
        assert!(there == here, "{view:?}");
        assert!(truth(&world, &view) == exact, "{view:?}");
    }
}

#[test]
fn nothing_of_an_old_picture_stays() {
    let random = &mut Random(7);
    for keep in [Keep::Display, Keep::Levels] {
        for threads in [1, 3] {
            let workers = Workers::new(threads, Level::new()).expect("threads are there");
            let mut frame = Frame::new(keep, workers);
            for (mut world, mut view) in scenes() {
                view.size = random.one_of(&[[65, 48], [65, 48], [65, 48], [48, 65]]);
                view.background = random.one_of(&[DVec3::ZERO, DVec3::new(255.0, 0.0, 90.0)]);
                if random.below(3) == 0 {
                    // Only the first cuboid stays in sight, so no depths are compared.
                    let places = world.query_mut::<(&FileOrder, &Mesh, &mut Transform)>();
                    for (_, _, it) in places.into_iter().filter(|it| it.0.0 > 0) {
                        it.position = DVec3::splat(1e9);
                    }
                }
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
