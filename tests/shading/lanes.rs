//! Tiles shaded in f32, a lane for every pixel, against their naive twin: the same tile, pixel by pixel in f64.

use fearless_simd::Fallback;
use glam::DVec3;
use shadetrade::components::{
    Illumination, Material, Mesh, PointLight, Projection, TRIANGLES, Transform,
};
use shadetrade::shading::display::Row;
use shadetrade::shading::gouraud::Gouraud;
use shadetrade::shading::patch::Patch;
use shadetrade::shading::phong::Phong;
use shadetrade::shading::triangle::{Rays, Solid, Triangle};
use shadetrade::shading::unit_vectors::UnitVectors;
use shadetrade::shading::{EXACT, Shader, Sink, Surface, TILE, TileKind, TileRow};

use crate::random::Random;

/// The levels of a tile, row by row.
#[derive(Default)]
struct Tile(Vec<TileRow>);

impl Sink for Tile {
    fn take(&mut self, row: usize, levels: &impl Row) {
        assert_eq!(row, self.0.len(), "rows come in order");
        let mut line = [[0.0; TILE]; 3];
        for lane in 0..TILE {
            for (channel, level) in line.iter_mut().zip(levels.levels(lane)) {
                channel[lane] = level;
            }
        }
        self.0.push(line);
    }
}

/// The first triangle of the top of a low cuboid, turned a little, that fills a tile's surroundings; with normals and
/// colours of its own, seen by an eye above it.
fn triangle(random: &mut Random) -> Triangle {
    let mut vector = |least: DVec3, most: DVec3| {
        let [x, y, z] = [0, 1, 2].map(|axis| random.within(least[axis], most[axis]));
        DVec3::new(x, y, z)
    };
    let eye = vector(DVec3::new(-2.0, -2.0, 6.0), DVec3::new(2.0, 2.0, 20.0));
    let transform = Transform {
        position: DVec3::ZERO,
        rotation: vector(DVec3::splat(-10.0), DVec3::splat(10.0)),
    };
    let mesh = Mesh::cuboid(DVec3::new(6.0, 6.0, 1.0));
    let axes = transform.axes();
    let offsets = mesh.corners.map(|corner| axes * corner);
    let normals =
        offsets.map(|_| vector(DVec3::new(-1.0, -1.0, 0.5), DVec3::new(1.0, 1.0, 1.0)).normalize());
    let colors = offsets.map(|_| vector(DVec3::ZERO, DVec3::splat(400.0)));
    let solid = Solid {
        axes,
        half: mesh.corners[7],
        offsets: &offsets,
        normals: &normals,
        colors: &colors,
    };
    let rays = Rays {
        eye,
        axes: [DVec3::X, DVec3::Y, DVec3::NEG_Z],
        pitch: 1e-3,
        projection: Projection::Perspective,
    };
    Triangle::new(TOP, &solid, &rays, |number| {
        Some(TRIANGLES[number].map(|corner| eye.z - offsets[usize::from(corner)].z))
    })
}

/// The first triangle of the face +z.
const TOP: usize = 8;

/// The tile over the middle of the triangle.
fn middle(triangle: &Triangle) -> Patch {
    let centre = triangle.own.offsets.iter().sum::<DVec3>() / 3.0;
    let seen = centre - triangle.eye.expect("in perspective");
    let origin = [seen.x, -seen.y].map(|place| (place / -seen.z / 1e-3).round());
    Patch::new(triangle, origin, [0, TILE as u8 - 1], [0, TILE as u8 - 1])
}

/// Shades a tile both ways; returns how it was done in lanes and the largest difference in levels.
fn compare(shader: &impl Shader, triangle: &Triangle) -> (TileKind, f64) {
    let steady = middle(triangle);
    let shaken = Patch {
        steady: false,
        ..steady
    };
    let [(kind, lanes), (twin, doubles)] = [steady, shaken].map(|patch| {
        let mut tile = Tile::default();
        let kind = crate::tile::shade(shader, triangle, &patch, &mut tile);
        assert_eq!(tile.0.len(), TILE);
        (kind, tile.0)
    });
    assert_eq!(twin, TileKind::Double);
    let levels = |rows: &[TileRow]| rows.as_flattened().as_flattened().to_vec();
    let pairs = levels(&lanes).into_iter().zip(levels(&doubles));
    (
        kind,
        pairs
            .map(|(a, b)| f64::from((a - b).abs()))
            .fold(0.0, f64::max),
    )
}

/// A shiny material under three lights.
fn lit(random: &mut Random) -> (Material, Illumination) {
    let mut between = |least: f64, most: f64| random.within(least, most);
    let material = Material {
        ambient: DVec3::splat(0.1),
        diffuse: DVec3::new(0.2, 0.5, 0.8),
        specular: DVec3::new(0.9, 0.6, 0.3),
        shininess: 10.0_f64.powf(between(0.0, 4.0)),
    };
    let points = (0..3).map(|_| PointLight {
        position: DVec3::new(between(-9.0, 9.0), between(-9.0, 9.0), between(-1.0, 9.0)),
        diffuse: DVec3::splat(between(0.0, 900.0)),
        specular: DVec3::splat(between(0.0, 300.0)),
    });
    let illumination = Illumination {
        ambient: DVec3::splat(50.0),
        points: points.collect(),
    };
    (material, illumination)
}

/// Compares a thousand random tiles; returns how many of them were shaded in f32.
#[track_caller]
fn compare_tiles(compare: impl Fn(Surface, &Triangle) -> (TileKind, f64)) -> usize {
    let mut random = Random(6);
    let mut one = || {
        let triangle = triangle(&mut random);
        let (material, illumination) = &lit(&mut random);
        let surface = Surface {
            material,
            illumination,
            centre: DVec3::ZERO,
        };
        let (kind, difference) = compare(surface, &triangle);
        assert!(difference <= EXACT, "{difference} levels of {surface:?}");
        kind
    };
    (0..1000).filter(|_| one() == TileKind::Exact).count()
}

#[test]
fn phong_in_lanes_is_phong_in_f64() {
    let lanes = compare_tiles(|surface, triangle| {
        compare(
            &Phong::new(Fallback::new(), surface, 0.0, triangle),
            triangle,
        )
    });
    assert!(lanes > 800, "{lanes} tiles");
}

#[test]
fn unit_vectors_in_lanes_are_unit_vectors_in_f64() {
    let lanes = compare_tiles(|surface, triangle| compare(&UnitVectors { surface }, triangle));
    assert!(lanes > 200, "{lanes} tiles");
}

#[test]
fn gouraud_in_lanes_is_gouraud_in_f64() {
    let lanes = compare_tiles(|_, triangle| compare(&Gouraud { tolerance: 0.0 }, triangle));
    assert_eq!(lanes, 1000);
}
