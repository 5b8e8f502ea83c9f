//! The camera about its target.

use glam::{DVec3, dvec3};
use proptest::prelude::*;
use shadetrade::components::{Camera, Orbit, Viewpoint};
use shadetrade::scene::Scene;
use shadetrade::window::bindings::Action;
use shadetrade::window::orbit::Limits;

use super::{SIZE, default_session, mixed_session};

fn camera_at(position: DVec3) -> Viewpoint {
    Viewpoint {
        position,
        camera: Camera {
            target: DVec3::ZERO,
            up: DVec3::Y,
            fov: 30.0,
            height: 6.0,
            near: None,
        },
    }
}

fn viewpoints() -> impl Strategy<Value = Viewpoint> {
    let point = || (-50.0..50.0, -50.0..50.0, -50.0..50.0).prop_map(|(x, y, z)| dvec3(x, y, z));
    let camera = (
        point(),
        point(),
        point(),
        proptest::option::of(0.001..1.0_f64),
    );
    camera.prop_filter_map("view parallel to up", |(position, target, up, near)| {
        let view = (target - position).try_normalize()?;
        (view.cross(up.try_normalize()?).length() > 1e-3).then_some(Viewpoint {
            position,
            camera: Camera {
                target,
                up,
                fov: 40.0,
                height: 5.0,
                near,
            },
        })
    })
}

#[test]
fn known_places() {
    let from = camera_at(dvec3(0.0, 0.0, 10.0));
    let turned = |azimuth, elevation| {
        from.orbited(&Orbit::default().moved(&from, azimuth, elevation))
            .position
    };
    assert!(
        turned(90.0, 0.0).abs_diff_eq(dvec3(10.0, 0.0, 0.0), 1e-12),
        "to the right"
    );
    assert!(
        turned(-90.0, 0.0).abs_diff_eq(dvec3(-10.0, 0.0, 0.0), 1e-12),
        "to the left"
    );
    assert!(
        turned(0.0, 30.0).abs_diff_eq(dvec3(0.0, 5.0, 75.0_f64.sqrt()), 1e-12),
        "up"
    );
    let closer = from.orbited(&Orbit {
        zoom: 1,
        ..Orbit::default()
    });
    assert!(
        closer
            .position
            .abs_diff_eq(dvec3(0.0, 0.0, 10.0 / 1.1), 1e-12)
    );
    assert!((closer.camera.height - 6.0 / 1.1).abs() < 1e-12);
    assert!(
        (closer.near() - 0.01 / 1.1).abs() < 1e-12,
        "the near plane follows the distance"
    );
}

#[test]
fn a_full_round_in_steps_ends_at_the_same_bits() {
    let mut session = mixed_session();
    for _ in 0..180 {
        session.apply(Action::Orbit {
            azimuth: 2.0,
            elevation: 0.0,
        });
    }
    assert_eq!(session.view(SIZE).viewpoint, session.scene.camera(0).0);
}

#[test]
fn the_poles_are_never_reached() {
    let from = camera_at(dvec3(0.0, 0.0, 10.0));
    for (step, sign) in [(2.0, 1.0), (-2.0, -1.0)] {
        let orbit = (0..100).fold(Orbit::default(), |orbit, _| orbit.moved(&from, 0.0, step));
        assert_eq!(orbit.elevation, 89.0 * sign);
        // What went too far is not stored up: one step back is one step back.
        assert_eq!(orbit.moved(&from, 0.0, -step).elevation, 87.0 * sign);
    }
}

#[test]
fn zooming_in_stops_outside_of_the_cuboid_and_its_near_plane() {
    let mut session = default_session();
    session.apply(Action::Zoom(1000));
    let seen = session.view(SIZE).viewpoint;
    // The farthest corner of the 4 x 3 x 2 cuboid is sqrt(2^2 + 1.5^2 + 1^2) = 2.6926 from its centre.
    let distance = seen.position.length();
    assert!(
        distance - seen.near() >= 2.6925 && distance < 2.6926 * 1.2,
        "{distance}"
    );
    session.apply(Action::Zoom(-1000));
    let distance = session.view(SIZE).viewpoint.position.length();
    let size = 2.0 * 2.6926;
    assert!(
        distance <= 30.0 * size && distance > 27.0 * size,
        "{distance}"
    );
}

#[test]
fn a_camera_outside_of_the_limits_may_only_come_back() {
    let scene = Scene::load(None).expect("the built-in scene is valid");
    let near = Viewpoint {
        camera: Camera {
            near: Some(1.0),
            ..camera_at(DVec3::ZERO).camera
        },
        ..camera_at(dvec3(0.0, 0.0, 1.0))
    };
    let limits = Limits::of(&scene, &near);
    assert_eq!(Orbit::default().zoomed(5, &limits).zoom, 0);
    assert_eq!(Orbit::default().zoomed(-5, &limits).zoom, -5);
    let far = camera_at(dvec3(0.0, 0.0, 1e9));
    let limits = Limits::of(&scene, &far);
    assert_eq!(Orbit::default().zoomed(-5, &limits).zoom, 0);
    let closer = Orbit::default().zoomed(5, &limits);
    assert_eq!(closer.zoom, 5);
    assert_eq!(closer.zoomed(-7, &limits).zoom, 0, "back, but no further");
}

proptest! {
    #[test]
    fn no_orbit_is_the_scene_bit_for_bit(from in viewpoints()) {
        prop_assert_eq!(from.orbited(&Orbit::default()), from);
    }

    #[test]
    fn as_many_steps_back_undo_any_zoom(from in viewpoints(), steps in -40_i32..40) {
        let scene = Scene::load(None).expect("the built-in scene is valid");
        let limits = Limits::of(&scene, &from);
        let there = Orbit::default().zoomed(steps, &limits);
        let back = there.zoomed(-there.zoom, &limits);
        prop_assert_eq!(from.orbited(&back), from);
    }

    #[test]
    fn every_orbit_looks_at_the_target_from_its_distance_short_of_the_poles(
        from in viewpoints(),
        moves in proptest::collection::vec((-200.0..200.0_f64, -200.0..200.0_f64), 1..5),
        zoom in -20_i32..20,
    ) {
        let start = Orbit { zoom, ..Orbit::default() };
        let orbit = moves.iter().fold(start, |orbit, (azimuth, elevation)| orbit.moved(&from, *azimuth, *elevation));
        prop_assert!(orbit.azimuth.abs() <= 180.0);
        let seen = from.orbited(&orbit);
        let offset = |it: &Viewpoint| it.position - it.camera.target;
        let distance = offset(&from).length() * orbit.factor();
        prop_assert!((offset(&seen).length() / distance - 1.0).abs() < 1e-9);
        prop_assert_eq!(seen.camera.target, from.camera.target);
        prop_assert_eq!(seen.camera.up, from.camera.up);
        prop_assert_eq!(seen.camera.near, from.camera.near);
        let sine = |it: &Viewpoint| offset(it).normalize().dot(it.camera.up.normalize()).abs();
        let limit = sine(&from).max(89.0_f64.to_radians().sin());
        prop_assert!(sine(&seen) <= limit + 1e-9);
        let [right, up, forward] = seen.axes();
        for (product, expected) in [(right.dot(up), 0.0), (up.dot(forward), 0.0), (right.length(), 1.0), (up.length(), 1.0)] {
            prop_assert!((product - expected).abs() < 1e-9);
        }
    }
}
