//! The reference against values computed on paper.

use glam::DVec3;
use hecs::World;
use shadetrade::components::{
    Camera, Light, LightKind, Material, Mesh, Name, Projection, ShadingMode, Transform, View,
    Viewpoint,
};
use shadetrade::frame::NO_TRIANGLE;
use shadetrade::reference::{Sample, Truth, at_pixel, picture};

/// kA 0.1, kD 1 and kE 0.5 in every channel.
const MATERIAL: Material = Material {
    ambient: DVec3::splat(0.1),
    diffuse: DVec3::ONE,
    specular: DVec3::splat(0.5),
    shininess: 2.0,
};

fn spawn_cuboid(world: &mut World, size: [f64; 3], position: [f64; 3]) {
    spawn_turned_cuboid(world, size, position, [0.0; 3], MATERIAL);
}

fn spawn_turned_cuboid(
    world: &mut World,
    size: [f64; 3],
    position: [f64; 3],
    rotation: [f64; 3],
    material: Material,
) {
    let transform = Transform {
        position: position.into(),
        rotation: rotation.into(),
    };
    world.spawn((
        transform,
        Mesh::cuboid(size.into()),
        material,
        ShadingMode::Phong,
    ));
}

/// A white light of 100 levels.
fn spawn_light(world: &mut World, kind: LightKind, position: [f64; 3]) {
    let name = Name(format!("{kind:?} at {position:?}"));
    let light = Light {
        kind,
        color: DVec3::ONE,
        intensity: 10.0,
        gain: 10.0,
        on: true,
    };
    world.spawn((
        name,
        Transform {
            position: position.into(),
            rotation: DVec3::ZERO,
        },
        light,
    ));
}

/// A cube from -1 to 1 and one light.
fn cube_under(kind: LightKind, position: [f64; 3]) -> World {
    let mut world = World::new();
    spawn_cuboid(&mut world, [2.0; 3], [0.0; 3]);
    spawn_light(&mut world, kind, position);
    world
}

/// From `eye` towards `target`, 90 degrees high: a point at distance d is seen d high at the picture's upper edge.
fn view(size: [usize; 2], eye: [f64; 3], target: [f64; 3]) -> View {
    let camera = Camera {
        target: target.into(),
        up: DVec3::Y,
        fov: 90.0,
        height: 10.0,
        near: Some(0.1),
    };
    View {
        size,
        viewpoint: Viewpoint {
            position: eye.into(),
            camera,
        },
        projection: Projection::Perspective,
        background: DVec3::new(1.0, 2.0, 3.0),
        shading: None,
        tolerance: 0.0,
    }
}

/// Along -z from z = 5, seeing 10 units of height.
fn orthographic(size: [usize; 2]) -> View {
    View {
        projection: Projection::Orthographic,
        ..view(size, [0.0, 0.0, 5.0], [0.0; 3])
    }
}

fn shaded(mode: ShadingMode, view: View) -> View {
    View {
        shading: Some(mode),
        ..view
    }
}

fn draw(world: &World, view: &View) -> Truth {
    picture(world, view, 0..view.size[1], &|| false, &|_| ()).expect("nobody cancels")
}

/// The first channel at a pixel.
fn level(world: &World, view: &View, x: usize, y: usize) -> f64 {
    draw(world, view).levels[y * view.size[0] + x][0]
}

fn sample(world: &World, view: &View, x: usize, y: usize) -> Sample {
    at_pixel(world, view, x, y).expect("the cuboid is seen there")
}

#[track_caller]
fn close(observed: f64, expected: f64) {
    assert!(
        (observed - expected).abs() <= 1e-9 * expected.abs().max(1.0),
        "{observed} is not {expected}"
    );
}

#[track_caller]
fn same_place(observed: DVec3, expected: [f64; 3]) {
    assert!(
        (observed - DVec3::from(expected)).length() <= 1e-12,
        "{observed} is not {expected:?}"
    );
}

// Where things are seen.

#[test]
fn a_pixel_sees_the_point_its_line_of_sight_meets() {
    // Column 60 of 100 lies (2 * 60 + 1 - 100) / 100 = 0.21 right of the axis per unit of depth, row 44 0.11 above; the
    // face is 4 away. The normal of a cube at (x, y, 1) goes as (x, y, 1).
    let world = cube_under(LightKind::Ambient, [0.0; 3]);
    let seen = sample(&world, &view([100, 100], [0.0, 0.0, 5.0], [0.0; 3]), 60, 44);
    same_place(seen.position, [0.84, 0.44, 1.0]);
    same_place(
        seen.normal,
        (DVec3::new(0.84, 0.44, 1.0) / 1.8992_f64.sqrt()).to_array(),
    );
    same_place(
        seen.to_eye,
        (DVec3::new(-0.84, -0.44, 4.0) / 16.8992_f64.sqrt()).to_array(),
    );
    assert_eq!(
        (seen.object, seen.triangle),
        (0, 8),
        "right of the diagonal of face +z"
    );
}

#[test]
fn the_vertical_field_of_view_fixes_the_scale_of_wide_pictures_too() {
    // As above, 50 pixels of margin on each side.
    let world = cube_under(LightKind::Ambient, [0.0; 3]);
    same_place(
        sample(
            &world,
            &view([200, 100], [0.0, 0.0, 5.0], [0.0; 3]),
            110,
            44,
        )
        .position,
        [0.84, 0.44, 1.0],
    );
}

#[test]
fn an_orthographic_pixel_sees_its_own_column_of_space() {
    // 10 units on 10 rows: column 5 sees x = 5 + 0.5 - 10 / 2 = 0.5, row 3 sees y = 1.5.
    let mut world = World::new();
    spawn_cuboid(&mut world, [4.0, 4.0, 2.0], [0.0; 3]);
    let seen = sample(&world, &orthographic([10, 10]), 5, 3);
    same_place(seen.position, [0.5, 1.5, 1.0]);
    same_place(
        seen.normal,
        (DVec3::new(0.25, 0.75, 1.0) / 1.625_f64.sqrt()).to_array(),
    );
    same_place(seen.to_eye, [0.0, 0.0, 1.0]);
}

#[test]
fn every_pixel_centre_on_an_edge_belongs_to_the_triangle_right_of_it_or_below() {
    // A 3 x 3 face whose border and diagonal run through pixel centres: left and upper border are in, right and lower
    // are out, the diagonal belongs to the triangle on its right.
    let mut world = World::new();
    spawn_cuboid(&mut world, [3.0; 3], [0.0; 3]);
    let mut grid = String::new();
    for row in draw(&world, &orthographic([10, 10])).triangles.chunks(10) {
        grid.extend(
            row.iter()
                .map(|id| char::from_digit(*id, 12).unwrap_or('.')),
        );
        grid.push('\n');
    }
    let expected = "\
        ..........\n..........\n..........\n\
        ...999....\n\
        ...998....\n\
        ...988....\n\
        ..........\n..........\n..........\n..........\n";
    assert_eq!(grid, expected, "\n{grid}");
}

#[test]
fn angles_turn_about_the_fixed_x_axis_first_then_y_then_z() {
    // 2 x 4 x 6 turned about x is 2 x 6 x 4, then about y 4 x 6 x 2: 4 columns and 6 rows. The other order gives 6 x 2.
    let mut world = World::new();
    spawn_turned_cuboid(
        &mut world,
        [2.0, 4.0, 6.0],
        [0.0; 3],
        [90.0, 90.0, 0.0],
        MATERIAL,
    );
    let truth = draw(&world, &orthographic([10, 10]));
    let covered: Vec<usize> = (0..100)
        .filter(|pixel| truth.triangles[*pixel] != NO_TRIANGLE)
        .collect();
    let expected: Vec<usize> = (2..8)
        .flat_map(|row| (3..7).map(move |column| 10 * row + column))
        .collect();
    assert_eq!(covered, expected);
}

#[test]
fn a_corner_turned_to_the_viewer_is_seen_where_the_angles_put_it() {
    // Turned by 45 degrees about y, the cube's edge x = z = 1 lies at (0, y, sqrt(2)).
    let mut world = World::new();
    spawn_turned_cuboid(&mut world, [2.0; 3], [0.0; 3], [0.0, -45.0, 0.0], MATERIAL);
    let seen = sample(&world, &orthographic([11, 11]), 5, 5);
    same_place(seen.position, [0.0, 0.0, 2.0_f64.sqrt()]);
    same_place(seen.normal, [0.0, 0.0, 1.0]);
}

#[test]
fn what_is_nearer_than_the_near_plane_is_not_there() {
    // The face is 4 away, and behind it there are only back faces.
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
fn a_clipped_face_shows_what_is_left_of_it() {
    // The eye is 1 above a floor 20 deep that reaches behind it: row 7 of 10 looks 0.5 down per unit of depth and sees
    // the floor 2 ahead; with the near plane at 2.5 only rows that look less steeply see any.
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
fn from_inside_a_cuboid_nothing_of_it_is_seen() {
    let world = cube_under(LightKind::Ambient, [0.0; 3]);
    let truth = draw(&world, &view([8, 8], [0.2, 0.1, 0.3], [0.0, 0.0, -5.0]));
    assert!(truth.triangles.iter().all(|id| *id == NO_TRIANGLE));
}

#[test]
fn the_nearer_cuboid_hides_the_other_whatever_their_order() {
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
fn faces_in_one_plane_belong_to_the_cuboid_earlier_in_the_file() {
    // Different sizes, so that rounding differs, and 1e-12 nearer is the same plane still.
    for positions in [[0.0, 0.25], [0.25, 0.0], [0.0, 0.25 + 1e-12]] {
        let mut world = World::new();
        for position in positions {
            let half = 1.0 - if position < 0.2 { 0.0 } else { 0.25 };
            spawn_turned_cuboid(
                &mut world,
                [2.0, 2.0, 2.0 * half],
                [0.0, 0.0, position],
                [0.0; 3],
                MATERIAL,
            );
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

// How light answers.

#[test]
fn straight_under_the_light_the_diffuse_term_is_whole_in_phong_and_a_mean_of_corners_in_gouraud() {
    // At the middle of the face l = n. At a corner (1, 1, 1) / sqrt(3) . (-1, -1, 3) / sqrt(11) = 1 / sqrt(33).
    let world = cube_under(LightKind::Diffuse, [0.0, 0.0, 4.0]);
    let view = view([11, 11], [0.0, 0.0, 5.0], [0.0; 3]);
    close(
        level(&world, &shaded(ShadingMode::Phong, view.clone()), 5, 5),
        100.0,
    );
    close(
        level(&world, &shaded(ShadingMode::Gouraud, view), 5, 5),
        100.0 / 33.0_f64.sqrt(),
    );
}

/// The middle of the face z = 1 under a specular light at (3, 0, 5), so that l = (0.6, 0, 0.8), seen from `eye`.
fn highlight(eye: [f64; 3], shininess: f64) -> f64 {
    let mut world = World::new();
    spawn_turned_cuboid(
        &mut world,
        [2.0; 3],
        [0.0; 3],
        [0.0; 3],
        Material {
            shininess,
            ..MATERIAL
        },
    );
    spawn_light(&mut world, LightKind::Specular, [3.0, 0.0, 5.0]);
    level(&world, &view([11, 11], eye, [0.0, 0.0, 1.0]), 5, 5)
}

#[test]
fn the_highlight_is_whole_where_the_eye_is_the_mirrored_light_for_every_exponent() {
    // r = 2 * 0.8 (0, 0, 1) - (0.6, 0, 0.8) = (-0.6, 0, 0.8) points to the eye: kE * 100.
    for shininess in [0.0, 1.0, 76.8, 1e6] {
        close(highlight([-3.0, 0.0, 5.0], shininess), 50.0);
    }
}

#[test]
fn beside_the_mirrored_light_the_highlight_falls_with_the_power_of_the_cosine() {
    // o = (0.6, 0, 0.8), so o.r = -0.36 + 0.64 = 0.28.
    close(highlight([3.0, 0.0, 5.0], 2.0), 50.0 * 0.28 * 0.28);
    close(highlight([3.0, 0.0, 5.0], 0.5), 50.0 * 0.28_f64.sqrt());
    // o = (-0.8, 0, 0.6), so o.r = 0.48 + 0.48 = 0.96.
    close(
        highlight([-4.0, 0.0, 4.0], 76.8),
        50.0 * 0.96_f64.powf(76.8),
    );
}

#[test]
fn a_narrow_highlight_is_right_where_its_cosine_rounds_to_nearly_one() {
    // An eye turned from r by the angle a sees cos(a)^rho = exp(-rho (a^2 / 2 + a^4 / 12)): a = 1e-3, rho = 1e6.
    let (sin, cos) = 1e-3_f64.sin_cos();
    let eye = [-3.0 * cos + 4.0 * sin, 0.0, 1.0 + 4.0 * cos + 3.0 * sin];
    let expected = 50.0 * (-0.5 - 1e-6_f64 / 12.0).exp();
    assert!((highlight(eye, 1e6) - expected).abs() < 1e-6);
}

#[test]
fn facing_away_from_the_mirrored_light_there_is_no_highlight_unless_the_exponent_is_zero() {
    // o = (0.96, 0, 0.28), so o.r = -0.352; 0^0 = 1.
    close(highlight([9.6, 0.0, 3.8], 2.0), 0.0);
    close(highlight([9.6, 0.0, 3.8], 0.0), 50.0);
}

#[test]
fn a_light_behind_the_surface_gives_neither_term() {
    for kind in [LightKind::Diffuse, LightKind::Specular] {
        let mut world = World::new();
        spawn_turned_cuboid(
            &mut world,
            [2.0; 3],
            [0.0; 3],
            [0.0; 3],
            Material {
                shininess: 0.0,
                ..MATERIAL
            },
        );
        spawn_light(&mut world, kind, [0.0, 0.0, 0.999]);
        close(
            level(&world, &view([11, 11], [0.0, 0.0, 5.0], [0.0; 3]), 5, 5),
            0.0,
        );
    }
}

#[test]
fn a_light_at_the_very_point_has_no_direction_and_adds_nothing() {
    let mut world = cube_under(LightKind::Diffuse, [0.0, 0.0, 1.0]);
    spawn_light(&mut world, LightKind::Specular, [0.0, 0.0, 1.0]);
    let seen = sample(&world, &orthographic([11, 11]), 5, 5);
    assert_eq!(seen.phong, DVec3::ZERO);
    assert!(
        seen.lights
            .iter()
            .all(|light| light.to_light.is_none() && light.reflected.is_none())
    );
}

#[test]
fn ambient_light_is_flat_and_background_is_where_nothing_is() {
    let world = cube_under(LightKind::Ambient, [0.0; 3]);
    for mode in [
        ShadingMode::Gouraud,
        ShadingMode::Phong,
        ShadingMode::UnitVectors,
    ] {
        let truth = draw(
            &world,
            &shaded(mode, view([20, 20], [1.0, 2.0, 3.0], [0.0; 3])),
        );
        for (levels, id) in truth.levels.iter().zip(&truth.triangles) {
            let expected = if *id == NO_TRIANGLE {
                [1.0, 2.0, 3.0]
            } else {
                [10.0; 3]
            };
            levels
                .iter()
                .zip(expected)
                .for_each(|(observed, expected)| close(*observed, expected));
        }
    }
}

#[test]
fn a_light_that_is_off_appears_nowhere() {
    let mut world = cube_under(LightKind::Diffuse, [0.0, 0.0, 4.0]);
    world
        .query_mut::<&mut Light>()
        .into_iter()
        .for_each(|light| light.on = false);
    let seen = sample(&world, &orthographic([11, 11]), 5, 5);
    assert_eq!(
        (seen.phong, seen.gouraud, seen.lights.len()),
        (DVec3::ZERO, DVec3::ZERO, 0)
    );
}

#[test]
fn colours_and_coefficients_multiply_channel_by_channel() {
    let mut world = World::new();
    let material = Material {
        diffuse: DVec3::new(0.5, 0.25, 2.0),
        ..MATERIAL
    };
    spawn_turned_cuboid(&mut world, [2.0; 3], [0.0; 3], [0.0; 3], material);
    spawn_light(&mut world, LightKind::Diffuse, [0.0, 0.0, 4.0]);
    world
        .query_mut::<&mut Light>()
        .into_iter()
        .for_each(|light| light.color = DVec3::new(1.0, 0.5, 3.0));
    let seen = sample(&world, &orthographic([11, 11]), 5, 5);
    assert!(
        (seen.phong - DVec3::new(50.0, 12.5, 600.0)).length() < 1e-9,
        "{}",
        seen.phong
    );
}

// How corners spread over a triangle.

/// The top of a cube 1 below the eye and 2 to 4 ahead, a diffuse light infinitely far along +z; `near` in world units.
///
/// Pixel (13, 17) of 25 x 25 looks 0.08 right and 0.4 down per unit of depth: it sees the point 2.5 ahead that lies at
/// (0.2, 1, 0.5) from the cube's centre, on the triangle of the corners (-1, 1, -1), (-1, 1, 1), (1, 1, 1) with weights
/// 0.25, 0.15, 0.6. The corners are 4, 2 and 2 deep: on the screen their weights go as 1, 0.3, 1.2, so 0.4, 0.12, 0.48.
fn receding_top(mode: ShadingMode, near: f64) -> f64 {
    let mut world = World::new();
    spawn_cuboid(&mut world, [2.0; 3], [0.0, -2.0, -3.0]);
    spawn_light(&mut world, LightKind::Diffuse, [0.0, -1.0, 1e15]);
    let mut view = shaded(mode, view([25, 25], [0.0; 3], [0.0, 0.0, -1.0]));
    view.viewpoint.camera.near = Some(near);
    level(&world, &view, 13, 17)
}

#[test]
fn gouraud_interpolates_levels_perspective_correctly() {
    // n.l at the corners: -1 / sqrt(3), which is dark, and twice 1 / sqrt(3).
    close(
        receding_top(ShadingMode::Gouraud, 0.1),
        75.0 / 3.0_f64.sqrt(),
    );
}

#[test]
fn phong_interpolates_normals_perspective_correctly_and_normalises_them() {
    close(
        receding_top(ShadingMode::Phong, 0.1),
        50.0 / 1.29_f64.sqrt(),
    );
}

#[test]
fn unit_vectors_are_interpolated_on_the_screen_and_left_short() {
    // n_z = (-0.4 + 0.12 + 0.48) / sqrt(3).
    close(
        receding_top(ShadingMode::UnitVectors, 0.1),
        20.0 / 3.0_f64.sqrt(),
    );
}

#[test]
fn unit_vectors_of_a_clipped_triangle_are_interpolated_perspective_correctly() {
    // The nearest corners are 2 deep and have no place on the screen: n_z = (-0.25 + 0.15 + 0.6) / sqrt(3).
    close(
        receding_top(ShadingMode::UnitVectors, 2.2),
        50.0 / 3.0_f64.sqrt(),
    );
    close(
        receding_top(ShadingMode::UnitVectors, 2.0),
        20.0 / 3.0_f64.sqrt(),
    );
}

#[test]
fn a_clipped_triangle_keeps_the_colours_of_the_whole_one() {
    close(
        receding_top(ShadingMode::Gouraud, 2.2),
        75.0 / 3.0_f64.sqrt(),
    );
    close(
        receding_top(ShadingMode::Phong, 2.2),
        50.0 / 1.29_f64.sqrt(),
    );
}

#[test]
fn unit_vectors_lose_the_highlight_and_two_thirds_of_the_light_at_the_middle_of_a_face() {
    // The corners on the diagonal have n = (-+1, -+1, 1) / sqrt(3) and, under a light 1 above the face, l = (+-1, +-1, 1)
    // / sqrt(3): both shrink to (0, 0, 1 / sqrt(3)). n.l = 1 / 3, and r = 2/3 n - l points down.
    for (kind, expected) in [
        (LightKind::Diffuse, 100.0 / 3.0),
        (LightKind::Specular, 0.0),
    ] {
        let world = cube_under(kind, [0.0, 0.0, 2.0]);
        close(
            level(
                &world,
                &shaded(ShadingMode::UnitVectors, orthographic([11, 11])),
                5,
                5,
            ),
            expected,
        );
    }
}

#[test]
fn unit_vectors_shorten_the_eye_and_with_it_the_highlight() {
    // Half-way down the left edge of face z = 1 n = (-1, 0, 1) / sqrt(3), and the eye 4 above it has o = (0, +-1, 4) /
    // sqrt(17) at the corners, (0, 0, 4 / sqrt(17)) between. A light infinitely far has l = (-1, 0, 1) / sqrt(2), so
    // r = (2/3 - 1/2) sqrt(2) (-1, 0, 1) and o.r = sqrt(2) / 6 * 4 / sqrt(17).
    let mut world = World::new();
    spawn_turned_cuboid(
        &mut world,
        [2.0; 3],
        [0.0; 3],
        [0.0; 3],
        Material {
            shininess: 1.0,
            ..MATERIAL
        },
    );
    spawn_light(&mut world, LightKind::Specular, [-1e15, 0.0, 1e15]);
    let view = shaded(
        ShadingMode::UnitVectors,
        view([11, 11], [-1.0, 0.0, 5.0], [-1.0, 0.0, 0.0]),
    );
    close(
        level(&world, &view, 5, 5),
        50.0 * 2.0_f64.sqrt() / 6.0 * 4.0 / 17.0_f64.sqrt(),
    );
}

// What must not matter.

/// Two cuboids and a light of each kind; every place moved by `offset`, every length multiplied by `scale`.
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
    for kind in [LightKind::Ambient, LightKind::Diffuse, LightKind::Specular] {
        spawn_light(&mut world, kind, place([5.0, 6.0, 7.0]));
    }
    let mut view = view([40, 30], place([4.0, 3.0, 6.0]), place([0.0; 3]));
    view.viewpoint.camera.near = Some(0.5 * scale);
    view.viewpoint.camera.height *= scale;
    view.viewpoint.camera.fov = 45.0;
    (world, View { projection, ..view })
}

#[test]
fn a_scene_a_billion_units_away_or_scaled_by_a_power_of_two_is_the_same_picture_bit_for_bit() {
    for projection in [Projection::Perspective, Projection::Orthographic] {
        let (world, view) = mixed_scene(0.0, 1.0, projection);
        let expected = draw(&world, &view);
        let covered = expected.triangles.iter().filter(|id| **id != NO_TRIANGLE);
        assert!(covered.count() > 100, "there is something to compare");
        for (offset, scale) in [
            (1e9, 1.0),
            (0.0, 2.0_f64.powi(300)),
            (0.0, 2.0_f64.powi(-300)),
        ] {
            let (world, view) = mixed_scene(offset, scale, projection);
            assert!(
                draw(&world, &view) == expected,
                "{offset} {scale} {projection:?}"
            );
        }
    }
}

#[test]
fn a_scene_at_the_ends_of_the_allowed_lengths_is_the_same_picture() {
    for projection in [Projection::Perspective, Projection::Orthographic] {
        let (world, view) = mixed_scene(0.0, 1.0, projection);
        let expected = draw(&world, &view);
        for scale in [1e98, 1e-98] {
            let (world, view) = mixed_scene(0.0, scale, projection);
            let observed = draw(&world, &view);
            assert_eq!(observed.triangles, expected.triangles, "{scale}");
            for (observed, expected) in observed.levels.iter().zip(&expected.levels) {
                observed
                    .iter()
                    .zip(expected)
                    .for_each(|(observed, expected)| close(*observed, *expected));
            }
        }
    }
}

#[test]
fn a_part_of_the_rows_is_that_part_of_the_picture() {
    let (world, view) = mixed_scene(0.0, 1.0, Projection::Perspective);
    let [whole, part] =
        [0..30, 7..19].map(|rows| picture(&world, &view, rows, &|| false, &|_| ()).expect("whole"));
    assert_eq!((part.width, part.rows), (40, 7..19));
    assert_eq!(part.levels, whole.levels[7 * 40..19 * 40]);
    assert_eq!(part.triangles, whole.triangles[7 * 40..19 * 40]);
}

#[test]
fn a_pixel_asked_for_alone_is_that_pixel_of_the_picture_and_its_terms_add_up() {
    let (world, view) = mixed_scene(0.0, 1.0, Projection::Perspective);
    let [gouraud, phong] = [ShadingMode::Gouraud, ShadingMode::Phong]
        .map(|mode| draw(&world, &shaded(mode, view.clone())));
    for (x, y) in (0..40).flat_map(|x| (0..30).map(move |y| (x, y))) {
        let pixel = 40 * y + x;
        let Some(seen) = at_pixel(&world, &view, x, y) else {
            assert_eq!(phong.triangles[pixel], NO_TRIANGLE);
            continue;
        };
        assert_eq!(
            seen.object * 12 + seen.triangle,
            phong.triangles[pixel] as usize
        );
        assert_eq!(
            [seen.gouraud.to_array(), seen.phong.to_array()],
            [gouraud.levels[pixel], phong.levels[pixel]]
        );
        close(
            seen.lights.iter().map(|light| light.phong.x).sum(),
            seen.phong.x,
        );
        close(
            seen.lights.iter().map(|light| light.gouraud.x).sum(),
            seen.gouraud.x,
        );
        for vector in seen
            .lights
            .iter()
            .flat_map(|light| [light.to_light, light.reflected])
            .flatten()
        {
            close(vector.length(), 1.0);
        }
        assert!(
            seen.lights[0].to_light.is_none(),
            "ambient light comes from nowhere"
        );
    }
    assert_eq!(at_pixel(&world, &view, 40, 5), None);
}

#[test]
fn a_cancelled_picture_is_none_and_a_finished_one_has_told_every_row() {
    let (world, view) = mixed_scene(0.0, 1.0, Projection::Perspective);
    assert_eq!(picture(&world, &view, 0..30, &|| true, &|_| ()), None);
    let told = std::sync::Mutex::new(Vec::new());
    draw(&world, &view);
    picture(&world, &view, 0..30, &|| false, &|done| {
        told.lock().expect("nobody panics").push(done)
    })
    .expect("whole");
    let mut told = told.into_inner().expect("nobody panics");
    told.sort_unstable();
    assert_eq!(told, (1..=30).collect::<Vec<_>>());
}
