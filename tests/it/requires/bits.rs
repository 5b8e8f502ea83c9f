//! The bits that each stage requires: numbers known on paper, a twin in f32, and properties of the search.

use std::sync::Mutex;

use glam::DVec3;
use shadetrade::components::{
    LightKind, Mesh, Projection, Segments, ShadingMode, TRIANGLES, View, overwrite,
};
use shadetrade::output::CANCELLED;
use shadetrade::output::Monitor;
use shadetrade::output::finished;
use shadetrade::questions::requires::bits::{FORMATS, Format, StageBits, bits};
use shadetrade::reference::in_row;
use shadetrade::scene::Scene;

use super::{WHITE, cubes, from_z};
use crate::extremes::enlarged;
use crate::support::random::Random;
use crate::support::scene::{at, view_from};

fn of(scene: &Scene, view: &View) -> Vec<StageBits> {
    finished(bits(scene, view, Monitor::NONE)).expect("nobody cancels it")
}

/// The row of a stage.
fn stage<'a>(found: &'a [StageBits], name: &str) -> &'a StageBits {
    let mut rows = found.iter();
    rows.find(|row| row.stage == name).expect("a stage")
}

/// A cube at the origin under lights, seen from +z at half a level.
fn cube(lights: &[(LightKind, f64, DVec3)]) -> (Scene, View) {
    let mut view = from_z(8.0, Projection::Perspective);
    view.size = [33, 25];
    (cubes(&[at(DVec3::ZERO)], lights, &view), view)
}

/// The scene of a file in the picture of its first camera.
fn built_in(name: &str, mode: ShadingMode, size: [usize; 2]) -> (Scene, View) {
    let mut scene = Scene::load(Some(name)).expect("built in");
    overwrite(&mut scene.world, &mode);
    let view = view_from(&scene, 0, size).with_tolerance(0.5);
    (scene, view)
}

#[test]
fn formats_round_as_ieee_754_has_it() {
    let two = |exponent| 2.0_f64.powi(exponent);
    let [(_, f16), (_, bf16), (_, f32)] = FORMATS;
    let of_bits = |bits| Format {
        bits,
        exponent: 900,
    };
    for (format, value, known) in [
        (f16, 65519.0, 65504.0),
        (f16, 65520.0, f64::INFINITY),
        (f16, -1e9, f64::NEG_INFINITY),
        (f16, 1.0 + two(-11), 1.0),
        (f16, 1.0 + 3.0 * two(-11), 1.0 + two(-9)),
        (f16, two(-25), 0.0),
        (f16, 3.0 * two(-25), two(-23)),
        (f16, two(-14) - two(-26), two(-14)),
        (bf16, 1.0 + two(-8), 1.0),
        (bf16, 3.0 * two(-134), two(-132)),
        (of_bits(2), 100.4, 96.0),
        (of_bits(5), 100.4, 100.0),
        (of_bits(11), 1e6, 999_936.0),
        (of_bits(24), two(-300), two(-300)),
    ] {
        assert_eq!(format.round(value), known, "{format:?}, {value}");
    }
    assert!(f16.round(f64::NAN).is_nan());
    let mut random = Random(31);
    for _ in 0..100_000 {
        let exponent = random.within(-160.0, 140.0);
        let value = random.within(-2.0, 2.0) * exponent.exp2();
        assert_eq!(f32.round(value), f64::from(value as f32), "{value:e}");
    }
}

/// 100.4 levels lie between 100 and 100.5 in multiples of 4, and between 96 and 104 in multiples of 8.
#[test]
fn an_ambient_light_requires_the_bits_of_its_levels() {
    let (scene, view) = cube(&[(LightKind::Ambient, 100.4, DVec3::ZERO)]);
    let found = of(&scene, &view);
    let names: Vec<&str> = found.iter().map(|row| row.stage).collect();
    let stages = "positions, normals, vectors to light and eye, dot products, power, sum";
    assert_eq!(names.join(", "), stages);
    for row in &found {
        let [f16, bf16, _] = &row.formats;
        let errors = [row.largest_error, f16.largest_error, bf16.largest_error];
        let (bits, known) = match row.stage {
            "sum" => (5, [0.4, 0.025, 0.1]),
            _ => (2, [0.0; 3]),
        };
        assert_eq!(row.bits, Some(bits), "{row:?}");
        for (error, known) in errors.into_iter().zip(known) {
            assert!((error - known).abs() < 1e-9, "{row:?}");
        }
    }
    for (tolerance, bits) in [(4.5, 2), (4.3, 4), (0.41, 5), (0.39, 8), (0.02, 12)] {
        let found = of(&scene, &view.with_tolerance(tolerance));
        assert_eq!(stage(&found, "sum").bits, Some(bits), "{tolerance}");
    }
}

/// The square of a distance of 1000 overflows f16, and l is then zero. n.l of the corners is nearly 1 / sqrt(3).
#[test]
fn a_format_fails_where_its_exponents_end() {
    let (scene, view) = cube(&[(LightKind::Diffuse, 200.0, DVec3::Z * 1e3)]);
    for mode in [ShadingMode::Gouraud, ShadingMode::Phong] {
        let mut scene = scene.snapshot();
        overwrite(&mut scene.world, &mode);
        let found = of(&scene, &view);
        let vectors = stage(&found, "vectors to light and eye");
        assert!(vectors.bits.expect("24 do") <= 11, "{vectors:?}");
        assert!(vectors.formats[0].largest_error > 90.0, "{vectors:?}");
        let f32 = &vectors.formats[2];
        assert!(f32.keeps && f32.largest_error < 1e-3, "{vectors:?}");
        // No light is specular.
        assert!(stage(&found, "power").formats[0].largest_error < 1e-6);
    }
}

/// 76.8 is 76.8125 in f16, a third of u = 2^-11 too large. log2, the product and 2^y err by u each, relative. With
/// z = |ln s^rho| the power errs by (7/3 z + 1) u of itself, and e^-z (7/3 z + 1) is at most 1.3176, at z = 4/7. The
/// specular light has 0.72811 * 255 levels, so f16 errs by at most 0.1195 level. With 9 bits 76.8 is 76.75, again a third
/// of u away, and the error is at most 0.478. In bf16 it is 77: (8/3 z + 1) u, at most 1.035 levels.
#[test]
fn half_a_level_of_the_default_highlight_requires_nine_bits_of_the_power() {
    let (scene, view) = built_in("cuboid", ShadingMode::Phong, enlarged([120, 90]));
    let power = &of(&scene, &view)[4];
    let [f16, bf16, _] = power.formats.each_ref().map(|it| it.largest_error);
    assert!((0.06..=0.1195).contains(&f16), "{power:?}");
    assert!((0.5..=1.036).contains(&bf16), "{power:?}");
    assert_eq!((power.bits, power.formats[1].keeps), (Some(9), false));
}

/// A light of 200 levels diffusely and 100 specularly, with one stage in f32: written for one light at `place`.
fn twin(
    stage: usize,
    corners: [[DVec3; 2]; 3],
    weights: [f64; 3],
    [place, eye]: [DVec3; 2],
) -> f64 {
    let fit = |own: usize, v: DVec3| {
        if own == stage {
            v.as_vec3().as_dvec3()
        } else {
            v
        }
    };
    let one = |own: usize, x: f64| fit(own, DVec3::splat(x)).x;
    let sum = |own, a: f64, b: f64| one(own, a + b);
    let dot = |own, a: DVec3, b: DVec3| {
        let product = fit(own, a * b);
        sum(own, sum(own, product.x, product.y), product.z)
    };
    let unit = |own, v: DVec3| fit(own, v / one(own, one(own, dot(own, v, v)).sqrt()));
    let between = |own: usize| {
        let [a, b, c] = [0, 1, 2].map(|i| fit(own, fit(own, corners[i][own]) * weights[i]));
        fit(own, fit(own, a + b) + c)
    };
    let (point, normal) = (between(0), unit(1, between(1)));
    let [l, o] = [place, eye].map(|place| unit(2, fit(2, fit(2, place) - point)));
    let cosine = dot(3, normal, l);
    if cosine <= 0.0 {
        return 0.0;
    }
    let mirrored = fit(3, fit(3, normal * (2.0 * cosine)) - l);
    let log = one(4, dot(3, o, mirrored).max(0.0).log2());
    let exponent = one(4, log * one(4, WHITE.shininess));
    let terms = [(200.0, cosine), (100.0, one(4, exponent.exp2()))];
    let [diffuse, specular] = terms.map(|(levels, factor)| one(5, one(5, levels) * factor));
    sum(5, diffuse, specular)
}

#[test]
fn the_errors_of_f32_are_those_of_a_twin() {
    let place = DVec3::new(3.1, 2.3, 7.7);
    let kinds = [LightKind::Diffuse, LightKind::Specular];
    let (mut scene, view) = cube(&kinds.map(|kind| (kind, 200.0, place)));
    overwrite(&mut scene.world, &ShadingMode::Phong);
    let found = of(&scene, &view);
    let mesh = Mesh::cuboid(DVec3::splat(2.0));
    let mut errors = [0.0_f64; 6];
    let columns: Vec<usize> = (0..view.size[0]).collect();
    let samples = (0..view.size[1]).flat_map(|y| in_row(&scene.world, &view, y, &columns));
    for sample in samples.flatten() {
        let corners = TRIANGLES[sample.triangle].map(usize::from);
        let corners = corners.map(|corner| [mesh.corners[corner], mesh.normals[corner]]);
        let places = [place, view.camera.position];
        let level = |stage| twin(stage, corners, sample.weights, places).min(255.0);
        let exact = level(6);
        errors = std::array::from_fn(|stage| errors[stage].max((level(stage) - exact).abs()));
    }
    for (row, error) in found.iter().zip(errors) {
        let difference = row.formats[2].largest_error - error;
        assert!(difference.abs() < 1e-9, "{error}: {row:?}");
        assert!(error > 1e-7, "the stage is rounded: {row:?}");
    }
}

/// Wrong vertices would err by tens of levels in every stage and format.
#[test]
fn on_a_grid_the_stages_of_gouraud_are_rounded_at_the_vertices_of_the_cell() {
    for mode in [ShadingMode::Gouraud, ShadingMode::Phong] {
        let (mut scene, view) = built_in("cuboid", mode, enlarged([32, 24]));
        let coarse = of(&scene, &view);
        overwrite(&mut scene.world, &Segments::new(8).expect("a number"));
        let fine = of(&scene, &view);
        for row in &fine {
            assert!(row.formats[2].largest_error < 0.05, "{row:?}");
        }
        // Phong does not depend on the grid.
        assert_eq!(fine == coarse, mode == ShadingMode::Phong);
    }
}

#[test]
fn a_tolerance_just_below_the_largest_error_requires_more_bits() {
    for (name, mode) in [
        ("cuboid", ShadingMode::Gouraud),
        ("assignment", ShadingMode::Phong),
    ] {
        let (scene, view) = built_in(name, mode, enlarged([32, 24]));
        for (index, row) in of(&scene, &view).into_iter().enumerate() {
            let is_kept = row.bits.is_some() && row.largest_error <= 0.5;
            assert!(is_kept, "{name}: {row:?}");
            if row.largest_error > 0.0002 {
                let view = view.with_tolerance(0.999 * row.largest_error);
                let less = &of(&scene, &view)[index];
                let is_kept = less.largest_error <= view.tolerance;
                assert!(less.bits > row.bits && is_kept, "{name}: {less:?}, {row:?}");
            }
        }
        for row in of(&scene, &view.with_tolerance(255.0)) {
            assert_eq!(row.bits, Some(2), "{name}: {row:?}");
        }
    }
}

#[test]
fn progress_rises_to_one_and_a_search_can_be_cancelled() {
    let (scene, view) = built_in("cuboid", ShadingMode::Gouraud, [24, 18]);
    let shares = Mutex::new(Vec::new());
    let progress = |_, share| shares.lock().unwrap().push(share);
    let monitor = Monitor {
        progress: &progress,
        ..Monitor::NONE
    };
    assert!(finished(bits(&scene, &view, monitor)).is_ok());
    let mut shares = shares.into_inner().unwrap();
    shares.sort_by(f64::total_cmp);
    assert_eq!((shares.len(), shares[0] > 0.0, shares[17]), (18, true, 1.0));
    let monitor = Monitor {
        is_cancelled: &|| true,
        ..Monitor::NONE
    };
    let error = finished(bits(&scene, &view, monitor)).expect_err("it is cancelled");
    assert_eq!(error.to_string(), CANCELLED);
}
