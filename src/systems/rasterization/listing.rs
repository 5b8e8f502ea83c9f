//! A projected cuboid in; its faces, the lights that reach them and the spans that they cover out.
//!
//! Rule: all of it is made once a face and frame.

use std::ops::Range;

use crate::components::{
    FACES, Illumination, Lens, Polygon, Projected, Projection, ShadingMode, View,
};
use crate::frame::{DrawList, Object, Piece};
use crate::shading::Surface;
use crate::shading::face::{Face, Rays, Solid};
use crate::shading::gloss::Gloss;
use crate::shading::phong::FaceLight;
use crate::systems::coverage::Scan;

/// Adds the faces of a cuboid that are seen.
pub fn add(
    list: &mut DrawList,
    mut object: Object,
    solid: &Solid,
    projected: &Projected,
    illumination: &Illumination,
    view: &View,
    lens: &Lens,
) {
    let material = object.material;
    let surface = Surface {
        material: &material,
        illumination,
        centre: object.centre,
    };
    let rays = Rays {
        axes: lens.axes,
        pitch: lens.pitch,
        projection: lens.projection,
    };
    let pieces = list.pieces.len();
    for (number, polygons) in projected.polygons.chunks(2).enumerate() {
        let covered = cover(list, [&polygons[0], &polygons[1]], view.size);
        if covered.iter().all(|(_, spans)| spans.is_empty()) {
            continue;
        }
        let face = Face::new(number, solid, &rays);
        let lights = list.lights.len();
        if object.mode == ShadingMode::Phong {
            let seen = illumination.points.iter();
            list.lights
                .extend(seen.filter_map(|light| FaceLight::new(&face, &surface, light, lens.eye)));
        }
        let depths = FACES[number].map(|corner| projected.seen[usize::from(corner)].z);
        let (farthest, nearest) = depths
            .iter()
            .fold((f64::MIN, f64::MAX), |(most, least), depth| {
                (most.max(*depth), least.min(*depth))
            });
        for (row, spans) in covered {
            if !spans.is_empty() {
                list.pieces.push(Piece {
                    face,
                    id: object.id + 2 * number as u32,
                    object: list.objects.len(),
                    lights: lights..list.lights.len(),
                    row,
                    spans,
                    nearness: match lens.projection {
                        Projection::Perspective => [1.0 / farthest, 1.0 / nearest.max(lens.near)],
                        Projection::Orthographic => [-farthest, -nearest.max(lens.near)],
                    },
                    depths: FACES[number].map(|corner| {
                        let seen = projected.seen[usize::from(corner)];
                        (seen.z >= lens.near).then(|| lens.homogeneous(seen).z)
                    }),
                });
            }
        }
    }
    if list.pieces.len() > pieces {
        if object.mode != ShadingMode::Gouraud {
            let last = list.glosses.last();
            if last.is_none_or(|gloss| gloss.material != material) {
                list.glosses.push(Gloss::new(&surface, view.tolerance));
            }
            object.gloss = list.glosses.len() - 1;
        }
        list.objects.push(object);
    }
}

/// Finds the pixels that a face covers: its first row, and where its spans are listed. The
/// spans of its two triangles meet along the diagonal and are listed as one; where snapping has bent a sliver so that they
/// do not, each triangle has its own.
fn cover(
    list: &mut DrawList,
    polygons: [&Polygon; 2],
    [width, height]: [usize; 2],
) -> [(usize, Range<usize>); 2] {
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
