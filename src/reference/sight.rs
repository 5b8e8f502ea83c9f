//! The camera of the reference: lines of sight through pixel centres, and the part of the picture that may show a cuboid.
//!
//! In intervals every number encloses the exact one.

use std::cmp::Ordering;
use std::ops::Range;

use glam::DVec3;

use super::edge::EDGE;
use super::interval::Interval;
use super::real::{Real, RealVector};
use super::rule::Rule;
use crate::components::{Mesh, Projection, Transform, View};

/// Larger than any distance in a scene, in world units.
const FAR: f64 = 1e150;

/// The lines of sight of a picture.
pub struct Sight<R> {
    /// In world units.
    pub eye: DVec3,
    /// Right, up and forward: unit vectors in world space.
    pub axes: [RealVector<R>; 3],
    pub projection: Projection,
    /// Distance of the near plane, in world units.
    pub near: R,
    /// Distance between neighbouring pixels: a slope in perspective, world units in orthographic projection.
    pub pitch: R,
    /// Width and height in pixels.
    pub size: [usize; 2],
}

/// A place in the picture.
#[derive(Clone, Copy)]
pub struct Place {
    /// From the picture's centre, in pixels right and down.
    pub offset: [f64; 2],
    /// Within this many pixels of an edge, an interval does not decide the side of the edge.
    pub margin: f64,
}

/// The line of sight through a place, `start + direction * t`, relative to the eye and in the cuboid's axes.
pub struct Line<R> {
    /// Relative to the eye; zero in perspective.
    pub start: RealVector<R>,
    pub direction: RealVector<R>,
    pub place: Place,
}

impl<R: Real> Sight<R> {
    /// The lines of sight of `view`, without a rule of the model if one is given.
    pub fn new(view: &View, without: Option<Rule>) -> Self {
        let camera = &view.camera;
        let eye = view.camera.position;
        let to_target = RealVector::exact(camera.target) - RealVector::exact(eye);
        let forward = to_target.unit();
        let right = forward.cross(RealVector::exact(camera.up).unit()).unit();
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

impl<R> Sight<R> {
    /// The centre of a pixel, which may show either side of an edge nearby.
    pub fn centre(&self, pixel: [usize; 2]) -> Place {
        let offset = [0, 1].map(|axis| pixel[axis] as f64 + 0.5 - self.size[axis] as f64 / 2.0);
        Place {
            offset,
            margin: EDGE,
        }
    }
}

impl Sight<Interval> {
    /// The columns and rows in which a cuboid may be visible; all of them if a corner may be behind the eye in
    /// perspective. The corners are projected in intervals, so the bounds hold every pixel that may show the cuboid.
    pub fn bounds(&self, transform: &Transform, mesh: &Mesh) -> [Range<usize>; 2] {
        let axes = own_axes(transform);
        let centre = RealVector::exact(transform.position) - RealVector::exact(self.eye);
        let seen = mesh.corners.map(|corner| {
            let [x, y, z] = corner.to_array().map(Interval::of);
            let from_eye = centre + axes[0] * x + axes[1] * y + axes[2] * z;
            self.axes.map(|axis| axis.dot(from_eye))
        });
        let depths = seen.map(|[_, _, depth]| depth);
        let is_before = |depth: &Interval| (*depth - self.near).sign(0.0) == Some(Ordering::Less);
        if depths.iter().all(is_before) {
            return [0..0, 0..0];
        }
        let is_behind = |depth: &Interval| depth.sign(0.0) != Some(Ordering::Greater);
        let is_perspective = self.projection == Projection::Perspective;
        if is_perspective && depths.iter().any(is_behind) {
            return self.size.map(|side| 0..side);
        }
        [0, 1].map(|axis| {
            let place = |[x, y, depth]: [Interval; 3]| {
                let offset = if axis == 0 { x } else { -y };
                let on_screen = if is_perspective {
                    offset / depth
                } else {
                    offset
                };
                on_screen / self.pitch
            };
            let places = seen.map(place).into_iter().reduce(Interval::either);
            let [least, largest] = places.unwrap_or(Interval::ALL).endpoints();
            let middle = self.size[axis] as f64 / 2.0;
            // One more pixel on each side, for edges. The conversion to integers saturates.
            let end = ((middle + largest + 2.0) as usize).min(self.size[axis]);
            ((middle + least - 1.0) as usize).min(end)..end
        })
    }
}

/// A cuboid's axes in world space, the columns of Rz * Ry * Rx.
pub fn own_axes<R: Real>(transform: &Transform) -> [RealVector<R>; 3] {
    let angles = transform.rotation;
    let [[sx, cx], [sy, cy], [sz, cz]]: [[R; 2]; 3] =
        [sin_cos(angles.x), sin_cos(angles.y), sin_cos(angles.z)];
    [
        RealVector([cz * cy, sz * cy, -sy]),
        RealVector([cz * sy * sx - sz * cx, sz * sy * sx + cz * cx, cy * sx]),
        RealVector([cz * sy * cx + sz * sx, sz * sy * cx - cz * sx, cy * cx]),
    ]
}

/// Sine and cosine of an angle in degrees.
fn sin_cos<R: Real>(degrees: f64) -> [R; 2] {
    // The remainder of floats is exact, and so is the difference to the nearest quarter turn.
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
