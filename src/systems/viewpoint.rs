//! Computes the lens of a view (the axes of its camera, near plane and scale) and the lines of sight, once per frame.

use glam::DVec3;
use hecs::World;

use crate::components::{Lens, Projection, View};
use crate::frame::Frame;
use crate::shading::face::Rays;

/// Overwrites the frame's [`Rays`] and their [`Lens`].
pub fn run(_world: &mut World, view: &View, frame: &mut Frame) {
    frame.list.rays = Rays::new(&Lens::new(view));
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
