//! From where a picture is seen: a camera, how far it has been moved, and what one frame asks for.
//!
//! ```text
//! Transform, Camera --Orbit--> Viewpoint --in a View--> Lens
//! ```
//!
//! Rule: no orbit gives the scene's own viewpoint bit for bit; every other one stays short of the poles, which are the
//! camera's `up` and its opposite, and keeps looking at the target.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::{ShadingMode, length, unit};

/// How close to a pole an orbit comes, in degrees, unless the camera's own place is closer.
const POLE_DISTANCE: f64 = 1.0;
/// What one step of zoom does to the distance and to the height seen.
const ZOOM_STEP: f64 = 1.1;

/// A camera; it stands at its [`super::Transform`]'s position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
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

impl Camera {
    /// Distance of the near plane of a camera that stands at `position`, in world units.
    pub fn near_from(&self, position: DVec3) -> f64 {
        self.near
            .unwrap_or_else(|| length(self.target - position) * 1e-3)
    }
}

/// The camera that the window looks from; exactly one of a scene's cameras has it.
#[derive(Clone, Copy, Debug)]
pub struct ActiveCamera;

/// How far a camera has gone from its own place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Orbit {
    /// Degrees about `up`, to the right as seen from the camera, -180..=180.
    pub azimuth: f64,
    /// Degrees towards `up`.
    pub elevation: f64,
    /// Steps of zoom; closer is positive. Whole steps, so that as many back undo them exactly.
    pub zoom: i32,
}

impl Orbit {
    /// What the distance and the height seen are multiplied by.
    pub fn factor(self) -> f64 {
        ZOOM_STEP.powi(-self.zoom)
    }
}

/// How the picture is formed from the camera.
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

    /// What the command line, reports and the window call it.
    pub const fn name(self) -> &'static str {
        match self {
            Projection::Perspective => "perspective",
            Projection::Orthographic => "orthographic",
        }
    }
}

/// A camera resolved for one frame: where it stands and what it sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewpoint {
    /// The eye, in world units.
    pub position: DVec3,
    /// See [`Camera`].
    pub camera: Camera,
}

impl Viewpoint {
    /// The unit vectors right, up and forward in world space.
    pub fn axes(&self) -> [DVec3; 3] {
        let forward = unit(self.camera.target - self.position);
        let right = unit(forward.cross(unit(self.camera.up)));
        [right, right.cross(forward), forward]
    }

    /// World units from one pixel's centre to the next in a picture `rows` pixels high: on the plane at distance 1
    /// in perspective, on every plane in orthographic projection.
    pub fn pixel_pitch(&self, projection: Projection, rows: usize) -> f64 {
        let seen = match projection {
            Projection::Perspective => 2.0 * (self.camera.fov / 2.0).to_radians().tan(),
            Projection::Orthographic => self.camera.height,
        };
        seen / rows as f64
    }

    /// Distance of the near plane, in world units.
    pub fn near(&self) -> f64 {
        self.camera.near_from(self.position)
    }

    /// What is seen from where `orbit` moves the camera that stands here.
    #[must_use]
    pub fn orbited(&self, orbit: &Orbit) -> Viewpoint {
        if *orbit == Orbit::default() {
            return *self;
        }
        let mut moved = *self;
        moved.camera.height *= orbit.factor();
        let offset = self.position - self.camera.target;
        let up = unit(self.camera.up);
        let right = unit(up.cross(unit(offset)));
        let outwards = right.cross(up);
        let (sin_azimuth, cos_azimuth) = orbit.azimuth.to_radians().sin_cos();
        let elevation = self.own_elevation() + self.elevation_short_of_poles(orbit.elevation);
        let (sin_elevation, cos_elevation) = elevation.to_radians().sin_cos();
        let direction =
            (outwards * cos_azimuth + right * sin_azimuth) * cos_elevation + up * sin_elevation;
        moved.position = self.camera.target + unit(direction) * (length(offset) * orbit.factor());
        moved
    }

    /// How far above its target the camera stands, in degrees.
    fn own_elevation(&self) -> f64 {
        let offset = unit(self.position - self.camera.target);
        let up = unit(self.camera.up);
        offset.dot(up).atan2(offset.cross(up).length()).to_degrees()
    }

    /// `elevation`, in degrees from the camera's own, as far as it stays short of the poles; a camera that stands closer
    /// to one than an orbit goes keeps its place.
    pub fn elevation_short_of_poles(&self, elevation: f64) -> f64 {
        let own = self.own_elevation();
        let limit = (90.0 - POLE_DISTANCE).max(own.abs());
        elevation.clamp(-limit - own, limit - own)
    }
}

/// How one frame is to be drawn.
#[derive(Clone, Debug)]
pub struct View {
    /// Width and height of the picture in pixels, each at least 1.
    pub size: [usize; 2],
    /// Where from.
    pub viewpoint: Viewpoint,
    /// How it is projected.
    pub projection: Projection,
    /// The colour where nothing is drawn, in levels.
    pub background: DVec3,
    /// The mode of every object; `None` leaves each its own [`ShadingMode`].
    pub shading: Option<ShadingMode>,
    /// The largest error of a shaded pixel against the exact evaluation of its mode, in levels, 0..=255.
    pub tolerance: f64,
}

impl View {
    /// The same with all cuboids shaded so.
    pub fn shaded(&self, mode: ShadingMode) -> View {
        View {
            shading: Some(mode),
            ..self.clone()
        }
    }
}

/// A [`View`]'s camera, ready to project: what every stage of one frame sees through.
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
    /// See [`Viewpoint::pixel_pitch`].
    pub pitch: f64,
    /// Half the picture's width and height in pixels.
    pub half: [f64; 2],
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_near_plane_is_a_thousandth_of_the_distance_to_the_target_unless_it_is_given() {
        let camera = Camera {
            target: DVec3::new(1.0, 5.0, 2.0),
            up: DVec3::Y,
            fov: 30.0,
            height: 1.0,
            near: None,
        };
        let viewpoint = |near| Viewpoint {
            position: DVec3::new(1.0, 1.0, -1.0),
            camera: Camera { near, ..camera },
        };
        // (0, 4, 3) is five long.
        assert!((viewpoint(None).near() - 5e-3).abs() < 1e-17);
        assert_eq!(viewpoint(Some(0.25)).near(), 0.25);
    }
}
