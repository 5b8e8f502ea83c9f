//! Visibility in the reference.

use glam::DVec3;
use hecs::World;
use shadetrade::components::{LightKind, Projection, View};
use shadetrade::frame::NO_TRIANGLE;
use shadetrade::reference::at_pixel;

use super::scenes::{
    MATERIAL, cube_under, draw, orthographic, same_place, sample, spawn_cuboid, spawn_light,
    spawn_turned_cuboid, view,
};

#[test]
fn a_pixel_shows_the_point_that_its_line_of_sight_hits() {
    // Column 60 of 100 is (2 * 60 + 1 - 100) / 100 = 0.21 right of the axis per unit of depth, row 44 is 0.11 above.
    // The face is at distance 4. The normal of a cube at (x, y, 1) is proportional to (x, y, 1). A wider picture has
    // margins.
    let world = cube_under(LightKind::Ambient, [0.0; 3]);
    for (width, column) in [(100, 60), (200, 110)] {
        let view = view([width, 100], [0.0, 0.0, 5.0], [0.0; 3]);
        let seen = sample(&world, &view, column, 44);
        same_place(seen.position, [0.84, 0.44, 1.0]);
        let normal = DVec3::new(0.84, 0.44, 1.0) / 1.8992_f64.sqrt();
        same_place(seen.normal, normal.to_array());
        let to_eye = DVec3::new(-0.84, -0.44, 4.0) / 16.8992_f64.sqrt();
        same_place(seen.to_eye, to_eye.to_array());
        // Right of the diagonal of face +z.
        assert_eq!((seen.object, seen.triangle), (0, 8));
    }
    // 10 units on 10 rows: column 5 sees x = 5 + 0.5 - 10 / 2 = 0.5, row 3 sees y = 1.5.
    let mut world = World::new();
    spawn_cuboid(&mut world, [4.0, 4.0, 2.0], [0.0; 3]);
    let seen = sample(&world, &orthographic([10, 10]), 5, 3);
    same_place(seen.position, [0.5, 1.5, 1.0]);
    let normal = DVec3::new(0.25, 0.75, 1.0) / 1.625_f64.sqrt();
    same_place(seen.normal, normal.to_array());
    same_place(seen.to_eye, [0.0, 0.0, 1.0]);
}

#[test]
fn a_pixel_centre_on_an_edge_belongs_to_the_triangle_right_of_it_or_below() {
    // A face of 3 x 3 pixels with border and diagonal through pixel centres: the left and upper border are covered, the
    // right and lower border are not, and the diagonal belongs to the triangle on its right. Rotated by quarter turns
    // in the plane of the picture it is the same face with another corner on top.
    for (degrees, rows) in [
        (0.0, ["999", "998", "988"]),
        (90.0, ["888", "988", "998"]),
        (180.0, ["888", "889", "899"]),
        (270.0, ["999", "899", "889"]),
    ] {
        let mut world = World::new();
        let rotation = [0.0, 0.0, degrees];
        spawn_turned_cuboid(&mut world, [3.0; 3], [0.0; 3], rotation, MATERIAL);
        let mut grid = String::new();
        for row in draw(&world, &orthographic([10, 10])).triangles.chunks(10) {
            grid.extend(
                row.iter()
                    .map(|id| char::from_digit(*id, 12).unwrap_or('.')),
            );
            grid.push('\n');
        }
        let [top, middle, bottom] = rows.map(|row| format!("...{row}....\n"));
        let nothing = "..........\n";
        let expected = nothing.repeat(3) + &top + &middle + &bottom + &nothing.repeat(4);
        assert_eq!(grid, expected, "rotated by {degrees} degrees\n{grid}");
    }
}

#[test]
fn angles_rotate_about_the_fixed_x_axis_first_then_y_then_z() {
    // 2 x 4 x 6 rotated about x is 2 x 6 x 4, then about y 4 x 6 x 2: 4 columns and 6 rows. The other order gives 6 x
    // 2.
    let turned = |size, rotation| {
        let mut world = World::new();
        spawn_turned_cuboid(&mut world, size, [0.0; 3], rotation, MATERIAL);
        world
    };
    let world = turned([2.0, 4.0, 6.0], [90.0, 90.0, 0.0]);
    let truth = draw(&world, &orthographic([10, 10]));
    let rows = truth.triangles.chunks(10).enumerate();
    for (row, triangles) in rows {
        for (column, triangle) in triangles.iter().enumerate() {
            let is_covered = (2..8).contains(&row) && (3..7).contains(&column);
            assert_eq!(*triangle != NO_TRIANGLE, is_covered, "{row} {column}");
        }
    }
    // Rotated by 45 degrees about y, the cube's edge x = z = 1 lies at (0, y, sqrt(2)).
    let world = turned([2.0; 3], [0.0, -45.0, 0.0]);
    let seen = sample(&world, &orthographic([11, 11]), 5, 5);
    same_place(seen.position, [0.0, 0.0, 2.0_f64.sqrt()]);
    same_place(seen.normal, [0.0, 0.0, 1.0]);
}

#[test]
fn surfaces_nearer_than_the_near_plane_are_invisible() {
    // The face is at distance 4, and behind it are only back faces.
    let world = cube_under(LightKind::Ambient, [0.0; 3]);
    for projection in [Projection::Perspective, Projection::Orthographic] {
        let mut view = View {
            projection,
            ..view([11, 11], [0.0, 0.0, 5.0], [0.0; 3])
        };
        view.viewpoint.camera.near = Some(4.0);
        assert!(at_pixel(&world, &view, 5, 5).is_some());
        view.viewpoint.camera.near = Some(4.0 + 1e-12);
        assert_eq!(at_pixel(&world, &view, 5, 5), None);
        assert_eq!(draw(&world, &view).levels[60], [1.0, 2.0, 3.0]);
    }
}

#[test]
fn a_clipped_face_shows_its_remaining_part() {
    // The eye is 1 above a floor of length 20 that reaches behind it. Row 7 of 10 looks 0.5 down per unit of depth and
    // shows the floor at distance 2. With the near plane at 2.5 only less steep rows show it.
    let mut world = World::new();
    spawn_cuboid(&mut world, [20.0, 2.0, 20.0], [0.0, -2.0, 0.0]);
    let mut view = view([10, 10], [0.0; 3], [0.0, 0.0, -1.0]);
    same_place(sample(&world, &view, 5, 7).position, [0.2, -1.0, -2.0]);
    view.viewpoint.camera.near = Some(2.5);
    assert_eq!(at_pixel(&world, &view, 5, 7), None);
    same_place(
        sample(&world, &view, 5, 6).position,
        [1.0 / 3.0, -1.0, -10.0 / 3.0],
    );
}

#[test]
fn from_inside_a_cuboid_is_invisible() {
    let world = cube_under(LightKind::Ambient, [0.0; 3]);
    let truth = draw(&world, &view([8, 8], [0.2, 0.1, 0.3], [0.0, 0.0, -5.0]));
    assert!(truth.triangles.iter().all(|id| *id == NO_TRIANGLE));
}

#[test]
fn the_nearer_cuboid_hides_the_other_in_any_order() {
    for [first, second] in [[0.0, -3.0], [-3.0, 0.0]] {
        let mut world = World::new();
        spawn_cuboid(&mut world, [2.0; 3], [0.0, 0.0, first]);
        spawn_cuboid(&mut world, [9.0, 9.0, 2.0], [0.0, 0.0, second]);
        let view = view([11, 11], [0.0, 0.0, 5.0], [0.0; 3]);
        assert_eq!(sample(&world, &view, 5, 5).position.z, 1.0);
        assert_eq!(
            sample(&world, &view, 5, 5).object,
            usize::from(first < second)
        );
    }
}

#[test]
fn coplanar_faces_belong_to_the_cuboid_earlier_in_the_file() {
    // The sizes differ, so that rounding differs, and a difference of 1e-12 is still the same plane.
    for positions in [[0.0, 0.25], [0.25, 0.0], [0.0, 0.25 + 1e-12]] {
        let mut world = World::new();
        for position in positions {
            let half = 1.0 - if position < 0.2 { 0.0 } else { 0.25 };
            spawn_cuboid(&mut world, [2.0, 2.0, 2.0 * half], [0.0, 0.0, position]);
        }
        let truth = draw(&world, &view([31, 31], [0.3, 0.4, 5.0], [0.0; 3]));
        let front = truth
            .triangles
            .iter()
            .filter(|id| matches!(**id % 12, 8 | 9));
        assert!(
            front.clone().count() > 0 && front.clone().all(|id| *id < 12),
            "{positions:?}"
        );
    }
}

#[test]
fn a_cuboid_a_trillion_times_longer_than_wide_is_as_exact_as_a_cube() {
    // Rotated by 30 degrees about z, its long axis is (cos 30, sin 30, 0). From 4 above the face z = 1, row 3 of 11
    // shows the point y = 4 * 2 * (5.5 - 3.5) / 11 = 16 / 11 up in the picture if that is rotated likewise.
    let (sin, cos) = 30_f64.to_radians().sin_cos();
    for length in [2e6, 2e9, 2e12] {
        let mut world = World::new();
        spawn_turned_cuboid(
            &mut world,
            [4.0, length, 2.0],
            [0.0; 3],
            [0.0, 0.0, -60.0],
            MATERIAL,
        );
        let light = DVec3::new(16.0 / 11.0 * cos, 16.0 / 11.0 * sin, 3.0);
        spawn_light(&mut world, LightKind::Diffuse, light.to_array());
        let mut view = view([11, 11], [0.0, 0.0, 5.0], [0.0; 3]);
        view.viewpoint.camera.up = DVec3::new(cos, sin, 0.0);
        let seen = sample(&world, &view, 5, 3);
        assert_eq!(seen.triangle / 2, 4, "face +z");
        assert!(
            (seen.position - light + 2.0 * DVec3::Z).length() < 1e-9,
            "{}",
            seen.position
        );
        // The light is straight above, and the normal has no tilt: kD * 100.
        assert!((seen.phong.x - 100.0).abs() < 1e-9, "{}", seen.phong);
    }
}
