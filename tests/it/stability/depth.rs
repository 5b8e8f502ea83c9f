//! Visibility of intersecting cuboids, as drawings.
//!
//! ```text
//!   . a a b    each letter is the colour of one cuboid, in the order of the file; `.` is the background
//! ```
//! Seen from straight above, one unit per pixel. Every drawing has 12 x 4 pixels.

use glam::DVec3;
use shadetrade::components::{LightKind, Material, Projection, Transform, View};
use shadetrade::frame::{Keep, NO_TRIANGLE};

use crate::support::scene::{at, draw, empty, shine, spawn_cuboid, view};

/// A cuboid: its size, position and rotation.
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

/// The picture in letters. The first cuboid is red, the second green, the third blue.
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
    shine(&mut world, LightKind::Ambient, 100.0, DVec3::ZERO);
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

#[test]
fn the_nearer_cuboid_hides_the_farther_in_any_order() {
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
fn of_intersecting_cuboids_the_nearer_is_visible_at_every_pixel() {
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
fn cuboids_that_touch_each_cover_their_own_pixels() {
    let left = ([4.0, 2.0, 2.0], [-2.0, 0.0, 0.0], UNTURNED);
    let right = ([4.0, 2.0, 2.0], [2.0, 0.0, 0.0], UNTURNED);
    let expected = "............ ..aaaabbbb.. ..aaaabbbb.. ............";
    assert_seen(&[left, right], expected);
    let above = ([2.0, 4.0, 2.0], [0.0, 0.0, 2.0], UNTURNED);
    let expected = ".....cc..... ..aaaccbbb.. ..aaaccbbb.. .....cc.....";
    assert_seen(&[left, right, above], expected);
}

#[test]
fn where_faces_coincide_the_earlier_cuboid_is_visible() {
    let left = ([6.0, 2.0, 2.0], [-2.0, 0.0, 0.0], UNTURNED);
    let right = ([6.0, 2.0, 4.0], [2.0, 0.0, -1.0], UNTURNED);
    let expected = "............ .aaaaaabbbb. .aaaaaabbbb. ............";
    assert_seen(&[left, right], expected);
    let expected = "............ .bbbbaaaaaa. .bbbbaaaaaa. ............";
    assert_seen(&[right, left], expected);
}
