//! Settings in, what the renderer makes of them out.
//!
//! Rule: one bench draws all of a case with the same instructions and threads.

mod comparison;

use fearless_simd::Level;
use rayon::ThreadPoolBuildError;

use super::setting::{Setting, Way};
use crate::components::{Projection, ShadingMode, View};
use crate::frame::{Frame, Keep, NO_TRIANGLE, Workers};
use crate::memory::OutOfMemory;
use crate::scene::{Scene, SceneError};
use crate::systems;
pub use comparison::{Distance, enclosures, enough, wrong};

/// What goes wrong with a case other than its picture.
#[derive(Debug, thiserror::Error)]
pub enum Trouble {
    /// It is no scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// It has no room.
    #[error(transparent)]
    Memory(#[from] OutOfMemory),
    /// It is not as expected.
    #[error("{0}")]
    Wrong(String),
}

/// Who draws the cases.
pub struct Bench {
    frame: Frame,
    display: Frame,
    /// Whether everything is drawn that the table says, or what a test has time for.
    pub full: bool,
}

/// A picture as the renderer drew it.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// Unclamped levels, row by row from the top.
    pub levels: Vec<[f32; 3]>,
    /// Cuboid * 12 + triangle, or [`NO_TRIANGLE`].
    pub triangles: Vec<u32>,
}

/// The modes that a scene can ask for.
pub const MODES: [ShadingMode; 2] = [ShadingMode::Gouraud, ShadingMode::Phong];

/// Every projection and mode, exactly and within half a level.
pub fn ways() -> impl Iterator<Item = Way> {
    Projection::ALL.into_iter().flat_map(|projection| {
        MODES.into_iter().flat_map(move |mode| {
            [0.0, 0.5].map(|tolerance| Way {
                projection,
                mode,
                tolerance,
            })
        })
    })
}

impl Bench {
    /// One that draws with these instructions and so many threads.
    ///
    /// # Errors
    /// When the system gives no threads.
    pub fn new(level: Level, threads: usize, full: bool) -> Result<Self, ThreadPoolBuildError> {
        Ok(Bench {
            frame: Frame::new(Keep::Levels, Workers::new(threads, level)?),
            display: Frame::new(Keep::Display, Workers::new(threads, level)?),
            full,
        })
    }

    /// One that draws with these instructions on the calling thread alone.
    pub fn alone(level: Level) -> Self {
        let frame = |keep| Frame::new(keep, Workers::alone(level));
        Bench {
            frame: frame(Keep::Levels),
            display: frame(Keep::Display),
            full: false,
        }
    }

    /// Another one, with workers and memory of its own.
    ///
    /// # Errors
    /// When the system gives no threads.
    pub fn another(&self, threads: usize) -> Result<Self, Trouble> {
        Bench::new(self.level(), threads, self.full)
            .map_err(|error| Trouble::Wrong(error.to_string()))
    }

    /// How many threads draw.
    pub fn threads(&self) -> usize {
        self.frame.workers().threads()
    }

    /// The instructions in use.
    pub fn level(&self) -> Level {
        self.frame.workers().level()
    }

    /// Draws a scene.
    ///
    /// # Errors
    /// When it has no room.
    pub fn draw(&mut self, scene: &mut Scene, view: &View) -> Result<&Frame, OutOfMemory> {
        systems::draw(&mut scene.world, view, &mut self.frame)?;
        Ok(&self.frame)
    }

    /// Draws a scene as a window shows it.
    ///
    /// # Errors
    /// When it has no room.
    pub fn display(&mut self, scene: &mut Scene, view: &View) -> Result<&Frame, OutOfMemory> {
        systems::draw(&mut scene.world, view, &mut self.display)?;
        Ok(&self.display)
    }

    /// A picture of a setting.
    ///
    /// # Errors
    /// When it is no scene, or has no room.
    pub fn picture(&mut self, setting: &Setting, way: Way) -> Result<Drawn, Trouble> {
        let mut scene = setting.scene()?;
        let view = setting.view(&scene, way);
        let frame = self.draw(&mut scene, &view)?;
        Ok(Drawn {
            levels: frame.levels().to_vec(),
            triangles: frame.triangles().to_vec(),
        })
    }
}

impl Drawn {
    /// How many pixels show a triangle.
    pub fn seen(&self) -> u64 {
        let seen = self.triangles.iter().filter(|id| **id != NO_TRIANGLE);
        seen.count() as u64
    }

    /// The first pixel whose bits are not the other's.
    pub fn first_other(&self, other: &Drawn) -> Option<usize> {
        let bits = |levels: &[f32; 3]| levels.map(f32::to_bits);
        (0..self.triangles.len()).find(|&pixel| {
            self.triangles[pixel] != other.triangles[pixel]
                || bits(&self.levels[pixel]) != bits(&other.levels[pixel])
        })
    }
}
