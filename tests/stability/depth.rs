//! Which of two cuboids is seen, drawn so that it can be seen.
//!
//! ```text
//!   . a a b    each letter is the colour of one cuboid, in the order of the file; `.` is the background
//! ```
//! Seen straight from above, a unit a pixel; every drawing is 12 x 4.

use glam::DVec3;
use shadetrade::components::{LightKind, Material, Projection, Transform, View};
use shadetrade::frame::{Keep, NO_TRIANGLE};

use crate::scene::{at, draw, empty, spawn_cuboid, spawn_light, view};

/// A cuboid: its size, its place, its rotation.
type Body = ([f64; 3], [f64; 3], [f64; 3]);

const UNTURNED: [f64; 3] = [0.0; 3];

fn from_above() -> View {
    let mut view = view(
        [12, 4],
        DVec3::Z * 20.0,
        DVec3::ZERO,
        Projection::Orthographic,
    );
    view.viewpoint.camera.height = 4.0;
    view
}

/// The picture in letters: the first cuboid is red, the second green, the third blue.
fn drawing(bodies: &[Body], view: &View) -> String {
    let mut world = empty();
    for (index, &(size, place, rotation)) in bodies.iter().enumerate() {
        let transform = Transform {
            rotation: rotation.into(),
            ..at(place.into())
        };
        let mut material = Material {
            ambient: DVec3::ZERO,
            diffuse: DVec3::ZERO,
            specular: DVec3::ZERO,
            shininess: 1.0,
        };
        material.ambient[index] = 1.0;
        spawn_cuboid(&mut world, size.into(), transform, material);
    }
    spawn_light(
        &mut world,
        LightKind::Ambient,
        DVec3::splat(100.0),
        DVec3::ZERO,
    );
    let frame = draw(&mut world, view, Keep::Levels);
    let letters = frame
        .levels()
        .iter()
        .zip(frame.triangles())
        .map(|(levels, &id)| {
            let cuboid = levels.iter().position(|level| (level - 100.0).abs() < 1e-3);
            let expected = (id != NO_TRIANGLE).then_some(id as usize / 12);
            assert_eq!(cuboid, expected, "the colour is the cuboid's: {levels:?}");
            cuboid.map_or('.', |cuboid| ['a', 'b', 'c'][cuboid])
        });
    let letters: Vec<char> = letters.collect();
    let rows = letters.chunks(view.size[0]).map(String::from_iter);
    rows.collect::<Vec<_>>().join("\n")
}

#[track_caller]
fn assert_seen(bodies: &[Body], expected: &str) {
    let found = drawing(bodies, &from_above());
    let expected = expected.split_whitespace().collect::<Vec<_>>().join("\n");
    assert!(found == expected, "seen\n{found}\n\nnot\n{expected}");
}

/// Asserts that in every pixel where anything is seen it is that cuboid, and that it is seen.
#[track_caller]
fn assert_only(letter: char, bodies: &[Body], view: &View) {
    let found = drawing(bodies, view);
    assert!(found.contains(letter), "nothing is seen of {bodies:?}");
    let others = found.replace([letter, '.', '\n'], "");
    assert!(others.is_empty(), "{found}\n{bodies:?}");
}

#[test]
fn the_nearer_cuboid_hides_the_farther_in_whatever_order_they_come() {
    let low = ([6.0, 4.0, 2.0], [-2.0, 0.0, 0.0], UNTURNED);
    let high = ([6.0, 2.0, 2.0], [2.0, 0.0, 3.0], UNTURNED);
    assert_seen(
        &[low, high],
        ".aaaaaa..... .aaaabbbbbb. .aaaabbbbbb. .aaaaaa.....",
    );
    assert_seen(
        &[high, low],
        ".bbbbbb..... .bbbbaaaaaa. .bbbbaaaaaa. .bbbbbb.....",
    );
}

#[test]
fn of_cuboids_that_cross_each_other_the_nearer_is_seen_at_every_pixel() {
    // Two plates at right angles, like the letter X seen from above; 8 cos 45 degrees are 5.7 pixels.
    let falling = ([8.0, 4.0, 0.1], [0.0; 3], [0.0, 45.0, 0.0]);
    let rising = ([8.0, 4.0, 0.1], [0.0; 3], [0.0, -45.0, 0.0]);
    let expected = "...aaabbb... ...aaabbb... ...aaabbb... ...aaabbb...";
    assert_seen(&[falling, rising], expected);
    // A bar through a block comes out on its other side.
    let block = ([4.0, 2.0, 4.0], [0.0; 3], UNTURNED);
    let bar = ([10.0, 1.0, 1.0], [0.0, -0.5, 0.0], UNTURNED);
    let expected = "............ ....aaaa.... .bbbaaaabbb. ............";
    assert_seen(&[block, bar], expected);
}

#[test]
fn of_cuboids_that_touch_each_has_its_own_pixels() {
    let left = ([4.0, 2.0, 2.0], [-2.0, 0.0, 0.0], UNTURNED);
    let right = ([4.0, 2.0, 2.0], [2.0, 0.0, 0.0], UNTURNED);
    let expected = "............ ..aaaabbbb.. ..aaaabbbb.. ............";
    assert_seen(&[left, right], expected);
    let above = ([2.0, 4.0, 2.0], [0.0, 0.0, 2.0], UNTURNED);
    let expected = ".....cc..... ..aaaccbbb.. ..aaaccbbb.. .....cc.....";
    assert_seen(&[left, right, above], expected);
}

#[test]
fn where_faces_coincide_the_earlier_cuboid_is_seen() {
    let left = ([6.0, 2.0, 2.0], [-2.0, 0.0, 0.0], UNTURNED);
    let right = ([6.0, 2.0, 4.0], [2.0, 0.0, -1.0], UNTURNED);
    let expected = "............ .aaaaaabbbb. .aaaaaabbbb. ............";
    assert_seen(&[left, right], expected);
    let expected = "............ .bbbbaaaaaa. .bbbbaaaaaa. ............";
    assert_seen(&[right, left], expected);
}

#[test]
fn of_cuboids_that_coincide_the_first_is_seen_however_they_are_written() {
    for projection in [Projection::Perspective, Projection::Orthographic] {
        for place in [0.0, 1e3, -1e6] {
            let offset = DVec3::splat(place);
            let view = view(
                [80, 60],
                offset + DVec3::new(5.0, 4.0, 9.0),
                offset,
                projection,
            );
            let place = [place; 3];
            // The same cuboid three times: as it is, given a full turn, and with its sides exchanged.
            let bodies = [
                ([2.0, 1.0, 3.0], place, [0.0, 0.0, 30.0]),
                ([2.0, 1.0, 3.0], place, [360.0, -720.0, 390.0]),
                ([1.0, 2.0, 3.0], place, [0.0, 0.0, 120.0]),
            ];
            let [a, b, c] = bodies;
            for order in [[a, b, c], [c, a, b], [b, c, a], [c, b, a]] {
                assert_only('a', &order, &view);
            }
        }
    }
}

#[test]
fn a_thousandth_of_a_unit_apart_the_nearer_is_seen_from_any_distance() {
    for projection in [Projection::Perspective, Projection::Orthographic] {
        for distance in [10.0, 1e2, 1e3, 1e4, 1e5] {
            let mut view = view([40, 30], DVec3::Z * distance, DVec3::ZERO, projection);
            view.viewpoint.camera.fov = 2.0 * (3.0 / distance).atan().to_degrees();
            let plate = |depth: f64| ([4.0, 3.0, 0.5], [0.0, 0.0, -depth], [0.0, 0.0, 20.0]);
            assert_only('b', &[plate(1e-3), plate(0.0)], &view);
        }
    }
}

#[test]
fn nothing_shows_through_a_sheet_from_ten_units_behind_it() {
    // Bars 100 units long, seen end-on but for some ten-thousandths of a degree: a pixel of their sides may be any
    // depth away.
    let sheet = ([9.0, 9.0, 0.1], [0.0; 3], UNTURNED);
    for projection in [Projection::Perspective, Projection::Orthographic] {
        let view = view([64, 48], DVec3::Z * 30.0, DVec3::ZERO, projection);
        for step in 0..100 {
            let step = f64::from(step);
            let place = [-0.5 - 1e-5 * step, 0.56 + 0.002 * step, -60.0];
            let bar = (
                [1.0, 1.0, 100.0],
                place,
                [-1.2e-6 * step, 0.7e-6 * step, 0.0],
            );
            assert_only('b', &[bar, sheet], &view);
        }
    }
}
