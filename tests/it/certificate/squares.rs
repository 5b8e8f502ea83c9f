//! Single squares of every size and slant, drawn within a tolerance, against the definition at every pixel in f64.

use fearless_simd::Simd;
use glam::DVec3;
use shadetrade::components::{
    Illumination, Lens, Material, Mesh, PointLight, Projection, ShadingMode, Transform,
};
use shadetrade::shading::display::{Rows, Sink};
use shadetrade::shading::face::{Face, Rays, Solid};
use shadetrade::shading::field::Places;
use shadetrade::shading::gloss::Gloss;
use shadetrade::shading::gouraud::Gouraud;
use shadetrade::shading::interpolation;
use shadetrade::shading::phong::Phong;
use shadetrade::shading::square::Square;
use shadetrade::shading::unit_vectors::UnitVectors;
use shadetrade::shading::{EXACT, Scratch, Shader, Surface, TileKind};
use shadetrade::simd::baseline;

use super::SCENES;
use crate::support::cases::cases;
use crate::support::random::Random;

/// The first pixel of the square, near the middle of the picture.
const PLACE: [usize; 2] = [64, 96];

/// The levels of a square's pixels, row by row.
struct Shown {
    side: usize,
    levels: Vec<[f64; 3]>,
}

impl<S: Simd> Sink<S> for Shown {
    fn draw(&mut self, rows: &mut impl Rows<S>) {
        self.levels.resize(self.side * self.side, [0.0; 3]);
        for part in 0..self.side / 16 {
            rows.go_to(part);
            for row in 0..self.side {
                let levels = rows.levels(row);
                for lane in 0..16 {
                    let pixel = row * self.side + 16 * part + lane;
                    self.levels[pixel] = levels.map(|channel| f64::from(channel[lane]));
                }
            }
        }
    }
}

/// A face of a random cuboid, with a square between a thousandth of the face and more than all of it.
struct Subject {
    solid: Solid,
    /// Unit normals and levels at its corners.
    normals: [DVec3; 8],
    colors: [DVec3; 8],
    rays: Rays,
    eye: DVec3,
    material: Material,
    illumination: Illumination,
    /// The picture's middle, in pixels.
    picture: [f64; 2],
    side: usize,
}

impl Subject {
    fn surface(&self) -> Surface<'_> {
        Surface {
            material: &self.material,
            illumination: &self.illumination,
            centre: DVec3::ZERO,
        }
    }

    /// The face +z.
    fn face(&self) -> Face<'_> {
        Face::new(4, &self.solid, &self.rays)
    }

    /// The centre of a pixel relative to the picture's middle.
    fn place(&self, column: usize, row: usize) -> [f64; 2] {
        let [left, top] = PLACE;
        [
            (left + column) as f64 + 0.5 - self.picture[0],
            (top + row) as f64 + 0.5 - self.picture[1],
        ]
    }

    /// Whether the whole square shows the face; a shader draws only such squares.
    fn is_inside(&self) -> bool {
        let face = self.face();
        let last = self.side - 1;
        [[0, 0], [last, 0], [0, last], [last, last]]
            .iter()
            .all(|&[column, row]| {
                let [x, y] = self.place(column, row);
                let DVec3 { x: u, y: v, z: w } = face.place.at(x, y);
                w > 0.0 && u.abs() <= w && v.abs() <= w
            })
    }
}

fn subject(random: &mut Random) -> Subject {
    let mesh = Mesh::cuboid(DVec3::ZERO.map(|_| random.decade(-1.0, 1.0)));
    let half = mesh.corners[7];
    let transform = Transform {
        position: DVec3::ZERO,
        rotation: random.vector(-180.0, 180.0),
    };
    let axes = transform.axes();
    let normals = mesh
        .corners
        .map(|corner| axes * (corner / half).normalize());
    let colors = mesh.corners.map(|_| random.vector(-20.0, 400.0));
    let over = |random: &mut Random, height: f64| {
        let place = random.vector(-1.2, 1.2) * half;
        axes * DVec3::new(place.x, place.y, half.z + height)
    };
    let target = over(random, 0.0);
    let height = random.decade(-2.0, 2.0);
    let aside = random.vector(-1.0, 1.0) * height * DVec3::new(3.0, 3.0, 0.0);
    let eye = over(random, height) + axes * aside;
    let forward = (target - eye).normalize();
    let right = forward.any_orthonormal_vector();
    let projection = random.one_of(&[
        Projection::Perspective,
        Projection::Perspective,
        Projection::Orthographic,
    ]);
    let seen = half.x.min(half.y) * random.decade(-4.0, -1.0);
    let rays = Rays::new(&Lens {
        axes: [right, right.cross(forward), forward],
        pitch: match projection {
            Projection::Perspective => seen / eye.distance(target),
            Projection::Orthographic => seen,
        },
        projection,
        ..Lens::default()
    });
    let solid = Solid {
        centre: -eye,
        axes,
        half,
    };
    let material = Material {
        ambient: random.vector(0.0, 1.0),
        diffuse: random.vector(0.0, 1.0),
        specular: random.vector(0.0, 1.0),
        shininess: random.decade(-1.0, 3.0),
    };
    let count = random.one_of(&[1, 1, 1, 2, 3]);
    let points = (0..count).map(|_| {
        // From grazing, even behind the face, to far above it; or where its highlight may lie on the square.
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
    let side = random.one_of(&[16, 16, 32]);
    Subject {
        solid,
        normals,
        colors,
        rays,
        eye,
        material,
        illumination,
        picture: PLACE.map(|first| first as f64 + random.within(-4.0, 20.0).round()),
        side,
    }
}

/// Draws the square; returns its kind of tile and the displayed levels.
fn shade(shader: &Shader, subject: &Subject) -> (TileKind, Vec<[f64; 3]>) {
    let simd = baseline().expect("every machine has them");
    let Subject { picture, side, .. } = *subject;
    let square = Square::whole(PLACE, side);
    let middle = [0, 1].map(|axis| square.middle()[axis] - picture[axis]);
    let places = Places::single(simd, middle, square.half());
    let mut shown = Shown {
        side,
        levels: Vec::new(),
    };
    let mut scratch = Scratch::default();
    let (interpolant, _) = shader.prepare(simd, &places, true, &mut scratch);
    if let Some(interpolant) = interpolant
        && let Some(form) = interpolant.forms[2]
    {
        interpolation::draw(simd, &interpolant, 2, form, &square, &mut shown);
        return (form.kind, shown.levels);
    }
    let [left, top] = square.first().map(|first| first as f32);
    for row in 0..side {
        let indices = side * row..side * (row + 1);
        scratch
            .pixels
            .extend(simd, [left, top + row as f32], indices);
    }
    match shader.evaluate(simd, &square, picture, 2, &mut scratch) {
        Some(evaluations) => {
            let levels = scratch.pixels.levels();
            let levels = levels.map(|(_, levels)| levels.map(f64::from));
            (evaluations.kind, levels.collect())
        }
        None => (TileKind::Double, defined(shader, subject)),
    }
}

/// The definition at every pixel, in f64.
fn defined(shader: &Shader, subject: &Subject) -> Vec<[f64; 3]> {
    (0..subject.side * subject.side)
        .map(|pixel| {
            let [x, y] = subject.place(pixel % subject.side, pixel / subject.side);
            shader.define(x, y).to_array()
        })
        .collect()
}

/// The largest difference of displayed levels over all pixels and channels.
fn largest_error(found: &[[f64; 3]], expected: &[[f64; 3]]) -> f64 {
    let pairs = found.as_flattened().iter().zip(expected.as_flattened());
    pairs
        .map(|(a, b)| (a.clamp(0.0, 255.0) - b.clamp(0.0, 255.0)).abs())
        .fold(0.0, f64::max)
}

/// The kind of tile of a square at a tolerance, its largest error, and the permitted error, both in levels.
fn shaded(subject: &Subject, mode: ShadingMode, tolerance: f64) -> (TileKind, f64, f64) {
    let (surface, face, eye) = (subject.surface(), &subject.face(), subject.eye);
    let normals = face.linear(&subject.normals, 0);
    let gloss = Gloss::new(&surface, tolerance);
    let lights = &mut Vec::new();
    let shader = if mode == ShadingMode::Gouraud {
        Shader::Gouraud(Gouraud::new(face, &subject.colors, tolerance))
    } else {
        let phong = Phong::new(face, normals, surface, eye, &gloss, lights, tolerance);
        Shader::Phong(phong)
    };
    let (kind, found) = shade(&shader, subject);
    let limit = if tolerance > 0.0 { tolerance } else { EXACT };
    let error = largest_error(&found, &defined(&shader, subject));
    (kind, error, limit)
}

#[test]
fn no_square_exceeds_its_tolerance() {
    // The used share of the tolerance by kind of tile.
    let mut used: [Vec<f64>; TileKind::ALL.len()] = Default::default();
    for seed in 0..80 * cases(SCENES) as u64 {
        let random = &mut Random(seed.wrapping_mul(0x1000_0000_01b3));
        let subject = subject(random);
        if !subject.is_inside() {
            continue;
        }
        let tolerance = random.one_of(&[0.0, 1.0, 1.0, 1.0]) * random.decade(-2.0, 0.9);
        for mode in [ShadingMode::Gouraud, ShadingMode::Phong] {
            let (kind, error, limit) = shaded(&subject, mode, tolerance);
            assert!(
                error <= limit,
                "seed {seed}: {kind:?} errs {error} of {limit}"
            );
            used[kind as usize].push(error / limit);
        }
    }
    for (kind, used) in TileKind::ALL.into_iter().zip(&mut used) {
        used.sort_by(f64::total_cmp);
        let most = used.last().copied().unwrap_or_default();
        println!("{}: {} squares, {most:.3} at most", kind.name(), used.len());
        assert!(used.len() > 20, "{kind:?} was chosen too rarely");
        let tight = !matches!(kind, TileKind::Exact | TileKind::Double);
        assert!(
            !tight || most > 0.2,
            "{kind:?}: the bounds are too loose to show a mistake"
        );
    }
}

#[test]
fn a_sliver_is_never_interpolated() {
    let simd = baseline().expect("every machine has them");
    let mut slivers = 0;
    for seed in 0..4000_u64 {
        let subject = subject(&mut Random(seed.wrapping_mul(0x1000_0000_01b3)));
        let Subject { picture, side, .. } = &subject;
        let face = &subject.face();
        let square = Square::whole(PLACE, *side);
        let middle = [0, 1].map(|axis| square.middle()[axis] - picture[axis]);
        if face.is_steady(face.plane.w.at(middle[0], middle[1])) {
            continue;
        }
        slivers += 1;
        let places = Places::single(simd, middle, square.half());
        let shader = Shader::Gouraud(Gouraud::new(face, &subject.colors, 8.0));
        let form = shader
            .prepare(simd, &places, true, &mut Scratch::default())
            .0
            .and_then(|interpolant| interpolant.forms[2]);
        assert_eq!(form, None, "seed {seed}");
    }
    assert!(slivers > 20, "{slivers} slivers");
}

/// A cuboid without rotation or lights, whose face +z is seen at this angle.
fn seen(half: DVec3, eye: DVec3, lens: Lens) -> Subject {
    let mesh = Mesh::cuboid(half * 2.0);
    Subject {
        solid: Solid {
            centre: -eye,
            axes: Transform::default().axes(),
            half,
        },
        normals: mesh.corners.map(|corner| (corner / half).normalize()),
        colors: [DVec3::ZERO; 8],
        rays: Rays::new(&lens),
        eye,
        material: Material {
            ambient: DVec3::ONE,
            diffuse: DVec3::ONE,
            specular: DVec3::ONE,
            shininess: 1.0,
        },
        illumination: Illumination {
            ambient: DVec3::ZERO,
            points: Vec::new(),
        },
        picture: PLACE.map(|first| first as f64 + 8.0),
        side: 16,
    }
}

#[test]
fn no_square_exceeds_its_tolerance_where_the_bound_is_tight() {
    // The normal rotates along x alone, towards a light that is far away and nearly in the plane of the face.
    let lens = Lens {
        axes: [DVec3::X, DVec3::Y, DVec3::NEG_Z],
        pitch: 0.1 / 7.5,
        projection: Projection::Orthographic,
        ..Lens::default()
    };
    let mut subject = seen(DVec3::new(1.0, 1e3, 1.0), DVec3::Z * 10.0, lens);
    subject.illumination.points.push(PointLight {
        position: DVec3::new(1e6, 0.0, 1.5e5),
        diffuse: DVec3::splat(255.0),
        specular: DVec3::ZERO,
    });
    let mut most = 0.0_f64;
    for step in 0..60 {
        let tolerance = 1e-3 * 1.1_f64.powi(step);
        let (kind, error, limit) = shaded(&subject, ShadingMode::Phong, tolerance);
        assert!(error <= limit, "{kind:?} errs {error} of {limit}");
        if kind == TileKind::Quadratic {
            most = most.max(error / limit);
        }
    }
    assert!(
        most > 0.6,
        "{most}: the bounds are too loose to show a mistake"
    );
}

#[test]
fn no_square_exceeds_its_tolerance_where_it_nearly_reaches_the_horizon() {
    for seed in 0..200 {
        let random = &mut Random(seed);
        // Low over the whole length of the face, whose end is in the first row of the square.
        let height = random.decade(-5.0, -4.0);
        let eye = DVec3::new(0.0, -1.001, 1.0 + height);
        let below = random.within(0.128, 0.16);
        let lens = Lens {
            axes: [DVec3::X, DVec3::Z, DVec3::Y],
            pitch: height / 2.0 / below,
            projection: Projection::Perspective,
            ..Lens::default()
        };
        let mut subject = seen(DVec3::ONE, eye, lens);
        // Bright nearby; the far end is within the displayed range.
        let bright = random.decade(1.0, 4.0);
        for (corner, color) in subject.colors.iter_mut().enumerate() {
            let size = if corner & 2 == 0 { bright } else { 10.0 };
            *color = random.vector(0.0, 1.0) * size;
        }
        subject.side = random.one_of(&[16, 32]);
        subject.picture = [
            PLACE[0] as f64 + random.within(0.0, 32.0),
            PLACE[1] as f64 + 0.499 - 2.0 / 1.99 * below,
        ];
        assert!(subject.is_inside(), "seed {seed}");
        for tolerance in [0.0, 1e-4, 1e-3, 1e-2] {
            let (kind, error, limit) = shaded(&subject, ShadingMode::Gouraud, tolerance);
            assert!(
                error <= limit,
                "seed {seed}: {kind:?} errs {error} of {limit}"
            );
        }
    }
}

#[test]
fn the_error_of_samples_is_subtracted_from_the_tolerance() {
    // The slope of s^1 in |r - o| is at most sqrt(2). |r - o| has 50 roundings and 12 of its directions, 1 - s has four more
    // at this slope and at its own size, the power six, the sum seven: 110. Interpolation enlarges each up to 25/9 times,
    // which makes 307. Rows have fourteen.
    let lens = Lens {
        axes: [DVec3::X, DVec3::Y, DVec3::NEG_Z],
        pitch: 1e-8,
        projection: Projection::Orthographic,
        ..Lens::default()
    };
    let mut subject = seen(DVec3::ONE, DVec3::Z * 10.0, lens);
    subject.illumination.points.push(PointLight {
        position: DVec3::Z * 1e6,
        diffuse: DVec3::ZERO,
        specular: DVec3::splat(255.0),
    });
    for (roundings, expected) in [(300.0, false), (330.0, true)] {
        let tolerance = roundings * 2.0_f64.powi(-24) * 255.0;
        let (kind, error, limit) = shaded(&subject, ShadingMode::Phong, tolerance);
        assert!(error <= limit, "{kind:?} errs {error} of {limit}");
        assert_eq!(kind == TileKind::Constant, expected, "{kind:?}");
    }
}

#[test]
fn where_a_highlight_ends_at_the_gate_each_pixel_is_on_its_own_side() {
    // n.l is zero along the middle of the square, where the highlight is bright, and so small all over that f32 has no sign.
    let forward = DVec3::new(1.0, 0.0, -0.2).normalize();
    let lens = Lens {
        axes: [DVec3::Y, DVec3::Y.cross(forward), forward],
        pitch: 1e-10,
        projection: Projection::Orthographic,
        ..Lens::default()
    };
    for shininess in [0.5, 1.0, 2.0] {
        let mut subject = seen(DVec3::ONE, DVec3::Z - 10.0 * forward, lens);
        subject.material.shininess = shininess;
        subject.illumination.points.push(PointLight {
            position: DVec3::new(20.0, 0.0, 1.0),
            diffuse: DVec3::ZERO,
            specular: DVec3::splat(255.0),
        });
        for tolerance in [0.0, 4.0] {
            let (kind, error, limit) = shaded(&subject, ShadingMode::Phong, tolerance);
            assert_eq!(kind, TileKind::Exact);
            assert!(error <= limit, "{kind:?} errs {error} of {limit}");
        }
    }
}

#[test]
fn the_shortcut_shows_the_far_end_of_a_face_where_snapping_covers_pixels_beyond_the_horizon() {
    // The eye looks along the face, whose far end lies 0.003 pixels below the horizon.
    let (height, below) = (1e-4, 0.003);
    let eye = DVec3::new(0.0, -1.001, 1.0 + height);
    let lens = Lens {
        axes: [DVec3::X, DVec3::Z, DVec3::Y],
        eye,
        pitch: height / 2.001 / below,
        projection: Projection::Perspective,
        near: 1e-6,
        ..Lens::default()
    };
    let mut subject = seen(DVec3::ONE, eye, lens);
    subject.illumination.points.push(PointLight {
        position: DVec3::new(0.5, 3.0, 2.0),
        diffuse: DVec3::splat(200.0),
        specular: DVec3::ZERO,
    });
    let face = subject.face();
    let normals = face.linear(&subject.normals, 0);
    let to_lights = &mut Vec::new();
    let shortcut = UnitVectors::new(&face, &normals, subject.surface(), &lens, to_lights);
    for step in -4..=4 {
        let x = 0.2 * f64::from(step) / 2.001 / lens.pitch;
        assert!(face.plane.w.at(x, -0.0005) < 0.0);
        let [beyond, end] = [-0.0005, below * 1.001].map(|y| shortcut.define(x, y));
        assert!((beyond - end).length() < 0.5, "{beyond}, not {end}");
        assert!(end.x > 1.0, "{end} is lit");
    }
}
