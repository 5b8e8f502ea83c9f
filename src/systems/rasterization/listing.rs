//! A projected cuboid in; the spans that its faces cover, and their planes, out.
//!
//! Rule: all of it is made once a face and frame.

use std::ops::Range;

use fearless_simd::{Level, Simd};
use glam::DVec3;
use hecs::World;

use crate::components::{
    FACES, FileOrder, Illumination, Lens, Material, Mesh, Normals, Polygon, Projected, Projection,
    ShadingMode, VertexColors, View, WorldTransform,
};
use crate::frame::{DrawList, Object, Piece};
use crate::shading::Surface;
use crate::shading::face::{Plane, Rays, Solid};
use crate::shading::gloss::Gloss;
use crate::simd::{dispatch, outlined, two};
use crate::systems::coverage::{SMALL, Scan, covered};

/// What is the same for all cuboids of a frame.
pub struct Context<'a> {
    pub illumination: &'a Illumination,
    pub view: &'a View,
    pub lens: &'a Lens,
    pub rays: &'a Rays,
}

impl Context<'_> {
    /// Lists the faces of every cuboid that are seen.
    pub fn list(&self, level: Level, world: &mut World, list: &mut DrawList) {
        list.clear();
        for (order, place, mesh, material, own, normals, colors, projected) in world.query_mut::<(
            &FileOrder,
            &WorldTransform,
            &Mesh,
            &Material,
            &ShadingMode,
            &Normals,
            &VertexColors,
            &Projected,
        )>() {
            let object = Object {
                id: 12 * order.0,
                material: *material,
                centre: place.position,
                mode: self.view.mode(*own),
                gloss: 0,
                solid: Solid {
                    centre: place.position - self.lens.eye,
                    axes: place.axes,
                    half: mesh.corners[7],
                    normals: normals.0,
                    colors: colors.0,
                },
            };
            dispatch!(level, simd => self.add(simd, list, object, projected));
        }
    }

    /// Adds the faces of a cuboid that are seen.
    fn add<S: Simd>(
        &self,
        simd: S,
        list: &mut DrawList,
        mut object: Object,
        projected: &Projected,
    ) {
        let pieces = list.pieces.len();
        for (number, polygons) in projected.polygons.chunks(2).enumerate() {
            let covered = cover(simd, list, [&polygons[0], &polygons[1]], self.view.size);
            for (row, spans) in covered {
                if !spans.is_empty() {
                    list.pieces.push(Piece {
                        id: object.id + 2 * number as u32,
                        object: list.objects.len(),
                        row,
                        spans,
                        nearness: Plane::new(number, &object.solid, self.rays).nearness(),
                        range: self.range(FACES[number].map(|it| projected.seen[usize::from(it)])),
                    });
                }
            }
        }
        if list.pieces.len() > pieces {
            if object.mode == ShadingMode::Phong {
                object.gloss = self.gloss(list, &object);
            }
            list.objects.push(object);
        }
    }

    /// The least and the most nearness of these corners.
    fn range(&self, seen: [DVec3; 4]) -> [f64; 2] {
        let depths = seen.map(|corner| corner.z);
        let farthest = depths.into_iter().fold(f64::MIN, f64::max);
        let nearest = depths.into_iter().fold(f64::MAX, f64::min);
        match self.lens.projection {
            Projection::Perspective => [1.0 / farthest, 1.0 / nearest.max(self.lens.near)],
            Projection::Orthographic => [-farthest, -nearest.max(self.lens.near)],
        }
    }

    /// Which of the list's highlights an object has.
    fn gloss(&self, list: &mut DrawList, object: &Object) -> usize {
        let tolerance = self.view.tolerance;
        let fits =
            |gloss: &Gloss| gloss.material == object.material && gloss.tolerance == tolerance;
        if !list.glosses.last().is_some_and(fits) {
            let surface = Surface {
                material: &object.material,
                illumination: self.illumination,
                centre: object.centre,
            };
            list.glosses.push(Gloss::new(&surface, tolerance));
        }
        list.glosses.len() - 1
    }
}

/// Finds the pixels that a face covers: its first row, and where its spans are listed. The
/// spans of its two triangles meet along the diagonal and are listed as one; where snapping has bent a sliver so that they
/// do not, each triangle has its own.
fn cover<S: Simd>(
    simd: S,
    list: &mut DrawList,
    polygons: [&Polygon; 2],
    size: [usize; 2],
) -> [(usize, Range<usize>); 2] {
    if polygons.iter().all(|polygon| polygon.len == 0) {
        return [(0, 0..0), (0, 0..0)];
    }
    let small = outlined!(simd, cover_small(simd, list, polygons, size));
    if let Some(covered) = small {
        return [covered, (0, 0..0)];
    }
    let [width, height] = size;
    let start = list.from.len();
    let [one, other] = polygons.map(|polygon| rows_of(polygon, height));
    let both = one.start.min(other.start)..one.end.max(other.end);
    blank(list, both.len());
    let mut meet = true;
    for polygon in polygons {
        let mut scan = Scan::new(polygon, 0..height, width);
        while let Some((row, from, to)) = scan.next_span() {
            let (from, to) = (from as i32, to as i32);
            let index = start + row - both.start;
            let (old_from, old_to) = (&mut list.from[index], &mut list.to[index]);
            meet &= *old_from >= *old_to || from <= *old_to && *old_from <= to;
            (*old_from, *old_to) = ((*old_from).min(from), (*old_to).max(to));
        }
    }
    if meet {
        return [(both.start, start..list.from.len()), (0, 0..0)];
    }
    list.from.truncate(start);
    list.to.truncate(start);
    polygons.map(|polygon| {
        let start = list.from.len();
        let own = rows_of(polygon, height);
        blank(list, own.len());
        let mut scan = Scan::new(polygon, 0..height, width);
        while let Some((row, from, to)) = scan.next_span() {
            let index = start + row - own.start;
            (list.from[index], list.to[index]) = (from as i32, to as i32);
        }
        (own.start, start..list.from.len())
    })
}

/// The same for two triangles within a small square of the picture, if their spans meet.
#[inline(always)]
fn cover_small<S: Simd>(
    simd: S,
    list: &mut DrawList,
    polygons: [&Polygon; 2],
    size: [usize; 2],
) -> Option<(usize, Range<usize>)> {
    let [one, other] = polygons;
    if one.len != 3 || other.len != 3 {
        return None;
    }
    let [[left, top], [a, b], c] = [one.vertices[0], one.vertices[1], one.vertices[2]];
    let d = other.vertices[2];
    let [first, last] = [i32::min, i32::max].map(|end: fn(i32, i32) -> i32| {
        [
            end(end(left, a), end(c[0], d[0])) >> 8,
            end(end(top, b), end(c[1], d[1])) >> 8,
        ]
    });
    let fits = |axis: usize| {
        first[axis] >= 0
            && last[axis] < size[axis] as i32
            && last[axis] - first[axis] < SMALL as i32
    };
    if !(fits(0) && fits(1)) {
        return None;
    }
    let rows = (last[1] - first[1] + 1) as usize;
    let [one, other] = two!(|polygon| {
        let [a, b, c, ..] = polygons[polygon].vertices;
        covered(simd, [a, b, c], first, rows)
    });
    let start = list.from.len();
    for (one, other) in one.into_iter().zip(other).take(rows) {
        let row = one | other;
        // One run of bits, or none: adding its lowest carries through all of it.
        if row & row.wrapping_add(row & row.wrapping_neg()) != 0 {
            list.from.truncate(start);
            list.to.truncate(start);
            return None;
        }
        let from = first[0] + row.trailing_zeros() as i32;
        list.from.push(from);
        list.to.push(from + row.count_ones() as i32);
    }
    Some((first[1] as usize, start..list.from.len()))
}

/// Lists so many rows that are not covered.
fn blank(list: &mut DrawList, rows: usize) {
    let len = list.from.len() + rows;
    list.from.resize(len, i32::MAX);
    list.to.resize(len, 0);
}

/// The rows of a picture that a polygon may cover.
fn rows_of(polygon: &Polygon, height: usize) -> Range<usize> {
    let [mut upper, mut lower] = [i32::MAX, i32::MIN];
    for &[_, y] in polygon.vertices() {
        (upper, lower) = (upper.min(y), lower.max(y));
    }
    if upper > lower {
        return height..0;
    }
    let row = |y: i32| ((y >> 8).max(0) as usize).min(height);
    row(upper)..row(lower.saturating_add(256))
}
