//! The least scene: the parts left out together, and the tolerance that the remaining scene keeps.

use glam::DVec3;
use shadetrade::components::{LightKind, Projection, View};
use shadetrade::report::Monitor;
use shadetrade::requires::{self, Part, changes, without};

use super::{WHITE, scene_of};
use crate::support::scene::{at, empty, shine, spawn_cuboid, view};

/// A cuboid under ambient lights of these levels, and another cuboid behind it.
fn least(levels: &[f64], candidates: &[Part]) -> Vec<Part> {
    let mut world = empty();
    for place in [DVec3::ZERO, DVec3::Z * -4.0] {
        spawn_cuboid(&mut world, DVec3::splat(2.0), at(place), WHITE);
    }
    for levels in levels {
        shine(&mut world, LightKind::Ambient, *levels, DVec3::ZERO);
    }
    let view = View {
        tolerance: 0.5,
        background: DVec3::splat(20.0),
        ..view(
            [24, 18],
            DVec3::Z * 8.0,
            DVec3::ZERO,
            Projection::Perspective,
        )
    };
    let scene = scene_of(world, &view);
    let found = requires::least::least(&scene, &view, candidates, Monitor::NONE);
    let (left_out, change) = found.expect("nobody cancels it");
    assert!(change.keeps(0.5), "{change:?}");
    // The remaining parts are those of the full scene minus those left out.
    let remains = without(&scene, &left_out);
    let change = |scene, left_out| {
        let changes = changes(scene, &view, &[left_out], Monitor::NONE);
        changes.expect("nobody cancels it")[0]
    };
    assert!(change(&scene, left_out.clone()).keeps(0.5));
    assert!(change(&remains, vec![]).keeps(0.0));
    left_out
}

#[test]
fn of_two_lights_that_matter_only_together_one_stays() {
    let lights = [Part::Light(1), Part::Light(2)];
    assert_eq!(least(&[100.0, 0.3, 0.4], &lights), [Part::Light(1)]);
    assert_eq!(least(&[100.0, 0.2, 0.2], &lights), lights);
    assert_eq!(least(&[100.0, 0.6, 0.7], &lights), []);
}

#[test]
fn as_many_lights_are_left_out_as_the_tolerance_allows() {
    let lights: Vec<Part> = (1..8).map(Part::Light).collect();
    assert_eq!(
        least(&[100.0, 0.12, 0.12, 0.12, 0.12, 0.12, 0.12, 0.12], &lights).len(),
        4
    );
}

#[test]
fn a_hidden_cuboid_is_left_out() {
    let cuboids = [Part::Cuboid(1)];
    assert_eq!(least(&[100.0], &cuboids), cuboids);
}

#[test]
fn one_cuboid_stays_even_if_it_is_invisible() {
    // Nearly the colour of the background.
    let cuboids = [Part::Cuboid(0), Part::Cuboid(1)];
    assert_eq!(least(&[20.3], &cuboids).len(), 1);
}
