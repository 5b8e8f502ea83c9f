//! A number in; a scene with that many lights, or that many cuboids, out.
//!
//! ```text
//!    lights:  . * .        cuboids:  . 7 5 8 .     the middle of a grid first
//!           *   #   *                9 2 1 3 .
//!             eye                    . 6 4 . .
//! ```
//! Rule: everything is in view and lit, and a scene of more holds that of fewer, unchanged.

use glam::{DMat3, DVec3};

use crate::components::{LightKind, Viewpoint};
use crate::scene::{CameraRecord, CuboidRecord, LightRecord, Scene, SceneRecord, ViewRecord};

/// Levels that a place sends of diffuse and of specular light where there is one place: bright, and nowhere beyond the display's
/// range.
const LEVELS: [(LightKind, f64); 2] = [(LightKind::Diffuse, 200.0), (LightKind::Specular, 150.0)];

/// Levels of ambient light, of which there is always one.
const AMBIENT: f64 = 100.0;

const BACKGROUND: DVec3 = DVec3::new(20.0, 20.0, 24.0);

/// The vertical field of view, in degrees.
const FIELD_OF_VIEW: f64 = 30.0;

/// A full turn over the square of the golden ratio, in degrees: its multiples never come near each other (Vogel 1979).
const GOLDEN_ANGLE: f64 = 137.507_764_050_037_85;

/// One cuboid under diffuse and specular light from `number` places on the half of a sphere that faces the eye, evenly spread:
/// towards the eye as van der Corput's sequence, around it by golden angles.
///
/// A place keeps its light and where it stands whatever the number of others, so that nothing else varies; `most` of them
/// together are as bright as the one of [`of_cuboids`].
pub fn of_lights(number: usize, most: usize) -> Scene {
    let camera = looking(DVec3::new(7.0, 5.0, 8.0), 6.3);
    let viewpoint = Viewpoint {
        position: camera.position,
        camera: camera.camera(),
    };
    let [right, up, forward] = viewpoint.axes();
    let places = (0..number).map(|index| {
        // The index's bits behind the binary point, in reverse; half a step of the finest keeps it off 0.
        let reversed = (index as u32).reverse_bits();
        let nearness = 1.0 - (f64::from(reversed) / 2.0_f64.powi(32) + 0.5 / most as f64);
        let aside = (1.0 - nearness * nearness).sqrt();
        let (sin, cos) = (index as f64 * GOLDEN_ANGLE).to_radians().sin_cos();
        let direction =
            DMat3::from_cols(right, up, -forward) * DVec3::new(aside * cos, aside * sin, nearness);
        // Farther than any corner, and as far as the default scene's lights.
        direction * 300.0_f64.sqrt()
    });
    let cuboid = CuboidRecord::new("0", [4.0, 3.0, 2.0], DVec3::ZERO);
    let places: Vec<DVec3> = places.collect();
    scene(vec![cuboid], &places, 1.0 / most as f64, camera)
}

/// The `number` cuboids that are nearest to the middle of a grid with room for at least `capacity`, which fills a picture of
/// that size; each is turned another way.
pub fn of_cuboids(number: usize, capacity: usize, [width, height]: [usize; 2]) -> Scene {
    let aspect = width as f64 / height as f64;
    let columns = ((capacity as f64 * aspect).sqrt().ceil() as usize).clamp(1, capacity);
    let rows = capacity.div_ceil(columns);
    // Half a cell is left free on every side, as what is nearer than the grid looks larger.
    let seen = (rows as f64).max(columns as f64 / aspect) + 1.0;
    let distance = seen / 2.0 / (FIELD_OF_VIEW / 2.0).to_radians().tan();

    let mut cells: Vec<[usize; 2]> = (0..rows)
        .flat_map(|row| (0..columns).map(move |column| [column, row]))
        .collect();
    // Twice the distance from the middle, in cells across and down.
    let off = |cell: usize, cells: usize| (2 * cell + 1).abs_diff(cells);
    cells.sort_by_key(|&[column, row]| (off(column, columns) * rows).max(off(row, rows) * columns));
    let cuboids = cells.iter().take(number).enumerate();
    let cuboids = cuboids.map(|(index, &[column, row])| {
        let middle = |cell: usize, cells: usize| cell as f64 + 0.5 - cells as f64 / 2.0;
        let position = DVec3::new(middle(column, columns), middle(row, rows), 0.0);
        let turn = index as f64 * GOLDEN_ANGLE;
        CuboidRecord {
            rotation: DVec3::new(turn, 2.0 * turn, 0.0),
            ..CuboidRecord::new(index.to_string(), [0.55; 3], position)
        }
    });
    scene(
        cuboids.collect(),
        &[DVec3::splat(distance)],
        1.0,
        looking(DVec3::Z * distance, seen),
    )
}

/// From `eye` towards the origin, where `height` world units are seen.
fn looking(eye: DVec3, height: f64) -> CameraRecord {
    CameraRecord::new("1", eye, DVec3::ZERO, [FIELD_OF_VIEW, height])
}

/// With ambient light, and with diffuse and specular light of `strength` times [`LEVELS`] from each of the places.
fn scene(
    cuboids: Vec<CuboidRecord>,
    places: &[DVec3],
    strength: f64,
    camera: CameraRecord,
) -> Scene {
    let ambient = LightRecord::new("ambient", LightKind::Ambient, AMBIENT, DVec3::ZERO);
    let mut lights = vec![ambient];
    for (index, &place) in places.iter().enumerate() {
        for (kind, levels) in LEVELS {
            let name = format!("{kind:?} {index}");
            lights.push(LightRecord::new(name, kind, strength * levels, place));
        }
    }
    let record = SceneRecord {
        background: BACKGROUND,
        cuboid: cuboids,
        light: lights,
        camera: vec![camera],
        view: ViewRecord::default(),
    };
    Scene::spawn(String::new(), &record)
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::components::{
        Illumination, Lens, Light, Mesh, Normals, PointLight, Projected, Projection, Transform,
        View,
    };
    use crate::systems::lighting::gather;
    use crate::systems::projection::project;
    use crate::systems::spin::world_transform;

    fn view(scene: &Scene, projection: Projection, size: [usize; 2]) -> View {
        View {
            projection,
            ..View::of(&scene.world, size)
        }
    }

    #[test]
    fn lights_stand_on_the_eye_s_side_and_stay_as_they_are_among_more() {
        let points = |number| {
            let scene = of_lights(number, 64);
            let mut illumination = Illumination::default();
            gather(
                scene.world.query::<(&Transform, &Light)>().iter(),
                &mut illumination,
            );
            illumination.points
        };
        let eye = View::of(&of_lights(1, 64).world, [1, 1]).viewpoint.position;
        let all = points(64);
        assert_eq!(all.len(), 64);
        for (index, point) in all.iter().enumerate() {
            assert!((point.position.length_squared() - 300.0).abs() < 1e-9);
            assert!(point.position.dot(eye) > 0.0);
            let other = |other: &PointLight| other.position.distance(point.position) > 1.0;
            assert!(all[..index].iter().all(other), "places are apart");
        }
        for number in [1, 2, 7, 32] {
            let fewer = points(number);
            assert_eq!(fewer.len(), number);
            for one in &fewer {
                let key = |one: &PointLight| (one.position, one.diffuse, one.specular);
                assert!(all.iter().any(|other| key(one) == key(other)), "{one:?}");
            }
        }
        let sent: f64 = all.iter().map(|point| point.diffuse.x).sum();
        assert!((sent - 200.0).abs() < 1e-9, "all send {sent}");
    }

    #[test]
    fn all_cuboids_are_in_view_whatever_the_shape_of_the_picture() {
        for size in [[1920, 1080], [90, 160], [300, 20], [8, 8]] {
            for (number, capacity) in [(1, 1), (1, 10), (10, 10), (30, 100)] {
                for projection in [Projection::Perspective, Projection::Orthographic] {
                    let mut scene = of_cuboids(number, capacity, size);
                    let lens = Lens::new(&view(&scene, projection, size));
                    let cuboids = scene
                        .world
                        .query_mut::<(&Transform, &Mesh, &mut Projected)>();
                    let mut seen = 0;
                    for (transform, mesh, projected) in cuboids {
                        let place = world_transform(transform, 0);
                        project(&place, mesh, &lens, projected);
                        for corner in projected.seen {
                            let [x, y] = lens.pixel(lens.homogeneous(corner));
                            let within = (0.0..size[0] as f64).contains(&x)
                                && (0.0..size[1] as f64).contains(&y);
                            assert!(within, "{number} of {capacity} in {size:?}: {x}, {y}");
                        }
                        seen += 1;
                    }
                    assert_eq!(seen, number);
                }
            }
        }
    }

    #[test]
    fn a_scene_of_more_cuboids_holds_those_of_fewer() {
        let places = |number| -> Vec<DVec3> {
            let scene = of_cuboids(number, 100, [160, 90]);
            let mut query = scene.world.query::<(&Transform, &Normals)>();
            query
                .iter()
                .map(|(transform, _)| transform.position)
                .collect()
        };
        let (few, many) = (places(10), places(100));
        assert_eq!(few, many[..10]);
        // The middle comes first: 14 columns and 8 rows have none of their own there.
        assert_eq!(few[0].abs(), DVec3::new(0.5, 0.5, 0.0));
        for (index, place) in many.iter().enumerate() {
            assert!(
                many[..index]
                    .iter()
                    .all(|other| other.distance(*place) >= 1.0)
            );
        }
    }
}
