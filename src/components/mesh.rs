//! The corners, faces, triangles and vertex normals of a cuboid.

use glam::DVec3;

use super::vector::unit;

/// A cuboid's eight corners, relative to its centre in world units, and its unit vertex normals; both before rotation.
///
/// Corner `i` lies at +x if bit 0 of `i` is set, at +y if bit 1 is, at +z if bit 2 is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mesh {
    pub corners: [DVec3; 8],
    pub normals: [DVec3; 8],
}

/// The faces +x, -x, +y, -y, +z, -z as corner indices, counter-clockwise seen from outside.
///
/// The first and the third corner are the ends of the diagonal along which the face is cut: the third has the largest
/// sum of local signs.
pub const FACES: [[u8; 4]; 6] = [
    [1, 3, 7, 5],
    [0, 4, 6, 2],
    [2, 6, 7, 3],
    [0, 1, 5, 4],
    [4, 5, 7, 6],
    [0, 2, 3, 1],
];

/// The twelve triangles, two to a face in the order of [`FACES`], counter-clockwise seen from outside.
pub const TRIANGLES: [[u8; 3]; 12] = {
    let mut triangles = [[0; 3]; 12];
    let mut face = 0;
    while face < 6 {
        let [a, b, c, d] = FACES[face];
        triangles[2 * face] = [a, b, c];
        triangles[2 * face + 1] = [a, c, d];
        face += 1;
    }
    triangles
};

impl Mesh {
    /// A cuboid with the given full edge lengths (world units, > 0).
    pub fn cuboid(size: DVec3) -> Self {
        let half = size * 0.5;
        let sign = |corner: usize, bit: usize| if corner >> bit & 1 == 1 { 1.0 } else { -1.0 };
        let corners =
            std::array::from_fn(|i| half * DVec3::new(sign(i, 0), sign(i, 1), sign(i, 2)));
        let normals = vertex_normals(&corners);
        Mesh { corners, normals }
    }

    /// The full edge lengths, in world units: those that [`Mesh::cuboid`] was given.
    pub fn size(&self) -> DVec3 {
        self.corners[7] - self.corners[0]
    }
}

/// The unit normals of the faces in the order of [`FACES`], pointing outwards.
///
/// The edges are normalised before they are crossed, so that neither needles nor sheets nor sizes of 1e±100 lose them.
fn face_normals(corners: &[DVec3; 8]) -> [DVec3; 6] {
    FACES.map(|[a, b, _, d]| {
        let corner = |index: u8| corners[usize::from(index)];
        unit(unit(corner(b) - corner(a)).cross(unit(corner(d) - corner(a))))
    })
}

/// The unit normals at a cuboid's corners: the normalised sum of the unit normals of the faces that meet there, each counted
/// once (not once a triangle), whatever the cuboid's proportions. A face's normal comes from its own corners.
fn vertex_normals(corners: &[DVec3; 8]) -> [DVec3; 8] {
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
