//! The view of one frame: camera, size and precision of a picture.

use glam::DVec3;
use hecs::World;

use super::camera::{Camera, Projection};
use super::surface::{Segments, ShadingMode};
use super::viewer::{active_camera, background, viewer};

/// The settings of one frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Width and height of the picture in pixels, each at least 1.
    pub size: [usize; 2],
    /// The camera, moved by its [`Orbit`](super::Orbit) in this projection.
    pub camera: Camera,
    /// Perspective or orthographic.
    pub projection: Projection,
    /// The colour of pixels without a cuboid, in levels.
    pub background: DVec3,
    /// The rotation of all cuboids about their own x axes, in degrees.
    pub turned: u32,
    /// The mode of every object; `None` leaves each its own [`ShadingMode`].
    pub shading: Option<ShadingMode>,
    /// The segments of every cuboid under Gouraud; `None` leaves each its own [`Segments`].
    pub segments: Option<Segments>,
    /// The largest error of a shaded pixel against the exact evaluation of its mode, in levels, 0..=255.
    pub tolerance: f64,
}

impl View {
    /// The view of the viewer in a picture of this size.
    ///
    /// # Panics
    /// If there is no viewer or no camera.
    pub fn of(world: &World, size: [usize; 2]) -> View {
        let viewer = viewer(world);
        View {
            size,
            camera: Camera::of(world, active_camera(world)),
            projection: viewer.projection,
            background: background(world),
            turned: viewer.turned,
            shading: None,
            segments: None,
            tolerance: viewer.tolerance,
        }
    }

    /// The mode of a cuboid whose own mode is `own`.
    pub fn mode(&self, own: ShadingMode) -> ShadingMode {
        self.shading.unwrap_or(own)
    }

    /// The segments of a cuboid whose own number is `own`.
    pub fn segments(&self, own: Segments) -> Segments {
        self.segments.unwrap_or(own)
    }

    /// The view with one mode for all cuboids.
    pub fn shaded(mut self, mode: ShadingMode) -> View {
        self.shading = Some(mode);
        self
    }

    /// The view in which each cuboid has its own mode and segments.
    pub fn unshaded(mut self) -> View {
        (self.shading, self.segments) = (None, None);
        self
    }

    /// The view with another tolerance, in levels.
    pub fn with_tolerance(mut self, levels: f64) -> View {
        self.tolerance = levels;
        self
    }
}
