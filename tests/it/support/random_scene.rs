//! Random scenes of a few cuboids, with lights anywhere, just above faces and at highlights, and a view of them.

use glam::DVec3;
use hecs::World;
use proptest::prelude::*;
use shadetrade::components::{
    Camera, FileOrder, Light, LightKind, Material, Mesh, Name, Projection, ShadingMode, Transform,
    View, Viewpoint, cuboid as components_of, length, unit,
};

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
            world.spawn(components_of(
                index,
                Name(index.to_string()),
                Transform {
                    position,
                    rotation: cuboid.rotation,
                },
                Mesh::cuboid(cuboid.size),
                Material {
                    ambient: DVec3::new(0.1, 0.2, 0.3),
                    diffuse: DVec3::new(0.9, 0.6, 0.3),
                    specular: DVec3::new(0.3, 0.7, 1.0),
                    shininess: cuboid.shininess,
                },
                self.mode,
            ));
        }
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

/// A number of a scene file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Number {
    Size,
    Position,
    Rotation,
    Ambient,
    Diffuse,
    Specular,
    Shininess,
    Color,
    Intensity,
    Gain,
    LightPosition,
    Eye,
    Target,
    Up,
    Fov,
    Height,
    Near,
    Background,
    /// The height of the eye above a face, which it looks along or down at: not a key, but a combination of several.
    Gap,
}

impl Number {
    /// Chooses the last one as often as five others.
    const ALL: [Number; 23] = [
        Number::Size,
        Number::Position,
        Number::Rotation,
        Number::Ambient,
        Number::Diffuse,
        Number::Specular,
        Number::Shininess,
        Number::Color,
        Number::Intensity,
        Number::Gain,
        Number::LightPosition,
        Number::Eye,
        Number::Target,
        Number::Up,
        Number::Fov,
        Number::Height,
        Number::Near,
        Number::Background,
        Number::Gap,
        Number::Gap,
        Number::Gap,
        Number::Gap,
        Number::Gap,
    ];

    /// The least length above 0 and the largest that the scene format allows.
    fn sizes(self) -> [f64; 2] {
        match self {
            Number::Size | Number::Height | Number::Near => [1e-100, 1e100],
            Number::Rotation => [5e-324, f64::MAX],
            Number::Ambient
            | Number::Diffuse
            | Number::Specular
            | Number::Color
            | Number::Intensity
            | Number::Gain => [5e-324, 1e30],
            Number::Shininess => [5e-324, 1e6],
            Number::Position
            | Number::LightPosition
            | Number::Eye
            | Number::Target
            | Number::Up => [5e-324, 1e100],
            Number::Fov => [5e-324, 179.0],
            Number::Background => [5e-324, 255.0],
            Number::Gap => [1e-12, 1e3],
        }
    }

    fn may_be_negative(self) -> bool {
        use Number::{Eye, LightPosition, Position, Rotation, Target, Up};
        matches!(
            self,
            Position | Rotation | LightPosition | Eye | Target | Up
        )
    }

    fn may_be_zero(self) -> bool {
        !matches!(
            self,
            Number::Size | Number::Height | Number::Near | Number::Fov
        )
    }
}

/// A number of a scene, of any magnitude that the scene format allows.
#[derive(Clone, Debug)]
pub struct Extreme {
    pub number: Number,
    /// The index of the cuboid or light, modulo their number, and of the channel or axis.
    index: usize,
    axis: usize,
    pub value: f64,
}

/// A number by magnitude: 0, the least, the largest, or evenly distributed in the logarithm over all or the usual
/// magnitudes.
pub fn extreme() -> impl Strategy<Value = Extreme> {
    let value = (0..10_u32, 0.0..=1.0, any::<bool>());
    let place = (0..Number::ALL.len(), 0..6_usize, 0..3_usize);
    (place, value).prop_map(
        |((number, index, axis), (kind, share, is_negative)): (_, (u32, f64, bool))| {
            let number = Number::ALL[number];
            let [least, largest] = number.sizes();
            let [from, to] = if kind < 6 {
                [least, largest]
            } else {
                [least.max(1e-20), largest.min(1e20)]
            };
            let size = match kind {
                0 if number.may_be_zero() => 0.0,
                0 | 1 => least,
                2 => largest,
                _ => (from.ln() * (1.0 - share) + to.ln() * share)
                    .exp()
                    .clamp(from, to),
            };
            let is_negative = is_negative && number.may_be_negative();
            Extreme {
                number,
                index,
                axis,
                value: if is_negative { -size } else { size },
            }
        },
    )
}

impl Extreme {
    /// Sets the number if the scene has it.
    pub fn apply(&self, world: &mut World, view: &mut View) {
        let Extreme {
            number,
            index,
            axis,
            value,
        } = *self;
        let eye = &mut view.viewpoint.position;
        let camera = &mut view.viewpoint.camera;
        match number {
            Number::Eye => eye[axis] = value,
            Number::Target => camera.target[axis] = value,
            Number::Up => camera.up[axis] = value,
            Number::Fov => camera.fov = value,
            Number::Height => camera.height = value,
            Number::Near => camera.near = Some(value),
            Number::Background => view.background[axis] = value,
            Number::Gap => {
                let mut query = world.query_mut::<(&Mesh, &mut Transform)>().into_iter();
                let (mesh, transform) = query.next().expect("there is a cuboid");
                if index < 2 {
                    transform.rotation = DVec3::ZERO;
                }
                let axes = transform.axes();
                let mut over = mesh.corners[7] * DVec3::new(0.3, -0.2, 0.34);
                over[axis] = mesh.corners[7][axis] + value;
                let mut ahead = DVec3::new(0.54, 0.31, -0.84);
                ahead[axis] = [0.0, -1e-5, -0.1, -1.0][index % 4];
                *eye = transform.position + axes * over;
                camera.target = *eye + axes * ahead * value.min(1.0);
                camera.up = axes.col(axis) + DVec3::new(1e-3, 2e-3, 0.0);
                camera.near = Some(value * 1e-3);
                camera.height = 3.0 * value;
            }
            Number::Color | Number::Intensity | Number::Gain | Number::LightPosition => {
                let mut lights: Vec<_> = world
                    .query_mut::<(&mut Light, &mut Transform)>()
                    .into_iter()
                    .collect();
                let index = index % lights.len().max(1);
                if let Some((light, transform)) = lights.get_mut(index) {
                    match number {
                        Number::Color => light.color[axis] = value,
                        Number::Intensity => light.intensity = value,
                        Number::Gain => light.gain = value,
                        _ => transform.position[axis] = value,
                    }
                }
            }
            _ => {
                let query = world.query_mut::<(&mut Mesh, &mut Transform, &mut Material)>();
                let mut cuboids: Vec<_> = query.into_iter().collect();
                let index = index % cuboids.len();
                let (mesh, transform, material) = &mut cuboids[index];
                match number {
                    Number::Size => {
                        let mut size = mesh.corners[7] * 2.0;
                        size[axis] = value;
                        **mesh = Mesh::cuboid(size);
                    }
                    Number::Position => transform.position[axis] = value,
                    Number::Rotation => transform.rotation[axis] = value,
                    Number::Ambient => material.ambient[axis] = value,
                    Number::Diffuse => material.diffuse[axis] = value,
                    Number::Specular => material.specular[axis] = value,
                    _ => material.shininess = value,
                }
            }
        }
    }
}

/// Whether the scene format allows this camera.
pub fn is_legal(view: &View) -> bool {
    let Viewpoint { position, camera } = &view.viewpoint;
    let to_target = camera.target - *position;
    length(to_target) >= 1e-100 && unit(camera.up).cross(unit(to_target)).length() >= 1e-9
}
