//! Rasterization: shaded pixels from screen polygons.

use glam::dvec3;
use hecs::Entity;
use shadetrade::shading::SquareKind;
use shadetrade::systems::frame::SQUARE_EDGE;
use shadetrade::systems::rasterization;

use super::{MATERIAL, PROJECTIONS, ahead, at, light, turned};
use crate::rasterization::counting::{snapped, spans};
use crate::stability::life::{still_life, views};
use crate::support::prelude::*;
use crate::support::scene;

/// A cube of two units with this many levels of red under an ambient light of one level.
fn flat_cube(world: &mut World, position: DVec3, levels: f64) -> Entity {
    let material = Material {
        ambient: DVec3::X * levels,
        ..MATERIAL
    };
    spawn_cuboid(world, DVec3::splat(2.0), at(position), material)
}

fn draw(world: &mut World, view: &View) -> Frame {
    scene::draw(world, view, Keep::Levels)
}

#[test]
fn no_square_reaches_beyond_the_edges_of_its_face() {
    // The face of 100 x 80 pixels is moved through all its places among the squares of 32 x 32.
    for shift in 0..32 {
        let mut world = World::new();
        let moved = DVec3::new(1.0, -1.0, 0.0) * f64::from(shift);
        spawn_cuboid(&mut world, dvec3(100.0, 80.0, 2.0), at(moved), MATERIAL);
        world.spawn((at(DVec3::ZERO), light(LightKind::Ambient, 1000.0)));
        let mut view = ahead(Projection::Orthographic, [200, 160]).with_tolerance(0.5);
        view.camera.height = 160.0;
        let shown = scene::draw(&mut world, &view, Keep::Display);
        let ids = draw(&mut world, &view);
        for (index, (pixel, id)) in shown.pixels().iter().zip(ids.triangles()).enumerate() {
            let [x, y] = [index % 200, index / 200].map(|place| place as i32 - shift);
            let inside = (50..150).contains(&x) && (40..120).contains(&y);
            assert_eq!(*pixel, if inside { 0x0064_6464 } else { 0 }, "{x}, {y}");
            // Face +z has the triangles 8 and, above its diagonal, 9.
            let is_second = 4 * (2 * (x - 50) + 1) < 5 * (2 * (120 - y) - 1);
            let triangle = TriangleId::new(0, 8 + usize::from(is_second));
            let expected = if inside { triangle } else { TriangleId::NONE };
            assert_eq!(*id, expected, "{x}, {y}");
        }
    }
}

#[test]
fn the_nearer_cuboid_is_visible_and_at_equal_depth_the_one_earlier_in_the_file() {
    for projection in PROJECTIONS {
        for (places, orders, expected) in [
            // In any order of the file.
            ([1.0, -1.0], [0, 1], 0),
            ([-1.0, 1.0], [0, 1], 1),
            // In any order of spawning.
            ([0.0, 0.0], [0, 1], 0),
            ([0.0, 0.0], [1, 0], 1),
        ] {
            let mut world = World::new();
            for (spawned, (z, order)) in places.into_iter().zip(orders).enumerate() {
                let cube = flat_cube(&mut world, DVec3::Z * z, 50.0 + 50.0 * spawned as f64);
                let inserted = world.insert_one(cube, FileOrder(order));
                inserted.expect("it was spawned");
            }
            world.spawn((at(DVec3::ZERO), light(LightKind::Ambient, 1.0)));
            let frame = draw(&mut world, &ahead(projection, [9, 9]));
            let seen = (frame.levels()[40][0], frame.triangles()[40].cuboid());
            assert_eq!(seen, (50.0 + 50.0 * expected as f32, orders[expected]));
        }
    }
}

#[test]
fn extra_components_do_not_change_a_picture() {
    /// A component that no system reads. Adding it moves an entity to another archetype of hecs.
    struct Selected;
    let view = &views([90, 60])[4];
    let mut world = still_life(3);
    let expected = draw(&mut world, view);
    let exact = truth(&world, view);
    assert!(expected.counts().covered_pixels > 1000);
    for cuboid in ordered::<Mesh>(&world) {
        world.insert_one(cuboid, Selected).expect("it was spawned");
        let seen = draw(&mut world, view);
        assert_eq!(seen.triangles(), expected.triangles());
        assert_eq!(seen.levels(), expected.levels());
        assert!(truth(&world, view) == exact);
    }
}

#[test]
fn levels_are_evaluated_in_f64_where_roundings_of_f32_reach_a_twentieth_of_a_level() {
    // A rounding error is 2^-24. Gouraud counts 80 of them. Ambient light under Phong counts six: two of the sum, one
    // of its term and three of the display step.
    // Highlights may be left out as long as they take at most a quarter of the limit.
    for (mode, roundings, limit, faint) in [
        (ShadingMode::Gouraud, 80.0, 0.05, 0.0),
        (ShadingMode::Phong, 6.0, 0.05, 0.0),
        (ShadingMode::Phong, 6.0, 0.0375, 0.01),
    ] {
        let edge = limit * 2.0_f64.powi(24) / roundings;
        for size in [[300, 200], [24, 16]] {
            for (share, is_double) in [(0.99, false), (1.01, true)] {
                let mut world = World::new();
                flat_cube(&mut world, DVec3::ZERO, share * edge);
                world.spawn((at(DVec3::ZERO), light(LightKind::Ambient, 1.0)));
                shine(&mut world, LightKind::Specular, faint, DVec3::Z * 50.0);
                let view = ahead(Projection::Orthographic, size).shaded(mode);
                let frame = draw(&mut world, &view);
                let drawn = frame.triangles().iter().zip(frame.kinds());
                for (_, kind) in drawn.filter(|(id, _)| **id != TriangleId::NONE) {
                    let kind = SquareKind::ALL[usize::from(kind & !SQUARE_EDGE)];
                    assert_eq!(kind == SquareKind::InF64, is_double, "{mode:?}, {share}");
                }
            }
        }
    }
}

#[test]
fn only_pixels_that_are_seen_are_counted() {
    // Two faces of 50 x 50 pixels; one hides half of the other.
    let mut world = World::new();
    for place in [DVec3::Z * 3.0, DVec3::X] {
        flat_cube(&mut world, place, 1.0);
    }
    let mut view = ahead(Projection::Orthographic, [100, 100]);
    view.camera.height = 4.0;
    assert_eq!(draw(&mut world, &view).counts().covered_pixels, 3750);
}

#[test]
fn hidden_pixels_of_a_small_face_are_not_evaluated() {
    let counts = |cuboids: usize| {
        let mut world = World::new();
        for order in 0..cuboids {
            // One behind the other.
            flat_cube(&mut world, DVec3::Z * (3.0 - 3.0 * order as f64), 1.0);
        }
        shine(&mut world, LightKind::Diffuse, 100.0, dvec3(1.0, 2.0, 20.0));
        draw(&mut world, &ahead(Projection::Orthographic, [100, 100])).counts()
    };
    let seen = counts(1);
    assert_eq!(seen.model_evaluations, 100);
    assert_eq!(counts(2), seen);
}

#[test]
fn small_faces_of_every_size_cover_all_their_pixels() {
    // About the size that is drawn as one square of 16 x 16 pixels, at several places in a pixel and at the picture's edges.
    for size in 0..7 * 7 {
        let [right, up] = [size % 7, size / 7].map(|side| f64::from(side) + 14.42);
        for shift in [0.0, 0.3, 0.7, 13.4, -13.4] {
            let mut world = World::new();
            let place = at(dvec3(shift, -shift, 0.0));
            spawn_cuboid(&mut world, dvec3(right, up, 2.0), place, MATERIAL);
            let mut view = ahead(Projection::Orthographic, [40, 40]);
            view.camera.height = 40.0;
            // Centres between two sides that are so far from the picture's middle.
            let centres = |side: f64, shift: f64| {
                let ends = [-side / 2.0, side / 2.0].map(|end| (end + shift).clamp(-20.0, 20.0));
                let [from, to] = ends.map(|end| (end - 0.5).ceil());
                (to - from) as u64
            };
            let expected = centres(right, shift) * centres(up, shift);
            let covered = draw(&mut world, &view).counts().covered_pixels;
            assert_eq!(covered, expected, "{right} x {up}, {shift}");
        }
    }
}

#[test]
fn of_coplanar_faces_the_cuboid_earlier_in_the_file_is_visible_despite_rounding() {
    // All have their face +z in the plane z = 4 of the turned axes; one covers the other's.
    for projection in PROJECTIONS {
        let view = ahead(projection, [200, 200]);
        let seen = |sizes: &[f64], order: u32| {
            let mut world = World::new();
            for size in sizes {
                let mut place = turned(dvec3(20.0, 30.0, 40.0));
                place.position = place.axes() * (DVec3::Z * (4.0 - size / 2.0));
                spawn_cuboid(&mut world, DVec3::splat(*size), place, MATERIAL);
            }
            let front = TriangleId::new(order, 8).face_id();
            let count = |ids: &[TriangleId]| ids.iter().filter(|id| id.face_id() == front).count();
            let drawn = draw(&mut world, &view);
            [drawn.triangles(), &truth(&world, &view).triangles].map(count)
        };
        let alone = seen(&[3.0], 0);
        assert!(alone[0] > 100, "{projection:?}: {alone:?}");
        assert_eq!(seen(&[3.0, 7.0], 0), alone, "{projection:?}");
        assert_eq!(seen(&[7.0, 3.0], 1), [0, 0], "{projection:?}");
    }
}

#[test]
fn a_face_covers_exactly_the_pixels_of_its_polygon() {
    for corners in [
        // Snapping bent the face: its second corner is a notch.
        [[1, 1], [6, 6], [1, 11], [13, 6]],
        // Snapping turned its upper part over: the rows there are empty.
        [[7, 1], [9, 6], [2, 14], [8, 10]],
        [[1, 1], [1, 9], [12, 12], [13, 1]],
    ] {
        for scale in [1, 3] {
            let view = ahead(Projection::Orthographic, [48, 48]);
            let mut world = World::new();
            flat_cube(&mut world, DVec3::ZERO, 50.0);
            let mut frame = draw(&mut world, &view);
            let mut expected = vec![false; 48 * 48];
            for projected in world.query_mut::<&mut Projected>() {
                let vertices = corners.map(|corner| corner.map(|x| 256 * scale * x));
                projected.polygons[4] = snapped(&vertices);
                for (row, from, to) in spans(&projected.polygons[4], [48, 48]) {
                    expected[48 * row + from..48 * row + to].fill(true);
                }
            }
            rasterization::run(&mut world, &view, &mut frame);
            let ids = frame.triangles().iter();
            let drawn: Vec<_> = ids.map(|id| *id != TriangleId::NONE).collect();
            assert!(drawn == expected, "{corners:?}, {scale}");
        }
    }
}

#[test]
fn beyond_its_corners_a_face_is_as_deep_as_its_outermost_corner() {
    // Two faces, from an edge at z = 1.4 to the sides at z = 0, and a wall with its front 0.05 before its middle.
    let seen = |projection, wall: Option<f64>, moved: fn(i32) -> i32| {
        let view = ahead(projection, [200, 200]);
        let mut world = World::new();
        let rotated = turned(DVec3::Y * 45.0);
        let cuboid = spawn_cuboid(&mut world, DVec3::splat(2.0), rotated, MATERIAL);
        if let Some(z) = wall {
            let size = dvec3(10.0, 10.0, 0.1);
            spawn_cuboid(&mut world, size, at(DVec3::Z * z), MATERIAL);
        }
        let mut frame = draw(&mut world, &view);
        let projected = world.query_one_mut::<&mut Projected>(cuboid);
        let polygons = projected.expect("it was projected").polygons.iter_mut();
        let vertices = polygons.flat_map(|it| &mut it.vertices);
        vertices.for_each(|[x, _]| *x = moved(*x));
        rasterization::run(&mut world, &view, &mut frame);
        let ids = frame.triangles().iter();
        ids.filter(|id| id.cuboid() == 0).count()
    };
    for projection in PROJECTIONS {
        // A fifth wider than they are: their planes would continue behind the wall.
        let wider = |x| x + (x - 256 * 100) / 5;
        let alone = seen(projection, None, wider);
        assert!(alone > 600, "{alone}");
        assert_eq!(seen(projection, Some(-0.1), wider), alone);
        // Three pixels aside: the plane of the left one would continue before the wall.
        assert_eq!(seen(projection, Some(1.45), |x| x + 3 * 256), 0);
    }
}
