//! The cause of a wrong picture is named where it is proven, and never otherwise.

use shadetrade::components::ShadingMode::{BlinnPhong, Flat, Gouraud, Phong, UnitVectors};
use shadetrade::questions::prove::causes;
use shadetrade::systems::frame::display_pixel;

use super::judged;
use crate::support::prelude::*;

const SIZE: [usize; 2] = [80, 60];

/// The default scene under Phong. Its highlight is from the side, so that Blinn-Phong's is another.
fn scene(change: impl Fn(&mut SceneRecord)) -> Scene {
    changed(|record| {
        record.cuboid[0].shading = Phong;
        record.light[2].position = Some(DVec3::new(-6.0, 6.0, 10.0));
        change(record);
    })
}

fn view(scene: &Scene) -> View {
    View::of(&scene.world, SIZE).with_tolerance(0.5)
}

/// The renderer's bytes of a changed scene.
fn drawn(change: impl Fn(&mut SceneRecord)) -> Vec<u32> {
    let mut scene = scene(change);
    let view = view(&scene);
    let frame = draw(&mut scene.world, &view, Keep::Display);
    frame.pixels().to_vec()
}

/// What is said about a picture of the default scene, which must be wrong.
fn found(picture: &[u32]) -> Vec<String> {
    let mut scene = scene(|_| ());
    let view = view(&scene);
    assert!(judged(&mut scene.world, &view, picture).refuted > 0);
    done(causes(&scene, &view, picture, Monitor::NONE))
}

/// A picture with each channel of its pixels changed.
fn recolored(picture: &[u32], change: impl Fn(u8) -> u8) -> Vec<u32> {
    let channels = |pixel: &u32| u32::from_be_bytes(pixel.to_be_bytes().map(&change));
    let pixels = picture.iter().map(channels);
    pixels.map(|pixel| pixel & 0x00ff_ffff).collect()
}

#[test]
fn a_change_that_makes_every_pixel_right_is_the_cause() {
    let right = drawn(|_| ());
    let mut from_below = right.clone();
    from_below.reverse();
    from_below.chunks_mut(SIZE[0]).for_each(<[u32]>::reverse);
    let mut mirrored = right.clone();
    mirrored.chunks_mut(SIZE[0]).for_each(<[u32]>::reverse);
    let swap = |pixel: &u32| {
        let [_, red, green, blue] = pixel.to_be_bytes();
        u32::from_be_bytes([0, blue, green, red])
    };
    let blue_first = right.iter().map(swap).collect();
    let default = scene(|_| ());
    let by_reference = |mode| {
        let truth = truth(&default.world, &view(&default).shaded(mode));
        truth.levels.into_iter().map(display_pixel).collect()
    };
    let shaded = |mode| drawn(|it| it.cuboid[0].shading = mode);
    for (picture, words) in [
        (from_below, "once its rows are"),
        (mirrored, "once its columns are"),
        (blue_first, "once red and blue are"),
        (shaded(Flat), "picture of flat"),
        (shaded(Gouraud), "picture of gouraud"),
        (by_reference(UnitVectors), "picture of phong-unit-vectors"),
        (by_reference(BlinnPhong), "picture of blinn-phong"),
        (
            drawn(|it| it.cuboid[0].normals = NormalMode::Face),
            "with face normals",
        ),
        (drawn(|it| it.light[2].on = false), "without light specular"),
    ] {
        let found = found(&picture);
        let is_right = found.len() == 1 && found[0].contains(words);
        assert!(is_right, "{words}: {found:?}");
    }
}

#[test]
fn a_picture_with_another_fault_has_no_cause() {
    let right = drawn(|_| ());
    let mut moved = right.clone();
    moved.rotate_right(1);
    let mut one = right.clone();
    one[SIZE[0] * SIZE[1] / 2 + SIZE[0] / 2] ^= 0x40;
    // Gouraud, but one pixel is not.
    let mut nearly = drawn(|it| it.cuboid[0].shading = Gouraud);
    nearly[SIZE[0] * SIZE[1] / 2 + SIZE[0] / 2] ^= 0x40;
    let gamma = |byte: u8| (255.0 * (f64::from(byte) / 255.0).powf(1.0 / 2.2)).round() as u8;
    for (name, picture) in [
        ("moved", moved),
        ("one pixel", one),
        ("nearly", nearly),
        ("gamma", recolored(&right, gamma)),
        ("brighter", recolored(&right, |byte| byte.saturating_add(3))),
        ("coarse", recolored(&right, |byte| byte & 0xf0)),
        ("black", vec![0; right.len()]),
        ("dim", drawn(|it| it.light[0].intensity *= 0.9)),
        ("small", drawn(|it| it.cuboid[0].size *= 0.9)),
        ("dull", drawn(|it| it.cuboid[0].material.shininess /= 2.0)),
    ] {
        let found = found(&picture);
        assert!(found.is_empty(), "{name}: {found:?}");
    }
}
