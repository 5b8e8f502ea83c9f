//! A camera in; the line of sight through every pixel's centre out.
//!
//! Rule: the axes are unit vectors in world space; in intervals every number encloses the exact one.

mod bounds;
mod edge;
mod solid;

use glam::DVec3;

use super::real::Real;
use super::rule::Rule;
use super::vector::Vector;
use crate::components::{Projection, Transform, View};
pub use solid::{Meeting, Place, Solid};

/// Farther away than anything in a scene, in world units.
const FAR: f64 = 1e150;

/// The lines of sight of a picture.
pub struct Sight<R> {
    /// In world units.
    pub eye: DVec3,
    /// Right, up and forward: unit vectors in world space.
    pub axes: [Vector<R>; 3],
    projection: Projection,
    /// Distance of the near plane, in world units.
    near: R,
    /// From one pixel to the next: a slope in perspective, in world units if orthographic.
    pitch: R,
    /// Width and height in pixels.
    size: [usize; 2],
}

/// The line of sight through one pixel's centre: `offset + along * t` from the eye, along the cuboid's axes.
pub struct Line<R> {
    /// How far the line starts from the eye; zero in perspective.
    pub offset: Vector<R>,
    pub along: Vector<R>,
    pixel: [f64; 2],
}

impl<R: Real> Sight<R> {
    /// The lines of sight that `view` asks for, without one of the model's rules.
    pub fn new(view: &View, without: Option<Rule>) -> Self {
        let camera = &view.viewpoint.camera;
        let eye = view.viewpoint.position;
        let to_target = Vector::exact(camera.target) - Vector::exact(eye);
        let forward = to_target.unit();
        let right = forward.cross(Vector::exact(camera.up).unit()).unit();
        let seen = match view.projection {
            Projection::Perspective => {
                let [sin, cos] = R::sin_cos(camera.fov / 2.0);
                R::of(2.0) * sin / cos
            }
            Projection::Orthographic => R::of(camera.height),
        };
        Sight {
            eye,
            axes: [right, right.cross(forward), forward],
            projection: view.projection,
            near: match (camera.near, view.projection) {
                (_, Projection::Perspective) if without == Some(Rule::NearPlane) => R::of(0.0),
                (_, Projection::Orthographic) if without == Some(Rule::NearPlane) => R::of(-FAR),
                (Some(near), _) => R::of(near),
                (None, _) => to_target.dot(forward) / R::of(1000.0),
            },
            pitch: seen / R::of(view.size[1] as f64),
            size: view.size,
        }
    }
}

/// A cuboid's axes in world space, the columns of Rz * Ry * Rx.
fn own_axes<R: Real>(transform: &Transform) -> [Vector<R>; 3] {
    let [[sx, cx], [sy, cy], [sz, cz]]: [[R; 2]; 3] = transform.rotation.to_array().map(sin_cos);
    [
        Vector([cz * cy, sz * cy, -sy]),
        Vector([cz * sy * sx - sz * cx, sz * sy * sx + cz * cx, cy * sx]),
        Vector([cz * sy * cx + sz * sx, sz * sy * cx - cz * sx, cy * cx]),
    ]
}

/// Sine and cosine of an angle in degrees.
fn sin_cos<R: Real>(degrees: f64) -> [R; 2] {
    // The remainder of a division of floats is exact, and so is the rest of a quarter turn.
    let turn = degrees % 360.0;
    let quarters = (turn / 90.0).round();
    let [sin, cos] = R::sin_cos(turn - 90.0 * quarters);
    match quarters.rem_euclid(4.0) as u8 {
        0 => [sin, cos],
        1 => [cos, -sin],
        2 => [-sin, -cos],
        _ => [-cos, sin],
    }
}

#[cfg(test)]
mod tests;
