//! Random scenes of a few cuboids, with lights anywhere, just above faces and at highlights, and a view of them.

use glam::DVec3;
use hecs::World;
use proptest::prelude::*;
use shadetrade::components::{
    Camera, FileOrder, Light, LightKind, Material, Name, Projection, ShadingMode, Transform, View,
    Viewpoint, overwrite,
};

use super::scene::spawn_cuboid;

/// Lengths are in multiples of the first cuboid's radius and positions relative to its centre, except in `cuboids`.
#[derive(Clone, Debug)]
pub struct Case {
    offset: DVec3,
    cuboids: Vec<Cuboid>,
    lights: Vec<Lamp>,
    eye: DVec3,
    target: DVec3,
    up: DVec3,
    fov: f64,
    height: f64,
    near: f64,
    projection: Projection,
    mode: ShadingMode,
}

#[derive(Clone, Debug)]
struct Cuboid {
    size: DVec3,
    place: DVec3,
    rotation: DVec3,
    shininess: f64,
}

#[derive(Clone, Debug)]
struct Lamp {
    kind: LightKind,
    intensity: f64,
    color: DVec3,
    place: Place,
}

#[derive(Clone, Debug)]
enum Place {
    /// Relative to the centre, in multiples of the radius.
    Anywhere(DVec3),
    /// Above a face of the first cuboid: the axis perpendicular to it, the position on it (-1..1), and the height in
    /// multiples of the radius.
    OverFace(usize, DVec3, f64),
    /// Where a point of the face, given likewise, reflects it to the eye, at this distance from the point.
    InMirror(usize, DVec3, f64),
}

/// Evenly distributed in the logarithm.
pub fn between(least: f64, most: f64) -> impl Strategy<Value = f64> {
    (least.ln()..most.ln()).prop_map(f64::exp)
}

fn vector(size: f64) -> impl Strategy<Value = DVec3> {
    [-size..size, -size..size, -size..size].prop_map(DVec3::from)
}

fn direction() -> impl Strategy<Value = DVec3> {
    vector(1.0)
        .prop_filter("has a direction", |v| v.length() > 0.1)
        .prop_map(DVec3::normalize)
}

fn cuboid() -> impl Strategy<Value = Cuboid> {
    let size = [
        between(0.01, 100.0),
        between(0.01, 100.0),
        between(0.01, 100.0),
    ];
    let shininess =
        prop_oneof![4 => between(0.5, 1000.0), 1 => between(1000.0, 1e6), 1 => Just(0.0)];
    (size, vector(1.5), vector(400.0), shininess).prop_map(|(size, place, rotation, shininess)| {
        Cuboid {
            size: size.into(),
            place,
            rotation,
            shininess,
        }
    })
}

fn lamp() -> impl Strategy<Value = Lamp> {
    let kind = prop_oneof![
        1 => Just(LightKind::Ambient),
        2 => Just(LightKind::Diffuse),
        3 => Just(LightKind::Specular),
    ];
    let over = (0..3_usize, vector(1.0), between(1e-4, 1.0));
    let mirrored = (0..3_usize, vector(1.0), between(0.01, 10.0));
    let place = prop_oneof![
        (direction(), between(0.3, 30.0)).prop_map(|(d, reach)| Place::Anywhere(d * reach)),
        over.prop_map(|(axis, at, height)| Place::OverFace(axis, at, height)),
        mirrored.prop_map(|(axis, at, reach)| Place::InMirror(axis, at, reach)),
    ];
    let color = [0.0..1.0, 0.0..1.0, 0.0..1.0].prop_map(DVec3::from);
    (kind, between(10.0, 2000.0), color, place).prop_map(|(kind, intensity, color, place)| Lamp {
        kind,
        intensity,
        color,
        place,
    })
}

/// A random scene in one shading mode.
pub fn case(mode: ShadingMode) -> impl Strategy<Value = Case> {
    let offset = prop_oneof![3 => Just(DVec3::ZERO), 1 => vector(1e6)];
    let things = (
        offset,
        prop::collection::vec(cuboid(), 1..4),
        prop::collection::vec(lamp(), 0..6),
    );
    let eye = (direction(), between(0.3, 20.0)).prop_map(|(d, reach)| d * reach);
    let projection = prop_oneof![
        Just(Projection::Perspective),
        Just(Projection::Orthographic)
    ];
    let sight = (
        eye,
        vector(0.3),
        direction(),
        between(3.0, 150.0),
        between(0.1, 4.0),
        between(1e-3, 1.0),
    );
    (things, sight, projection)
        .prop_map(
            move |((offset, cuboids, lights), (eye, target, up, fov, height, near), projection)| {
                Case {
                    offset,
                    cuboids,
                    lights,
                    eye,
                    target,
                    up,
                    fov,
                    height,
                    near,
                    projection,
                    mode,
                }
            },
        )
        .prop_filter("up is not the view direction", |case| {
            case.up.cross((case.target - case.eye).normalize()).length() > 0.01
        })
}

impl Case {
    /// The scene and a view of it.
    pub fn build(&self, size: [usize; 2], tolerance: f64) -> (World, View) {
        let first = &self.cuboids[0];
        let radius = first.size.length() / 2.0;
        let place = |place: DVec3| self.offset + place * radius;
        let mut world = World::new();
        for (index, cuboid) in self.cuboids.iter().enumerate() {
            let position = if index == 0 {
                self.offset
            } else {
                place(cuboid.place)
            };
            let transform = Transform {
                position,
                rotation: cuboid.rotation,
            };
            let material = Material {
                ambient: DVec3::new(0.1, 0.2, 0.3),
                diffuse: DVec3::new(0.9, 0.6, 0.3),
                specular: DVec3::new(0.3, 0.7, 1.0),
                shininess: cuboid.shininess,
            };
            spawn_cuboid(&mut world, cuboid.size, transform, material);
        }
        overwrite(&mut world, &self.mode);
        let axes = Transform {
            position: self.offset,
            rotation: first.rotation,
        }
        .axes();
        let on_face = |axis: usize, mut at: DVec3| {
            at[axis] = 1.0_f64.copysign(at[axis]);
            at
        };
        for (index, lamp) in self.lights.iter().enumerate() {
            let position = match lamp.place {
                Place::Anywhere(at) => place(at),
                Place::OverFace(axis, at, height) => {
                    let mut local = on_face(axis, at) * first.size / 2.0;
                    local[axis] += (height * radius).copysign(at[axis]);
                    self.offset + axes * local
                }
                Place::InMirror(axis, at, reach) => {
                    let at = on_face(axis, at);
                    let point = axes * (at * first.size / 2.0);
                    let to_eye = match self.projection {
                        Projection::Perspective => self.eye * radius - point,
                        Projection::Orthographic => self.eye - self.target,
                    };
                    let (normal, to_eye) = ((axes * at).normalize(), to_eye.normalize());
                    let to_light = 2.0 * normal.dot(to_eye) * normal - to_eye;
                    self.offset + point + to_light * reach * radius
                }
            };
            let light = Light {
                kind: lamp.kind,
                color: lamp.color,
                intensity: lamp.intensity,
                gain: 1.0,
                on: true,
            };
            world.spawn((
                Name(index.to_string()),
                FileOrder(index as u32),
                Transform::at(position),
                light,
            ));
        }
        let camera = Camera {
            target: place(self.target),
            up: self.up,
            fov: self.fov,
            height: self.height * radius,
            near: Some(self.near * radius),
        };
        let view = View {
            size,
            viewpoint: Viewpoint {
                position: place(self.eye),
                camera,
            },
            projection: self.projection,
            background: DVec3::new(20.0, 20.0, 24.0),
            turned: 0,
            shading: None,
            tolerance,
        };
        (world, view)
    }
}
