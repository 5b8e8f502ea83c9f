//! Meshes and places in, unit vertex normals in world space out.
//!
//! Rule: a vertex normal is the normalised sum of the unit normals of the faces that meet at the vertex, each face
//! counted once (not once a triangle), whatever the cuboid's proportions; a face's normal comes from its own corners.

use glam::DVec3;
use hecs::World;

use crate::components::{FACES, Mesh, Normals, View, WorldTransform, unit};
use crate::frame::Frame;

/// Overwrites the [`Normals`] of every cuboid.
pub fn run(world: &mut World, _view: &View, _frame: &mut Frame) {
    for (place, mesh, normals) in world.query_mut::<(&WorldTransform, &Mesh, &mut Normals)>() {
        normals.0 = vertex_normals(&mesh.corners).map(|normal| place.axes * normal);
    }
}

/// The unit normals of the faces in the order of [`FACES`], pointing outwards.
///
/// The edges are normalised before they are crossed, so that neither needles nor sheets nor sizes of 1e±100 lose them.
pub fn face_normals(corners: &[DVec3; 8]) -> [DVec3; 6] {
    FACES.map(|[a, b, _, d]| {
        let corner = |index: u8| corners[usize::from(index)];
        unit(unit(corner(b) - corner(a)).cross(unit(corner(d) - corner(a))))
    })
}

/// The unit normals at the eight corners, before rotation.
pub fn vertex_normals(corners: &[DVec3; 8]) -> [DVec3; 8] {
    let mut sums = [DVec3::ZERO; 8];
    for (face, normal) in FACES.iter().zip(face_normals(corners)) {
        for &corner in face {
            sums[usize::from(corner)] += normal;
        }
    }
    sums.map(unit)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn faces_point_outwards_along_the_axes() {
        let expected = [
            DVec3::X,
            DVec3::NEG_X,
            DVec3::Y,
            DVec3::NEG_Y,
            DVec3::Z,
            DVec3::NEG_Z,
        ];
        assert_eq!(
            face_normals(&Mesh::cuboid(DVec3::new(4.0, 3.0, 2.0)).corners),
            expected
        );
    }
}
