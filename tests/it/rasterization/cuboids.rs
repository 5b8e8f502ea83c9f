//! Coverage of all faces of a cuboid together.

use glam::DVec3;
use shadetrade::components::{
    Camera, Lens, Mesh, Polygon, Projected, Projection, Transform, View, Viewpoint,
};
use shadetrade::systems::projection::project;
use shadetrade::systems::spin::world_transform;

use super::counting::count;
use crate::support::random::Random;

/// The screen polygons of a cuboid of 2 x 3 x 4 units.
fn screen_polygons(transform: Transform, view: &View) -> Vec<Polygon> {
    let mut projected = Projected::default();
    let mesh = Mesh::cuboid(DVec3::new(2.0, 3.0, 4.0));
    let place = world_transform(&transform, 0);
    project(&place, &mesh, &Lens::new(view), &mut projected);
    projected.polygons.to_vec()
}

/// A view from the origin along -z, 60 degrees or 8 units high.
fn forwards(projection: Projection) -> View {
    let camera = Camera {
        target: DVec3::NEG_Z,
        up: DVec3::Y,
        fov: 60.0,
        height: 8.0,
        near: Some(0.5),
    };
    View {
        size: [48, 48],
        viewpoint: Viewpoint {
            position: DVec3::ZERO,
            camera,
        },
        projection,
        background: DVec3::ZERO,
        turned: 0,
        shading: None,
        tolerance: 0.0,
    }
}

fn turned(random: &mut Random, depth: f64) -> Transform {
    let mut vector = |reach: f64| std::array::from_fn(|_| random.within(-reach, reach)).into();
    Transform {
        position: vector(1.5) + DVec3::NEG_Z * depth,
        rotation: vector(180.0),
    }
}

#[test]
fn a_cuboid_behind_the_eye_covers_nothing() {
    let mut random = Random(3);
    for projection in [Projection::Perspective, Projection::Orthographic] {
        for _ in 0..200 {
            let polygons = screen_polygons(turned(&mut random, -5.0), &forwards(projection));
            assert_eq!(count(&polygons, [48, 48]).iter().sum::<u32>(), 0);
        }
    }
}

// Snapping moves corners by up to 1/512 pixel. For about one cuboid in a million it turns one triangle of an edge-on
// face over the neighbouring face, and a pixel is drawn twice. No such cuboid is among these.

#[test]
fn the_faces_of_a_cuboid_in_front_meet_without_gap_or_overlap() {
    let mut random = Random(4);
    for projection in [Projection::Perspective, Projection::Orthographic] {
        for _ in 0..1000 {
            let transform = turned(&mut random, 8.0);
            let polygons = screen_polygons(transform, &forwards(projection));
            let counts = count(&polygons, [48, 48]);
            assert!(counts.iter().sum::<u32>() > 50, "{transform:?} is in sight");
            for row in counts.chunks(48) {
                // A convex body covers each pixel from the first to the last once.
                let mut runs = row.chunk_by(|a, b| a == b).filter(|run| run[0] > 0);
                let (first, second) = (runs.next(), runs.next());
                assert!(
                    first.is_none_or(|run| run[0] == 1) && second.is_none(),
                    "{row:?} of {transform:?}"
                );
            }
        }
    }
}

#[test]
fn the_faces_of_a_cuboid_that_the_near_plane_cuts_do_not_overlap() {
    let mut random = Random(5);
    for projection in [Projection::Perspective, Projection::Orthographic] {
        let mut covered = 0;
        for _ in 0..1000 {
            let transform = turned(&mut random, 2.0);
            let counts = count(&screen_polygons(transform, &forwards(projection)), [48, 48]);
            assert!(counts.iter().all(|&count| count <= 1), "{transform:?}");
            covered += counts.iter().sum::<u32>();
        }
        assert!(covered > 100_000, "{covered} pixels were looked at");
    }
}
