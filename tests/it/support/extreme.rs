//! Numbers of a scene at any magnitude that the scene format allows.

use glam::DVec3;
use hecs::World;
use proptest::prelude::*;
use shadetrade::components::{Light, Material, Mesh, Transform, View, Viewpoint, length, unit};

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

/// Numbers with their least size above 0, their largest size, whether they may be negative, and whether they may be 0.
const NUMBERS: [(Number, [f64; 2], bool, bool); 19] = [
    (Number::Size, [1e-100, 1e100], false, false),
    (Number::Position, [5e-324, 1e100], true, true),
    (Number::Rotation, [5e-324, f64::MAX], true, true),
    (Number::Ambient, [5e-324, 1e30], false, true),
    (Number::Diffuse, [5e-324, 1e30], false, true),
    (Number::Specular, [5e-324, 1e30], false, true),
    (Number::Shininess, [5e-324, 1e6], false, true),
    (Number::Color, [5e-324, 1e30], false, true),
    (Number::Intensity, [5e-324, 1e30], false, true),
    (Number::Gain, [5e-324, 1e30], false, true),
    (Number::LightPosition, [5e-324, 1e100], true, true),
    (Number::Eye, [5e-324, 1e100], true, true),
    (Number::Target, [5e-324, 1e100], true, true),
    (Number::Up, [5e-324, 1e100], true, true),
    (Number::Fov, [5e-324, 179.0], false, false),
    (Number::Height, [1e-100, 1e100], false, false),
    (Number::Near, [1e-100, 1e100], false, false),
    (Number::Background, [5e-324, 255.0], false, true),
    (Number::Gap, [1e-12, 1e3], false, true),
];

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
    // The last one is chosen as often as five others.
    let place = (0..NUMBERS.len() + 4, 0..6_usize, 0..3_usize);
    (place, value).prop_map(
        |((number, index, axis), (kind, share, is_negative)): (_, (u32, f64, bool))| {
            let (number, [least, largest], may_be_negative, may_be_zero) =
                NUMBERS[number.min(NUMBERS.len() - 1)];
            let [from, to] = if kind < 6 {
                [least, largest]
            } else {
                [least.max(1e-20), largest.min(1e20)]
            };
            let size = match kind {
                0 if may_be_zero => 0.0,
                0 | 1 => least,
                2 => largest,
                _ => (from.ln() * (1.0 - share) + to.ln() * share)
                    .exp()
                    .clamp(from, to),
            };
            let is_negative = is_negative && may_be_negative;
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
