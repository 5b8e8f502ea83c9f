//! One frame's view: from where, how large and how precisely a picture is drawn.

use glam::DVec3;
use hecs::World;

use super::{Background, Projection, ShadingMode, Spin, Tolerance, Viewpoint, active_camera};

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
    /// How far all cuboids have turned about their own x axes, in degrees.
    pub turned: u32,
    /// The mode of every object; `None` leaves each its own [`ShadingMode`].
    pub shading: Option<ShadingMode>,
    /// The largest error of a shaded pixel against the exact evaluation of its mode, in levels, 0..=255.
    pub tolerance: f64,
}

impl View {
    /// What the viewer asks for, in a picture of that size.
    ///
    /// # Panics
    /// When there is no viewer or no camera.
    pub fn of(world: &World, size: [usize; 2]) -> View {
        let mut viewers = world.query::<(&Projection, &Background, &Spin, &Tolerance)>();
        let viewer = viewers.iter().next().expect("a scene has a viewer");
        let (projection, background, spin, tolerance) = viewer;
        View {
            size,
            viewpoint: Viewpoint::of(world, active_camera(world)),
            projection: *projection,
            background: background.0,
            turned: spin.degrees,
            shading: None,
            tolerance: tolerance.0,
        }
    }

    /// How a cuboid is shaded whose own mode is `own`.
    pub fn mode(&self, own: ShadingMode) -> ShadingMode {
        self.shading.unwrap_or(own)
    }

    /// The same with all cuboids shaded so.
    pub fn shaded(&self, mode: ShadingMode) -> View {
        View {
            shading: Some(mode),
            ..self.clone()
        }
    }

    /// The same within so many levels.
    pub fn with_tolerance(&self, levels: f64) -> View {
        View {
            tolerance: levels,
            ..self.clone()
        }
    }
}
