//! Projection: screen polygons from mesh and placement.

use glam::dvec3;
use hecs::Entity;
use shadetrade::systems::projection;

use super::{MATERIAL, PROJECTIONS, ahead, at, empty_frame, place, read, turned};
use crate::support::prelude::*;

/// Face +z: corners 4, 5, 7 and 6.
const FRONT: usize = 4;

fn spawn(world: &mut World, position: DVec3, size: DVec3) -> Entity {
    let mesh = Mesh::cuboid(size);
    world.spawn((place(at(position)), mesh, Projected::default()))
}

fn run(world: &mut World, view: &View) {
    let mut frame = empty_frame();
    projection::run(world, view, &mut frame);
}

/// The screen polygons of one cuboid.
fn seen(position: DVec3, size: DVec3, view: &View) -> Projected {
    let mut world = World::new();
    let cuboid = spawn(&mut world, position, size);
    run(&mut world, view);
    read(&world, cuboid)
}

fn is_drawn(projected: &Projected) -> bool {
    projected.polygons.iter().any(|polygon| polygon.len > 0)
}

#[test]
fn the_axis_is_the_middle_of_the_picture_and_half_the_field_of_view_its_edge() {
    for fov in [1.0_f64, 30.0, 90.0, 126.87, 170.0] {
        let half_angle = (fov / 2.0).to_radians().tan();
        for (projection, half) in PROJECTIONS.into_iter().zip([10.0 * half_angle, fov / 2.0]) {
            let mut view = ahead(projection, [300, 200]);
            (view.camera.fov, view.camera.height) = (fov, fov);
            // The front face is ten units away, as high as the picture, and half as wide as it is high.
            let size = dvec3(half, 2.0 * half, 2.0);
            for (aside, expected) in [
                (DVec3::ZERO, [[100, 200], [200, 200], [200, 0], [100, 0]]),
                // Corner 4 of face +z, at -x and -y, is on the axis.
                (
                    size / 2.0 * dvec3(1.0, 1.0, 0.0),
                    [[150, 100], [250, 100], [250, -100], [150, -100]],
                ),
            ] {
                let seen = seen(DVec3::NEG_Z + aside, size, &view);
                let expected = expected.map(|pixel| pixel.map(|x| x * 256));
                let found = seen.polygons[FRONT].vertices();
                assert_eq!(found, expected, "{projection:?}, {fov}");
            }
        }
    }
    let view = ahead(Projection::Perspective, [3, 2]);
    let seen = seen(dvec3(1.0, 1.0, -1.0), DVec3::splat(2.0), &view);
    assert_eq!(seen.seen[4], dvec3(0.0, 0.0, 10.0));
}

#[test]
fn a_cuboid_behind_the_near_plane_leaves_no_polygon() {
    for projection in PROJECTIONS {
        let view = ahead(projection, [300, 200]);
        let drawn = |position: DVec3| is_drawn(&seen(position, DVec3::splat(2.0), &view));
        // The eye is at z = 10, the near plane at z = 9.
        assert!(drawn(DVec3::Z * 7.9), "nearer than the near plane");
        // Clipped by it, one of the four other faces is visible, unless it is edge-on.
        let perspective = projection == Projection::Perspective;
        assert_eq!(drawn(dvec3(2.0, 0.0, 9.0)), perspective);
        for beyond in [10.1, 15.0, 1e9] {
            assert!(!drawn(dvec3(2.0, 0.0, beyond)), "{beyond}");
        }
    }
}

#[test]
fn a_face_in_the_near_plane_up_to_rounding_is_cut_within_its_own_ends() {
    let mut random = Random(11);
    for case in 0..2000 {
        let placed = place(turned(random.around(180.0)));
        let mut eye = random.around(1.0);
        eye.z = 1.0 + random.between(1e-6, 10.0);
        let mut view = ahead(PROJECTIONS[case % 2], [200, 200]);
        (view.camera.fov, view.camera.up) = (170.0, placed.axes * DVec3::Y);
        view.camera.position = placed.axes * eye;
        view.camera.target = placed.axes * dvec3(eye.x, eye.y, 0.0);
        // The ends of face +z right and down, before the near plane and in it.
        let [whole, cut] = [0.5, 1.0].map(|share| {
            view.camera.near = Some(share * (eye.z - 1.0));
            let (mesh, mut projected) = (Mesh::cuboid(DVec3::splat(2.0)), Projected::default());
            projection::project(&placed, &mesh, &Lens::new(&view), &mut projected);
            let corners = projected.polygons[FRONT].vertices();
            [0, 1].map(|axis| {
                let places = corners.iter().map(move |corner| corner[axis]);
                places.clone().min().zip(places.max())
            })
        });
        for (whole, cut) in whole.into_iter().zip(cut) {
            let (Some(whole), Some(cut)) = (whole, cut) else {
                continue;
            };
            let is_within = whole.0 - 1 <= cut.0 && cut.1 <= whole.1 + 1;
            assert!(is_within, "{cut:?} of {whole:?} from {eye}");
        }
    }
}

#[test]
fn a_face_is_drawn_everywhere_even_if_its_visible_part_is_tiny() {
    // The visible part is smaller than the rounding of its position.
    for least in [1e-10, 1e-15, 1e-17, 1e-20, 1e-22, 1e-25, 1e-50, 1e-100] {
        for projection in PROJECTIONS {
            for (rotation, target) in [
                (DVec3::ZERO, dvec3(0.3, 0.2, 1.0)),
                (dvec3(10.0, 30.0, 50.0), dvec3(0.1, -0.2, 0.0)),
                (dvec3(-70.0, 20.0, 5.0), dvec3(-0.3, 0.1, 0.2)),
            ] {
                let mut view = ahead(projection, [30, 20]);
                view.camera.position = dvec3(7.0, 5.0, 8.0);
                let camera = &mut view.camera;
                (camera.target, camera.fov, camera.height) = (target, least, least);
                let mut world = World::new();
                let transform = placed(DVec3::splat(0.1), rotation);
                spawn_cuboid(&mut world, DVec3::splat(2.0), transform, MATERIAL);
                let counts = draw(&mut world, &view, Keep::Levels).counts();
                assert_eq!(
                    counts.covered_pixels, 600,
                    "{projection:?}, {least}, {rotation}"
                );
            }
        }
    }
}
