//! Viewpoint: the view of the viewer, cameras and their orbits, and the lens of a frame.

use glam::{DVec3, dvec3};
use hecs::World;
use shadetrade::components::{
    Background, Camera, Lens, Limits, Orbit, Projection, ShadingMode, Spin, Tolerance, View,
    active_camera, names, overwrite,
};
use shadetrade::scene::Scene;
use shadetrade::systems::viewpoint;

use super::{PROJECTIONS, ahead, empty_frame};

fn run(view: &View) -> Lens {
    let mut frame = empty_frame();
    viewpoint::run(&mut World::new(), view, &mut frame);
    frame.lens
}

/// Two cameras at a distance of ten from the origin: one in front of it, one to the right of it.
const CAMERAS: &str = r#"
[[cuboid]]
name = "cube"
size = [1.0, 1.0, 1.0]
[cuboid.material]
ambient = [1.0, 1.0, 1.0]
diffuse = [1.0, 1.0, 1.0]
specular = [1.0, 1.0, 1.0]
shininess = 1.0
[[camera]]
name = "front"
position = [0.0, 0.0, 10.0]
target = [0.0, 0.0, 0.0]
fov = 90.0
height = 20.0
[[camera]]
name = "right"
position = [10.0, 0.0, 0.0]
target = [0.0, 0.0, 0.0]
fov = 90.0
height = 20.0
"#;

/// The lens of the active camera with this orbit.
fn moved(scene: &Scene, orbit: Orbit) -> Lens {
    let camera = active_camera(&scene.world);
    *scene
        .world
        .get::<&mut Orbit>(camera)
        .expect("a camera has one") = orbit;
    run(&View::of(&scene.world, [300, 200]))
}

#[test]
fn a_camera_that_looks_along_minus_z_has_x_to_the_right_and_y_up() {
    for projection in PROJECTIONS {
        let lens = run(&ahead(projection, [300, 200]));
        assert_eq!(lens.axes, [DVec3::X, DVec3::Y, DVec3::NEG_Z]);
        assert_eq!(lens.eye, DVec3::Z * 10.0);
        assert_eq!(lens.near, 1.0);
        assert_eq!(lens.half, [150.0, 100.0]);
        assert_eq!(lens.projection, projection);
    }
}

#[test]
fn the_field_of_view_or_the_height_is_divided_by_the_rows() {
    // 90 degrees are two units at distance one; 20 units are 20 units.
    for (projection, seen) in PROJECTIONS.into_iter().zip([2.0, 20.0]) {
        for rows in [1, 200, 16384] {
            let lens = run(&ahead(projection, [300, rows]));
            let error = lens.pitch * rows as f64 - seen;
            assert!(error.abs() < 1e-14, "{projection:?}, {rows} rows: {error}");
        }
    }
}

#[test]
fn an_orbit_of_ninety_degrees_looks_from_the_right() {
    let scene = Scene::parse("cameras", CAMERAS).expect("the scene above is valid");
    let here = moved(&scene, Orbit::default());
    assert_eq!(here.eye, DVec3::Z * 10.0);
    let orbit = Orbit {
        azimuth: 90.0,
        ..Orbit::default()
    };
    let lens = moved(&scene, orbit);
    assert!(lens.eye.abs_diff_eq(DVec3::X * 10.0, 1e-14), "{}", lens.eye);
    let expected = [DVec3::NEG_Z, DVec3::Y, DVec3::NEG_X];
    for (axis, expected) in lens.axes.into_iter().zip(expected) {
        assert!(axis.abs_diff_eq(expected, 1e-15), "{axis} {expected}");
    }
    assert_eq!(moved(&scene, Orbit::default()), here, "and back");
}

#[test]
fn zoom_is_a_factor_of_the_distance() {
    let scene = Scene::parse("cameras", CAMERAS).expect("the scene above is valid");
    let orbit = Orbit {
        zoom: 1.0 / 1.21,
        ..Orbit::default()
    };
    let expected = dvec3(0.0, 0.0, 10.0 / 1.21);
    assert!(moved(&scene, orbit).eye.abs_diff_eq(expected, 1e-14));
}

#[test]
fn only_the_orbit_of_the_active_camera_counts() {
    let mut scene = Scene::parse("cameras", CAMERAS).expect("the scene above is valid");
    let orbit = Orbit {
        elevation: 45.0,
        ..Orbit::default()
    };
    let seen_from = |scene: &Scene| View::of(&scene.world, [3, 2]).viewpoint.position;
    assert_eq!(seen_from(&scene), DVec3::Z * 10.0);
    scene.look_from("right").expect("it is there");
    assert_eq!(seen_from(&scene), DVec3::X * 10.0);
    moved(&scene, orbit);
    assert_ne!(seen_from(&scene), DVec3::X * 10.0);
    scene.look_from("left").expect_err("there is none");
    scene.look_from("front").expect("it is there");
    assert_eq!(seen_from(&scene), DVec3::Z * 10.0);
}

#[test]
fn without_its_active_camera_a_scene_uses_the_first() {
    let mut scene = Scene::parse("cameras", CAMERAS).expect("the scene above is valid");
    scene.look_from("right").expect("it is there");
    let active = active_camera(&scene.world);
    scene.world.despawn(active).expect("it is there");
    assert_eq!(names::<Camera>(&scene.world), ["front"]);
    let view = View::of(&scene.world, [3, 2]);
    assert_eq!(view.viewpoint.position, DVec3::Z * 10.0);
}

#[test]
fn a_view_has_the_components_of_the_viewer() {
    let mut scene = Scene::parse("cameras", CAMERAS).expect("the scene above is valid");
    let view = View::of(&scene.world, [3, 2]);
    assert_eq!(
        (view.size, view.projection),
        ([3, 2], Projection::Perspective)
    );
    assert_eq!((view.tolerance, view.turned), (0.5, 0));
    assert_eq!((view.background, view.shading), (DVec3::ZERO, None));

    let spin = Spin {
        degrees: 7,
        on: true,
    };
    let world = &mut scene.world;
    overwrite(world, &Projection::Orthographic);
    overwrite(world, &Tolerance(0.25));
    overwrite(world, &spin);
    overwrite(world, &Background(DVec3::ONE));
    let view = View::of(world, [30, 20]);
    assert_eq!(
        (view.size, view.projection),
        ([30, 20], Projection::Orthographic)
    );
    assert_eq!((view.tolerance, view.turned), (0.25, 7));
    assert_eq!(view.background, DVec3::ONE);
}

#[test]
fn the_mode_of_a_view_overrides_that_of_every_cuboid() {
    let view = ahead(Projection::Perspective, [3, 2]);
    for own in [ShadingMode::Gouraud, ShadingMode::Phong] {
        assert_eq!(view.mode(own), own);
        for mode in [ShadingMode::Gouraud, ShadingMode::UnitVectors] {
            assert_eq!(view.shaded(mode).mode(own), mode);
        }
    }
    assert_eq!(view.with_tolerance(3.0).tolerance, 3.0);
}

/// At a distance of ten from a cube of size one: the nearest zoom is at its corner, the farthest at thirty times its
/// size.
#[test]
fn steps_of_zoom_are_tenths_with_limits_and_are_undone_exactly() {
    let scene = Scene::parse("cameras", CAMERAS).expect("the scene above is valid");
    let limits = Limits::of(&scene.world);
    let own = Orbit::default();
    assert!((own.zoomed(2, &limits).zoom - 1.0 / 1.21).abs() < 1e-15);
    assert!((own.zoomed(-3, &limits).zoom - 1.331).abs() < 1e-15);
    for steps in [-7, -1, 0, 1, 2, 19, 23] {
        let there = own.zoomed(steps, &limits);
        let back = there.zoomed(-steps, &limits);
        assert_eq!(back, own, "{steps} steps");
    }
    let root = 3.0_f64.sqrt();
    let ends = [1000, -1000].map(|steps| own.zoomed(steps, &limits).zoom * 10.0);
    let closest = root / 2.0 * 1.001_002;
    assert!((closest..closest * 1.1).contains(&ends[0]), "{ends:?}");
    // The height at twice the distance is the limit.
    assert!(
        (15.0 * root / 1.1..=15.0 * root).contains(&ends[1]),
        "{ends:?}"
    );
    // A file may place a camera beyond the limits of the keys.
    let outside = Orbit { zoom: 50.0, ..own };
    assert!(outside.zoomed(1, &limits).zoom < 50.0);
    assert_eq!(outside.zoomed(-1, &limits).zoom, 50.0);
}
