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
use crate::shading::number::ABREAST;
use crate::shading::patch::Squares;
use crate::shading::phong::Phong;
use crate::shading::polynomial::Polynomial;
use crate::shading::triangle::{self, Rays, Solid, Triangle};
use crate::shading::unit_vectors::UnitVectors;
use crate::shading::{BLOCK, Evaluations, Scratch, Shader, Sink, Surface, TILE};
use crate::simd::apart;

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
    let screen = |number: usize| {
        let seen = TRIANGLES[number].map(|corner| projected.seen[usize::from(corner)]);
        seen.iter()
            .all(|seen| seen.z >= lens.near)
            .then(|| seen.map(|seen| lens.homogeneous(seen).z))
    };
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
        ShadingMode::Gouraud => apart(
            simd,
            #[inline(always)]
            || draw_with(simd, &Gouraud { tolerance }, shape, lens, band, scratch),
        ),
        ShadingMode::Phong => apart(
            simd,
            #[inline(always)]
            || {
                let phong = Phong::new(simd, surface, tolerance, &shape.triangle);
                draw_with(simd, &phong, shape, lens, band, scratch)
            },
        ),
        ShadingMode::UnitVectors => apart(
            simd,
            #[inline(always)]
            || draw_with(simd, &UnitVectors { surface }, shape, lens, band, scratch),
        ),
    }
}

/// Shades a polygon, block by block: a block that one polynomial covers within the tolerance is drawn with it, the others
/// tile by tile. Polynomials are looked for in four blocks side by side, or in the four tiles of one.
#[inline(always)]
fn draw_with(
    simd: impl Simd,
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
    let mut blocks = Squares::NONE;
    let mut tiles = Squares::NONE;
    let rows =
        band.rows.start / BLOCK * BLOCK..band.rows.end.next_multiple_of(BLOCK).min(band.height);
    let mut scan = Scan::new(polygon, rows, band.width);
    while let Some(row) = scan.next_row() {
        let first = row / BLOCK * BLOCK;
        let spans = scan.spans::<BLOCK>(first);
        let plain = band.takes_whole(first, BLOCK);
        let extent = spans.extent();
        for column in (extent.start / BLOCK * BLOCK..extent.end).step_by(ABREAST * BLOCK) {
            blocks.renew(
                triangle,
                lens.half,
                |index| [column + index * BLOCK, first],
                |index| spans.coverage(column + index * BLOCK),
            );
            shader.certify_blocks(triangle, &mut blocks);
            for index in 0..ABREAST {
                let (block, polynomial) = (&blocks.covered[index], &blocks.polynomials[index]);
                if block.pixels == 0 {
                    continue;
                }
                let corner = blocks.patches[index].first();
                if plain && let Some(polynomial) = polynomial {
                    let mut store = Store::new(band, blocks.places[index], block, *id);
                    store.draw(&polynomial.placed(corner), block);
                    counts.covered_pixels += store.stored();
                    counts.tiles[polynomial.kind as usize] += block.tiles();
                    continue;
                }
                let [column, row] = blocks.places[index];
                tiles.renew(
                    triangle,
                    lens.half,
                    |index| [column + index % 2 * TILE, row + index / 2 * TILE],
                    |index| block.tile(index % 2, index / 2),
                );
                let common = polynomial.as_ref().map(|polynomial| (polynomial, corner));
                let (tiles, counts) = (&mut tiles, &mut counts);
                apart(
                    simd,
                    #[inline(always)]
                    || draw_tiles(simd, shader, shape, tiles, common, band, scratch, counts),
                );
            }
        }
    }
    counts
}

/// Shades the four tiles of a block: with the polynomial they have in common, where there is one, whose middle lies as far
/// from the block's first pixel as is said, or each by itself.
#[inline(always)]
fn draw_tiles(
    simd: impl Simd,
    shader: &impl Shader,
    shape: &Shape,
    tiles: &mut Squares<TILE>,
    common: Option<(&Polynomial, [f64; 2])>,
    band: &mut Band,
    scratch: &mut Scratch,
    counts: &mut Counts,
) {
    let Shape { triangle, id, .. } = shape;
    let mut seen = [false; ABREAST];
    for index in 0..ABREAST {
        let tile = &tiles.covered[index];
        seen[index] = tile.pixels > 0 && Store::new(band, tiles.places[index], tile, *id).is_seen();
        tiles.wanted[index] &= seen[index];
    }
    if common.is_none() {
        shader.certify_tiles(triangle, tiles, scratch);
    }
    for index in 0..ABREAST {
        if !seen[index] {
            continue;
        }
        let tile = &tiles.covered[index];
        let mut store = Store::new(band, tiles.places[index], tile, *id);
        let whole = if let Some((polynomial, [x, y])) = common {
            let [right, down] = [index % 2 * TILE, index / 2 * TILE];
            Some((polynomial, [x + right as f64, y + down as f64]))
        } else {
            let own = tiles.polynomials[index].as_ref();
            own.filter(|polynomial| polynomial.is_whole())
                .map(|polynomial| (polynomial, tiles.patches[index].first()))
        };
        let evaluations = if let Some((polynomial, first)) = whole {
            apart(
                simd,
                #[inline(always)]
                || store.draw(&polynomial.placed(first), tile),
            );
            Evaluations::of(polynomial.kind)
        } else {
            shader.shade(triangle, tiles, index, scratch, &mut store)
        };
        store.mark(evaluations.kind);
        counts.covered_pixels += store.stored();
        counts.model_evaluations += evaluations.model;
        counts.specular_evaluations += evaluations.specular;
        counts.tiles[evaluations.kind as usize] += 1;
    }
}
