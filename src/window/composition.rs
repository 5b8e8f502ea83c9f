//! The session's scene -> the picture that its view asks for, short of what lies over it.
//!
//! ```text
//!            +-- frame: as it is shaded -------------------+
//! Session ---+-- frame: Gouraud, Phong (for their wipe) ---+-- views --> pixels
//!            +-- levels: how tiles were drawn -------------+
//!            '-- findings: reference, error map -----------'
//! ```
//! Rule: what is not computed yet is shown as the picture dimmed, never as something else.

use std::time::Instant;

use super::session::Session;
use super::views::{self, ViewMode};
use crate::components::ShadingMode;
use crate::frame::{Frame, Keep, Workers};
use crate::memory::OutOfMemory;

/// The pictures that views are made of.
pub struct Composition {
    frame: Frame,
    levels: Frame,
    gouraud: Vec<u32>,
    phong: Vec<u32>,
}

impl Composition {
    /// Nothing drawn yet; both draw alike.
    pub fn new(workers: Workers, other_workers: Workers) -> Self {
        Composition {
            frame: Frame::new(Keep::Display, workers),
            levels: Frame::new(Keep::Levels, other_workers),
            gouraud: Vec::new(),
            phong: Vec::new(),
        }
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [usize; 2] {
        self.frame.size()
    }

    /// Draws anew what the session's view needs; the time of the picture itself is noted in its statistics.
    ///
    /// # Errors
    /// When it does not fit in memory.
    pub fn draw(&mut self, session: &mut Session, size: [usize; 2]) -> Result<(), OutOfMemory> {
        session.update_probe(size, self.frame.workers().level())?;
        let mode = session.view_mode();
        if mode == ViewMode::GouraudPhong {
            for (pixels, mode) in [
                (&mut self.gouraud, ShadingMode::Gouraud),
                (&mut self.phong, ShadingMode::Phong),
            ] {
                session.draw_as(Some(mode), size, &mut self.frame)?;
                pixels.clear();
                pixels.extend_from_slice(self.frame.pixels());
            }
        }
        if mode == ViewMode::Tiles {
            session.draw(size, &mut self.levels)?;
        }
        let start = Instant::now();
        session.draw(size, &mut self.frame)?;
        session.record(start.elapsed(), &self.frame);
        Ok(())
    }

    /// Puts what was last drawn together as the session wants to see it now.
    pub fn compose(&self, session: &Session, pixels: &mut Vec<u32>) {
        let [width, _] = self.size();
        let picture = self.frame.pixels();
        let findings = session.findings();
        let reference = findings.map(|findings| findings.reference.as_slice());
        pixels.clear();
        if let Some(reference) = reference.filter(|_| session.blinks()) {
            return pixels.extend_from_slice(reference);
        }
        pixels.extend_from_slice(picture);
        match session.view_mode() {
            ViewMode::Picture => {}
            ViewMode::GouraudPhong => {
                let divider = session.divider_column(width);
                views::wipe(pixels, &self.gouraud, &self.phong, width, divider);
            }
            ViewMode::MethodReference => {
                let divider = session.divider_column(width);
                if let Some(reference) = reference {
                    views::wipe(pixels, picture, reference, width, divider);
                } else {
                    let mut waiting = picture.to_vec();
                    views::dim(&mut waiting);
                    views::wipe(pixels, picture, &waiting, width, divider);
                }
            }
            ViewMode::ErrorMap => match findings {
                Some(findings) => pixels.copy_from_slice(&findings.error_map),
                None => views::dim(pixels),
            },
            ViewMode::Tiles => views::tint(pixels, self.levels.kinds(), self.levels.triangles()),
        }
    }
}
