//! A scene and the choices made for it, brought together: what every command that draws is handed.
//!
//! Rule: a [`Drawing`] is valid; nothing that uses one checks it again.

use std::num::NonZero;
use std::thread::available_parallelism;

use anyhow::Context;
use fearless_simd::Level;

use crate::components::{Projection, ShadingMode, View};
use crate::frame::Workers;
use crate::scene::Scene;
use crate::shading::MIN_TOLERANCE;

/// The most threads that draw: more than machines have cores, fewer than a process may start.
pub const MAX_THREADS: usize = 1024;

/// The longest side of a picture, in pixels.
pub const MAX_SIDE: usize = 16_384;

/// Whether a picture can be drawn within so many levels.
pub fn is_tolerance(levels: f64) -> bool {
    levels == 0.0 || (MIN_TOLERANCE..=255.0).contains(&levels)
}

/// A scene and how it is to be drawn, everything checked.
pub struct Drawing {
    /// With the lights on that were asked for.
    pub scene: Scene,
    /// Position in the scene's list of cameras.
    pub camera: usize,
    /// How it is projected.
    pub projection: Projection,
    /// How all objects are shaded; `None` leaves each its own.
    pub shading: Option<ShadingMode>,
    /// Levels, 0..=255.
    pub tolerance: f64,
    /// Width and height in pixels, each 1..=16384.
    pub size: [usize; 2],
    /// At least 1.
    pub threads: usize,
    /// One this machine has.
    pub level: Level,
}

impl Drawing {
    /// How a frame of it is drawn.
    pub fn view(&self) -> View {
        View {
            projection: self.projection,
            shading: self.shading,
            tolerance: self.tolerance,
            ..self.scene.view(self.camera, self.size)
        }
    }

    /// The mode of all cuboids, or `scene` where they differ.
    pub fn mode(&self) -> &'static str {
        if let Some(mode) = self.shading {
            return mode.name();
        }
        let mut modes = self.scene.world.query::<&ShadingMode>();
        let mut modes = modes.iter().copied();
        let first = modes.next();
        match first.filter(|first| modes.all(|mode| mode == *first)) {
            Some(mode) => mode.name(),
            None => "scene",
        }
    }

    /// What is drawn, in words; `from` says more about where from.
    pub fn subject(&self, from: &str) -> String {
        let [width, height] = self.size;
        format!(
            "{}, camera {}{from}, {}, {width}x{height}, {}, tolerance {}",
            self.scene.name,
            self.scene.camera_names()[self.camera],
            self.projection.name(),
            self.mode(),
            self.tolerance
        )
    }

    /// Who draws it.
    ///
    /// # Errors
    /// When the system gives no threads.
    pub fn workers(&self) -> anyhow::Result<Workers> {
        Workers::new(self.threads, self.level).context("cannot start the threads that draw")
    }
}

/// As many threads as the machine runs at once.
pub fn all_cores() -> usize {
    available_parallelism()
        .map_or(1, NonZero::get)
        .min(MAX_THREADS)
}
