//! What fuzzing found.

use glam::DVec3;
use shadetrade::components::{LightKind, Material, Projection, ShadingMode};
use shadetrade::frame::Keep;

use crate::scene::{at, draw, empty, shaded, spawn_cuboid, spawn_light, view};

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
