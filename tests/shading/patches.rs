//! What a tile knows of its triangle.

use glam::{DMat3, DVec3};
use shadetrade::components::{Mesh, Projection};
use shadetrade::shading::TILE;
use shadetrade::shading::patch::Patch;
use shadetrade::shading::triangle::{Rays, Solid, Triangle};

#[test]
fn a_pixel_that_sees_nothing_of_the_triangles_plane_shows_the_triangles_middle() {
    // The eye stands over the top of a cube and looks away from it: behind the middle of the picture lies the triangle.
    let mesh = Mesh::cuboid(DVec3::splat(2.0));
    let solid = Solid {
        axes: DMat3::IDENTITY,
        half: mesh.corners[7],
        offsets: &mesh.corners,
        normals: &mesh.corners,
        colors: &mesh.corners,
    };
    let rays = Rays {
        eye: DVec3::new(0.5, -0.5, 5.0),
        axes: [DVec3::NEG_X, DVec3::Y, DVec3::Z],
        pitch: 1e-3,
        projection: Projection::Perspective,
    };
    // The first triangle of the face +z.
    let triangle = Triangle::new(8, &solid, &rays, |_| None);
    let patch = Patch::new(
        &triangle,
        [0.0; 2],
        [0, TILE as u8 - 1],
        [0, TILE as u8 - 1],
    );
    assert!(!patch.steady);
    let point = patch.point(&triangle, 0.0, 0.0);
    assert_eq!(point.weights, DVec3::splat(1.0 / 3.0));
    let [a, b, c] = triangle.own.offsets;
    assert!((point.offset - (a + b + c) / 3.0).length() < 1e-15);
}
