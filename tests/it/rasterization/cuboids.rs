//! Coverage of all faces of a cuboid together: each pixel is drawn once, whatever part of the picture is drawn.

use std::f64::consts::TAU;

use shadetrade::systems;

use super::counting::count;
use crate::prove::proof;
use crate::stability::life::Bits;
use crate::support::prelude::*;

const SIZES: [[usize; 2]; 3] = [[640, 480], [97, 73], [161, 399]];

/// A world with one random cuboid, seen from anywhere.
fn ordinary(random: &mut Random, size: [usize; 2]) -> (World, View) {
    let mut world = lit(random);
    let edges = DVec3::new(2.0, 3.0, 4.0);
    let transform = placed(random.around(1.5), random.around(180.0));
    spawn_cuboid(&mut world, edges, transform, white(20.0));
    let eye = 8.0 * random.direction();
    let mut view = view(size, eye, DVec3::ZERO, random.one_of(&Projection::ALL));
    view.camera.up = random.direction();
    (view.camera.fov, view.camera.height) = (60.0, 8.0);
    (world, view)
}

/// A world with one random cuboid. The eye is at most 3e-5 off the plane of a face, so that snapping often bends the face.
fn edge_on(random: &mut Random, size: [usize; 2]) -> (World, View) {
    let mut world = lit(random);
    let edges = DVec3::ONE.map(|_| random.within(1.0, 4.0));
    spawn_cuboid(&mut world, edges, turned(DVec3::ZERO), white(20.0));
    let axis = random.below(3);
    let target = 0.3 * random.direction();
    let (sin, cos) = random.within(0.0, TAU).sin_cos();
    let projection = random.one_of(&Projection::ALL);
    let mut eye = DVec3::ZERO;
    eye[(axis + 1) % 3] = 6.0 * sin;
    eye[(axis + 2) % 3] = 6.0 * cos;
    eye[axis] = random.between(1e-8, 3e-5)
        + match projection {
            Projection::Perspective => edges[axis] / 2.0,
            Projection::Orthographic => target[axis],
        };
    let mut view = view(size, eye, target, projection);
    view.camera.up = random.direction();
    (view.camera.fov, view.camera.height) = (random.within(25.0, 60.0), 6.0);
    (world, view)
}

/// A world with one cuboid that is thin in two directions, or in one.
fn thin(random: &mut Random, size: [usize; 2]) -> (World, View) {
    let (mut world, view) = ordinary(random, size);
    let pixel = 8.0 / size[1] as f64;
    let mut edges = DVec3::splat(pixel * random.between(1e-3, 2.0));
    edges[random.below(3)] = 4.0;
    edges[random.below(3)] = 3.0;
    for mesh in world.query_mut::<&mut Mesh>() {
        *mesh = Mesh::cuboid(edges);
    }
    (world, view)
}

/// A world with two to five random cuboids, some edge-on.
fn several(random: &mut Random, size: [usize; 2]) -> (World, View) {
    let (mut world, view) = random.one_of(&SCENES)(random, size);
    for _ in 0..=random.below(4) {
        let transform = placed(random.around(2.0), random.around(180.0));
        let edges = DVec3::ONE.map(|_| random.within(0.5, 3.0));
        spawn_cuboid(&mut world, edges, transform, white(20.0));
    }
    (world, view)
}

fn lit(random: &mut Random) -> World {
    let mut world = empty();
    shine(&mut world, LightKind::Ambient, 30.0, DVec3::ZERO);
    shine(&mut world, LightKind::Diffuse, 200.0, random.around(20.0));
    shine(&mut world, LightKind::Diffuse, 100.0, random.around(20.0));
    world
}

type Scene = fn(&mut Random, [usize; 2]) -> (World, View);

const SCENES: [Scene; 3] = [ordinary, edge_on, thin];

#[test]
fn the_faces_of_a_cuboid_meet_without_gap_or_overlap() {
    let mut random = Random(4);
    for scene in SCENES {
        let mut pixels = 0;
        for case in 0..cases(400) {
            let size = SIZES[case % SIZES.len()];
            let (mut world, view) = scene(&mut random, size);
            draw(&mut world, &view, Keep::Display);
            for projected in world.query_mut::<&Projected>() {
                let counts = count(&projected.polygons, size);
                pixels += counts.iter().sum::<u32>();
                for row in counts.chunks(size[0]) {
                    // A convex body covers each pixel from the first to the last once.
                    let runs = row.chunk_by(|a, b| a == b).filter(|run| run[0] > 0);
                    let runs: Vec<u32> = runs.map(|run| run[0]).collect();
                    assert!(matches!(runs[..], [] | [1]), "{view:?}: {row:?}");
                }
            }
        }
        assert!(pixels > 100 * cases(400) as u32, "{pixels}: it is in sight");
    }
}

#[test]
fn any_cuboid_has_the_same_bits_and_counts_on_any_threads_and_the_same_bits_in_any_rows() {
    let mut random = Random(5);
    let mut frames = [Keep::Levels, Keep::Display].map(|keep| {
        [1, 2, 4].map(|threads| {
            let workers = Workers::new(threads, Level::new()).expect("the system gives threads");
            Frame::new(keep, workers)
        })
    });
    for scene in SCENES.into_iter().chain([several as Scene]) {
        for case in 0..cases(60) {
            let size = SIZES[case % SIZES.len()];
            let (mut world, view) = scene(&mut random, size);
            let mode = ShadingMode::ALL[case % 3];
            let mut view = view.shaded(mode).with_tolerance([0.5, 0.0][case / 2 % 2]);
            view.segments = Segments::new([1, 2, 9, 100][case / 4 % 4]);
            let [alone, others @ ..] = &mut frames[case / 3 % 2];
            systems::draw(&mut world, &view, alone).expect("a small picture fits");
            let (whole, counts) = (Bits::of(alone), alone.counts());
            for frame in others {
                systems::draw(&mut world, &view, frame).expect("a small picture fits");
                let is_same = Bits::of(frame) == whole && frame.counts() == counts;
                assert!(is_same, "{view:?}");
            }
            for _ in 0..6 {
                let from = random.below(size[1]);
                let rows = from..(from + 1 + random.below(64)).min(size[1]);
                systems::draw_rows(&mut world, &view, rows.clone(), alone)
                    .expect("a small picture fits");
                let part = whole.part(size[0] * rows.start..size[0] * rows.end);
                assert!(Bits::of(alone) == part, "{rows:?} of {view:?}");
            }
        }
    }
}

#[test]
fn no_pixel_of_any_cuboid_is_refuted() {
    let mut random = Random(6);
    for scene in SCENES.into_iter().chain([several as Scene]) {
        for case in 0..cases(10) {
            let size = [[64, 48], [97, 73], [33, 129]][case % 3];
            let (mut world, view) = scene(&mut random, size);
            let mode = ShadingMode::ALL[case % 3];
            let mut view = view.shaded(mode).with_tolerance(0.5);
            view.segments = Segments::new([1, 2, 9, 100][case / 2 % 4]);
            let proof = proof(&mut world, &view);
            assert_eq!(proof.refuted, 0, "{view:?}: {:?}", proof.examples);
        }
    }
}
