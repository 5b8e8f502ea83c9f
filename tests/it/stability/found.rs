//! Faults found by fuzzing.

use shadetrade::components::LightKind::{Ambient, Diffuse, Specular};

use crate::support::prelude::*;

/// Asserts that every level of a picture that shows a cuboid is defined.
fn assert_defined(world: &mut World, view: &View, modes: &[ShadingMode]) {
    for mode in modes {
        let frame = draw(world, &view.shaded(*mode), Keep::Levels);
        assert!(frame.counts().covered_pixels > 0);
        let undefined = frame.levels().as_flattened().iter().any(|it| it.is_nan());
        assert!(!undefined, "{mode:?}: {:?}", frame.levels());
    }
}

/// An infinite slope in f32 times a reach of zero gave NaN: a square of one pixel, on a corner where the weight of the
/// bright corner is 0.
#[test]
fn on_a_corner_without_weight_of_others_every_level_is_defined() {
    for bright in [1e30, 1e60, 1e90] {
        let mut world = empty();
        let material = grey([1.0, 1.0, 0.0], 0.0);
        spawn_cuboid(&mut world, DVec3::ONE, at(DVec3::ONE), material);
        shine(&mut world, Ambient, 100.0, DVec3::ZERO);
        for axis in DVec3::AXES {
            shine(&mut world, Diffuse, bright, 9.0 - 16.0 * axis);
        }
        for projection in Projection::ALL {
            let view = view([1, 1], DVec3::ZERO, DVec3::ONE, projection);
            let modes = ShadingMode::ALL;
            assert_defined(&mut world, &view, &modes);
        }
    }
}

/// Between a corner brighter than f32 can hold and a dark one, the colour is a multiple of the former. In a square of one
/// pixel that multiple is 0 and the slope is infinite.
#[test]
fn beside_a_corner_beyond_f32_every_level_is_defined() {
    for bright in [1e37, 1e39, 1e60] {
        let mut world = empty();
        spawn_cuboid(&mut world, DVec3::ONE, at(DVec3::ZERO), white(2.0));
        let levels = DVec3::new(bright, 100.0, 100.0);
        spawn_light(&mut world, Specular, levels, DVec3::splat(8.0));
        let eye = DVec3::splat(-8.0);
        let view = view([11, 11], eye, DVec3::ZERO, Projection::Perspective);
        assert_defined(&mut world, &view, &[ShadingMode::Gouraud]);
    }
}

/// On a floor this large, clipping in f64 loses the bounds of the guard band. No vertex may leave it.
#[test]
fn the_largest_floors_stay_in_the_guard_band() {
    for thickness in [1e-9, 0.5, 1e9] {
        let mut world = empty();
        let place = at(DVec3::new(-10.5, -7e16, 5.0));
        let size = DVec3::new(1e100, 1e100, thickness);
        spawn_cuboid(&mut world, size, place, white(1.0));
        for (eye, target) in [
            (DVec3::new(-3.5, -12.0, 15.0), DVec3::new(0.0, 0.0, 1.4)),
            (DVec3::splat(10.5), DVec3::new(7.4, 7.375, 1.0)),
        ] {
            for projection in Projection::ALL {
                let view = view([5, 25], eye, target, projection);
                draw(&mut world, &view, Keep::Levels);
                for projected in world.query_mut::<&Projected>() {
                    let vertices = projected.polygons.iter().flat_map(Polygon::vertices);
                    for coordinate in vertices.flatten() {
                        assert!(coordinate.abs() <= 1 << 30, "{projected:?}");
                    }
                }
            }
        }
    }
}

/// At this distance rounding moves a silhouette by its own size. Outside their triangle the vectors of the shortcut are
/// longer than one, and a large exponent overflows.
#[test]
fn the_shortcut_is_defined_outside_its_triangles() {
    let mut world = empty();
    let mut material = grey([0.0, 0.0, 5.0], 1e6);
    material.diffuse = DVec3::new(0.5, 0.0, 5.0);
    let place = placed([1.025e-89, 5e-91, -1e10], [3.161e36, 0.0, 0.0]);
    let size = DVec3::splat(4.831_298_828_125e-90);
    spawn_cuboid(&mut world, size, place, material);
    for (kind, at) in [
        (Specular, [3.5, -1.757_080_078_125, 3.5]),
        (Diffuse, [3.5, 3.5, 1.756_835_937_5]),
    ] {
        let levels = DVec3::new(600.0, 1200.0, 1200.0);
        spawn_light(&mut world, kind, levels, DVec3::from(at) * 1e-90);
    }
    let [eye, target] = [6.5, 3.5].map(|z| DVec3::new(3.5, 3.5, z) * 1e-90);
    let mut view = view([27, 16], eye, target, Projection::Orthographic);
    view.camera.up = DVec3::ONE;
    view.camera.height = 8e-90;
    let shortcut = truth(&world, &view.shaded(ShadingMode::UnitVectors));
    let mut levels = shortcut.levels.as_flattened().iter();
    assert!(!levels.any(|it| it.is_nan()), "{:?}", shortcut.levels);
}
