//! The view of the viewer, cameras and their orbits, and the lens of a view.

use glam::dvec3;

use crate::support::prelude::*;

/// Six units above its target.
const RIGHT: DVec3 = dvec3(8.0, 6.0, 0.0);

/// Two cameras at a distance of ten from a cube, one in front of it and one to the right of it, and another cube aside.
fn cameras() -> Scene {
    let sees = [90.0, 20.0];
    let record = SceneRecord {
        cuboid: vec![
            records::cuboid("cube", DVec3::ONE, DVec3::X * -0.25),
            records::cuboid("aside", DVec3::ONE, DVec3::X * 2.75),
        ],
        camera: vec![
            records::camera("front", DVec3::Z * 10.0, DVec3::ZERO, sees),
            records::camera("right", RIGHT, DVec3::ZERO, sees),
        ],
        ..SceneRecord::default()
    };
    Scene::spawn("cameras".to_owned(), &record)
}

/// The lens of the active camera with this orbit.
fn moved(scene: &Scene, orbit: Orbit) -> Lens {
    let camera = scene.world.get::<&mut Orbit>(active_camera(&scene.world));
    *camera.expect("a camera has one") = orbit;
    Lens::new(&View::of(&scene.world, [300, 200]))
}

fn seen_from(scene: &Scene) -> DVec3 {
    View::of(&scene.world, [3, 2]).camera.position
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
    assert_eq!(seen_from(&scene), RIGHT);
    let eye = moved(&scene, quarter).eye;
    assert!(eye.abs_diff_eq(dvec3(0.0, 6.0, -8.0), 1e-14), "{eye}");
    for (elevation, expected) in [(170.0, 89.0_f64), (-170.0, -89.0)] {
        let raised = Orbit {
            elevation,
            ..quarter
        };
        let height = moved(&scene, raised).eye.y;
        assert!((height - 10.0 * expected.to_radians().sin()).abs() < 1e-13);
    }
    scene.look_from("left").expect_err("there is none");
    scene.look_from("front").expect("it is there");
    assert_eq!(moved(&scene, Orbit::default()), here, "and back");
}

#[test]
fn zoom_in_orthographic_projection_changes_the_height_and_moves_neither_eye_nor_near_plane() {
    let mut scene = cameras();
    let own = moved(&scene, Orbit::default());
    viewer_mut(&mut scene.world).projection = Projection::Orthographic;
    let raised = |zoom| Orbit {
        azimuth: 30.0,
        elevation: 20.0,
        zoom,
    };
    let far = moved(&scene, raised(1.0));
    for zoom in [0.001, 0.1, 2.0] {
        let orbit = Orbit {
            zoom,
            ..Orbit::default()
        };
        let lens = moved(&scene, orbit);
        assert_eq!((lens.eye, lens.near), (own.eye, own.near));
        assert!((lens.pitch * 200.0 / (20.0 * zoom) - 1.0).abs() < 1e-14);
        let lens = moved(&scene, raised(zoom));
        assert_eq!((lens.eye, lens.near), (far.eye, far.near));
    }
    // The wheel goes on where in perspective the eye would be in the cuboid.
    let limits = Orbit::limits(&scene.world);
    let expected = 3.0 * 2.0_f64.sqrt();
    let error = limits.start() * 20.0 / expected * 1000.0 - 1.0;
    assert!(error.abs() < 1e-12, "{limits:?}");
}

#[test]
fn an_orbit_is_moved_the_shorter_way_round_and_short_of_the_poles() {
    let mut camera = View::of(&cameras().world, [3, 2]).camera;
    let moved = |azimuth: f64| Orbit::default().moved(&camera, azimuth, 0.0).azimuth;
    assert_eq!([170.0, 190.0, -190.0].map(moved), [170.0, -170.0, 170.0]);
    assert!((-180.0..=180.0).contains(&moved(5e60)));
    // A camera that stands closer to a pole keeps its place.
    camera.position = dvec3(0.01, 10.0, 0.0);
    assert_eq!(camera.elevation_short_of_poles(5.0), 0.0);
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
fn steps_of_zoom_are_tenths_with_limits_and_are_undone_exactly() {
    let limits = Orbit::limits(&cameras().world);
    let own = Orbit::default();
    assert!((own.zoomed(2, &limits).zoom - 1.0 / 1.21).abs() < 1e-15);
    assert!((own.zoomed(-3, &limits).zoom - 1.331).abs() < 1e-15);
    for steps in [-7, -1, 0, 1, 2, 19, 23] {
        let back = own.zoomed(steps, &limits).zoomed(-steps, &limits);
        assert_eq!(back, own, "{steps} steps");
    }
    // The nearest distance is that of the farthest corner of the cube around the target, and of the near plane. The largest height, twice
    // the distance, is thirty times the size of both cubes.
    let expected = [17.0_f64.sqrt() / 4.0 + 0.01, 45.0 * 2.0_f64.sqrt()];
    for (limit, expected) in [limits.start(), limits.end()].into_iter().zip(expected) {
        assert!((limit * 10.0 - expected).abs() < 1e-12, "{limits:?}");
    }
    // The limits do not depend on where the scene is.
    let mut record = SceneRecord::of(&cameras().world);
    let centres = record.cuboid.iter_mut().map(|it| &mut it.position);
    centres.for_each(|it| *it += DVec3::X);
    for camera in &mut record.camera {
        (camera.position, camera.target) = (camera.position + DVec3::X, DVec3::X);
    }
    let moved = Orbit::limits(&Scene::spawn(String::new(), &record).world);
    assert!((moved.start() - limits.start()).abs() + (moved.end() - limits.end()).abs() < 1e-12);
    // Where little height is seen, the distance decides. It is half of the height above.
    record.camera.iter_mut().for_each(|it| it.height = 1.0);
    let low = Orbit::limits(&Scene::spawn(String::new(), &record).world);
    assert!((low.end() / limits.end() - 2.0).abs() < 1e-12, "{low:?}");
    let [nearest, farthest] = [1000, -1000].map(|steps| own.zoomed(steps, &limits).zoom);
    let reached = nearest / 1.1 < *limits.start() && farthest * 1.1 > *limits.end();
    assert!(reached && limits.contains(&nearest) && limits.contains(&farthest));
    // A file may place a camera beyond the limits of the keys.
    let outside = Orbit { zoom: 50.0, ..own };
    assert!(outside.zoomed(1, &limits).zoom < 50.0);
    assert_eq!(outside.zoomed(-1, &limits).zoom, 50.0);
    assert!(outside.zoomed(1, &(100.0..=200.0)).zoom < 50.0);
}
