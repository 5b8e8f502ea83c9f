//! Normals: vertex normals in world space from mesh and placement.

use glam::{DVec3, dvec3};
use hecs::World;
use shadetrade::components::{FACES, Mesh, NormalMode, Normals, Projection, Transform};
use shadetrade::systems::normals;

use super::{ahead, at, empty_frame, place, read, signs, turned};
use crate::support::random::Random;

/// The vertex normals of cuboids.
fn run<const N: usize>(cuboids: [(Transform, DVec3); N]) -> [[DVec3; 8]; N] {
    let mut world = World::new();
    let entities = cuboids.map(|(transform, size)| {
        world.spawn((
            place(transform),
            Mesh::cuboid(size),
            NormalMode::Corner,
            Normals::default(),
        ))
    });
    let view = ahead(Projection::Perspective, [8, 8]);
    normals::run(&mut world, &view, &mut empty_frame());
    entities.map(|entity| match read(&world, entity) {
        Normals::Corner(normals) => normals,
        Normals::Face(_) => panic!("the mode is that of corners"),
    })
}

#[test]
fn a_corner_normal_of_an_upright_cuboid_has_its_signs_for_any_proportions() {
    let third = 1.0 / 3.0_f64.sqrt();
    for size in [
        dvec3(4.0, 3.0, 2.0),
        dvec3(1e6, 1.0, 1e-6),
        DVec3::splat(1e-100),
    ] {
        let [normals] = run([(at(DVec3::splat(5.0)), size)]);
        for (corner, normal) in normals.iter().enumerate() {
            let error = (*normal - signs(corner) * third).length();
            assert!(error < 1e-15, "{size}, corner {corner}: {normal}");
        }
    }
}

#[test]
fn normals_turn_with_their_own_cuboid_and_keep_their_length() {
    // A quarter turn about z takes +x to +y and +y to -x.
    let quarter = turned(DVec3::Z * 90.0);
    let [upright, turned_once] = run([(at(DVec3::ZERO), DVec3::ONE), (quarter, DVec3::ONE)]);
    for (before, after) in upright.iter().zip(turned_once) {
        assert_eq!(after, dvec3(-before.y, before.x, before.z));
    }
    let mut random = Random(2);
    for _ in 0..100 {
        let [normals] = run([(turned(random.around(720.0)), dvec3(5.0, 1.0, 0.2))]);
        let mut errors = normals.iter().map(|normal| normal.length() - 1.0);
        assert!(errors.all(|error| error.abs() < 1e-14));
    }
}

#[test]
fn a_face_normal_is_perpendicular_to_the_edges_of_its_face_and_points_outwards() {
    let mut random = Random(7);
    for _ in 0..50 {
        let (transform, size) = (turned(random.around(400.0)), dvec3(4.0, 3.0, 2.0));
        let mut world = World::new();
        let mesh = Mesh::cuboid(size);
        let derived = (place(transform), mesh, NormalMode::Face, Normals::default());
        let entity = world.spawn(derived);
        let view = ahead(Projection::Perspective, [8, 8]);
        normals::run(&mut world, &view, &mut empty_frame());
        let normals: Normals = read(&world, entity);
        let axes = place(transform).axes;
        for (face, corners) in FACES.iter().enumerate() {
            let [a, b, c, d] = corners.map(|corner| axes * mesh.corners[usize::from(corner)]);
            for normal in normals.of_face(face) {
                assert!((normal.length() - 1.0).abs() < 1e-12);
                assert!(normal.dot(b - a).abs() < 1e-12 && normal.dot(d - a).abs() < 1e-12);
                assert!(normal.dot(a + c) > 0.0);
            }
        }
    }
}
