//! Blinn-Phong with four times the exponent against Phong, on scenes whose difference is known on paper.
//!
//! ```text
//!   light  n  eye      the light is far, at an angle t of incidence; the eye is in the mirror direction,
//!       \  |  /        and the pixels see the face from beside it by f: across the plane of incidence
//!      t \ | / t       o.r = 1 - f^2 / 2 and n.h = 1 - f^2 / (8 cos^2 t), nearly
//!  ________|________
//! ```

use shadetrade::components::LightKind::Specular;
use shadetrade::components::ShadingMode::{BlinnPhong, Phong};
use shadetrade::reference::{Interval, Real, Reference};

use crate::support::prelude::*;

/// The face z = 0 under a light at this angle of incidence, seen from the mirror direction. Angles are in degrees.
fn mirror(incidence: f64, shininess: f64, fov: f64) -> (World, View) {
    let (sin, cos) = incidence.to_radians().sin_cos();
    let mut world = empty();
    let slab = DVec3::new(400.0, 400.0, 1.0);
    spawn_cuboid(&mut world, slab, at(DVec3::Z * -0.5), white(shininess));
    let light = DVec3::new(-sin, 0.0, cos) * 1e9;
    shine(&mut world, Specular, 255.0, light);
    overwrite(&mut world, &NormalMode::Face);
    let eye = DVec3::new(sin, 0.0, cos) * 10.0;
    let mut view = view([121; 2], eye, DVec3::ZERO, Projection::Perspective);
    view.camera.fov = fov;
    (world, view)
}

/// The largest difference of two pictures, in levels.
fn difference(one: &(World, View), other: &(World, View)) -> f64 {
    let [one, other] = [one, other].map(|(world, view)| truth(world, view).levels);
    let pairs = one.as_flattened().iter().zip(other.as_flattened());
    let differences = pairs.map(|(one, other)| (one - other).abs());
    differences.fold(0.0, f64::max)
}

/// The difference of Blinn-Phong with `times` the exponent from Phong, in one scene.
fn error_with(times: f64, incidence: f64, shininess: f64, fov: f64) -> f64 {
    let scene = |mode, shininess| {
        let (world, view) = mirror(incidence, shininess, fov);
        (world, view.shaded(mode))
    };
    // The method has four times the shininess.
    let blinn = scene(BlinnPhong, shininess * times / 4.0);
    difference(&blinn, &scene(Phong, shininess))
}

/// The largest x - x^k, 0 < x < 1, as levels.
fn law(k: f64) -> f64 {
    255.0 * k.powf(-1.0 / (k - 1.0)) * (1.0 - 1.0 / k)
}

/// Times the exponent, angle of incidence, shininess, field of view, and the difference and its error.
const DIFFERENCES: &str = "
It goes with the angle of incidence. The smallest is known to one digit.
4 0   77   30   0.5   0.05
4 30  77   30   26.7  0.267
4 45  77   30   63.5  0.635
4 60  77   30   120.2 1.202
4 75  77   30   195.3 1.953
It does not depend on the shininess: k = 1 / cos^2 t is 2.
4 45  50   40   63.75 0.6375
4 45  800  10   63.75 0.6375
4 45  2e4  2    63.75 0.6375
Head-on little is left at a low shininess.
4 0   5    100  7.7   0.06
4 0   10   100  3.6   0.06
4 0   20   100  1.8   0.06
Equal exponents differ by half of the range.
1 0   77   60   121.5 1.5
1 45  77   60   121.5 1.5";

#[test]
fn differences_are_those_on_paper() {
    assert!((law(2.0) - 63.75).abs() < 1e-9);
    let rows = DIFFERENCES
        .lines()
        .filter(|row| row.starts_with(char::is_numeric));
    for row in rows {
        let numbers: Vec<f64> = row.split_whitespace().flat_map(str::parse).collect();
        let [times, incidence, shininess, fov, known, near] = numbers[..] else {
            panic!("{row}");
        };
        let found = error_with(times, incidence, shininess, fov);
        assert!((found - known).abs() < near, "{found}: {row}");
    }
}

/// It errs as much across the plane of incidence as in it.
#[test]
fn the_best_exponent_is_4_cos_t_times_as_large() {
    for incidence in [30.0_f64, 45.0, 60.0] {
        let cos = incidence.to_radians().cos();
        let with = |times: f64| error_with(times, incidence, 800.0, 15.0);
        let (best, known) = (with(4.0 * cos), law(1.0 / cos));
        let is_known = (best - known).abs() < 0.02 * known;
        assert!(is_known, "{best}, not {known}, at {incidence} degrees");
        for other in [0.9, 1.1].map(|it| with(4.0 * cos * it)) {
            assert!(other > 1.05 * best, "{other}, {best}");
        }
    }
}

#[test]
fn enclosures_hold_the_levels_of_the_reference() {
    for (incidence, shininess) in [(0.0, 1e6), (45.0, 77.0), (80.0, 0.0)] {
        let (world, view) = mirror(incidence, shininess, 30.0);
        let view = view.shaded(BlinnPhong);
        let exact = Reference::<Interval>::new(&world, &view);
        let levels = truth(&world, &view).levels;
        for y in 0..121 {
            exact.row(y, |x, seen| {
                let level = levels[y * 121 + x][0];
                let near = |[least, most]: [f64; 2]| least - 1e-6 < level && level < most + 1e-6;
                let holds = seen.iter().any(|it| near(it.levels[0].endpoints()));
                assert!(holds, "{level}, {seen:?}");
                let [least, most] = seen[0].levels[0].endpoints();
                assert!(most - least < 1e-6, "{least} to {most}");
            });
        }
    }
}
