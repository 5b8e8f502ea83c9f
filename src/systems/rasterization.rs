//! Screen polygons in, shaded pixels out.
//!
//! ```text
//!  polygon --scan conversion--> spans --cut by a grid of 16x16--> tiles --shader--> rows of levels --display step--> frame
//! ```
//! Rules: a pixel is covered if its centre is inside the snapped polygon, or on its top or left edge; the arithmetic is in
//! integers and exact, so pixels along a shared edge are drawn once. A depth buffer exists only while there is more than
//! one cuboid, and then only pixels that are seen are shaded. Tiles hang on the picture's own grid and are set up from all
//! they cover, so neither threads nor parts of a picture change a bit.

use fearless_simd::dispatch;
use glam::DVec3;
use hecs::World;

use super::coverage::Scan;
use super::projection::Lens;
use crate::components::{
    Illumination, Material, Normals, Polygon, Projected, Projection, ShadingMode, TRIANGLES,
    Transform, VertexColors, View,
};
use crate::frame::{Band, Counts, Frame, display_step_lane};
use crate::shading::patch::{Patch, Triangle};
use crate::shading::phong::Phong;
use crate::shading::{
    Coverage, Evaluations, Scratch, Sink, Surface, TILE, TileRow, gouraud, unit_vectors,
};

/// Below this many pixels in the polygons' boxes a second thread costs more than it saves.
const WORTH_SHARING: i64 = 100_000;

/// Depths that differ by less than this share of themselves are a tie, which the cuboid earlier in the file wins.
const DEPTH_TIE: f64 = 1e-11;

/// Draws every cuboid into the frame.
pub fn run(world: &mut World, view: &View, frame: &mut Frame) {
    let lens = Lens::new(view);
    let world = &*world;
    let area: i64 = world
        .query::<&Projected>()
        .iter()
        .flat_map(|projected| projected.polygons.iter())
        .map(|polygon| box_area(polygon, view.size))
        .sum();
    let level = frame.workers().level();
    frame.paint(view.background, area < WORTH_SHARING, |band| {
        band.clear();
        let mut counts = Counts::default();
        if !band.depths.is_empty() {
            for (index, projected) in world.query::<&Projected>().iter().enumerate() {
                for (number, polygon) in projected.polygons.iter().enumerate().filter(|(_, polygon)| polygon.len > 0) {
                    let plane = depth_plane(projected, number, &lens);
                    dispatch!(level, _simd => see(polygon, plane, index as u32 * 12 + number as u32, &lens, band));
                }
            }
        }
        let mut scratch = Scratch::default();
        for illumination in world.query::<&Illumination>().iter() {
            let mut cuboids = world.query::<(&Transform, &Material, &ShadingMode, &Normals, &VertexColors, &Projected)>();
            for (index, (transform, material, own, normals, colors, projected)) in cuboids.iter().enumerate() {
                let object = Object {
                    surface: Surface { material, illumination, centre: transform.position },
                    mode: view.shading.unwrap_or(*own),
                    tolerance: view.tolerance,
                };
                for (number, polygon) in projected.polygons.iter().enumerate().filter(|(_, polygon)| polygon.len > 0) {
                    let triangle = triangle(projected, number, normals, colors, &object.surface, &lens);
                    let id = index as u32 * 12 + number as u32;
                    counts += dispatch!(level, _simd => draw(polygon, &triangle, id, &object, &lens, band, &mut scratch));
                }
            }
        }
        counts
    });
}

/// An upper bound of the pixels a polygon covers.
fn box_area(polygon: &Polygon, size: [usize; 2]) -> i64 {
    let side = |axis: usize| {
        let ends = polygon
            .vertices()
            .iter()
            .map(|vertex| i64::from(vertex[axis]).clamp(0, 256 * size[axis] as i64));
        ends.clone()
            .max()
            .zip(ends.min())
            .map_or(0, |(most, least)| (most - least) / 256)
    };
    side(0) * side(1) / 2
}

/// One cuboid as its pixels are shaded.
struct Object<'a> {
    surface: Surface<'a>,
    mode: ShadingMode,
    tolerance: f64,
}

/// Gathers what is interpolated over triangle `number`.
fn triangle(
    projected: &Projected,
    number: usize,
    normals: &Normals,
    colors: &VertexColors,
    surface: &Surface,
    lens: &Lens,
) -> Triangle {
    let corners = TRIANGLES[number].map(usize::from);
    let seen = corners.map(|corner| projected.seen[corner]);
    let vertices = seen.map(|seen| lens.homogeneous(seen));
    let eye = match lens.projection {
        Projection::Perspective => Some(lens.eye - surface.centre),
        Projection::Orthographic => None,
    };
    Triangle {
        planes: Triangle::planes(vertices),
        pitch: lens.pitch,
        offsets: corners.map(|corner| projected.offsets[corner]),
        normals: corners.map(|corner| normals.0[corner]),
        colors: corners.map(|corner| colors.0[corner]),
        screen: seen
            .iter()
            .all(|seen| seen.z >= lens.near)
            .then(|| vertices.map(|vertex| vertex.z)),
        eye,
        backward: -lens.axes[2],
    }
}

/// What grows towards the eye and is affine on the screen, as coefficients of (X, Y, 1): 1 / depth in perspective, minus
/// the depth in orthographic projection.
fn depth_plane(projected: &Projected, number: usize, lens: &Lens) -> DVec3 {
    let seen = TRIANGLES[number].map(|corner| projected.seen[usize::from(corner)]);
    let vertices = seen.map(|seen| lens.homogeneous(seen));
    let planes = Triangle::planes(vertices);
    let volume = vertices[0].dot(planes[0]);
    match lens.projection {
        Projection::Perspective => (planes[0] + planes[1] + planes[2]) / volume,
        Projection::Orthographic => {
            -(planes[0] * seen[0].z + planes[1] * seen[1].z + planes[2] * seen[2].z) / volume
        }
    }
}

/// Enters a polygon into the depth buffer wherever it is nearest.
#[inline(always)]
fn see(polygon: &Polygon, plane: DVec3, id: u32, lens: &Lens, band: &mut Band) {
    let mut scan = Scan::new(polygon, band.rows.clone(), band.width);
    while let Some((row, from, to)) = scan.next_span() {
        let y = (lens.half[1] - row as f64 - 0.5) * lens.pitch;
        let start = plane.y * y + plane.z;
        let first = band.index(from, row);
        let depths = &mut band.depths[first..first + to - from];
        let triangles = &mut band.triangles[first..first + to - from];
        for (offset, (old, triangle)) in depths.iter_mut().zip(triangles).enumerate() {
            let x = ((from + offset) as f64 + 0.5 - lens.half[0]) * lens.pitch;
            let new = start + plane.x * x;
            if new - *old > DEPTH_TIE * old.abs() {
                *old = new;
                *triangle = id;
            }
        }
    }
}

/// Shades a polygon, tile by tile.
#[inline(always)]
fn draw(
    polygon: &Polygon,
    triangle: &Triangle,
    id: u32,
    object: &Object,
    lens: &Lens,
    band: &mut Band,
    scratch: &mut Scratch,
) -> Counts {
    let mut counts = Counts::default();
    let tiles =
        band.rows.start / TILE * TILE..band.rows.end.next_multiple_of(TILE).min(band.height);
    let mut scan = Scan::new(polygon, tiles, band.width);
    let phong = Phong::new(object.surface, object.tolerance);
    while let Some(tile_row) = scan.next_tiles() {
        for row in tile_row.rows() {
            let (from, to) = tile_row.span(row);
            if from < to && band.rows.contains(&row) {
                band.touch(row, from, to);
            }
        }
        for column in tile_row.columns() {
            let coverage = tile_row.coverage(column);
            let mut store = Store::new(band, [column, tile_row.first], &coverage, id);
            if coverage.pixels == 0 || !store.is_seen() {
                continue;
            }
            let origin = [
                column as f64 - lens.half[0],
                tile_row.first as f64 - lens.half[1],
            ];
            let patch = Patch::new(triangle, origin, coverage.lanes, coverage.rows);
            let evaluations = match object.mode {
                ShadingMode::Gouraud => {
                    gouraud::shade(triangle, &patch, &coverage, object.tolerance, &mut store)
                }
                ShadingMode::Phong => phong.shade(triangle, &patch, &coverage, scratch, &mut store),
                ShadingMode::UnitVectors => unit_vectors::shade(
                    &object.surface,
                    triangle,
                    &patch,
                    &coverage,
                    scratch,
                    &mut store,
                ),
            };
            counts += counted(evaluations, store.stored);
        }
    }
    counts
}

fn counted(evaluations: Evaluations, covered_pixels: u64) -> Counts {
    let mut counts = Counts {
        covered_pixels,
        model_evaluations: evaluations.model,
        specular_evaluations: evaluations.specular,
        ..Counts::default()
    };
    counts.tiles[evaluations.kind as usize] = 1;
    counts
}

/// Stores the rows of one tile.
struct Store<'a, 'b> {
    band: &'a mut Band<'b>,
    coverage: &'a Coverage,
    id: u32,
    /// The picture's row of the tile's first.
    row: usize,
    /// Where the tile's first pixel stands in the band's slices, had the band no first row.
    first: usize,
    /// Whether the band has all of the tile's rows.
    whole: bool,
    stored: u64,
}

impl<'a, 'b> Store<'a, 'b> {
    #[inline(always)]
    fn new(
        band: &'a mut Band<'b>,
        [column, row]: [usize; 2],
        coverage: &'a Coverage,
        id: u32,
    ) -> Self {
        let first = (row * band.width + column).wrapping_sub(band.rows.start * band.width);
        let whole = band.rows.start <= row && row + TILE <= band.rows.end;
        Store {
            band,
            coverage,
            id,
            row,
            first,
            whole,
            stored: 0,
        }
    }

    /// The place of the first lane of a row of the tile, if the band has that row.
    #[inline(always)]
    fn place(&self, row: usize) -> Option<usize> {
        let held = self.whole || self.band.rows.contains(&(self.row + row));
        held.then(|| self.first.wrapping_add(row * self.band.width))
    }

    /// Whether any pixel of the tile is drawn here: in this band, and not hidden.
    #[inline(always)]
    fn is_seen(&self) -> bool {
        if self.whole && self.band.depths.is_empty() {
            return true;
        }
        self.coverage
            .spans
            .iter()
            .enumerate()
            .any(|(row, &(from, to))| {
                from < to
                    && self.place(row).is_some_and(|first| {
                        let covered = first + usize::from(from)..first + usize::from(to);
                        self.band.depths.is_empty()
                            || self.band.triangles[covered].contains(&self.id)
                    })
            })
    }
}

impl Sink for Store<'_, '_> {
    #[inline(always)]
    fn take(&mut self, row: usize, levels: &TileRow) {
        let Some(first) = self.place(row) else { return };
        let (from, to) = self.coverage.spans[row];
        let lanes = usize::from(from)..usize::from(to);
        let deep = !self.band.depths.is_empty();
        if self.band.pixels.is_empty() {
            for lane in lanes {
                let pixel = first + lane;
                if !deep {
                    self.band.triangles[pixel] = self.id;
                }
                if self.band.triangles[pixel] == self.id {
                    self.band.levels[pixel] = [levels[0][lane], levels[1][lane], levels[2][lane]];
                    self.stored += 1;
                }
            }
            return;
        }
        let mut bytes = [0_u32; TILE];
        for lane in 0..TILE {
            bytes[lane] = display_step_lane(levels[0][lane]) << 16
                | display_step_lane(levels[1][lane]) << 8
                | display_step_lane(levels[2][lane]);
        }
        if deep {
            for lane in lanes {
                if self.band.triangles[first + lane] == self.id {
                    self.band.pixels[first + lane] = bytes[lane];
                    self.stored += 1;
                }
            }
        } else if lanes.len() == TILE {
            // A copy of known length: two or four stores instead of a call.
            self.band.pixels[first..first + TILE].copy_from_slice(&bytes);
            self.stored += TILE as u64;
        } else {
            self.band.pixels[first + lanes.start..first + lanes.end].copy_from_slice(&bytes[lanes]);
            self.stored += u64::from(to - from);
        }
    }
}
