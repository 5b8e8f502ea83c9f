//! Normals: vertex normals in world space from mesh and placement.

use glam::{DVec3, dvec3};
use hecs::World;
use shadetrade::components::{FACES, Mesh, NormalMode, Normals, Projection, Transform};
use shadetrade::systems::normals;

use super::{ahead, at, empty_frame, place, read, signs, turned};
use crate::support::random::Random;

/// The normals of a cuboid.
fn run(transform: Transform, size: DVec3, mode: NormalMode) -> Normals {
    let mut world = World::new();
    let cuboid = (
        place(transform),
        Mesh::cuboid(size),
        mode,
        Normals::default(),
    );
    let cuboid = world.spawn(cuboid);
    let view = ahead(Projection::Perspective, [8, 8]);
    normals::run(&mut world, &view, &mut empty_frame());
    read(&world, cuboid)
}

#[test]
fn a_corner_normal_of_an_upright_cuboid_has_its_signs_for_any_proportions() {
    let third = 1.0 / 3.0_f64.sqrt();
    for size in [[4.0, 3.0, 2.0], [1e6, 1.0, 1e-6], [1e-100; 3]].map(DVec3::from) {
        let normals = run(at(DVec3::splat(5.0)), size, NormalMode::Corner);
        let Normals::Corner(normals) = normals else {
            panic!("the mode is that of corners");
        };
        for (corner, normal) in normals.iter().enumerate() {
            let error = (*normal - signs(corner) * third).length();
            assert!(error < 1e-15, "{size}, corner {corner}: {normal}");
        }
    }
}

#[test]
fn a_face_normal_is_perpendicular_to_the_edges_of_its_face_and_points_outwards() {
    let mut random = Random(7);
    for _ in 0..50 {
        let (transform, size) = (turned(random.around(400.0)), dvec3(4.0, 3.0, 2.0));
        let normals = run(transform, size, NormalMode::Face);
        let (mesh, axes) = (Mesh::cuboid(size), place(transform).axes);
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
