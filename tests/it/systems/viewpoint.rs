//! Cameras and their orbits in, the lens that a frame is seen through out.

use glam::{DVec3, dvec3};
use hecs::World;
use shadetrade::components::{ActiveCamera, Lens, Orbit, Projection, View};
use shadetrade::scene::Scene;
use shadetrade::systems::viewpoint;

use super::{PROJECTIONS, ahead, empty_frame};

fn run(view: &View) -> Lens {
    let mut frame = empty_frame();
    viewpoint::run(&mut World::new(), view, &mut frame);
    frame.lens
}

/// Two cameras: the first ten units before the origin, the second ten to the right of it.
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

/// The lens of the scene's active camera once it was moved.
fn moved(scene: &Scene, orbit: Orbit) -> Lens {
    let camera = scene.cameras[scene.active_camera()];
    *scene
        .world
        .get::<&mut Orbit>(camera)
        .expect("a camera has one") = orbit;
    run(&View {
        viewpoint: scene.viewpoint(scene.active_camera()),
        ..ahead(Projection::Perspective, [300, 200])
    })
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
fn the_field_of_view_or_the_height_is_shared_out_among_the_rows() {
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
fn two_steps_of_zoom_come_closer_by_a_tenth_twice() {
    let scene = Scene::parse("cameras", CAMERAS).expect("the scene above is valid");
    let orbit = Orbit {
        zoom: 2,
        ..Orbit::default()
    };
    let expected = dvec3(0.0, 0.0, 10.0 / 1.21);
    assert!(moved(&scene, orbit).eye.abs_diff_eq(expected, 1e-14));
}

#[test]
fn one_camera_is_active_and_only_its_orbit_counts() {
    let mut scene = Scene::parse("cameras", CAMERAS).expect("the scene above is valid");
    let orbit = Orbit {
        elevation: 45.0,
        ..Orbit::default()
    };
    for camera in [0, 1, 1, 0, 1] {
        scene.look_from(camera);
        assert_eq!(scene.active_camera(), camera);
        let mut active = scene.world.query::<&ActiveCamera>();
        assert_eq!(active.iter().count(), 1);
    }
    moved(&scene, orbit);
    scene.look_from(0);
    assert_eq!(scene.viewpoint(0).position, DVec3::Z * 10.0);
    assert_ne!(scene.viewpoint(1).position, DVec3::X * 10.0);
}
