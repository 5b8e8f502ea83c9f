//! Where the user has moved the camera: ([`Viewpoint`] of the scene, [`Orbit`]) -> [`Viewpoint`] seen.
//!
//! Rule: no orbit gives the scene's own viewpoint bit for bit; every other one stays short of the poles, which are the
//! camera's `up` and its opposite, and keeps looking at the target. Zoom is counted in whole steps, so that as many
//! steps back undo it exactly.

use glam::DVec3;

use crate::components::{Mesh, Transform, Viewpoint, length, unit};
use crate::scene::Scene;

/// How close to a pole the camera comes, in degrees, unless its own place in the scene is closer.
const POLE_DISTANCE: f64 = 1.0;
/// What one step of zoom does to the distance and to the height seen.
const ZOOM_STEP: f64 = 1.1;
/// Where the near plane alone would stop it, the camera comes no closer than this part of the scene's size.
const CLOSEST: f64 = 0.001;
/// The camera goes no further away than so many times the scene's size, nor sees so many times its height: beyond that
/// there would be nothing left to see.
const FARTHEST: f64 = 30.0;

/// How far the camera has gone from its place in the scene.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Orbit {
    /// Degrees about `up`, to the right as seen from the camera, -180..=180.
    pub azimuth: f64,
    /// Degrees towards `up`.
    pub elevation: f64,
    /// Steps of zoom; closer is positive.
    pub zoom: i32,
}

impl Orbit {
    /// This orbit moved by so many degrees to the right and up, as far as the poles allow.
    #[must_use]
    pub fn moved(self, from: &Viewpoint, azimuth: f64, elevation: f64) -> Self {
        let azimuth = self.azimuth + azimuth;
        Orbit {
            azimuth: if azimuth.abs() > 180.0 {
                azimuth - 360.0 * (azimuth / 360.0).round()
            } else {
                azimuth
            },
            elevation: elevation_short_of_poles(from, self.elevation + elevation),
            ..self
        }
    }

    /// This orbit so many steps closer, as far as `limits` allow.
    #[must_use]
    pub fn zoomed(self, steps: i32, limits: &Limits) -> Self {
        let mut zoom = self.zoom;
        for _ in 0..steps.unsigned_abs() {
            let next = zoom + steps.signum();
            // Back towards the scene's own distance is always allowed, wherever the scene has put its camera.
            if next.abs() > zoom.abs() && !limits.allow(next) {
                break;
            }
            zoom = next;
        }
        Orbit { zoom, ..self }
    }

    /// What the distance and the height seen are multiplied by.
    pub fn factor(self) -> f64 {
        ZOOM_STEP.powi(-self.zoom)
    }
}

/// How far zooming may go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Eye to target in the scene, world units.
    distance: f64,
    /// World units seen vertically in the scene.
    height: f64,
    closest: f64,
    farthest: f64,
}

impl Limits {
    /// How far a camera that stands at `from` may zoom in `scene`.
    pub fn of(scene: &Scene, from: &Viewpoint) -> Self {
        let target = from.camera.target;
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let mut clearance: f64 = 0.0;
        for &entity in &scene.cuboids {
            let cuboid = (
                scene.world.get::<&Mesh>(entity),
                scene.world.get::<&Transform>(entity),
            );
            let (Ok(mesh), Ok(transform)) = cuboid else {
                continue;
            };
            let axes = transform.axes();
            let corners = mesh
                .corners
                .map(|corner| axes * corner + transform.position);
            for corner in corners {
                (low, high) = (low.min(corner), high.max(corner));
            }
            let inside = (axes.transpose() * (target - transform.position)).abs();
            if inside.cmple(mesh.corners[7]).all() {
                let reach = corners.map(|corner| length(corner - target));
                clearance = reach.into_iter().fold(clearance, f64::max);
            }
        }
        Limits::new(from, length(high - low), clearance)
    }

    /// `size` is the scene's greatest extent, `clearance` how far the cuboid around the target reaches from it, 0 where
    /// there is none; both in world units.
    pub fn new(from: &Viewpoint, size: f64, clearance: f64) -> Self {
        let distance = length(from.position - from.camera.target);
        // A camera that stands closer than the farthest corner is meant to: only the near plane stops it.
        let clearance = if distance > clearance { clearance } else { 0.0 };
        let closest = clearance.max(size * CLOSEST);
        let closest = match from.camera.near {
            Some(near) => closest + near,
            // The near plane is a thousandth of the distance away and follows it.
            None => closest * (distance / (distance - from.near())),
        };
        Limits {
            distance,
            height: from.camera.height,
            closest,
            farthest: size * FARTHEST,
        }
    }

    /// Whether `zoom` keeps the eye between the near plane and thirty times the scene's size.
    fn allow(&self, zoom: i32) -> bool {
        let factor = Orbit {
            zoom,
            ..Orbit::default()
        }
        .factor();
        let distance = self.distance * factor;
        if zoom > 0 {
            distance >= self.closest
        } else {
            distance.max(self.height * factor) <= self.farthest
        }
    }
}

/// What is seen from where `orbit` has moved the camera that stands at `from`.
pub fn moved_camera(from: &Viewpoint, orbit: &Orbit) -> Viewpoint {
    if *orbit == Orbit::default() {
        return *from;
    }
    let mut moved = *from;
    moved.camera.height *= orbit.factor();
    let offset = from.position - from.camera.target;
    let up = unit(from.camera.up);
    let right = unit(up.cross(unit(offset)));
    let outwards = right.cross(up);
    let (sin_azimuth, cos_azimuth) = orbit.azimuth.to_radians().sin_cos();
    let elevation = own_elevation(from) + elevation_short_of_poles(from, orbit.elevation);
    let (sin_elevation, cos_elevation) = elevation.to_radians().sin_cos();
    let direction =
        (outwards * cos_azimuth + right * sin_azimuth) * cos_elevation + up * sin_elevation;
    moved.position = from.camera.target + unit(direction) * (length(offset) * orbit.factor());
    moved
}

/// How far above its target the scene's camera stands, in degrees.
fn own_elevation(from: &Viewpoint) -> f64 {
    let (offset, up) = (
        unit(from.position - from.camera.target),
        unit(from.camera.up),
    );
    offset.dot(up).atan2(offset.cross(up).length()).to_degrees()
}

/// `elevation`, in degrees from the scene's own, as far as it stays short of the poles; a camera that the scene itself
/// puts closer to one keeps its place.
fn elevation_short_of_poles(from: &Viewpoint, elevation: f64) -> f64 {
    let own = own_elevation(from);
    let limit = (90.0 - POLE_DISTANCE).max(own.abs());
    elevation.clamp(-limit - own, limit - own)
}
