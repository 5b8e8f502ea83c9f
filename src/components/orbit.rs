//! The movement of a camera around its target, and the limits that keep the scene in view.
//!
//! The default orbit leaves the camera unchanged, bit for bit. All others look at the target and stay short of
//! the poles, which are the camera's `up` and its opposite. In orthographic projection a zoom changes the height seen
//! alone: the eye and its near plane stay, so that they cut nothing away.

use std::ops::RangeInclusive;

use glam::DVec3;
use hecs::{Entity, World};
use serde::{Deserialize, Serialize};

use super::camera::{Camera, Projection};
use super::entity::get;
use super::mesh::Mesh;
use super::transform::Transform;
use super::vector::{length, unit};
use super::viewer::{active_camera, viewer};

/// The least distance of an orbit from a pole, in degrees, unless the camera's own place is closer.
const POLE_DISTANCE: f64 = 1.0;
/// The factor of distance and height in one step of zoom.
const ZOOM_STEP: f64 = 1.1;
/// The least distance from the target and the least height, as a share of the scene's size.
const CLOSEST: f64 = 0.001;
/// The largest distance and the largest height, as multiples of the scene's size.
const FARTHEST: f64 = 30.0;

/// The movement of a camera from its own place.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, expecting = "a table")]
pub struct Orbit {
    /// Degrees about `up`, to the right as seen from the camera, -180..=180.
    pub azimuth: f64,
    /// Degrees towards `up`.
    pub elevation: f64,
    /// Factor of the distance in perspective, and of the height seen in orthographic projection, > 0; smaller is closer.
    pub zoom: f64,
}

impl Default for Orbit {
    fn default() -> Self {
        Orbit {
            azimuth: 0.0,
            elevation: 0.0,
            zoom: 1.0,
        }
    }
}

impl Orbit {
    /// This orbit moved by these degrees to the right and up, as far as the poles allow. `from` is the camera's own place.
    #[must_use]
    pub fn moved(self, from: &Camera, azimuth: f64, elevation: f64) -> Self {
        let azimuth = self.azimuth + azimuth % 360.0;
        Orbit {
            // A half turn, which is a tie, stays what it is.
            azimuth: azimuth - 360.0 * (azimuth / 360.0).round_ties_even(),
            elevation: from.elevation_short_of_poles(self.elevation + elevation),
            ..self
        }
    }

    /// This orbit moved closer by a number of steps, as far as the `limits` of its zoom allow. From the camera's own
    /// distance, the same number of steps back restores it exactly.
    #[must_use]
    pub fn zoomed(mut self, steps: i32, limits: &RangeInclusive<f64>) -> Self {
        let mut place = -self.zoom.ln() / ZOOM_STEP.ln();
        if (place - place.round()).abs() < 1e-9 {
            place = place.round();
        }
        for _ in 0..steps.unsigned_abs() {
            let next = place + f64::from(steps.signum());
            let zoom = ZOOM_STEP.powf(-next);
            let is_within = if steps > 0 {
                zoom >= *limits.start()
            } else {
                zoom <= *limits.end()
            };
            // Back towards the camera's own distance is always allowed, wherever the scene has put it.
            if next.abs() > place.abs() && !is_within {
                break;
            }
            (place, self.zoom) = (next, zoom);
        }
        self
    }

    /// The zooms that keep the active camera near the scene, and in perspective outside of the cuboids.
    pub fn limits(world: &World) -> RangeInclusive<f64> {
        let from = Camera::own(world, active_camera(world));
        let turned = viewer(world).turned;
        let target = from.target;
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        // The distance from the target to the farthest corner of the cuboid around it; 0 if there is none.
        let mut clearance: f64 = 0.0;
        for (mesh, transform) in world.query::<(&Mesh, &Transform)>().iter() {
            let axes = transform.turned(turned).axes();
            let inside = (axes.transpose() * (target - transform.position)).abs();
            let is_inside = inside.cmple(mesh.corners[7]).all();
            for corner in mesh.corners {
                let corner = axes * corner + transform.position;
                (low, high) = (low.min(corner), high.max(corner));
                if is_inside {
                    clearance = clearance.max(length(corner - target));
                }
            }
        }
        let size = length(high - low);
        let distance = length(from.position - target);
        // A camera that starts closer than the farthest corner is stopped only by the near plane.
        let clearance = if distance > clearance { clearance } else { 0.0 };
        let closest = match viewer(world).projection {
            Projection::Perspective => (clearance.max(size * CLOSEST) + from.near()) / distance,
            Projection::Orthographic => size * CLOSEST / from.height,
        };
        closest..=size * FARTHEST / distance.max(from.height)
    }
}

impl Camera {
    /// The camera of an entity, without its [`Orbit`].
    ///
    /// # Panics
    /// If the entity is no camera.
    pub fn own(world: &World, entity: Entity) -> Camera {
        get(world, entity).expect("the entity is a camera")
    }

    /// The camera of an entity, moved by its [`Orbit`] in the projection of the viewer.
    ///
    /// # Panics
    /// If the entity is no camera.
    pub fn of(world: &World, entity: Entity) -> Camera {
        let own = Camera::own(world, entity);
        let mut orbit: Orbit = get(world, entity).unwrap_or_default();
        let mut moved = own;
        moved.height *= orbit.zoom;
        if viewer(world).projection == Projection::Orthographic {
            orbit.zoom = 1.0;
        }
        if orbit == Orbit::default() {
            return moved;
        }
        let offset = own.position - own.target;
        let up = unit(own.up);
        let right = unit(up.cross(unit(offset)));
        let outwards = right.cross(up);
        let (sin_azimuth, cos_azimuth) = orbit.azimuth.to_radians().sin_cos();
        let elevation = own.own_elevation() + own.elevation_short_of_poles(orbit.elevation);
        let (sin_elevation, cos_elevation) = elevation.to_radians().sin_cos();
        let direction =
            (outwards * cos_azimuth + right * sin_azimuth) * cos_elevation + up * sin_elevation;
        moved.position = own.target + unit(direction) * (length(offset) * orbit.zoom);
        moved
    }

    /// The angle of the camera above its target, in degrees.
    fn own_elevation(&self) -> f64 {
        let offset = unit(self.position - self.target);
        let up = unit(self.up);
        offset.dot(up).atan2(offset.cross(up).length()).to_degrees()
    }

    /// The nearest elevation that stays short of the poles, in degrees from the camera's own. A camera that stands closer
    /// to a pole keeps its place.
    pub fn elevation_short_of_poles(&self, elevation: f64) -> f64 {
        let own = self.own_elevation();
        let limit = (90.0 - POLE_DISTANCE).max(own.abs());
        elevation.clamp(-limit - own, limit - own)
    }
}
