//! The checked input of every command that draws: a scene, the size of the picture, threads and SIMD level.

use std::fmt::{self, Display, Formatter};
use std::num::NonZero;
use std::thread::available_parallelism;

use anyhow::Context;
use fearless_simd::Level;
use hecs::World;
use serde::Serialize;

use crate::components::{Name, Projection, ShadingMode, View, active_camera, common, get};
use crate::output::{one_line, say};
use crate::scene::{Scene, unseen};
use crate::systems::frame::Workers;

/// The largest number of threads: more than the cores of common machines, fewer than the limit of a process.
pub const MAX_THREADS: usize = 1024;

/// A scene and the settings that are not part of it. All of it is valid.
pub struct Drawing {
    /// The scene; options of the command line have overwritten its components.
    pub scene: Scene,
    /// Width and height in pixels, each 1..=16384.
    pub size: [usize; 2],
    /// At least 1.
    pub threads: usize,
    /// A SIMD level of this machine.
    pub level: Level,
}

/// The heading of a report: the scene, and from where it is seen.
#[derive(Clone, Debug, Serialize)]
pub struct Heading {
    pub scene: String,
    pub camera: String,
    pub projection: Projection,
    /// Width and height in pixels.
    pub size: [usize; 2],
}

impl Display for Heading {
    fn fmt(&self, formatter: &mut Formatter) -> fmt::Result {
        let [scene, camera] = [&self.scene, &self.camera].map(one_line);
        let (projection, [width, height]) = (self.projection.name(), self.size);
        write!(
            formatter,
            "{scene}, camera {camera}, {projection}, {width}x{height}"
        )
    }
}

impl Drawing {
    /// The view of a frame.
    pub fn view(&self) -> View {
        View::of(&self.scene.world, self.size)
    }

    /// The heading of a report on it.
    pub fn heading(&self) -> Heading {
        Heading {
            scene: self.scene.name.clone(),
            camera: camera_name(&self.scene.world),
            projection: self.view().projection,
            size: self.size,
        }
    }

    /// The shading mode of all cuboids, or `scene` if they differ.
    pub fn mode(&self) -> &'static str {
        common(&self.scene.world).map_or("scene", ShadingMode::name)
    }

    /// The picture in words: the heading, shading and tolerance.
    pub fn subject(&self) -> String {
        let (heading, mode, tolerance) = (self.heading(), self.mode(), self.view().tolerance);
        format!("{heading}, {mode}, tolerance {tolerance}")
    }

    /// A drawing of the present state, to be changed.
    #[must_use]
    pub fn snapshot(&self) -> Drawing {
        Drawing {
            scene: self.scene.snapshot(),
            ..*self
        }
    }

    /// Says on standard error why nothing is seen, if that is so in a picture with so many pixels of cuboids.
    pub fn say_if_unseen(&self, covered_pixels: u64) {
        if let Some(reason) = unseen::reason(&self.scene.world, &self.view(), covered_pixels) {
            say(&reason);
        }
    }

    /// The threads and the SIMD level.
    ///
    /// # Errors
    /// If the threads cannot be started.
    pub fn workers(&self) -> anyhow::Result<Workers> {
        Workers::new(self.threads, self.level).context("cannot start the threads that draw")
    }
}

/// The name of the active camera.
pub fn camera_name(world: &World) -> String {
    get(world, active_camera(world)).map_or_else(String::new, |Name(name)| name)
}

/// The number of threads that the machine runs in parallel, at most [`MAX_THREADS`].
pub fn all_cores() -> usize {
    available_parallelism()
        .map_or(1, NonZero::get)
        .min(MAX_THREADS)
}
