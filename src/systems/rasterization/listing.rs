//! Lists the visible faces of projected cuboids, with the spans of pixels that they cover. Each is listed once per frame.

use std::ops::Range;

use fearless_simd::Simd;
use glam::DVec3;
use hecs::World;

use crate::components::{
    FACES, FileOrder, Material, Mesh, Normals, Polygon, Projected, Projection, ShadingMode,
    VertexColors, View, WorldTransform,
};
use crate::frame::{DrawList, Object, Piece};
use crate::shading::Surface;
use crate::shading::face::nearness;
use crate::shading::gloss::Gloss;
use crate::simd::outlined;
use crate::systems::coverage::{SMALL, covered, rows, scan};

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
            let id = 12 * order.0;
            let pieces = self.pieces.len();
            self.list_faces(simd, view.size, id, transform, half, projected);
            if self.pieces.len() == pieces {
                continue;
            }
            let mode = view.mode(*own);
            let gloss = match mode {
                ShadingMode::Phong => self.gloss(material, transform.position),
                _ => 0,
            };
            self.objects.push(Object {
                material: *material,
                transform: *transform,
                half,
                mode,
                gloss,
                corners: match mode {
                    ShadingMode::Gouraud => colors.0,
                    _ => normals.0,
                },
            });
        }
    }

    /// Lists the visible faces of a cuboid; `id` is the number of its first triangle.
    fn list_faces<S: Simd>(
        &mut self,
        simd: S,
        size: [usize; 2],
        id: u32,
        transform: &WorldTransform,
        half: DVec3,
        projected: &Projected,
    ) {
        for (index, polygons) in projected.polygons.as_chunks::<2>().0.iter().enumerate() {
            if polygons.iter().all(|polygon| polygon.len == 0) {
                continue;
            }
            let (row, covered) = cover(simd, self, polygons, size);
            for spans in covered {
                if !spans.is_empty() {
                    self.pieces.push(Piece {
                        id: id + 2 * index as u32,
                        object: self.objects.len(),
                        row,
                        spans,
                        nearness: nearness(index, transform, half, &self.rays),
                        range: self.range(FACES[index].map(|it| projected.seen[usize::from(it)].z)),
                    });
                }
            }
        }
    }

    /// The least and the largest nearness of corners at these depths.
    fn range(&self, depths: [f64; 4]) -> [f64; 2] {
        let farthest = depths.into_iter().fold(f64::MIN, f64::max);
        let nearest = depths.into_iter().fold(f64::MAX, f64::min);
        let nearest = nearest.max(self.rays.lens.near);
        match self.rays.lens.projection {
            Projection::Perspective => [1.0 / farthest, 1.0 / nearest],
            Projection::Orthographic => [-farthest, -nearest],
        }
    }

    /// The index in `glosses` of the constants of a material's highlights.
    fn gloss(&mut self, material: &Material, centre: DVec3) -> usize {
        let last = self.glosses.last();
        if last.is_none_or(|gloss| gloss.material != *material) {
            let surface = Surface::new(material, &self.illumination, centre);
            self.glosses.push(Gloss::new(&surface, self.tolerance));
        }
        self.glosses.len() - 1
    }
}

/// Lists the pixels that a face covers. Returns the row of the picture of the first span, and the ranges of the spans of one
/// or two pieces. The spans of its two triangles meet along the diagonal and are listed as one. If snapping has bent a sliver
/// so that they do not meet, each triangle is a piece.
fn cover<S: Simd>(
    simd: S,
    list: &mut DrawList,
    polygons: &[Polygon; 2],
    size: [usize; 2],
) -> (usize, [Range<usize>; 2]) {
    let small = outlined!(simd, cover_small(simd, list, polygons, size));
    if let Some(covered) = small {
        return covered;
    }
    let [width, height] = size;
    let rows = rows(polygons, height);
    let triangles = polygons.each_ref().map(|polygon| {
        scan(polygon, &rows, width, &mut list.from, &mut list.to);
        list.from.len() - rows.len()..list.from.len()
    });
    let [one, other] = triangles.clone();
    for (one, other) in one.zip(other) {
        let [one, other] = [one, other].map(|index| list.from[index]..list.to[index]);
        let span = if one.is_empty() {
            other
        } else if other.is_empty() {
            one
        } else if one.start <= other.end && other.start <= one.end {
            one.start.min(other.start)..one.end.max(other.end)
        } else {
            return (rows.start, triangles);
        };
        list.from.push(span.start);
        list.to.push(span.end);
    }
    (rows.start, [triangles[1].end..list.from.len(), 0..0])
}

/// The same for two triangles within a small square of the picture, if their spans meet.
#[inline(always)]
fn cover_small<S: Simd>(
    simd: S,
    list: &mut DrawList,
    [one, other]: &[Polygon; 2],
    size: [usize; 2],
) -> Option<(usize, [Range<usize>; 2])> {
    let ([a, b, c], [d, e, f]) = (one.vertices(), other.vertices()) else {
        return None;
    };
    let [first, last] = [i32::min, i32::max].map(|end: fn(i32, i32) -> i32| {
        // Triangles cut by the near plane need not share corners, so all six vertices count.
        let all = [b, c, d, e, f];
        [0, 1].map(|axis| all.iter().fold(a[axis], |edge, it| end(edge, it[axis])) >> 8)
    });
    let fits = [0, 1].map(|axis| {
        first[axis] >= 0
            && last[axis] < size[axis] as i32
            && last[axis] - first[axis] < SMALL as i32
    });
    if fits != [true; 2] {
        return None;
    }
    let rows = (last[1] - first[1] + 1) as usize;
    let one = covered(simd, [*a, *b, *c], first, rows);
    let other = covered(simd, [*d, *e, *f], first, rows);
    let start = list.from.len();
    for (one, other) in one.into_iter().zip(other).take(rows) {
        let row = one | other;
        // If the bits are one run, adding the lowest bit carries through all of it and leaves none of its bits set.
        if row & row.wrapping_add(row & row.wrapping_neg()) != 0 {
            return None;
        }
        let from = first[0] + row.trailing_zeros() as i32;
        list.from.push(from);
        list.to.push(from + row.count_ones() as i32);
    }
    Some((first[1] as usize, [start..list.from.len(), 0..0]))
}
