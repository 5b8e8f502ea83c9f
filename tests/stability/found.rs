//! What fuzzing found.

use glam::DVec3;
use shadetrade::components::{LightKind, Material, Projection, ShadingMode, View};
use shadetrade::frame::Keep;

use crate::scene::{at, draw, empty, shaded, spawn_cuboid, spawn_light, view};

/// A slope that is infinite in f32 times a reach of zero: a tile of one pixel, on the corner where the bright one's share
/// is nothing.
#[test]
fn on_a_corner_that_no_other_reaches_every_level_is_defined() {
    for bright in [1e30, 1e60, 1e90] {
        let mut world = empty();
        let material = Material {
            ambient: DVec3::ONE,
            diffuse: DVec3::ONE,
            specular: DVec3::ZERO,
            shininess: 0.0,
        };
        spawn_cuboid(&mut world, DVec3::ONE, at(DVec3::ONE), material);
        spawn_light(
            &mut world,
            LightKind::Ambient,
            DVec3::splat(100.0),
            DVec3::ZERO,
        );
        for place in [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| 9.0 - 16.0 * axis) {
            let levels = DVec3::splat(bright);
            spawn_light(&mut world, LightKind::Diffuse, levels, place);
        }
        for projection in [Projection::Perspective, Projection::Orthographic] {
            let view = View {
                tolerance: 0.0,
                ..view([1, 1], DVec3::ZERO, DVec3::ONE, projection)
            };
            for mode in [ShadingMode::Gouraud, ShadingMode::Phong] {
                let frame = draw(&mut world, &shaded(mode, &view), Keep::Levels);
                assert_eq!(frame.counts().covered_pixels, 1);
                let [levels] = frame.levels() else {
                    panic!("one pixel was asked for")
                };
                assert!(!levels.iter().any(|level| level.is_nan()), "{levels:?}");
            }
        }
    }
}

/// Between a corner brighter than f32 can hold and a dark one the colour is some multiple of the former; where a tile has
/// a single pixel, that multiple is zero and the slope beside it infinite.
#[test]
fn beside_a_corner_brighter_than_floats_can_hold_every_level_is_defined() {
    for bright in [1e37, 1e39, 1e60] {
        let material = Material {
            ambient: DVec3::ONE,
            diffuse: DVec3::ONE,
            specular: DVec3::ONE,
            shininess: 2.0,
        };
        let mut world = empty();
        spawn_cuboid(&mut world, DVec3::ONE, at(DVec3::ZERO), material);
        let levels = DVec3::new(bright, 100.0, 100.0);
        spawn_light(&mut world, LightKind::Specular, levels, DVec3::splat(8.0));
        let eye = DVec3::splat(-8.0);
        let view = view([11, 11], eye, DVec3::ZERO, Projection::Perspective);
        let frame = draw(
            &mut world,
            &shaded(ShadingMode::Gouraud, &view),
            Keep::Levels,
        );
        assert!(frame.counts().covered_pixels > 0);
        let undefined = frame.levels().iter().flatten().any(|level| level.is_nan());
        assert!(!undefined, "{bright:e}: {:?}", frame.levels());
    }
}
