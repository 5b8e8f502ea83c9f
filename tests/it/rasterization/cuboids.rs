//! Coverage of all faces of a cuboid together.

use glam::DVec3;
use shadetrade::components::{Lens, Mesh, Projected, Projection};
use shadetrade::systems::projection::project;
use shadetrade::systems::spin::world_transform;

use super::counting::count;
use crate::support::random::Random;
use crate::support::scene::{placed, view};

/// The number of polygons that cover each pixel of a picture of a random cuboid of 2 x 3 x 4 units, at about this depth
/// before the eye.
fn counts(random: &mut Random, depth: f64, projection: Projection) -> Vec<u32> {
    let mut view = view([48, 48], DVec3::ZERO, DVec3::NEG_Z, projection);
    let camera = &mut view.camera;
    (camera.fov, camera.height, camera.near) = (60.0, 8.0, Some(0.5));
    let position = random.around(1.5) + DVec3::NEG_Z * depth;
    let place = world_transform(&placed(position, random.around(180.0)), 0);
    let mesh = Mesh::cuboid(DVec3::new(2.0, 3.0, 4.0));
    let mut projected = Projected::default();
    project(&place, &mesh, &Lens::new(&view), &mut projected);
    count(&projected.polygons, [48, 48])
}

// Snapping moves corners by up to 1/512 pixel. For about one cuboid in a million it turns one triangle of an edge-on
// face over the neighbouring face, and a pixel is drawn twice. No such cuboid is among these.

#[test]
fn the_faces_of_a_cuboid_meet_without_gap_or_overlap() {
    let mut random = Random(4);
    for projection in Projection::ALL {
        for _ in 0..1000 {
            let counts = counts(&mut random, 8.0, projection);
            assert!(counts.iter().sum::<u32>() > 50, "it is in sight");
            for row in counts.chunks(48) {
                // A convex body covers each pixel from the first to the last once.
                let runs = row.chunk_by(|a, b| a == b).filter(|run| run[0] > 0);
                let runs: Vec<u32> = runs.map(|run| run[0]).collect();
                assert!(matches!(runs[..], [] | [1]), "{row:?}");
            }
        }
    }
}
