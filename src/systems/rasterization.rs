//! Screen polygons in, shaded pixels out.
//!
//! ```text
//!  polygon --scan conversion--> spans --cut by a grid of 16x16--> tiles --shader--> rows of levels --display step--> frame
//! ```
//! Rules: a pixel is covered if its centre is inside the snapped polygon, or on its top or left edge; the arithmetic is in
//! integers and exact, so pixels along a shared edge are drawn once. A depth buffer exists only while there is more than
//! one cuboid, and then only pixels that are seen are shaded. Tiles hang on the picture's own grid and are set up from all
//! they cover, so neither threads nor parts of a picture change a bit.

mod store;

use std::ops::Range;

use fearless_simd::{Simd, dispatch};
use hecs::World;

use self::store::Store;
use super::coverage::Scan;
use super::projection::Lens;
use crate::components::{
    Illumination, Material, Mesh, Normals, Polygon, Projected, Projection, ShadingMode, TRIANGLES,
    Transform, VertexColors, View,
};
use crate::frame::{Band, Counts, Frame};
use crate::shading::affine::Scalar;
use crate::shading::gouraud::Gouraud;
use crate::shading::patch::Patch;
use crate::shading::phong::Phong;
use crate::shading::polynomial::Polynomial;
use crate::shading::triangle::{self, Rays, Solid, Triangle};
use crate::shading::unit_vectors::UnitVectors;
use crate::shading::{BLOCK, Coverage, Evaluations, Scratch, Shader, Sink, Surface, TILE};

/// Below this many pixels in the polygons' boxes a second thread costs more than it saves.
const WORTH_SHARING: i64 = 100_000;

/// A polynomial for a block of no more pixels than this costs more to find than it saves.
const WORTH_A_TRY: u32 = 2 * TILE as u32;

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
        let rows = band.rows.clone();
        if band.depths.is_empty() {
            for projected in world.query::<&Projected>().iter() {
                for polygon in projected.polygons.iter().filter(|polygon| touches(polygon, &rows)) {
                    announce(polygon, band);
                }
            }
        }
        dispatch!(level, _simd => band.clear());
        let mut counts = Counts::default();
        if !band.depths.is_empty() {
            let mut cuboids = world.query::<(&Transform, &Mesh, &Normals, &VertexColors, &Projected)>();
            for (index, (transform, mesh, normals, colors, projected)) in cuboids.iter().enumerate() {
                let (solid, rays) = before(transform, mesh, normals, colors, projected, &lens);
                for (number, polygon) in projected.polygons.iter().enumerate().filter(|(_, polygon)| touches(polygon, &rows)) {
                    let nearness = Nearness::new(number, &solid, projected, &lens, &rays);
                    dispatch!(level, _simd => see(polygon, &nearness, index as u32 * 12 + number as u32, &lens, band));
                }
            }
        }
        let mut scratch = Scratch::default();
        for illumination in world.query::<&Illumination>().iter() {
            let mut cuboids = world.query::<(&Transform, &Mesh, &Material, &ShadingMode, &Normals, &VertexColors, &Projected)>();
            for (index, (transform, mesh, material, own, normals, colors, projected)) in cuboids.iter().enumerate() {
                let object = Object {
                    surface: Surface { material, illumination, centre: transform.position },
                    mode: view.shading.unwrap_or(*own),
                    tolerance: view.tolerance,
                };
                let (solid, rays) = before(transform, mesh, normals, colors, projected, &lens);
                for (number, polygon) in projected.polygons.iter().enumerate().filter(|(_, polygon)| touches(polygon, &rows)) {
                    let shape = Shape {
                        polygon,
                        triangle: triangle(number, &solid, projected, &lens, &rays),
                        id: index as u32 * 12 + number as u32,
                    };
                    counts += dispatch!(level, simd => draw(simd, &shape, &object, &lens, band, &mut scratch));
                }
            }
        }
        counts
    });
}

/// Whether a polygon may cover anything in these rows of the picture.
fn touches(polygon: &Polygon, rows: &Range<usize>) -> bool {
    let [mut upper, mut lower] = [i32::MAX, i32::MIN];
    for &[_, y] in polygon.vertices() {
        (upper, lower) = (upper.min(y), lower.max(y));
    }
    upper < 256 * rows.end as i32 && lower > 256 * rows.start as i32
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

/// One triangle as it is drawn.
struct Shape<'a> {
    /// What of it is in the picture.
    polygon: &'a Polygon,
    triangle: Triangle,
    id: u32,
}

/// One cuboid as its pixels are shaded.
struct Object<'a> {
    surface: Surface<'a>,
    mode: ShadingMode,
    tolerance: f64,
}

/// A cuboid as rays meet it, and the rays as the cuboid meets them.
fn before<'a>(
    transform: &Transform,
    mesh: &Mesh,
    normals: &'a Normals,
    colors: &'a VertexColors,
    projected: &'a Projected,
    lens: &Lens,
) -> (Solid<'a>, Rays) {
    let solid = Solid {
        axes: projected.axes,
        half: mesh.corners[7],
        offsets: &projected.offsets,
        normals: &normals.0,
        colors: &colors.0,
    };
    let rays = Rays {
        eye: lens.eye - transform.position,
        axes: lens.axes,
        pitch: lens.pitch,
        projection: lens.projection,
    };
    (solid, rays)
}

/// Gathers what is interpolated over triangle `number`.
fn triangle(
    number: usize,
    solid: &Solid,
    projected: &Projected,
    lens: &Lens,
    rays: &Rays,
) -> Triangle {
    let seen = TRIANGLES[number].map(|corner| projected.seen[usize::from(corner)]);
    let screen = seen
        .iter()
        .all(|seen| seen.z >= lens.near)
        .then(|| seen.map(|seen| lens.homogeneous(seen).z));
    Triangle::new(number, solid, rays, screen)
}

/// How near a triangle is, for the depth buffer.
struct Nearness {
    /// See [`triangle::nearness`].
    plane: Scalar,
    /// The least and the most of what is seen of the triangle. Samples are held to it: one that snapping put just outside
    /// an edge-on face would else be as near or as far as the face is steep.
    range: [f64; 2],
}

impl Nearness {
    fn new(number: usize, solid: &Solid, projected: &Projected, lens: &Lens, rays: &Rays) -> Self {
        let [a, b, c] = TRIANGLES[number].map(|corner| projected.seen[usize::from(corner)].z);
        let (farthest, nearest) = (a.max(b).max(c), a.min(b).min(c).max(lens.near));
        Nearness {
            plane: triangle::nearness(number, solid, rays),
            range: match lens.projection {
                Projection::Perspective => [1.0 / farthest, 1.0 / nearest],
                Projection::Orthographic => [-farthest, -nearest],
            },
        }
    }
}

/// Tells the band which pixels a polygon will cover.
fn announce(polygon: &Polygon, band: &mut Band) {
    let mut scan = Scan::new(polygon, band.rows.clone(), band.width);
    while let Some((row, from, to)) = scan.next_span() {
        band.announce(row, from, to);
    }
}

/// Enters a polygon into the depth buffer wherever it is nearest.
#[inline(always)]
fn see(polygon: &Polygon, nearness: &Nearness, id: u32, lens: &Lens, band: &mut Band) {
    let Nearness {
        plane,
        range: [least, most],
    } = *nearness;
    let mut scan = Scan::new(polygon, band.rows.clone(), band.width);
    while let Some((row, from, to)) = scan.next_span() {
        let start = plane.centre + plane.dy * (row as f64 + 0.5 - lens.half[1]);
        band.touch(row, from, to);
        let first = band.index(from, row);
        let depths = &mut band.depths[first..first + to - from];
        let triangles = &mut band.triangles[first..first + to - from];
        for (offset, (old, triangle)) in depths.iter_mut().zip(triangles).enumerate() {
            let x = (from + offset) as f64 + 0.5 - lens.half[0];
            let new = (start + plane.dx * x).max(least).min(most);
            if new - *old > DEPTH_TIE * old.abs() {
                *old = new;
                *triangle = id;
            }
        }
    }
}

/// Shades a polygon with the shader of its object's mode.
#[inline(always)]
fn draw<S: Simd>(
    simd: S,
    shape: &Shape,
    object: &Object,
    lens: &Lens,
    band: &mut Band,
    scratch: &mut Scratch,
) -> Counts {
    let Object {
        surface,
        mode,
        tolerance,
    } = *object;
    match mode {
        ShadingMode::Gouraud => draw_with(&Gouraud { tolerance }, shape, lens, band, scratch),
        ShadingMode::Phong => {
            let phong = Phong::new(simd, surface, tolerance, &shape.triangle);
            draw_with(&phong, shape, lens, band, scratch)
        }
        ShadingMode::UnitVectors => draw_with(&UnitVectors { surface }, shape, lens, band, scratch),
    }
}

/// Shades a polygon, block by block: a block that one polynomial covers within the tolerance is drawn with it, the others
/// tile by tile.
#[inline(always)]
fn draw_with(
    shader: &impl Shader,
    shape: &Shape,
    lens: &Lens,
    band: &mut Band,
    scratch: &mut Scratch,
) -> Counts {
    let Shape {
        polygon,
        triangle,
        id,
    } = shape;
    let mut counts = Counts::default();
    let rows =
        band.rows.start / BLOCK * BLOCK..band.rows.end.next_multiple_of(BLOCK).min(band.height);
    let mut scan = Scan::new(polygon, rows, band.width);
    while let Some(row) = scan.next_row() {
        let first = row / BLOCK * BLOCK;
        let spans = scan.spans::<BLOCK>(first);
        let plain = band.takes_whole(first, BLOCK);
        let extent = spans.extent();
        for column in (extent.start / BLOCK * BLOCK..extent.end).step_by(BLOCK) {
            let corner = [column as f64 - lens.half[0], first as f64 - lens.half[1]];
            // Apart from each other, so that the compiler knows the most frequent one's size.
            let (block, (patch, polynomial)) = if spans.cover(column..column + BLOCK) {
                let whole = Coverage::WHOLE;
                (whole, certified(shader, triangle, corner, &whole))
            } else {
                let block = spans.coverage(column);
                (block, certified(shader, triangle, corner, &block))
            };
            if plain && let Some(polynomial) = &polynomial {
                let mut store = Store::new(band, [column, first], &block, *id);
                store.draw(polynomial, patch.first(), &block);
                counts.covered_pixels += store.stored;
                counts.tiles[polynomial.kind as usize] += block.tiles();
                continue;
            }
            for (down, right) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                let coverage = &block.tile(right, down);
                let [right, down] = [right * TILE, down * TILE];
                let mut store = Store::new(band, [column + right, first + down], coverage, *id);
                if coverage.pixels == 0 || !store.is_seen() {
                    continue;
                }
                let shift = [right as f64, down as f64];
                let evaluations = if let Some(polynomial) = &polynomial {
                    let first = [patch.first()[0] + shift[0], patch.first()[1] + shift[1]];
                    store.draw(polynomial, first, coverage);
                    Evaluations::of(polynomial.kind)
                } else {
                    let origin = [corner[0] + shift[0], corner[1] + shift[1]];
                    let patch = Patch::new(triangle, origin, coverage.lanes, coverage.rows);
                    shader.shade(triangle, &patch, coverage, scratch, &mut store)
                };
                store.mark(evaluations.kind);
                counts += counted(evaluations, store.stored);
            }
        }
    }
    counts
}

/// A block as a patch, and its colour as one polynomial where there is one.
#[inline(always)]
fn certified(
    shader: &impl Shader,
    triangle: &Triangle,
    corner: [f64; 2],
    block: &Coverage<BLOCK>,
) -> (Patch, Option<Polynomial>) {
    let patch = Patch::new(triangle, corner, block.lanes, block.rows);
    let polynomial = if block.pixels > WORTH_A_TRY {
        shader.polynomial(triangle, &patch)
    } else {
        None
    };
    (patch, polynomial)
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
