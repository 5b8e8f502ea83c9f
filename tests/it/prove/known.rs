//! Scenes with levels known on paper, which f32 or coordinates relative to a cuboid's centre get wrong.

use std::f64::consts::SQRT_2;

use glam::DMat3;
use shadetrade::questions::prove::{Shown, Verdict, judge};

use super::{enclosures, proof};
use crate::requires::WHITE;
use crate::support::prelude::*;

/// One pixel in the middle of a face under an ambient light of 200 levels and `count` diffuse lights of 7e-6 levels,
/// each straight above the middle.
fn faint_lights(count: usize) -> (World, View) {
    let mut world = empty();
    spawn_cuboid(&mut world, DVec3::splat(4.0), at(DVec3::ZERO), WHITE);
    shine(&mut world, LightKind::Ambient, 200.0, DVec3::ZERO);
    for i in 0..count {
        let place = DVec3::Z * (1000 + i) as f64;
        shine(&mut world, LightKind::Diffuse, 7e-6, place);
    }
    let eye = DVec3::Z * 12.0;
    let view = view([1, 1], eye, DVec3::ZERO, Projection::Orthographic);
    (world, view)
}

#[test]
fn a_sum_that_drops_twenty_thousand_faint_lights_is_refuted() {
    let (world, view) = faint_lights(20_000);
    let seen = &enclosures(&world, &view)[0];
    let judged = |level: f64| {
        let shown = Shown {
            face: seen[0].face(),
            levels: [level; 3],
            ..Shown::default()
        };
        judge(shown, seen, 0.05)
    };
    // 200 + 20,000 * 7e-6, and the sum in f32, which no single light changes.
    assert_eq!(judged(200.14).0.verdict, Verdict::Proven);
    let (mark, [_, error]) = judged(200.0);
    assert_eq!(mark.verdict, Verdict::Refuted);
    assert!((error - 0.14).abs() < 1e-9, "{error}");
}

#[test]
fn twenty_thousand_faint_lights_are_summed_within_the_tolerance() {
    let (mut world, view) = faint_lights(20_000);
    let proof = proof(&mut world, &view.shaded(ShadingMode::Phong));
    assert_eq!(proof.proven, 1, "{:?}", proof.examples);
}

/// Snapping puts pixels of one triangle beyond the diagonal of the face, where the other triangle may be brighter by
/// hundreds of thousands of levels per pixel.
#[test]
fn every_pixel_beside_a_diagonal_is_proven() {
    for seed in 0..cases(6) {
        let mut random = Random(seed as u64);
        let mut world = empty();
        let mut vector = |from: f64, to: f64| DVec3::ZERO.map(|_| random.within(from, to));
        let size = vector(1.0, 4.0);
        spawn_cuboid(&mut world, size, at(DVec3::ZERO), WHITE);
        let [eye, light] = [12.0, 8.0].map(|far| vector(-1.0, 1.0).normalize() * far);
        shine(&mut world, LightKind::Diffuse, 1e5, light);
        for projection in Projection::ALL {
            let view = view([64, 48], eye, DVec3::ZERO, projection);
            for mode in ShadingMode::ALL {
                let proof = proof(&mut world, &view.shaded(mode));
                let unproven = proof.refuted + proof.undecided;
                assert_eq!(unproven, 0, "{seed}, {mode:?}: {:?}", proof.examples);
            }
        }
    }
}

/// Snapping moves the left edge by 0.0015 pixel onto centres, where the levels grow by 58 a pixel to the left.
#[test]
fn every_pixel_just_outside_an_edge_is_proven() {
    let mut world = empty();
    let place = at(DVec3::X * 0.25075);
    spawn_cuboid(&mut world, DVec3::splat(2.0), place, WHITE);
    shine(&mut world, LightKind::Diffuse, 400.0, DVec3::X * -1e6);
    let eye = DVec3::Z * 12.0;
    let mut view = view([8, 8], eye, DVec3::ZERO, Projection::Orthographic);
    view.camera.height = 4.0;
    let proof = proof(&mut world, &view.shaded(ShadingMode::Gouraud));
    assert_eq!(proof.proven, 64, "{:?}", proof.examples);
}

/// Seen from one unit above the first of three plates: the second ties with the first, and the third with the second alone; and
/// rounding decides whether the second ties with the first.
#[test]
fn faces_that_nearly_tie_are_proven_as_they_are_drawn() {
    for heights in [[0.0, 9.9993e-12, 1.5e-11], [0.0, 1.000_01e-11, 0.0]] {
        let mut world = empty();
        for height in heights {
            let place = at(DVec3::Y * (height - 1.5));
            spawn_cuboid(&mut world, DVec3::new(10.0, 1.0, 10.0), place, WHITE);
        }
        let view = view([8, 8], DVec3::ZERO, -DVec3::ONE, Projection::Perspective);
        let proof = proof(&mut world, &view);
        assert_eq!(proof.proven, 64, "{:?}", proof.examples);
    }
}

/// A cuboid of 2e14 units, lit and seen from a few units in front of its corner.
pub fn vast_cuboid(projection: Projection, mode: ShadingMode) -> (World, View) {
    const HALF: f64 = 1e14;
    let corner = DVec3::splat(HALF);
    let mut world = empty();
    spawn_cuboid(&mut world, 2.0 * corner, at(DVec3::ZERO), WHITE);
    let [diffuse, specular, eye] = [[-1.0, 2.0, 3.0], [2.0, -2.0, 4.0], [3.0, 4.0, 5.0]]
        .map(|offset| corner + DVec3::from(offset));
    shine(&mut world, LightKind::Diffuse, 150.0, diffuse);
    shine(&mut world, LightKind::Specular, 200.0, specular);
    let view = view([16, 12], eye, corner, projection);
    (world, view.shaded(mode))
}

const SHINY: Material = grey([0.0, 0.0, 1.0], 1.0);

/// A cube of two units with any rotation, and its axes.
fn any_cube(random: &mut Random) -> (World, DMat3) {
    let transform = turned(random.around(180.0));
    let mut world = empty();
    spawn_cuboid(&mut world, DVec3::splat(2.0), transform, SHINY);
    (world, transform.axes())
}

/// The corners of the cube's face z = 1 have n = (±1, ±1, 1) / sqrt(3) and, for a light 2 above its middle, l = (∓1,
/// ∓1, 2) / sqrt(6), so n.l is 0 at all four on paper. The light is reflected to r = -l, which meets the eye from below
/// if the gate is open.
#[test]
fn corners_of_one_face_may_decide_a_tie_independently() {
    let mut random = Random(3);
    let mut covered = 0;
    for _ in 0..40 {
        let (mut world, axes) = any_cube(&mut random);
        let light = axes * (3.0 * DVec3::Z);
        shine(&mut world, LightKind::Specular, 200.0, light);
        let eye = axes * DVec3::new(6.0, 1.0, -4.0);
        let view = view([24, 18], eye, DVec3::ZERO, Projection::Perspective);
        let proof = proof(&mut world, &view.shaded(ShadingMode::Gouraud));
        assert!(proof.examples.is_empty(), "{:?}", proof.examples);
        covered += proof.covered;
    }
    assert!(covered > 1000, "{covered} pixels were covered");
}

/// Three lights are tied at the corner (1, 1, 1), and five in the middle of the face z = 1: more than have a bit. The
/// others lie at three places, which have one each.
#[test]
fn no_combination_of_many_tied_gates_is_refuted() {
    let mut random = Random(5);
    let corner = [[0.0, 0.0, 3.0], [0.0, 3.0, 0.0], [3.0, 0.0, 0.0]];
    let middle = [[3.0, 0.0], [0.0, 3.0], [3.0, 2.0], [2.0, 3.0], [5.0, 1.0]];
    let others = [[3.0, 0.0], [0.0, 3.0], [0.0, 7.0], [3.0, 0.0], [3.0, 0.0]];
    let [middle, others] = [middle, others].map(|places| places.map(|[x, y]| [x, y, 1.0]));
    for (mode, size, places) in [
        (ShadingMode::Gouraud, [24, 18], &corner[..]),
        (ShadingMode::Phong, [1, 1], &middle),
        (ShadingMode::Phong, [1, 1], &others),
    ] {
        for _ in 0..40 {
            let (mut world, axes) = any_cube(&mut random);
            for (levels, place) in [20.0, 30.0, 40.0, 50.0, 60.0].into_iter().zip(places) {
                let place = axes * DVec3::from(*place);
                shine(&mut world, LightKind::Specular, levels, place);
            }
            let eye = axes * DVec3::new(-4.0, -4.0, 6.0);
            let view = view(size, eye, axes * DVec3::Z, Projection::Perspective);
            let proof = proof(&mut world, &view.shaded(mode));
            assert_eq!(proof.refuted, 0, "{mode:?}: {:?}", proof.examples);
        }
    }
}

/// The direction to a light is not enclosed where the light is within rounding of the point that it lights, as docs/limits.md
/// says: of a vertex at (sqrt 2, 0, 1); of the point in the middle; of all points, known to a millionth of a unit.
#[test]
fn a_light_within_rounding_of_a_point_leaves_it_undecided() {
    use LightKind::{Diffuse, Specular};
    use ShadingMode::{Gouraud, Phong};
    let cube = DVec3::splat(2.0);
    let plate = DVec3::new(2e4, 2e6, 2e6);
    let far = DVec3::new(1.3, 866_025.403_784_438_6, 5e5);
    let lit = |size, place, kind, light| {
        let mut world = empty();
        spawn_cuboid(&mut world, size, place, WHITE);
        shine(&mut world, kind, 100.0, light);
        world
    };
    let vertex = DVec3::new(SQRT_2, 0.0, 1.0);
    let at_a_vertex = lit(cube, turned(DVec3::Z * 45.0), Diffuse, vertex);
    let middle = DVec3::new(1e-17, -1e-17, 0.0);
    let in_the_middle = lit(cube, at(DVec3::Y), Specular, middle);
    let place = turned(DVec3::X * 30.0);
    let far_away = lit(plate, place, Diffuse, far + DVec3::Z * 3e-5);
    for (mut world, eye, target, mode, undecided) in [
        (at_a_vertex, [7.0, 5.0, 8.0], DVec3::ZERO, Gouraud, 50..200),
        (in_the_middle, [-6.0, -2.0, -9.9], DVec3::ZERO, Phong, 1..2),
        (far_away, [1e9, 1e10, 1.2e10], far, Phong, 300..400),
    ] {
        let view = view([33, 33], eye.into(), target, Projection::Orthographic);
        let proof = proof(&mut world, &view.shaded(mode).with_tolerance(1e-4));
        let is_right = proof.refuted == 0 && undecided.contains(&proof.undecided);
        assert!(is_right, "{}: {:?}", proof.undecided, proof.examples);
    }
}
