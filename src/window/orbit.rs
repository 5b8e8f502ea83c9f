//! A drag or a key in, the [`Orbit`] it leads to out.
//!
//! Rule: whatever the steps, an orbit stays short of the poles and within the [`Limits`] of its scene.

use glam::DVec3;

use crate::components::{Mesh, Orbit, Spin, Transform, Viewpoint, length};
use crate::scene::Scene;

/// Where the near plane alone would stop it, the camera comes no closer than this part of the scene's size.
const CLOSEST: f64 = 0.001;
/// The camera goes no further away than so many times the scene's size, nor sees so many times its height: beyond that
/// there would be nothing left to see.
const FARTHEST: f64 = 30.0;

impl Orbit {
    /// This orbit moved by so many degrees to the right and up, as far as the poles allow.
    #[must_use]
    pub fn moved(self, from: &Viewpoint, azimuth: f64, elevation: f64) -> Self {
        // A log may hold any number.
        let azimuth = self.azimuth + azimuth % 360.0;
        Orbit {
            azimuth: if azimuth.abs() > 180.0 {
                azimuth - 360.0 * (azimuth / 360.0).round()
            } else {
                azimuth
            },
            elevation: from.elevation_short_of_poles(self.elevation + elevation),
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
        // How far the cuboid around the target reaches from it, 0 where there is none.
        let mut clearance: f64 = 0.0;
        let mut cuboids = scene.world.query::<(&Mesh, &Transform, &Spin)>();
        for (mesh, transform, spin) in cuboids.iter() {
            let axes = transform.spun(*spin).axes();
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
        let size = length(high - low);
        let distance = length(from.position - target);
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
