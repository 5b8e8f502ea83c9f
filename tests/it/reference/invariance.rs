//! Changes of a scene that must not change the picture.

use hecs::{Entity, World};
use shadetrade::components::{FileOrder, LightKind, Projection, ShadingMode, View};
use shadetrade::frame::NO_TRIANGLE;
use shadetrade::reference::{at_pixel, picture};

use super::scenes::{MATERIAL, close, draw, spawn_cuboid, spawn_light, spawn_turned_cuboid, view};

/// Two cuboids and a light of each kind. Every position is moved by `offset`, every length multiplied by `scale`.
fn mixed_scene(offset: f64, scale: f64, projection: Projection) -> (World, View) {
    let place = |p: [f64; 3]| p.map(|x| x * scale + offset);
    let size = |s: [f64; 3]| s.map(|x| x * scale);
    let mut world = World::new();
    spawn_turned_cuboid(
        &mut world,
        size([4.0, 3.0, 2.0]),
        place([0.0; 3]),
        [30.0, 40.0, 50.0],
        MATERIAL,
    );
    spawn_cuboid(&mut world, size([0.5, 8.0, 0.5]), place([1.0, 0.0, 2.0]));
    // Lights at one position share l in the reference; these do not.
    for (kind, x) in [
        (LightKind::Ambient, 5.0),
        (LightKind::Diffuse, 5.0),
        (LightKind::Specular, 4.0),
    ] {
        spawn_light(&mut world, kind, place([x, 6.0, 7.0]));
    }
    let mut view = view([40, 30], place([4.0, 3.0, 6.0]), place([0.0; 3]));
    view.viewpoint.camera.near = Some(0.5 * scale);
    view.viewpoint.camera.height *= scale;
    view.viewpoint.camera.fov = 45.0;
    (world, View { projection, ..view })
}

#[test]
fn a_scene_a_billion_units_away_or_of_another_size_is_the_same_picture() {
    for projection in Projection::ALL {
        let (world, view) = mixed_scene(0.0, 1.0, projection);
        let expected = draw(&world, &view);
        let covered = expected.triangles.iter().filter(|id| **id != NO_TRIANGLE);
        assert!(covered.count() > 100, "there is something to compare");
        let power = 2.0_f64.powi(300);
        let same_bits = [(1e9, 1.0), (0.0, power), (0.0, power.recip())];
        for (offset, scale) in same_bits.into_iter().chain([(0.0, 1e98), (0.0, 1e-98)]) {
            let (world, view) = mixed_scene(offset, scale, projection);
            let observed = draw(&world, &view);
            assert_eq!(observed.triangles, expected.triangles, "{scale}");
            if same_bits.contains(&(offset, scale)) {
                assert!(observed == expected, "{offset} {scale} {projection:?}");
            }
            let levels = observed.levels.as_flattened().iter();
            let pairs = levels.zip(expected.levels.as_flattened());
            pairs.for_each(|(observed, expected)| close(*observed, *expected));
        }
    }
}

#[test]
fn the_order_of_hecs_does_not_replace_that_of_the_file() {
    struct Marked;
    let (mut world, view) = mixed_scene(0.0, 1.0, Projection::Perspective);
    let (expected, seen) = (draw(&world, &view), at_pixel(&world, &view, 20, 15));
    assert_eq!(seen.as_ref().map(|sample| sample.lights.len()), Some(3));
    // An entity with one more component moves behind those without it.
    for first in [FileOrder(0), FileOrder(1)] {
        let mut entities = world.query::<(Entity, &FileOrder)>();
        let moved = entities.iter().filter(|(_, order)| **order == first);
        let moved: Vec<Entity> = moved.map(|(entity, _)| entity).collect();
        drop(entities);
        for entity in moved {
            world.insert_one(entity, Marked).expect("it is there");
        }
        assert!(draw(&world, &view) == expected, "{first:?}");
        assert_eq!(at_pixel(&world, &view, 20, 15), seen, "{first:?}");
    }
}

#[test]
fn some_rows_equal_those_of_the_whole_picture() {
    let (world, view) = mixed_scene(0.0, 1.0, Projection::Perspective);
    let [whole, part] =
        [0..30, 7..19].map(|rows| picture(&world, &view, rows, &|| false, &|_| ()).expect("whole"));
    assert_eq!(part.width, 40);
    assert_eq!(part.levels, whole.levels[7 * 40..19 * 40]);
    assert_eq!(part.triangles, whole.triangles[7 * 40..19 * 40]);
}

#[test]
fn a_single_pixel_equals_that_of_the_picture_and_its_terms_add_up() {
    let (world, view) = mixed_scene(0.0, 1.0, Projection::Perspective);
    let [gouraud, phong] =
        [ShadingMode::Gouraud, ShadingMode::Phong].map(|mode| draw(&world, &view.shaded(mode)));
    for pixel in 0..40 * 30 {
        let Some(seen) = at_pixel(&world, &view, pixel % 40, pixel / 40) else {
            assert_eq!(phong.triangles[pixel], NO_TRIANGLE);
            continue;
        };
        let triangle = seen.object * 12 + seen.triangle;
        assert_eq!(triangle, phong.triangles[pixel] as usize);
        let levels = [seen.gouraud.to_array(), seen.phong.to_array()];
        assert_eq!(levels, [gouraud.levels[pixel], phong.levels[pixel]]);
        let lights = seen.lights.iter();
        close(lights.clone().map(|it| it.phong.x).sum(), seen.phong.x);
        close(lights.clone().map(|it| it.gouraud.x).sum(), seen.gouraud.x);
        let vectors = lights.flat_map(|light| [light.to_light, light.reflected]);
        assert!(
            vectors.clone().take(2).all(|it| it.is_none()),
            "ambient light"
        );
        vectors
            .flatten()
            .for_each(|vector| close(vector.length(), 1.0));
    }
    assert_eq!(at_pixel(&world, &view, 40, 5), None);
}

#[test]
fn a_cancelled_picture_is_none_and_a_finished_one_has_reported_every_row() {
    let (world, view) = mixed_scene(0.0, 1.0, Projection::Perspective);
    assert_eq!(picture(&world, &view, 0..30, &|| true, &|_| ()), None);
    let told = std::sync::Mutex::new(Vec::new());
    picture(&world, &view, 0..30, &|| false, &|done| {
        told.lock().expect("no thread has panicked").push(done);
    })
    .expect("whole");
    let mut told = told.into_inner().expect("no thread has panicked");
    told.sort_unstable();
    assert_eq!(told, (1..=30).collect::<Vec<_>>());
}
