//! Scenes in; pictures out.
//!
//! Rule: one renderer draws all of a case with the same instructions and threads.

use anyhow::anyhow;
use fearless_simd::Level;
use rayon::ThreadPoolBuildError;

use super::scene_spec::{RenderConfig, SceneSpec};
use crate::components::View;
use crate::frame::{Frame, Keep, NO_TRIANGLE, Workers};
use crate::systems;

/// Draws scenes as levels and as a window shows them.
pub struct Renderer {
    pub levels: Frame,
    pub display: Frame,
    /// Whether everything is drawn that the table says, or only what a test has time for.
    pub full: bool,
}

/// A picture of levels.
pub struct Picture {
    pub view: View,
    /// Unclamped levels, row by row from the top.
    pub levels: Vec<[f32; 3]>,
    /// Cuboid * 12 + triangle, or [`NO_TRIANGLE`].
    pub triangles: Vec<u32>,
    pub specular_evaluations: u64,
}

impl Renderer {
    /// A renderer with these instructions and so many threads.
    ///
    /// # Errors
    /// When the system gives no threads.
    pub fn new(level: Level, threads: usize, full: bool) -> Result<Self, ThreadPoolBuildError> {
        Ok(Renderer {
            levels: Frame::new(Keep::Levels, Workers::new(threads, level)?),
            display: Frame::new(Keep::Display, Workers::new(threads, level)?),
            full,
        })
    }

    pub fn workers(&self) -> &Workers {
        self.levels.workers()
    }

    /// Draws a picture of levels.
    ///
    /// # Errors
    /// When the format refuses the scene, or the picture does not fit in memory.
    pub fn picture(&mut self, spec: &SceneSpec, config: RenderConfig) -> anyhow::Result<Picture> {
        let mut scene = spec.parse()?;
        let view = spec.view(&scene, config);
        systems::draw(&mut scene.world, &view, &mut self.levels)?;
        Ok(Picture {
            view,
            levels: self.levels.levels().to_vec(),
            triangles: self.levels.triangles().to_vec(),
            specular_evaluations: self.levels.counts().specular_evaluations,
        })
    }
}

impl Picture {
    /// How many pixels show a cuboid.
    pub fn covered(&self) -> u64 {
        let shown = self.triangles.iter().filter(|id| **id != NO_TRIANGLE);
        shown.count() as u64
    }

    /// The first pixel that shows a cuboid and is not as `is_right` demands of its triangle and levels, as an error.
    ///
    /// # Errors
    /// When there is one.
    pub fn expect(&self, is_right: impl Fn(u32, [f32; 3]) -> bool) -> anyhow::Result<()> {
        for (pixel, (&id, &levels)) in self.triangles.iter().zip(&self.levels).enumerate() {
            if id != NO_TRIANGLE && !is_right(id, levels) {
                let what = format!("shows {} with levels {levels:?}", name(id));
                return Err(wrong_pixel(&self.view, pixel, &what));
            }
        }
        Ok(())
    }

    /// Compares with a picture that must have the same bits.
    ///
    /// # Errors
    /// When a pixel differs.
    pub fn expect_bits_of(&self, other: &Picture) -> anyhow::Result<()> {
        for pixel in 0..self.triangles.len() {
            let bits = |it: &Picture| (it.triangles[pixel], it.levels[pixel].map(f32::to_bits));
            if bits(self) != bits(other) {
                return Err(wrong_pixel(&self.view, pixel, "differs"));
            }
        }
        Ok(())
    }
}

/// What is shown, in words.
pub fn name(id: u32) -> String {
    match id {
        NO_TRIANGLE => "the background".to_owned(),
        _ => format!("triangle {} of cuboid {}", id % 12, id / 12),
    }
}

/// What is wrong at a pixel, counted row by row from the top.
pub fn wrong_pixel(view: &View, pixel: usize, what: &str) -> anyhow::Error {
    let [x, y] = [pixel % view.size[0], pixel / view.size[0]];
    let mode = view.shading.map_or("", |mode| mode.name());
    anyhow!(
        "pixel {x},{y} {what} ({mode}, {}, tolerance {})",
        view.projection.name(),
        view.tolerance
    )
}
