//! A scene of three intersecting cuboids under five lights, and all ways to draw it.

use glam::DVec3;
use hecs::World;
use shadetrade::components::{LightKind, Material, Projection, ShadingMode, Transform, View};
use shadetrade::frame::Frame;

use crate::support::scene::{at, empty, spawn_cuboid, spawn_light, view};

/// The first `count` of the three cuboids, and the lights.
pub fn still_life(cuboids: usize) -> World {
    let mut world = empty();
    let material = |shininess: f64| Material {
        ambient: DVec3::new(0.25, 0.125, 0.5),
        diffuse: DVec3::new(0.75, 0.5, 0.25),
        specular: DVec3::new(0.5, 0.75, 1.0),
        shininess,
    };
    let turned = |x: f64, y: f64, z: f64, rotation: [f64; 3]| Transform {
        rotation: rotation.into(),
        ..at(DVec3::new(x, y, z))
    };
    let all = [
        (
            [4.0, 3.0, 2.0],
            turned(0.0, 0.0, 0.0, [10.0, 20.0, 30.0]),
            76.8,
        ),
        (
            [0.5, 9.0, 0.5],
            turned(1.0, 0.5, 0.5, [0.0, 0.0, -60.0]),
            9.0,
        ),
        (
            [3.0, 0.125, 3.0],
            turned(-1.0, 1.0, 0.75, [45.0, 0.0, 0.0]),
            1000.0,
        ),
    ];
    for (size, transform, shininess) in &all[..cuboids] {
        spawn_cuboid(
            &mut world,
            DVec3::from(*size),
            *transform,
            material(*shininess),
        );
    }
    let lights = [
        (
            LightKind::Ambient,
            DVec3::splat(40.0),
            DVec3::new(0.0, 0.0, 0.0),
        ),
        (
            LightKind::Diffuse,
            DVec3::new(90.0, 60.0, 200.0),
            DVec3::new(4.0, 8.0, 6.0),
        ),
        (
            LightKind::Specular,
            DVec3::splat(200.0),
            DVec3::new(4.0, 8.0, 6.0),
        ),
        (
            LightKind::Diffuse,
            DVec3::new(300.0, 0.0, 0.0),
            DVec3::new(-6.0, 1.0, 2.0),
        ),
        (
            LightKind::Specular,
            DVec3::new(0.0, 90.0, 0.0),
            DVec3::new(2.0, 2.0, 1.5),
        ),
    ];
    for (kind, levels, position) in lights {
        spawn_light(&mut world, kind, levels, position);
    }
    world
}

/// Views of it in every projection and mode, at tolerances 0, 0.5 and 4.
pub fn views(size: [usize; 2]) -> Vec<View> {
    let mut views = Vec::new();
    for projection in [Projection::Perspective, Projection::Orthographic] {
        let (eye, target) = (DVec3::new(4.0, 3.0, 9.0), DVec3::new(0.0, 0.125, 0.0));
        let view = view(size, eye, target, projection);
        for mode in [
            ShadingMode::Gouraud,
            ShadingMode::Phong,
            ShadingMode::UnitVectors,
        ] {
            for tolerance in [0.0, 0.5, 4.0] {
                views.push(View {
                    tolerance,
                    ..view.shaded(mode)
                });
            }
        }
    }
    views
}

/// All buffers of a frame, floats as their bits.
#[derive(PartialEq, Eq)]
pub struct Bits {
    pub pixels: Vec<u32>,
    pub levels: Vec<[u32; 3]>,
    pub triangles: Vec<u32>,
}

impl Bits {
    pub fn of(frame: &Frame) -> Self {
        Bits {
            pixels: frame.pixels().to_vec(),
            levels: frame
                .levels()
                .iter()
                .map(|levels| levels.map(f32::to_bits))
                .collect(),
            triangles: frame.triangles().to_vec(),
        }
    }
}
