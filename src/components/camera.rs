//! A camera, its projection, and the lens of one frame.
//!
//! ```text
//! Camera --Orbit--> Camera --in a View--> Lens
//! ```

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::vector::{length, unit};
use super::view::View;

/// A camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The eye, in world units.
    pub position: DVec3,
    /// The point it looks at, in world units.
    pub target: DVec3,
    /// The direction that is up in the picture; not parallel to the view.
    pub up: DVec3,
    /// The vertical field of view in degrees, (0, 179]; perspective.
    pub fov: f64,
    /// World units seen vertically, > 0; orthographic.
    pub height: f64,
    /// Distance of the near plane, > 0; `None` is a thousandth of the distance to the target.
    pub near: Option<f64>,
}

/// The projection of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Projection {
    /// Rays leave the eye; the vertical field of view sets the scale.
    #[default]
    Perspective,
    /// Rays are parallel to the view direction; the seen height sets the scale.
    Orthographic,
}

impl Projection {
    /// The usual one first.
    pub const ALL: [Projection; 2] = [Projection::Perspective, Projection::Orthographic];

    /// The name on the command line, in reports and in the window.
    pub const fn name(self) -> &'static str {
        match self {
            Projection::Perspective => "perspective",
            Projection::Orthographic => "orthographic",
        }
    }
}

impl Camera {
    /// The unit vectors right, up and forward in world space.
    pub fn axes(&self) -> [DVec3; 3] {
        let forward = unit(self.target - self.position);
        let right = unit(forward.cross(unit(self.up)));
        [right, right.cross(forward), forward]
    }

    /// World units from one pixel's centre to the next in a picture `rows` pixels high: on the plane at distance 1
    /// in perspective, on every plane in orthographic projection.
    pub fn pixel_pitch(&self, projection: Projection, rows: usize) -> f64 {
        let seen = match projection {
            Projection::Perspective => 2.0 * (self.fov / 2.0).to_radians().tan(),
            Projection::Orthographic => self.height,
        };
        seen / rows as f64
    }

    /// The camera at the same place that sees `factor` times as much in height and width.
    #[must_use]
    pub fn widened(mut self, factor: f64) -> Camera {
        if factor != 1.0 {
            let seen = factor * (self.fov / 2.0).to_radians().tan();
            self.fov = 2.0 * seen.atan().to_degrees();
            self.height *= factor;
        }
        self
    }

    /// Distance of the near plane, in world units.
    pub fn near(&self) -> f64 {
        let to_target = || length(self.target - self.position);
        self.near.unwrap_or_else(|| to_target() * 1e-3)
    }
}

/// The camera of one [`View`](super::View) in the form that projects points.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lens {
    /// Right, up and forward: unit vectors in world space.
    pub axes: [DVec3; 3],
    /// In world units.
    pub eye: DVec3,
    /// Distance of the near plane in world units.
    pub near: f64,
    /// Perspective or orthographic.
    pub projection: Projection,
    /// See [`Camera::pixel_pitch`].
    pub pitch: f64,
    /// The middle of the picture, in pixels from its corner.
    pub middle: [f64; 2],
}

impl Lens {
    /// The lens of a view.
    pub fn new(view: &View) -> Self {
        Lens {
            axes: view.camera.axes(),
            eye: view.camera.position,
            near: view.camera.near(),
            projection: view.projection,
            pitch: view.camera.pixel_pitch(view.projection, view.size[1]),
            middle: view.size.map(|pixels| pixels as f64 / 2.0),
        }
    }

    /// A point of the world relative to the eye, along right, up and forward.
    pub fn seen(&self, point: DVec3) -> DVec3 {
        let offset = point - self.eye;
        self.axes.map(|axis| offset.dot(axis)).into()
    }

    /// A point relative to the eye, given along right, up and forward, in homogeneous screen coordinates: x / w and
    /// y / w are world units on the plane whose pixels are [`Lens::pitch`] apart.
    pub fn homogeneous(&self, seen: DVec3) -> DVec3 {
        match self.projection {
            Projection::Perspective => seen,
            Projection::Orthographic => DVec3::new(seen.x, seen.y, 1.0),
        }
    }

    /// The projection of such a homogeneous point, in pixels from the top left corner; `w` must be positive.
    pub fn pixel(&self, point: DVec3) -> [f64; 2] {
        [
            self.middle[0] + point.x / point.z / self.pitch,
            self.middle[1] - point.y / point.z / self.pitch,
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_near_plane_is_a_thousandth_of_the_distance_to_the_target_unless_it_is_given() {
        let camera = |near| Camera {
            position: DVec3::new(1.0, 1.0, -1.0),
            target: DVec3::new(1.0, 5.0, 2.0),
            up: DVec3::Y,
            fov: 30.0,
            height: 1.0,
            near,
        };
        // (0, 4, 3) is five long.
        assert!((camera(None).near() - 5e-3).abs() < 1e-17);
        assert_eq!(camera(Some(0.25)).near(), 0.25);
    }
}
