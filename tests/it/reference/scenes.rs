//! Scenes with results from paper, and views of them.

use glam::DVec3;
use hecs::World;
use shadetrade::components::{LightKind, Material, Projection, Transform, View};
use shadetrade::reference::{Sample, Truth, at_pixel, picture};

use crate::support::scene;

/// kA 0.1, kD 1 and kE 0.5 in every channel.
pub const MATERIAL: Material = Material {
    ambient: DVec3::splat(0.1),
    diffuse: DVec3::ONE,
    specular: DVec3::splat(0.5),
    shininess: 2.0,
};

pub fn spawn_cuboid(world: &mut World, size: [f64; 3], position: [f64; 3]) {
    spawn_turned_cuboid(world, size, position, [0.0; 3], MATERIAL);
}

pub fn spawn_turned_cuboid(
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
    scene::spawn_cuboid(world, size.into(), transform, material);
}

/// A white light of 100 levels.
pub fn spawn_light(world: &mut World, kind: LightKind, position: [f64; 3]) {
    scene::spawn_light(world, kind, DVec3::splat(100.0), position.into());
}

/// A cube from -1 to 1 and one light.
pub fn cube_under(kind: LightKind, position: [f64; 3]) -> World {
    cube_of(MATERIAL, kind, position)
}

/// The same cube with another material.
pub fn cube_of(material: Material, kind: LightKind, position: [f64; 3]) -> World {
    let mut world = World::new();
    spawn_turned_cuboid(&mut world, [2.0; 3], [0.0; 3], [0.0; 3], material);
    spawn_light(&mut world, kind, position);
    world
}

/// A view from `eye` towards `target`, 90 degrees high: at distance d the upper edge of the picture is d above the
/// axis.
pub fn view(size: [usize; 2], eye: [f64; 3], target: [f64; 3]) -> View {
    let mut view = scene::view(size, eye.into(), target.into(), Projection::Perspective);
    view.viewpoint.camera.fov = 90.0;
    view.viewpoint.camera.height = 10.0;
    view.viewpoint.camera.near = Some(0.1);
    view.background = DVec3::new(1.0, 2.0, 3.0);
    view
}

/// A view along -z from z = 5, 10 units high.
pub fn orthographic(size: [usize; 2]) -> View {
    View {
        projection: Projection::Orthographic,
        ..view(size, [0.0, 0.0, 5.0], [0.0; 3])
    }
}

pub fn draw(world: &World, view: &View) -> Truth {
    picture(world, view, 0..view.size[1], &|| false, &|_| ()).expect("it is not cancelled")
}

/// The first channel at a pixel.
pub fn level(world: &World, view: &View, x: usize, y: usize) -> f64 {
    draw(world, view).levels[y * view.size[0] + x][0]
}

pub fn sample(world: &World, view: &View, x: usize, y: usize) -> Sample {
    at_pixel(world, view, x, y).expect("the cuboid is seen there")
}

#[track_caller]
pub fn close(observed: f64, expected: f64) {
    assert!(
        (observed - expected).abs() <= 1e-9 * expected.abs().max(1.0),
        "{observed} is not {expected}"
    );
}

#[track_caller]
pub fn same_place(observed: DVec3, expected: [f64; 3]) {
    assert!(
        (observed - DVec3::from(expected)).length() <= 1e-12,
        "{observed} is not {expected:?}"
    );
}
