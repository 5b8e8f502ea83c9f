//! Single tiles of every size and slant, certified against the same tile pixel by pixel in f64.

use fearless_simd::Fallback;
use glam::DVec3;
use shadetrade::components::{Illumination, Material, Mesh, PointLight, Projection, Transform};
use shadetrade::shading::display::Row;
use shadetrade::shading::gouraud::Gouraud;
use shadetrade::shading::patch::{Patch, Point};
use shadetrade::shading::phong::Phong;
use shadetrade::shading::triangle::{Rays, Solid, Triangle};
use shadetrade::shading::{EXACT, Shader, Sink, Surface, TILE, TileKind};

use crate::cases;
use crate::random::Random;

/// What is displayed of a tile's pixels, row by row.
#[derive(Default)]
struct Displayed(Vec<[f64; 3]>);

impl Sink for Displayed {
    fn take(&mut self, _row: usize, levels: &impl Row) {
        let lanes = (0..TILE).map(|lane| levels.levels(lane));
        self.0
            .extend(lanes.map(|levels| levels.map(|level| f64::from(level).clamp(0.0, 255.0))));
    }
}

/// A face of a random cuboid, seen so that a tile is anything from a thousandth of it to more than all of it.
struct Subject {
    triangle: Triangle,
    patch: Patch,
    material: Material,
    illumination: Illumination,
}

impl Subject {
    fn surface(&self) -> Surface<'_> {
        Surface {
            material: &self.material,
            illumination: &self.illumination,
            centre: DVec3::ZERO,
        }
    }
}

fn subject(random: &mut Random) -> Subject {
    let decades = |random: &mut Random| DVec3::splat(0.0).map(|_| random.decade(-1.0, 1.0));
    let mesh = Mesh::cuboid(decades(random));
    let half = mesh.corners[7];
    let transform = Transform {
        position: DVec3::ZERO,
        rotation: random.vector(-180.0, 180.0),
    };
    let axes = transform.axes();
    let offsets = mesh.corners.map(|corner| axes * corner);
    let normals = offsets.map(|offset| (axes * ((axes.transpose() * offset) / half)).normalize());
    let colors = offsets.map(|_| random.vector(-20.0, 400.0));
    let solid = Solid {
        axes,
        half,
        offsets: &offsets,
        normals: &normals,
        colors: &colors,
    };
    // Numbers 8 and 9 are the triangles of the face +z.
    let number = random.one_of(&[8, 9]);
    let over = |random: &mut Random, height: f64| {
        let place = random.vector(-1.2, 1.2) * half;
        axes * DVec3::new(place.x, place.y, half.z + height)
    };
    let target = over(random, 0.0);
    let height = random.decade(-2.0, 2.0);
    let eye = over(random, height)
        + axes * (random.vector(-1.0, 1.0) * height * DVec3::new(3.0, 3.0, 0.0));
    let forward = (target - eye).normalize();
    let right = forward.any_orthonormal_vector();
    let distance = eye.distance(target);
    let projection = random.one_of(&[
        Projection::Perspective,
        Projection::Perspective,
        Projection::Orthographic,
    ]);
    let seen = half.x.min(half.y) * random.decade(-4.0, -1.0);
    let rays = Rays {
        eye,
        axes: [right, right.cross(forward), forward],
        pitch: match projection {
            Projection::Perspective => seen / distance,
            Projection::Orthographic => seen,
        },
        projection,
    };
    let triangle = Triangle::new(number, &solid, &rays, |_| None);
    let origin = [
        random.within(-20.0, 4.0).round(),
        random.within(-20.0, 4.0).round(),
    ];
    let last = TILE as u8 - 1;
    let patch = Patch::new(&triangle, origin, [0, last], [0, last]);
    let material = Material {
        ambient: random.vector(0.0, 1.0),
        diffuse: random.vector(0.0, 1.0),
        specular: random.vector(0.0, 1.0),
        shininess: random.decade(-0.301, 3.0),
    };
    let count = random.one_of(&[1, 1, 1, 2, 3]);
    let points = (0..count).map(|_| {
        // From grazing, even behind the face, to far above it; and where its highlight may be on the tile.
        let height = random.decade(-2.0, 2.0) * random.one_of(&[1.0, 1.0, 1.0, -1.0]);
        let mirrored = target + (target - eye) * random.decade(-1.0, 1.0);
        let position = match random.one_of(&[0, 1, 2]) {
            0 => over(random, height),
            1 => random.vector(-20.0, 20.0),
            _ => {
                let local = axes.transpose() * mirrored;
                let bounced = DVec3::new(local.x, local.y, 2.0 * half.z - local.z);
                axes * bounced + random.vector(-1.0, 1.0) * half * 0.3
            }
        };
        PointLight {
            position,
            diffuse: random.vector(0.0, 1.0) * random.one_of(&[0.0, 50.0, 255.0, 2000.0]),
            specular: random.vector(0.0, 1.0) * random.one_of(&[0.0, 50.0, 255.0, 2000.0]),
        }
    });
    let illumination = Illumination {
        ambient: DVec3::splat(40.0),
        points: points.collect(),
    };
    Subject {
        triangle,
        patch,
        material,
        illumination,
    }
}

/// Shades a tile; what is displayed of it, and how it was done.
fn shade(shader: &impl Shader, triangle: &Triangle, patch: &Patch) -> (TileKind, Vec<[f64; 3]>) {
    let mut tile = Displayed::default();
    let kind = crate::tile::shade(shader, triangle, patch, &mut tile);
    (kind, tile.0)
}

/// What ought to be displayed of a tile, pixel by pixel in f64.
fn exact(patch: &Patch, triangle: &Triangle, levels: impl Fn(&Point) -> DVec3) -> Vec<[f64; 3]> {
    let place = |index: usize, middle: f64| index as f64 - middle;
    (0..TILE * TILE)
        .map(|pixel| {
            let (x, y) = (
                place(pixel % TILE, patch.lane),
                place(pixel / TILE, patch.row),
            );
            let levels = levels(&patch.point(triangle, x, y));
            levels.clamp(DVec3::ZERO, DVec3::splat(255.0)).to_array()
        })
        .collect()
}

fn phong(surface: &Surface, triangle: &Triangle, point: &Point) -> DVec3 {
    let normal = Triangle::blend(point.weights, &point.vertices.normals).normalize();
    let to_eye = triangle
        .eye
        .map_or(triangle.backward, |eye| eye - point.offset);
    surface.levels(point.offset, normal, to_eye.normalize())
}

/// In levels, over all pixels and channels.
fn largest_error(found: &[[f64; 3]], expected: &[[f64; 3]]) -> f64 {
    let pairs = found.as_flattened().iter().zip(expected.as_flattened());
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn no_certified_tile_exceeds_its_tolerance() {
    let tiles = 100 * cases();
    // By kind: the share of the tolerance that was used up.
    let mut used: [Vec<f64>; TileKind::ALL.len()] = Default::default();
    for seed in 0..tiles {
        let random = &mut Random(seed.wrapping_mul(0x1000_0000_01b3));
        let subject = subject(random);
        let tolerance = random.decade(-2.0, 0.9);
        let surface = subject.surface();
        let Subject {
            triangle, patch, ..
        } = &subject;
        if !patch.steady {
            continue;
        }
        let (kind, found, expected) = if random.one_of(&[true, true, false]) {
            let (kind, found) = shade(
                &Phong::new(Fallback::new(), surface, tolerance, triangle),
                triangle,
                patch,
            );
            (
                kind,
                found,
                exact(patch, triangle, |point| phong(&surface, triangle, point)),
            )
        } else {
            let (kind, found) = shade(&Gouraud { tolerance }, triangle, patch);
            (
                kind,
                found,
                exact(patch, triangle, |point| {
                    Triangle::blend(point.weights, &point.vertices.levels)
                }),
            )
        };
        let error = largest_error(&found, &expected);
        let limit = tolerance.max(EXACT);
        assert!(
            error <= limit,
            "tile {seed}: {error} levels, tolerance {tolerance}, {kind:?}"
        );
        used[kind as usize].push(error / tolerance);
    }
    for (kind, shares) in TileKind::ALL.into_iter().zip(&mut used) {
        shares.sort_unstable_by(f64::total_cmp);
        let (Some(most), middle) = (shares.last(), shares.get(shares.len() / 2)) else {
            continue;
        };
        println!(
            "{:>12}: {:>7} tiles, of the tolerance used: median {:.3}, most {most:.3}",
            kind.name(),
            shares.len(),
            middle.unwrap_or(&0.0),
        );
    }
    let least = tiles as usize / 500;
    for kind in &TileKind::ALL {
        let count = used[*kind as usize].len();
        assert!(count >= least, "{count} tiles of {tiles} are {kind:?}");
    }
}

#[test]
fn a_highlight_that_varies_slowly_is_a_polynomial_and_keeps_its_tolerance() {
    let tolerance = 0.5;
    let (mut smooth, mut by_pixel) = (0, 0);
    let mut most = 0.0_f64;
    for seed in 0..40 * cases() {
        let random = &mut Random(seed.wrapping_mul(0x1000_0000_01b3) ^ 0x5eed);
        let mut subject = subject(random);
        // Nothing but the highlights, and none so bright that the display cuts it off.
        subject.illumination.ambient = DVec3::ZERO;
        for light in &mut subject.illumination.points {
            light.diffuse = DVec3::ZERO;
            light.specular = light.specular.min(DVec3::splat(80.0));
        }
        let surface = subject.surface();
        let Subject {
            triangle, patch, ..
        } = &subject;
        let expected = exact(patch, triangle, |point| phong(&surface, triangle, point));
        let levels = expected.as_flattened();
        let brightest = levels.iter().copied().fold(0.0, f64::max);
        let darkest = levels.iter().copied().fold(f64::INFINITY, f64::min);
        if !patch.steady || brightest < 5.0 || brightest - darkest < tolerance {
            continue;
        }
        let (kind, found) = shade(
            &Phong::new(Fallback::new(), surface, tolerance, triangle),
            triangle,
            patch,
        );
        if matches!(kind, TileKind::Linear | TileKind::Quadratic) {
            smooth += 1;
            most = most.max(largest_error(&found, &expected));
        } else {
            by_pixel += 1;
        }
    }
    println!(
        "highlights: {smooth} polynomials with {most:.3} levels of error, {by_pixel} tiles by pixel"
    );
    assert!(most <= tolerance, "{most}");
    assert!(10 * smooth > by_pixel, "{smooth}, by pixel {by_pixel}");
}

#[test]
fn a_terminator_that_is_hardly_noticed_is_a_polynomial_and_keeps_its_tolerance() {
    let tolerance = 0.5;
    let (mut smooth, mut by_pixel, mut every_pixel) = (0, 0, 0);
    let mut most = 0.0_f64;
    for seed in 0..60 * cases() {
        let random = &mut Random(seed.wrapping_mul(0x1000_0000_01b3) ^ 0x7e53);
        let mut subject = subject(random);
        // None so dark or so bright that the display cuts it off.
        subject.material.ambient = DVec3::ONE;
        for light in &mut subject.illumination.points {
            light.diffuse = light.diffuse.min(DVec3::splat(40.0));
            light.specular = light.specular.min(DVec3::splat(20.0));
            if seed % 2 == 0 {
                light.specular = DVec3::ZERO;
            }
        }
        let first = Illumination {
            ambient: DVec3::ZERO,
            points: vec![PointLight {
                specular: DVec3::ZERO,
                ..subject.illumination.points[0]
            }],
        };
        let surface = subject.surface();
        let Subject {
            triangle, patch, ..
        } = &subject;
        let lit = Surface {
            illumination: &first,
            ..surface
        };
        let diffuse = exact(patch, triangle, |point| phong(&lit, triangle, point));
        let brightest = diffuse.as_flattened().iter().copied().fold(0.0, f64::max);
        let crossed = diffuse
            .iter()
            .any(|levels| levels.iter().all(|&level| level == 0.0));
        if !patch.steady || !crossed || brightest < tolerance || brightest > 5.0 {
            continue;
        }
        let expected = exact(patch, triangle, |point| phong(&surface, triangle, point));
        let (kind, found) = shade(
            &Phong::new(Fallback::new(), surface, tolerance, triangle),
            triangle,
            patch,
        );
        match kind {
            TileKind::Linear | TileKind::Quadratic => {
                smooth += 1;
                most = most.max(largest_error(&found, &expected));
            }
            TileKind::Exact => every_pixel += 1,
            _ => by_pixel += 1,
        }
    }
    println!(
        "terminators: {smooth} polynomials with {most:.3} levels of error, {by_pixel} tiles by pixel, {every_pixel} exact"
    );
    assert!(most <= tolerance, "{most}");
    assert!(5 * smooth > by_pixel, "{smooth}, by pixel {by_pixel}");
    // Some turn too much for any certificate. A terminator that spends what other terms need would make that more.
    assert!(
        10 * every_pixel < 8 * (smooth + by_pixel),
        "{every_pixel} exact, others {smooth} and {by_pixel}"
    );
}
