//! The view of the viewer, cameras and their orbits, and the lens of a frame.

use glam::{DVec3, dvec3};
use hecs::World;
use shadetrade::components::{
    Background, Camera, Lens, Orbit, Projection, ShadingMode, View, Viewer, active_camera, names,
    overwrite,
};
use shadetrade::scene::{Scene, SceneRecord};
use shadetrade::systems::viewpoint;

use super::{PROJECTIONS, ahead, empty_frame};
use crate::support::records;

fn run(view: &View) -> Lens {
    let mut frame = empty_frame();
    viewpoint::run(&mut World::new(), view, &mut frame);
    frame.lens
}

/// Two cameras at a distance of ten from a cube: one in front of it, one to the right of it.
fn cameras() -> Scene {
    let sees = [90.0, 20.0];
    let record = SceneRecord {
        cuboid: vec![records::cuboid("cube", DVec3::ONE, DVec3::ZERO)],
        camera: vec![
            records::camera("front", DVec3::Z * 10.0, DVec3::ZERO, sees),
            records::camera("right", DVec3::X * 10.0, DVec3::ZERO, sees),
        ],
        ..SceneRecord::default()
    };
    Scene::spawn("cameras".to_owned(), &record)
}

/// The lens of the active camera with this orbit.
fn moved(scene: &Scene, orbit: Orbit) -> Lens {
    let camera = scene.world.get::<&mut Orbit>(active_camera(&scene.world));
    *camera.expect("a camera has one") = orbit;
    run(&View::of(&scene.world, [300, 200]))
}

fn seen_from(scene: &Scene) -> DVec3 {
    View::of(&scene.world, [3, 2]).camera.position
}

#[test]
fn a_lens_has_the_axes_of_the_camera_and_the_size_of_a_pixel() {
    // 90 degrees are two units at distance one; 20 units are 20 units.
    for (projection, seen) in PROJECTIONS.into_iter().zip([2.0, 20.0]) {
        for rows in [1, 200, 16384] {
            let lens = run(&ahead(projection, [300, rows]));
            assert_eq!(lens.axes, [DVec3::X, DVec3::Y, DVec3::NEG_Z]);
            assert_eq!((lens.eye, lens.near), (DVec3::Z * 10.0, 1.0));
            assert_eq!(lens.half, [150.0, rows as f64 / 2.0]);
            assert_eq!(lens.projection, projection);
            let error = lens.pitch * rows as f64 - seen;
            assert!(error.abs() < 1e-14, "{projection:?}, {rows} rows: {error}");
        }
    }
}

#[test]
fn an_orbit_moves_the_active_camera_around_its_target() {
    let mut scene = cameras();
    let here = moved(&scene, Orbit::default());
    assert_eq!(here.eye, DVec3::Z * 10.0);
    let quarter = Orbit {
        azimuth: 90.0,
        ..Orbit::default()
    };
    let lens = moved(&scene, quarter);
    let expected = [DVec3::X * 10.0, DVec3::NEG_Z, DVec3::Y, DVec3::NEG_X];
    let [x, y, z] = lens.axes;
    for (found, expected) in [lens.eye, x, y, z].into_iter().zip(expected) {
        assert!(found.abs_diff_eq(expected, 1e-14), "{found} {expected}");
    }
    let mut nearer = Orbit {
        zoom: 1.0 / 1.21,
        ..Orbit::default()
    };
    let expected = dvec3(0.0, 0.0, 10.0 / 1.21);
    assert!(moved(&scene, nearer).eye.abs_diff_eq(expected, 1e-14));
    // A degree is left to the pole.
    nearer.elevation = 170.0;
    let height = moved(&scene, nearer).eye.y;
    assert!((height - expected.z * 89_f64.to_radians().sin()).abs() < 1e-14);
    let seen = View::of(&scene.world, [3, 2]).camera.height;
    assert_eq!(seen, 20.0 * nearer.zoom);
    // The other camera keeps its own orbit.
    scene.look_from("right").expect("it is there");
    assert_eq!(seen_from(&scene), DVec3::X * 10.0);
    scene.look_from("left").expect_err("there is none");
    scene.look_from("front").expect("it is there");
    assert_eq!(moved(&scene, Orbit::default()), here, "and back");
}

#[test]
fn without_its_active_camera_a_scene_uses_the_first() {
    let mut scene = cameras();
    scene.look_from("right").expect("it is there");
    let active = active_camera(&scene.world);
    scene.world.despawn(active).expect("it is there");
    assert_eq!(names::<Camera>(&scene.world), ["front"]);
    assert_eq!(seen_from(&scene), DVec3::Z * 10.0);
}

#[test]
fn a_view_has_the_settings_of_the_viewer_and_its_mode_overrides_that_of_every_cuboid() {
    let mut scene = cameras();
    let world = &mut scene.world;
    let viewer = Viewer {
        projection: Projection::Orthographic,
        tolerance: 0.25,
        turned: 7,
        turns: true,
        ..Viewer::default()
    };
    overwrite(world, &viewer);
    overwrite(world, &Background(DVec3::ONE));
    let view = View::of(world, [30, 20]);
    assert_eq!(
        (view.size, view.projection),
        ([30, 20], Projection::Orthographic)
    );
    assert_eq!((view.tolerance, view.turned), (0.25, 7));
    assert_eq!((view.background, view.shading), (DVec3::ONE, None));
    for own in [ShadingMode::Gouraud, ShadingMode::Phong] {
        assert_eq!(view.mode(own), own);
        for mode in [ShadingMode::Gouraud, ShadingMode::UnitVectors] {
            assert_eq!(view.shaded(mode).mode(own), mode);
        }
    }
}

/// At a distance of ten from a cube of size one: the nearest zoom is at its corner, the farthest at thirty times its
/// size.
#[test]
fn steps_of_zoom_are_tenths_with_limits_and_are_undone_exactly() {
    let limits = Orbit::limits(&cameras().world);
    let own = Orbit::default();
    assert!((own.zoomed(2, &limits).zoom - 1.0 / 1.21).abs() < 1e-15);
    assert!((own.zoomed(-3, &limits).zoom - 1.331).abs() < 1e-15);
    for steps in [-7, -1, 0, 1, 2, 19, 23] {
        let back = own.zoomed(steps, &limits).zoomed(-steps, &limits);
        assert_eq!(back, own, "{steps} steps");
    }
    let root = 3.0_f64.sqrt();
    let ends = [1000, -1000].map(|steps| own.zoomed(steps, &limits).zoom * 10.0);
    let closest = root / 2.0 * 1.001_002;
    assert!((closest..closest * 1.1).contains(&ends[0]), "{ends:?}");
    // The height at twice the distance is the limit.
    let farthest = 15.0 * root;
    assert!((farthest / 1.1..=farthest).contains(&ends[1]), "{ends:?}");
    // A file may place a camera beyond the limits of the keys.
    let outside = Orbit { zoom: 50.0, ..own };
    assert!(outside.zoomed(1, &limits).zoom < 50.0);
    assert_eq!(outside.zoomed(-1, &limits).zoom, 50.0);
}
