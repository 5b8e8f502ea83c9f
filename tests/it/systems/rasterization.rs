//! Rasterization: shaded pixels from screen polygons.

use glam::{DVec3, dvec3};
use hecs::World;
use shadetrade::components::{
    FileOrder, LightKind, Material, Projected, Projection, ShadingMode, Transform, VertexColors,
    View,
};
use shadetrade::frame::{Frame, NO_TRIANGLE, OUTLINE};
use shadetrade::shading::TileKind;
use shadetrade::systems::rasterization;
use shadetrade::{reference, systems};

use super::{MATERIAL, PROJECTIONS, ahead, at, empty_frame, light, spawn_cuboid};
use crate::rasterization::counting::spans;

/// A cube of two units with this many levels of red under an ambient light of one level.
fn flat_cube(world: &mut World, order: usize, position: DVec3, levels: f64) {
    let material = Material {
        ambient: DVec3::X * levels,
        ..MATERIAL
    };
    let size = DVec3::splat(2.0);
    spawn_cuboid(
        world,
        order,
        at(position),
        size,
        material,
        ShadingMode::Gouraud,
    );
}

fn draw(world: &mut World, view: &View) -> Frame {
    let mut frame = empty_frame();
    systems::draw(world, view, &mut frame).expect("a small picture fits");
    frame
}

/// The red level and the visible cuboid in the middle of a picture of 9 x 9 pixels.
fn middle(world: &mut World, projection: Projection) -> (f32, u32) {
    world.spawn((at(DVec3::ZERO), light(LightKind::Ambient, 1.0)));
    let frame = draw(world, &ahead(projection, [9, 9]));
    (frame.levels()[40][0], frame.triangles()[40] / 12)
}

#[test]
fn a_face_of_60_x_40_pixels_covers_2400() {
    // 20 units over 200 rows are ten pixels a unit: the face of 6 x 4 units is 60 x 40 pixels.
    let mut world = World::new();
    let size = dvec3(6.0, 4.0, 2.0);
    let mode = ShadingMode::Phong;
    spawn_cuboid(&mut world, 0, at(DVec3::ZERO), size, MATERIAL, mode);
    let frame = draw(&mut world, &ahead(Projection::Orthographic, [300, 200]));
    assert_eq!(frame.counts().covered_pixels, 60 * 40);
    for (index, &id) in frame.triangles().iter().enumerate() {
        let (x, y) = (index % 300, index / 300);
        let inside = (120..180).contains(&x) && (80..120).contains(&y);
        // Face +z has the triangles 8 and 9.
        assert_eq!(inside, [8, 9].contains(&id), "{x}, {y}: {id}");
        assert_eq!(!inside, id == NO_TRIANGLE, "{x}, {y}: {id}");
    }
}

#[test]
fn the_nearer_cuboid_is_visible_in_any_order_of_the_file() {
    for projection in PROJECTIONS {
        for (near, far) in [(0, 1), (1, 0)] {
            let mut world = World::new();
            flat_cube(&mut world, near, DVec3::Z, 50.0);
            flat_cube(&mut world, far, DVec3::NEG_Z, 100.0);
            assert_eq!(middle(&mut world, projection), (50.0, near as u32));
        }
    }
}

#[test]
fn at_equal_depth_the_cuboid_earlier_in_the_file_is_visible_in_any_order_of_spawning() {
    for projection in PROJECTIONS {
        for spawned in [[0, 1], [1, 0]] {
            let mut world = World::new();
            for order in spawned {
                flat_cube(&mut world, order, DVec3::ZERO, 50.0 + 50.0 * order as f64);
            }
            assert_eq!(middle(&mut world, projection), (50.0, 0), "{spawned:?}");
        }
    }
}

/// A group of cuboids, some of which intersect, and two of which share a face.
fn crowd(spawned: [usize; 4]) -> World {
    let places = [
        [0.0; 3],
        [1.0, 1.0, 0.0],
        [-1.5, 0.5, 0.3],
        [0.0, -1.0, 1.0],
    ];
    let mut world = World::new();
    for order in spawned {
        let transform = Transform {
            position: places[order].into(),
            rotation: if order < 2 {
                DVec3::ZERO
            } else {
                dvec3(30.0, 40.0, 50.0)
            },
        };
        let mode = [ShadingMode::Gouraud, ShadingMode::Phong][order % 2];
        let material = Material {
            shininess: order as f64,
            ..MATERIAL
        };
        let size = DVec3::splat(2.0);
        spawn_cuboid(&mut world, order, transform, size, material, mode);
    }
    world.spawn((at(DVec3::ZERO), light(LightKind::Ambient, 40.0)));
    world.spawn((at(dvec3(5.0, 6.0, 7.0)), light(LightKind::Diffuse, 200.0)));
    world.spawn((at(dvec3(5.0, 6.0, 7.0)), light(LightKind::Specular, 90.0)));
    world
}

/// A component that no system reads. Adding it moves an entity to another archetype of hecs.
struct Selected;

#[test]
fn order_of_spawning_and_extra_components_do_not_change_a_picture() {
    for projection in PROJECTIONS {
        let mut view = ahead(projection, [90, 60]);
        view.viewpoint.camera.fov = 40.0;
        view.viewpoint.camera.height = 7.0;
        let truth = |world: &World| {
            let truth = reference::picture(world, &view, 0..60, &|| false, &|_| ());
            let truth = truth.expect("it is not cancelled");
            (truth.levels, truth.triangles)
        };
        let expected = draw(&mut crowd([0, 1, 2, 3]), &view);
        let exact = truth(&crowd([0, 1, 2, 3]));
        assert!(expected.counts().covered_pixels > 1000);
        for (spawned, selected) in [([3, 2, 1, 0], None), ([2, 0, 3, 1], Some(0))] {
            let mut world = crowd(spawned);
            let mut cuboids = world.query::<(hecs::Entity, &FileOrder)>();
            let wanted = cuboids.iter().find(|(_, order)| selected == Some(order.0));
            let wanted = wanted.map(|(entity, _)| entity);
            drop(cuboids);
            if let Some(entity) = wanted {
                world.insert_one(entity, Selected).expect("it was spawned");
            }
            let seen = draw(&mut world, &view);
            assert_eq!(seen.triangles(), expected.triangles(), "{spawned:?}");
            assert_eq!(seen.levels(), expected.levels(), "{spawned:?}");
            assert_eq!(truth(&world), exact, "{spawned:?}");
        }
    }
}

#[test]
fn gouraud_draws_the_vertex_colours() {
    for projection in PROJECTIONS {
        let view = ahead(projection, [300, 200]);
        let mut world = World::new();
        flat_cube(&mut world, 0, DVec3::ZERO, 50.0);
        let mut frame = draw(&mut world, &view);
        assert!(frame.levels().iter().all(|levels| levels[0] == 0.0), "dark");
        // The bottom has 0 levels, the top 100.
        for colors in world.query_mut::<&mut VertexColors>() {
            colors.0 = std::array::from_fn(|corner| DVec3::X * [0.0, 100.0][corner >> 1 & 1]);
        }
        rasterization::run(&mut world, &view, &mut frame);
        for (index, (levels, id)) in frame.levels().iter().zip(frame.triangles()).enumerate() {
            if *id == NO_TRIANGLE {
                continue;
            }
            let pitch = match projection {
                // The front face is nine units away.
                Projection::Perspective => 0.09,
                Projection::Orthographic => 0.1,
            };
            let y = (100.0 - (index / 300) as f64 - 0.5) * pitch;
            let expected = 100.0 * (y + 1.0) / 2.0;
            assert!(
                (f64::from(levels[0]) - expected).abs() < 0.05,
                "{projection:?}: {} for {expected}",
                levels[0]
            );
        }
    }
}

/// Whether any pixel, and whether every pixel with a triangle, is evaluated in f64.
fn doubles(frame: &Frame) -> [bool; 2] {
    let seen = frame.triangles().iter().zip(frame.kinds());
    let kinds = seen.filter(|(id, _)| **id != NO_TRIANGLE);
    let is_double = |kind: &u8| TileKind::ALL[usize::from(kind & !OUTLINE)] == TileKind::Double;
    let doubles: Vec<bool> = kinds.map(|(_, kind)| is_double(kind)).collect();
    [doubles.contains(&true), !doubles.contains(&false)]
}

#[test]
fn levels_are_evaluated_in_f64_where_roundings_of_f32_reach_a_twentieth_of_a_level() {
    // A rounding error is 2^-24. Gouraud counts 80 of them. Ambient light under Phong counts six: two of the sum, one
    // of its term and three of the display step.
    for (mode, roundings) in [(ShadingMode::Gouraud, 80.0), (ShadingMode::Phong, 6.0)] {
        let edge = 0.05 * 2.0_f64.powi(24) / roundings;
        for (size, share, expected) in [
            ([300, 200], 0.99, [false; 2]),
            ([300, 200], 1.01, [true; 2]),
            ([24, 16], 0.99, [false; 2]),
            ([24, 16], 1.01, [true; 2]),
        ] {
            let mut world = World::new();
            flat_cube(&mut world, 0, DVec3::ZERO, share * edge);
            world.spawn((at(DVec3::ZERO), light(LightKind::Ambient, 1.0)));
            let mut view = ahead(Projection::Orthographic, size);
            view.shading = Some(mode);
            let frame = draw(&mut world, &view);
            assert_eq!(doubles(&frame), expected, "{mode:?}, {size:?}, {share}");
        }
    }
}

#[test]
fn hidden_pixels_of_a_small_face_are_not_evaluated() {
    let counts = |cuboids: usize| {
        let mut world = World::new();
        for order in 0..cuboids {
            // One behind the other.
            let position = DVec3::Z * (3.0 - 3.0 * order as f64);
            let (side, mode) = (DVec3::splat(2.0), ShadingMode::Phong);
            spawn_cuboid(&mut world, order, at(position), side, MATERIAL, mode);
        }
        world.spawn((at(dvec3(1.0, 2.0, 20.0)), light(LightKind::Diffuse, 100.0)));
        draw(&mut world, &ahead(Projection::Orthographic, [100, 100])).counts()
    };
    let seen = counts(1);
    assert_eq!(seen.model_evaluations, 100);
    assert_eq!(counts(2), seen);
}

#[test]
fn small_faces_of_every_size_cover_all_their_pixels() {
    // About the size that is drawn as one square of 16 x 16 pixels, at several places in a pixel.
    for width in 14..=20_u32 {
        for height in 14..=20_u32 {
            for shift in [0.0, 0.3, 0.7] {
                let mut world = World::new();
                let [right, up] = [width, height].map(|side| f64::from(side) + 0.42);
                let mode = ShadingMode::Phong;
                let place = at(dvec3(shift, shift, 0.0));
                spawn_cuboid(&mut world, 0, place, dvec3(right, up, 2.0), MATERIAL, mode);
                let mut view = ahead(Projection::Orthographic, [40, 40]);
                view.viewpoint.camera.height = 40.0;
                // Centres between two sides that are so far from the picture's middle.
                let centres = |side: f64, shift: f64| {
                    let [from, to] =
                        [-side / 2.0, side / 2.0].map(|end| (end + shift - 0.5).ceil());
                    (to - from) as u64
                };
                let expected = centres(right, shift) * centres(up, -shift);
                let covered = draw(&mut world, &view).counts().covered_pixels;
                assert_eq!(covered, expected, "{width} x {height}, {shift}");
            }
        }
    }
}

#[test]
fn of_coplanar_faces_the_cuboid_earlier_in_the_file_is_visible_despite_rounding() {
    let turned = Transform {
        rotation: dvec3(20.0, 30.0, 40.0),
        ..at(DVec3::ZERO)
    };
    // Both have their face +z in the plane z = 4 of the turned axes; one covers the other's.
    let spawn = |world: &mut World, order: usize, size: f64| {
        let mut place = turned;
        place.position = turned.axes() * (DVec3::Z * (4.0 - size / 2.0));
        let mode = ShadingMode::Phong;
        spawn_cuboid(world, order, place, DVec3::splat(size), MATERIAL, mode);
    };
    for projection in PROJECTIONS {
        let seen = |sizes: &[f64], order: u32| {
            let mut world = World::new();
            for (order, size) in sizes.iter().enumerate() {
                spawn(&mut world, order, *size);
            }
            let frame = draw(&mut world, &ahead(projection, [200, 200]));
            let face = [12 * order + 8, 12 * order + 9];
            let ids = frame.triangles().iter();
            ids.filter(|id| face.contains(id)).count()
        };
        let alone = seen(&[3.0], 0);
        assert!(alone > 100, "{projection:?}: {alone}");
        assert_eq!(seen(&[3.0, 7.0], 0), alone, "{projection:?}");
        assert_eq!(seen(&[7.0, 3.0], 1), 0, "{projection:?}");
    }
}

#[test]
fn a_face_covers_exactly_its_two_triangles() {
    for triangles in [
        // Snapping made the face concave: its first corner is a notch, so the upper rows have two spans.
        [[[6, 6], [1, 1], [6, 14]], [[6, 6], [6, 14], [11, 1]]],
        // The near plane cut it: the triangles meet along the diagonal, but the second has more of it.
        [[[1, 1], [1, 9], [9, 9]], [[12, 12], [13, 1], [1, 1]]],
        [[[12, 12], [13, 1], [1, 1]], [[1, 1], [1, 9], [9, 9]]],
    ] {
        for scale in [1, 3] {
            let view = ahead(Projection::Orthographic, [48, 48]);
            let mut world = World::new();
            flat_cube(&mut world, 0, DVec3::ZERO, 50.0);
            let mut frame = draw(&mut world, &view);
            let mut expected = vec![false; 48 * 48];
            for projected in world.query_mut::<&mut Projected>() {
                for (polygon, triangle) in projected.polygons[8..10].iter_mut().zip(triangles) {
                    let vertices = triangle.map(|corner| corner.map(|x| 256 * scale * x));
                    polygon.vertices[..3].copy_from_slice(&vertices);
                    polygon.len = 3;
                    for (row, from, to) in spans(polygon, 0..48, 48) {
                        expected[48 * row + from..48 * row + to].fill(true);
                    }
                }
            }
            rasterization::run(&mut world, &view, &mut frame);
            let ids = frame.triangles().iter();
            let drawn: Vec<_> = ids.map(|id| *id != NO_TRIANGLE).collect();
            assert!(drawn == expected, "{triangles:?}, {scale}");
        }
    }
}

#[test]
fn beyond_its_corners_a_face_is_as_deep_as_its_outermost_corner() {
    // Two faces, from an edge at z = 1.4 to the sides at z = 0, and a wall with its front 0.05 before its middle.
    let seen = |projection, wall: Option<f64>, moved: fn(i32) -> i32| {
        let view = ahead(projection, [200, 200]);
        let mut world = World::new();
        let turned = Transform {
            rotation: DVec3::Y * 45.0,
            ..at(DVec3::ZERO)
        };
        let (size, mode) = (DVec3::splat(2.0), ShadingMode::Phong);
        spawn_cuboid(&mut world, 0, turned, size, MATERIAL, mode);
        if let Some(z) = wall {
            let (place, size) = (at(DVec3::Z * z), dvec3(10.0, 10.0, 0.1));
            spawn_cuboid(&mut world, 1, place, size, MATERIAL, mode);
        }
        let mut frame = draw(&mut world, &view);
        for (order, projected) in world.query_mut::<(&FileOrder, &mut Projected)>() {
            if order.0 == 0 {
                let polygons = projected.polygons.iter_mut();
                let vertices = polygons.flat_map(|it| &mut it.vertices);
                vertices.for_each(|[x, _]| *x = moved(*x));
            }
        }
        rasterization::run(&mut world, &view, &mut frame);
        frame.triangles().iter().filter(|id| **id < 12).count()
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
