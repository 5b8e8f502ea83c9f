//! What every command that draws is handed: a scene, and what is no part of it.
//!
//! A [`Drawing`] is valid; nothing that uses one checks it again.

use std::num::NonZero;
use std::thread::available_parallelism;

use anyhow::Context;
use fearless_simd::Level;

use crate::components::{Budget, Name, ShadingMode, View, active_camera, get, viewer};
use crate::frame::Workers;
use crate::scene::Scene;

/// The most threads that draw: more than machines have cores, fewer than a process may start.
pub const MAX_THREADS: usize = 1024;

/// A scene and how it is drawn, everything checked.
pub struct Drawing {
    /// With what was asked for in its components.
    pub scene: Scene,
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
        View::of(&self.scene.world, self.size)
    }

    /// The longest time of a frame, in milliseconds, where the method is chosen for that.
    pub fn budget(&self) -> Option<f64> {
        let world = &self.scene.world;
        get(world, viewer(world)).and_then(|Budget(budget)| budget)
    }

    /// The name of the camera that is looked through.
    pub fn camera(&self) -> String {
        let world = &self.scene.world;
        get(world, active_camera(world)).map_or_else(String::new, |Name(name)| name)
    }

    /// The mode of all cuboids, or `scene` where they differ.
    pub fn mode(&self) -> &'static str {
        let mut modes = self.scene.world.query::<&ShadingMode>();
        let mut modes = modes.iter().copied();
        let first = modes.next();
        match first.filter(|first| modes.all(|mode| mode == *first)) {
            Some(mode) => mode.name(),
            None => "scene",
        }
    }

    /// What is drawn, in words.
    pub fn subject(&self) -> String {
        let view = self.view();
        let [width, height] = view.size;
        format!(
            "{}, camera {}, {}, {width}x{height}, {}, tolerance {}",
            self.scene.name,
            self.camera(),
            view.projection.name(),
            self.mode(),
            view.tolerance
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
