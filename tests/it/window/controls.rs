//! The changes that keys make in a World, and the messages at their limits.

use std::time::Duration;

use shadetrade::components::ShadingMode::{Gouraud, Phong, UnitVectors};
use shadetrade::scene;
use shadetrade::window::controls::{
    Rotation, has_face_normals, set_budget, set_tolerance, show, switch_normals, wipe,
};
use shadetrade::window::keys::EXACT_SIDES;

use super::changed;
use crate::support::prelude::*;
use crate::support::window::{default_scene, first_scene};

#[test]
fn sides_of_a_wipe_follow_the_tolerance_that_they_had() {
    let mut world = default_scene().world;
    let side = |mode, tolerance| Side::Method {
        mode,
        segments: None,
        tolerance,
    };
    for (before, sides, after) in [
        (0.5, [side(Phong, 0.5), side(Phong, 1.0)], [2.0, 1.0]),
        (0.0, [side(UnitVectors, 0.0), side(Phong, 0.0)], [0.0, 2.0]),
    ] {
        set_tolerance(&mut world, before);
        wipe(&mut world, sides);
        set_tolerance(&mut world, 2.0);
        let found = viewer(&world).sides.map(|side| match side {
            Side::Method { tolerance, .. } => tolerance,
            _ => f64::NAN,
        });
        assert_eq!(found, after);
    }
    wipe(&mut world, EXACT_SIDES);
    show(&mut world, ViewMode::Wipe);
    assert_eq!(viewer(&world).sides, Side::gouraud_phong(2.0));
}

#[test]
fn the_error_map_of_a_wipe_is_that_of_its_left_side() {
    let mut world = default_scene().world;
    show(&mut world, ViewMode::Error);
    assert_eq!(common(&world), Some(Gouraud), "the picture's own");
    let phong = Side::from(Method::of(Phong, 4.0));
    wipe(&mut world, [phong, Side::Picture]);
    show(&mut world, ViewMode::Error);
    assert_eq!(viewer(&world).show, ViewMode::Error);
    assert_eq!(common(&world), Some(Phong));
    assert_eq!(viewer(&world).tolerance, 4.0);
    // No cuboid is shaded by the reference.
    wipe(&mut world, [Side::Reference, Side::Picture]);
    show(&mut world, ViewMode::Error);
    assert_eq!(common(&world), Some(Phong));
}

#[test]
fn normals_of_two_kinds_become_face_normals() {
    let other = records::cuboid("other", [1.0; 3], [3.0, 0.0, 0.0]);
    let mut world = changed(|record| {
        record.cuboid[0].normals = NormalMode::Face;
        record.cuboid.push(other);
    })
    .world;
    for is_face in [true, false] {
        assert_eq!(has_face_normals(&world), !is_face);
        switch_normals(&mut world);
        assert_eq!(common(&world) == Some(NormalMode::Face), is_face);
    }
}

#[test]
fn cuboids_turn_by_the_clock_from_where_they_stopped() {
    let mut world = default_scene().world;
    let mut rotation = Rotation::default();
    let after = |degrees: u32| Duration::from_millis(30) * degrees;
    for (start, degrees, turned) in [(0, 400, 40), (1000, 1, 41)] {
        rotation.switch(&mut world, after(start));
        rotation.go_on(&mut world, after(start + degrees));
        assert_eq!(viewer(&world).turned, turned);
        rotation.switch(&mut world, after(start + degrees));
    }
}

#[test]
fn a_budget_and_a_wipe_between_two_methods_exclude_each_other() {
    let mut world = first_scene().world;
    assert_eq!(viewer(&world).show, ViewMode::Wipe);
    set_budget(&mut world, Some(1.0));
    assert_eq!(viewer(&world).show, ViewMode::Picture);
    show(&mut world, ViewMode::Wipe);
    assert_eq!(viewer(&world).budget, None);
}

#[test]
fn a_budget_is_within_its_range() {
    let mut world = default_scene().world;
    viewer_mut(&mut world).tolerance = 4.0;
    for wish in [0.0, 1e9] {
        set_budget(&mut world, Some(wish));
        let text = scene::updated("", &SceneRecord::of(&world));
        Scene::parse("saved", &text).unwrap_or_else(|error| panic!("{error}"));
    }
    set_budget(&mut world, Some(0.1234));
    assert_eq!(viewer(&world).budget, Some(0.12));
    assert_eq!(viewer(&world).tolerance, 0.5, "the usual one");
    set_budget(&mut world, None);
    assert_eq!(viewer(&world).budget, None);
}
