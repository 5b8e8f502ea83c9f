//! The session's scene -> the picture that its view asks for, short of what lies over it.
//!
//! ```text
//!            +-- frame: as it is shaded, or both sides of Gouraud | Phong --+
//! Session ---+-- levels: how tiles were drawn ------------------------------+-- views --> pixels
//!            '-- reference, error map --------------------------------------'
//! ```
//! Rules: what is not computed yet is shown as the picture dimmed, never as something else. A frame is timed from the
//! first stage to the display step, nothing else is.

use std::time::{Duration, Instant};

use hecs::World;

use super::session::Session;
use super::views::{self, ViewMode};
use crate::components::{ShadingMode, View};
use crate::frame::{Counts, Frame, Keep, Workers};
use crate::memory::OutOfMemory;
use crate::systems;

/// How many warm frames are timed once the picture rests.
pub const FRAMES: usize = 9;

/// The longest time for which the user waits while a picture is drawn again to be timed.
const TIMING_BUDGET: Duration = Duration::from_millis(100);

/// What the frames of the present state took; all are of one state of the window.
#[derive(Clone, Debug, Default)]
pub struct FrameTimes {
    /// Of the picture, or of the left and the right one of a wipe between two methods.
    pub sides: [Vec<Duration>; 2],
    /// What the last frame did.
    pub counts: Counts,
    /// How many threads may draw.
    pub threads: usize,
}

/// The pictures that views are made of.
pub struct Composition {
    /// The picture; of Gouraud | Phong the right side.
    frame: Frame,
    /// The left side of Gouraud | Phong.
    left: Vec<u32>,
    levels: Frame,
}

impl Composition {
    /// Nothing drawn yet.
    pub fn new(workers: Workers) -> Self {
        let level = workers.level();
        Composition {
            frame: Frame::new(Keep::Display, workers),
            left: Vec::new(),
            levels: Frame::new(Keep::Levels, Workers::alone(level)),
        }
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [usize; 2] {
        self.frame.size()
    }

    /// Draws anew what the session's view needs, and tells the session what that took.
    ///
    /// # Errors
    /// When it does not fit in memory.
    pub fn draw(&mut self, session: &mut Session, size: [usize; 2]) -> Result<(), OutOfMemory> {
        session.update_probe(size)?;
        let times = self.draw_sides(session, size, 1)?;
        if session.state.mode == ViewMode::Tiles {
            let view = session.view(size);
            systems::draw(&mut session.scene.world, &view, &mut self.levels)?;
        }
        session.drawn(times, self.frame.pixels());
        Ok(())
    }

    /// Draws the same again, until enough warm frames are timed or the user would notice the time that takes.
    ///
    /// # Errors
    /// When it does not fit in memory.
    pub fn time(&mut self, session: &mut Session) -> Result<(), OutOfMemory> {
        let mut times = self.draw_sides(session, self.size(), 1 + FRAMES)?;
        for side in &mut times.sides {
            // The first frame warms caches and branch predictors.
            if side.len() > 1 {
                side.remove(0);
            }
        }
        session.timed(times);
        Ok(())
    }

    /// Draws each side so many times.
    fn draw_sides(
        &mut self,
        session: &mut Session,
        size: [usize; 2],
        frames: usize,
    ) -> Result<FrameTimes, OutOfMemory> {
        let view = session.view(size);
        let (world, frame) = (&mut session.scene.world, &mut self.frame);
        let sides = if session.state.mode == ViewMode::GouraudPhong {
            let left = draw_timed(world, &view.shaded(ShadingMode::Gouraud), frame, frames)?;
            self.left.clear();
            self.left.extend_from_slice(frame.pixels());
            let right = draw_timed(world, &view.shaded(ShadingMode::Phong), frame, frames)?;
            [left, right]
        } else {
            [draw_timed(world, &view, frame, frames)?, Vec::new()]
        };
        Ok(FrameTimes {
            sides,
            counts: self.frame.counts(),
            threads: self.frame.workers().threads(),
        })
    }

    /// Puts what was last drawn together as the session wants to see it now.
    pub fn compose(&self, session: &Session, pixels: &mut Vec<u32>) {
        let [width, _] = self.size();
        let picture = self.frame.pixels();
        let state = &session.state;
        let result = session.reference.as_ref();
        let or_dimmed = |known| views::or_dimmed(known, picture);
        let reference = || or_dimmed(result.map(|it| &it.reference));
        let divider = state.divider_column(width);
        pixels.clear();
        if let Some(requires) = &session.requires
            && requires.left_out.is_some()
        {
            return pixels.extend_from_slice(&or_dimmed(requires.picture.as_ref()));
        }
        match state.mode {
            _ if state.shows_reference => pixels.extend_from_slice(&reference()),
            ViewMode::Picture => pixels.extend_from_slice(picture),
            ViewMode::GouraudPhong => views::wipe(pixels, &self.left, picture, width, divider),
            ViewMode::MethodReference => {
                views::wipe(pixels, picture, &reference(), width, divider);
            }
            ViewMode::ErrorMap => {
                pixels.extend_from_slice(&or_dimmed(result.map(|it| &it.error_map)));
            }
            ViewMode::Tiles => {
                pixels.extend_from_slice(picture);
                views::tint(pixels, self.levels.kinds(), self.levels.triangles());
            }
        }
    }
}

/// Draws the same picture so many times, or until [`TIMING_BUDGET`] is used up; returns what each took.
fn draw_timed(
    world: &mut World,
    view: &View,
    frame: &mut Frame,
    frames: usize,
) -> Result<Vec<Duration>, OutOfMemory> {
    let mut times = Vec::with_capacity(frames);
    let mut spent = Duration::ZERO;
    while times.is_empty() || times.len() < frames && spent < TIMING_BUDGET {
        let start = Instant::now();
        systems::draw(world, view, frame)?;
        let time = start.elapsed();
        times.push(time);
        spent += time;
    }
    Ok(times)
}
