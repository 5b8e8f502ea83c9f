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

/// The sign of a face's outward normal along its axis, as [`FACES`] counts.
pub fn outward_sign(face: usize) -> f64 {
    if face.is_multiple_of(2) { 1.0 } else { -1.0 }
}

/// The two axes along a face, as [`FACES`] counts: those of u and v.
pub fn axes_along(face: usize) -> [usize; 2] {
    [(face / 2 + 1) % 3, (face / 2 + 2) % 3]
}

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

/// The number of a triangle in a scene: cuboid * 12 + its index in [`TRIANGLES`], which is 2 * face + (0 or 1).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct TriangleId(pub u32);

impl TriangleId {
    /// The triangle of a pixel that shows the background.
    pub const NONE: TriangleId = TriangleId(u32::MAX);

    /// The triangle at an index in [`TRIANGLES`] of a cuboid.
    pub fn new(cuboid: u32, triangle: usize) -> Self {
        TriangleId(12 * cuboid + triangle as u32)
    }

    /// The first or the second triangle of a face.
    pub fn of_face(face_id: u32, is_second: bool) -> Self {
        TriangleId(2 * face_id + u32::from(is_second))
    }

    /// The [`FileOrder`](super::FileOrder) of its cuboid.
    pub fn cuboid(self) -> u32 {
        self.0 / 12
    }

    /// Its index in [`TRIANGLES`].
    pub fn triangle(self) -> usize {
        (self.0 % 12) as usize
    }

    /// The index of its face in [`FACES`].
    pub fn face(self) -> usize {
        self.triangle() / 2
    }

    /// The number of its face in the scene: cuboid * 6 + face. [`Self::NONE`] gives a number that no cuboid has.
    pub fn face_id(self) -> u32 {
        self.0 / 2
    }
}

impl Mesh {
    /// A cuboid with the given full edge lengths (world units, > 0).
    pub fn cuboid(size: DVec3) -> Self {
        let sign = |corner: usize, bit: usize| if corner >> bit & 1 == 1 { 1.0 } else { -1.0 };
        let signs: [DVec3; 8] =
            std::array::from_fn(|i| DVec3::new(sign(i, 0), sign(i, 1), sign(i, 2)));
        Mesh {
            corners: signs.map(|signs| size * 0.5 * signs),
            // The unit normals of the three faces that meet at a corner are the axes with these signs.
            normals: signs.map(unit),
        }
    }

    /// A point (u, v) of a face, -1 to 1 along its edges: its place, and its normal between those at the corners, not of length 1.
    /// Both are affine functions of u and v.
    pub fn on_face(&self, face: usize, normals: &[DVec3; 4], [u, v]: [f64; 2]) -> (DVec3, DVec3) {
        let corners = FACES[face].map(|corner| self.corners[usize::from(corner)]);
        let axes = axes_along(face);
        let mut place = corners[0];
        for (axis, share) in axes.into_iter().zip([u, v]) {
            place[axis] = self.corners[7][axis] * share;
        }
        let weight = |corner: DVec3| {
            (1.0 + u * corner[axes[0]].signum()) * (1.0 + v * corner[axes[1]].signum())
        };
        let terms = corners.iter().zip(normals);
        let normal = terms.map(|(corner, normal)| *normal * weight(*corner));
        (place, normal.sum())
    }

    /// The corners of a cell of a face's grid, by the points' numbers along the face's axes, in the order of [`FACES`].
    pub fn cell(face: usize, [i, j]: [usize; 2]) -> [[usize; 2]; 4] {
        let axes = axes_along(face);
        FACES[face].map(|corner| {
            let [right, up] = axes.map(|axis| usize::from(corner >> axis & 1));
            [i + right, j + up]
        })
    }

    /// The full edge lengths, in world units: those that [`Mesh::cuboid`] was given.
    pub fn size(&self) -> DVec3 {
        self.corners[7] - self.corners[0]
    }
}
