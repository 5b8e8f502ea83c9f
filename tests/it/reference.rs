//! The reference: visibility on paper, and parts of a picture. `shading` compares its levels with
//! paper, `prove` its formula with a second arithmetic, and the renderer with it.

use std::sync::Mutex;

use shadetrade::reference::{Sample, in_row, picture};

use crate::support::prelude::*;
use crate::support::scene;

const MATERIAL: Material = grey([0.1, 1.0, 0.5], 2.0);

/// A view from this height on the z axis, 90 degrees or 10 units high.
fn above(size: [usize; 2], height: f64, projection: Projection) -> View {
    let mut view = view(size, DVec3::Z * height, DVec3::ZERO, projection);
    (view.camera.fov, view.camera.height) = (90.0, 10.0);
    view
}

/// A cuboid at the origin, rotated about z.
fn turned(size: [f64; 3], degrees: f64) -> World {
    let mut world = empty();
    let transform = scene::turned(DVec3::Z * degrees);
    spawn_cuboid(&mut world, size.into(), transform, MATERIAL);
    world
}

fn at_pixel(world: &World, view: &View, x: usize, y: usize) -> Option<Sample> {
    in_row(world, view, y, &[x]).pop()?
}

#[track_caller]
fn assert_near(found: DVec3, expected: [f64; 3]) {
    let error = (found - DVec3::from(expected)).length();
    assert!(error < 1e-9, "{found} is not {expected:?}");
}

#[test]
fn a_pixel_shows_the_point_that_its_line_of_sight_hits() {
    let unit = |v: DVec3| v.normalize().to_array();
    // Column 60 of 100 is (2 * 60 + 1 - 100) / 100 = 0.21 right of the axis per unit of depth, row 44 is 0.11 above.
    // The face is at distance 4. The normal of a cube at (x, y, 1) is proportional to (x, y, 1). A wider picture has
    // margins.
    let world = turned([2.0; 3], 0.0);
    for (width, column) in [(100, 60), (200, 110)] {
        let view = above([width, 100], 5.0, Projection::Perspective);
        let seen = at_pixel(&world, &view, column, 44).expect("the cube");
        assert_near(seen.position, [0.84, 0.44, 1.0]);
        assert_near(seen.normal, unit(DVec3::new(0.84, 0.44, 1.0)));
        assert_near(seen.to_eye, unit(DVec3::new(-0.84, -0.44, 4.0)));
        // Right of the diagonal of face +z.
        assert_eq!((seen.object, seen.triangle), (0, 8));
    }
    // 10 units on 10 rows: column 5 sees x = 5 + 0.5 - 10 / 2 = 0.5, row 3 sees y = 1.5.
    let world = turned([4.0, 4.0, 2.0], 0.0);
    let view = above([10, 10], 5.0, Projection::Orthographic);
    let seen = at_pixel(&world, &view, 5, 3).expect("the cuboid");
    assert_near(seen.position, [0.5, 1.5, 1.0]);
    assert_near(seen.normal, unit(DVec3::new(0.25, 0.75, 1.0)));
    assert_near(seen.to_eye, [0.0, 0.0, 1.0]);
}

#[test]
fn a_pixel_centre_on_an_edge_belongs_to_the_triangle_right_of_it_or_below() {
    // A face of 3 x 3 pixels with border and diagonal through pixel centres: the left and upper border are covered, the
    // right and lower border are not, and the diagonal belongs to the triangle on its right. Rotated by quarter turns
    // in the plane of the picture it is the same face with another corner on top.
    for (degrees, expected) in [
        (0.0, "999 998 988"),
        (90.0, "888 988 998"),
        (180.0, "888 889 899"),
        (270.0, "999 899 889"),
    ] {
        let view = above([10, 10], 5.0, Projection::Orthographic);
        let triangles = truth(&turned([3.0; 3], degrees), &view).triangles;
        let rows = triangles.chunks(10).map(|row| {
            let seen = row.iter().filter(|id| **id != TriangleId::NONE);
            seen.map(|id| id.0.to_string()).collect::<String>()
        });
        let rows: Vec<String> = rows.filter(|row| !row.is_empty()).collect();
        assert_eq!(rows.join(" "), expected, "{degrees} degrees");
        let first = triangles.iter().position(|id| *id != TriangleId::NONE);
        assert_eq!(first, Some(33), "row 3, column 3");
    }
}

#[test]
fn surfaces_nearer_than_the_near_plane_are_invisible() {
    // The face is at distance 4, and behind it are only back faces.
    let world = turned([2.0; 3], 0.0);
    for projection in Projection::ALL {
        let mut view = above([11, 11], 5.0, projection);
        view.camera.near = Some(4.0);
        assert!(at_pixel(&world, &view, 5, 5).is_some());
        view.camera.near = Some(4.0 + 1e-12);
        assert_eq!(at_pixel(&world, &view, 5, 5), None);
        assert_eq!(truth(&world, &view).levels[60], view.background.to_array());
    }
}

#[test]
fn a_cuboid_a_trillion_times_longer_than_wide_is_as_exact_as_a_cube() {
    // Rotated by 30 degrees about z, its long axis is (cos 30, sin 30, 0). From 4 above the face z = 1, row 3 of 11
    // shows the point y = 4 * 2 * (5.5 - 3.5) / 11 = 16 / 11 up in the picture if that is rotated likewise.
    let axis = DVec3::from((glam::DVec2::from_angle(30_f64.to_radians()), 0.0));
    for length in [2e6, 2e9, 2e12] {
        let mut world = turned([4.0, length, 2.0], -60.0);
        let point = axis * 16.0 / 11.0 + DVec3::Z;
        let above_it = point + 2.0 * DVec3::Z;
        shine(&mut world, LightKind::Diffuse, 100.0, above_it);
        let mut view = above([11, 11], 5.0, Projection::Perspective);
        view.camera.up = axis;
        let seen = at_pixel(&world, &view, 5, 3).expect("the cuboid");
        assert_eq!(seen.triangle / 2, 4, "face +z");
        assert_near(seen.position, point.to_array());
        // The light is straight above, and the normal has no tilt: kD * 100.
        assert_near(seen.phong, [100.0; 3]);
    }
}

#[test]
fn a_light_exactly_at_the_point_has_no_direction() {
    for (z, is_there) in [(0.999, true), (1.0, false)] {
        let mut world = turned([2.0; 3], 0.0);
        shine(&mut world, LightKind::Specular, 100.0, DVec3::Z * z);
        let view = above([11, 11], 5.0, Projection::Orthographic);
        let seen = at_pixel(&world, &view, 5, 5).expect("the cube");
        assert_eq!(seen.phong, DVec3::ZERO);
        let vectors = [seen.lights[0].to_light, seen.lights[0].reflected];
        assert_eq!(vectors.map(|it| it.is_some()), [is_there; 2]);
    }
}

/// Two cuboids and a light of each kind.
fn mixed_scene() -> (World, View) {
    let mut world = empty();
    let size = DVec3::new(4.0, 3.0, 2.0);
    let transform = scene::turned([30.0, 40.0, 50.0]);
    spawn_cuboid(&mut world, size, transform, MATERIAL);
    let place = at(DVec3::new(1.0, 0.0, 2.0));
    spawn_cuboid(&mut world, DVec3::new(0.5, 8.0, 0.5), place, MATERIAL);
    // Lights at one position share l in the reference; these do not.
    for (kind, x) in LightKind::ALL.into_iter().zip([5.0, 5.0, 4.0]) {
        shine(&mut world, kind, 100.0, DVec3::new(x, 6.0, 7.0));
    }
    let eye = DVec3::new(4.0, 3.0, 6.0);
    let mut view = view([40, 30], eye, DVec3::ZERO, Projection::Perspective);
    view.camera.near = Some(0.5);
    view.camera.fov = 45.0;
    (world, view)
}

#[track_caller]
fn assert_close(found: f64, expected: f64) {
    let error = (found - expected).abs();
    let limit = 1e-9 * expected.abs().max(1.0);
    assert!(error <= limit, "{found}, not {expected}");
}

#[test]
fn a_single_pixel_equals_that_of_the_picture_and_its_terms_add_up() {
    let (world, view) = mixed_scene();
    let [gouraud, phong] =
        [ShadingMode::Gouraud, ShadingMode::Phong].map(|mode| truth(&world, &view.shaded(mode)));
    for pixel in 0..40 * 30 {
        let Some(seen) = at_pixel(&world, &view, pixel % 40, pixel / 40) else {
            assert_eq!(phong.triangles[pixel], TriangleId::NONE);
            continue;
        };
        let triangle = TriangleId::new(seen.object as u32, seen.triangle);
        assert_eq!(triangle, phong.triangles[pixel]);
        let levels = [seen.gouraud.to_array(), seen.phong.to_array()];
        assert_eq!(levels, [gouraud.levels[pixel], phong.levels[pixel]]);
        assert_close(seen.lights.iter().map(|it| it.phong.x).sum(), seen.phong.x);
        let gouraud = seen.lights.iter().map(|it| it.gouraud.x);
        assert_close(gouraud.sum(), seen.gouraud.x);
        for light in &seen.lights {
            let is_ambient = light.kind == LightKind::Ambient;
            for vector in [light.to_light, light.reflected] {
                assert_eq!(vector.is_none(), is_ambient);
                assert_close(vector.map_or(1.0, DVec3::length), 1.0);
            }
        }
    }
    assert_eq!(at_pixel(&world, &view, 40, 5), None);
}

#[test]
fn some_rows_equal_those_of_the_picture_and_each_is_reported_unless_it_is_cancelled() {
    let (world, view) = mixed_scene();
    let whole = truth(&world, &view);
    let told = Mutex::new(Vec::new());
    let tell = |_, share: f64| told.lock().expect("no thread panics").push(30.0 * share);
    let monitor = Monitor {
        progress: &tell,
        ..Monitor::NONE
    };
    let part = finished(picture(&world, &view, 7..19, monitor)).expect("it is not cancelled");
    assert_eq!(part.width, 40);
    assert_eq!(part.levels, whole.levels[7 * 40..19 * 40]);
    assert_eq!(part.triangles, whole.triangles[7 * 40..19 * 40]);
    let mut told = told.into_inner().expect("no thread has panicked");
    told.sort_unstable_by(f64::total_cmp);
    // The share is that of the whole picture.
    let mut rows = told.iter().zip(8..);
    assert!(rows.all(|(told, row)| (told - f64::from(row)).abs() < 1e-9));
    assert_eq!(told.len(), 12);
    assert!(finished(picture(&world, &view, 0..30, CANCEL)).is_err());
}

/// Asserts the level of Gouraud with this many segments at points (x, y) of the face z = 2 of a cube from -2 to 2.
#[track_caller]
fn assert_levels(world: &World, segments: u32, points: &[([i32; 2], f64)]) {
    for projection in Projection::ALL {
        let mut view =
            view([5, 5], DVec3::Z * 12.0, DVec3::ZERO, projection).shaded(ShadingMode::Gouraud);
        (view.camera.height, view.camera.fov) = (5.0, 2.0 * 0.25_f64.atan().to_degrees());
        view.segments = Segments::new(segments);
        let truth = truth(world, &view);
        for &([x, y], level) in points {
            let [found, ..] = truth.levels[((2 - y) * 5 + 2 + x) as usize];
            let is_known = (found - level).abs() < 1e-9;
            assert!(is_known, "{found} at {x}, {y}, not {level}, of {segments}");
        }
    }
}

/// The light stands 2 above the middle of the face. n.l is 1 there, 1 / sqrt(2) in the middle of an edge, 1 / sqrt(3) at a
/// corner.
#[test]
fn two_cells_along_an_edge_find_the_light_above_the_middle_of_a_face() {
    let mut world = turned([4.0; 3], 0.0);
    overwrite(&mut world, &NormalMode::Face);
    shine(&mut world, LightKind::Diffuse, 90.0, DVec3::Z * 4.0);
    let [edge, corner] = [2.0_f64, 3.0].map(|square| 90.0 / square.sqrt());
    assert_levels(&world, 1, &[[0, 0], [1, 0], [1, -1]].map(|at| (at, corner)));
    let points = [
        ([0, 0], 90.0),
        ([1, 0], edge.midpoint(90.0)),
        // On the diagonals of two cells, which are parallel to that of the face. Two others are cut there.
        ([1, 1], corner.midpoint(90.0)),
        ([-1, -1], corner.midpoint(90.0)),
        ([1, -1], edge),
        ([-1, 1], edge),
    ];
    assert_levels(&world, 2, &points);
}

/// The light is infinitely far along z. The normal at (x, y) goes with (x / 2, y / 2, 1). With four segments every pixel lies
/// on a point of the grid and shows Phong's level. With two, linear interpolation errs in the middle of a cell's edge.
#[test]
fn on_a_point_of_the_grid_gouraud_is_phong_and_between_two_the_mean() {
    let mut world = turned([4.0; 3], 0.0);
    shine(&mut world, LightKind::Diffuse, 90.0, DVec3::Z * 1e15);
    let phong = |x: i32, y: i32| 90.0 / (1.0 + f64::from(x * x + y * y) / 4.0).sqrt();
    let points = (-2..2).flat_map(|x| (-1..3).map(move |y| [x, y]));
    let levels: Vec<_> = points.map(|[x, y]| ([x, y], phong(x, y))).collect();
    assert_levels(&world, 4, &levels);
    let mean = |[x, y]: [i32; 2], [u, v]: [i32; 2]| phong(x, y).midpoint(phong(u, v));
    let points = [
        ([1, 0], mean([0, 0], [2, 0])),
        ([-1, 1], mean([-2, 0], [0, 2])),
        ([-2, 1], mean([-2, 0], [-2, 2])),
    ];
    assert_levels(&world, 2, &points);
}
