//! Lists the visible faces of projected cuboids, with the spans of pixels that they cover. Each is listed once per frame.

use fearless_simd::Simd;
use glam::DVec3;
use hecs::World;

use crate::components::{
    FACES, FileOrder, Material, Mesh, Normals, Polygon, Projected, Projection, ShadingMode,
    TriangleId, VertexColors, View, WorldTransform,
};
use crate::shading::Surface;
use crate::shading::face::Plane;
use crate::shading::gloss::Gloss;
use crate::shading::simd::outlined;
use crate::systems::coverage::{SMALL, covered, is_convex, scan};
use crate::systems::frame::{DrawList, Object, Piece};

impl DrawList {
    /// Lists the cuboids that have visible faces, and these faces.
    pub fn fill<S: Simd>(&mut self, simd: S, world: &mut World, view: &View) {
        self.clear();
        self.tolerance = view.tolerance;
        for (order, transform, mesh, material, own, normals, colors, projected) in world
            .query_mut::<(
                &FileOrder,
                &WorldTransform,
                &Mesh,
                &Material,
                &ShadingMode,
                &Normals,
                &VertexColors,
                &Projected,
            )>()
        {
            let half = mesh.corners[7];
            let pieces = self.pieces.len();
            self.list_faces(simd, view.size, order.0, transform, half, projected);
            if self.pieces.len() == pieces {
                continue;
            }
            let mode = view.mode(*own);
            for piece in &mut self.pieces[pieces..] {
                let face = piece.id.face();
                match (mode, colors) {
                    (ShadingMode::Gouraud, VertexColors::Grid(grids)) => {
                        piece.grid = Some(grids[face / 2]);
                    }
                    (ShadingMode::Flat | ShadingMode::Gouraud, _) => {
                        piece.corners = colors.of_face(face);
                    }
                    _ => piece.corners = normals.of_face(face),
                }
            }
            let surface = Surface::new(material, &self.illumination, transform.position);
            let gloss = match self.objects.last() {
                Some(last) if last.material == *material => last.gloss,
                _ => Gloss::new(&surface, self.tolerance),
            };
            self.objects.push(Object {
                material: *material,
                transform: *transform,
                half,
                mode,
                has_face_normals: matches!(normals, Normals::Face(_)),
                gloss,
            });
        }
    }

    /// Lists the visible faces of a cuboid.
    fn list_faces<S: Simd>(
        &mut self,
        simd: S,
        size: [usize; 2],
        cuboid: u32,
        transform: &WorldTransform,
        half: DVec3,
        projected: &Projected,
    ) {
        for (index, polygon) in projected.polygons.iter().enumerate() {
            if !polygon.meets(size) {
                continue;
            }
            let start = self.from.len();
            let small = outlined!(simd, cover_small(simd, self, polygon, size));
            let row = small.unwrap_or_else(|| scan(polygon, size, &mut self.from, &mut self.to));
            if self.from.len() > start {
                self.pieces.push(Piece {
                    id: TriangleId::new(cuboid, 2 * index),
                    object: self.objects.len(),
                    row,
                    spans: start..self.from.len(),
                    plane: Plane::new(index, transform, half, &self.rays),
                    corners: [DVec3::ZERO; 4],
                    grid: None,
                    range: self.range(FACES[index].map(|it| projected.seen[usize::from(it)].z)),
                });
            }
        }
    }

    /// The least and the largest depth key of corners at these depths.
    fn range(&self, depths: [f64; 4]) -> [f64; 2] {
        let farthest = depths.into_iter().fold(f64::MIN, f64::max);
        let nearest = depths.into_iter().fold(f64::MAX, f64::min);
        let nearest = nearest.max(self.rays.lens.near);
        match self.rays.lens.projection {
            Projection::Perspective => [1.0 / farthest, 1.0 / nearest],
            Projection::Orthographic => [-farthest, -nearest],
        }
    }
}

/// Lists the pixels that a convex face within a small square of the picture covers, as [`scan`] does. Returns the row of the
/// first span.
#[inline(always)]
fn cover_small<S: Simd>(
    simd: S,
    list: &mut DrawList,
    polygon: &Polygon,
    size: [usize; 2],
) -> Option<usize> {
    let corners: &[[i32; 2]; 4] = polygon.vertices().try_into().ok()?;
    let [first, last] = [i32::min, i32::max].map(|end: fn(i32, i32) -> i32| {
        let [a, b, c, d] = corners;
        [0, 1].map(|axis| end(end(a[axis], b[axis]), end(c[axis], d[axis])) >> 8)
    });
    let fits = [0, 1].map(|axis| {
        first[axis] >= 0
            && last[axis] < size[axis] as i32
            && last[axis] - first[axis] < SMALL as i32
    });
    if fits != [true; 2] || !is_convex(corners) {
        return None;
    }
    let rows = (last[1] - first[1] + 1) as usize;
    let bits = &covered(simd, corners, first, rows)[..rows];
    let from = |row: &u32| first[0] + row.trailing_zeros() as i32;
    list.from.extend(bits.iter().map(from));
    let to = |row: &u32| first[0] + (u32::BITS - row.leading_zeros()) as i32;
    list.to.extend(bits.iter().map(to));
    Some(first[1] as usize)
}
