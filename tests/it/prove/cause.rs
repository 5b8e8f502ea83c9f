//! The cause of a wrong picture is named where it is proven, and never otherwise.

use fearless_simd::Level;
use glam::DVec3;
use shadetrade::components::{NormalMode, ShadingMode, View};
use shadetrade::output::{Monitor, finished};
use shadetrade::questions::prove::{causes, prove};
use shadetrade::questions::requires::{Part, picture_without};
use shadetrade::reference::Rule;
use shadetrade::scene::{Scene, SceneRecord};
use shadetrade::systems::frame::{Keep, display_pixel};

use crate::support::scene::{draw, truth};

const SIZE: [usize; 2] = [120, 90];

/// The default scene under Phong. Its highlight is from the side, so that Blinn-Phong's is another.
fn scene(change: impl Fn(&mut SceneRecord)) -> Scene {
    let mut record = SceneRecord::of(&Scene::load(None).expect("it is built in").world);
    record.cuboid[0].shading = ShadingMode::Phong;
    record.light[2].position = Some(DVec3::new(-6.0, 6.0, 10.0));
    change(&mut record);
    Scene::spawn("changed".to_owned(), &record)
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
    let (view, level) = (view(&scene), Level::new());
    let proof = prove(&mut scene.world, &view, Some(picture), level, Monitor::NONE);
    assert!(finished(proof).expect("it fits").refuted > 0);
    finished(causes(&scene, &view, picture, Monitor::NONE)).expect("nobody cancels it")
}

/// A picture with each channel of its pixels changed.
fn changed(picture: &[u32], change: impl Fn(u8) -> u8) -> Vec<u32> {
    let channels = |pixel: &u32| u32::from_be_bytes(pixel.to_be_bytes().map(&change));
    picture
        .iter()
        .map(channels)
        .map(|pixel| pixel & 0x00ff_ffff)
        .collect()
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
    let both = from_below.iter().map(swap).collect();
    let default = scene(|_| ());
    let by_reference = |mode| {
        let truth = truth(&default.world, &view(&default).shaded(mode));
        truth.levels.into_iter().map(display_pixel).collect()
    };
    let without = |rule| {
        let scene = scene(|_| ());
        let view = view(&scene);
        let picture = picture_without(&scene, &view, Part::Rule(rule), Monitor::NONE);
        finished(picture).expect("nobody cancels it")
    };
    for (picture, words) in [
        (from_below, "once its rows are"),
        (mirrored, "once its columns are"),
        (blue_first, "once red and blue are"),
        (both, "once its rows and red and blue are"),
        (
            drawn(|it| it.cuboid[0].shading = ShadingMode::Flat),
            "picture of flat",
        ),
        (
            drawn(|it| it.cuboid[0].shading = ShadingMode::Gouraud),
            "picture of gouraud",
        ),
        (
            by_reference(ShadingMode::UnitVectors),
            "picture of phong-unit-vectors",
        ),
        (
            by_reference(ShadingMode::BlinnPhong),
            "picture of blinn-phong",
        ),
        (
            drawn(|it| it.cuboid[0].normals = NormalMode::Face),
            "with face normals",
        ),
        (drawn(|it| it.light[2].on = false), "without light specular"),
        (without(Rule::DiffuseClamp), "without diffuse clamp"),
        (without(Rule::UnitNormal), "without unit normal"),
        (
            without(Rule::PerspectiveCorrect),
            "without perspective-correct interpolation",
        ),
    ] {
        let found = found(&picture);
        assert!(
            found.len() == 1 && found[0].contains(words),
            "{words}: {found:?}"
        );
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
    let mut nearly = drawn(|it| it.cuboid[0].shading = ShadingMode::Gouraud);
    nearly[SIZE[0] * SIZE[1] / 2 + SIZE[0] / 2] ^= 0x40;
    let gamma = |byte: u8| (255.0 * (f64::from(byte) / 255.0).powf(1.0 / 2.2)).round() as u8;
    for (name, picture) in [
        ("moved", moved),
        ("one pixel", one),
        ("nearly", nearly),
        ("gamma", changed(&right, gamma)),
        ("brighter", changed(&right, |byte| byte.saturating_add(3))),
        ("coarse", changed(&right, |byte| byte & 0xf0)),
        ("black", vec![0; right.len()]),
        ("dim", drawn(|it| it.light[0].intensity *= 0.9)),
        ("small", drawn(|it| it.cuboid[0].size *= 0.9)),
        ("dull", drawn(|it| it.cuboid[0].material.shininess /= 2.0)),
    ] {
        let found = found(&picture);
        assert!(found.is_empty(), "{name}: {found:?}");
    }
}
