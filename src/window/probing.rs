//! A pixel looked at -> what is known of it in the present picture.
//!
//! Rule: nothing is known of a pixel but what was found out about the picture as it is now.

use fearless_simd::Level;

use crate::components::View;
use crate::frame::Workers;
use crate::memory::OutOfMemory;
use crate::probe::{self, Probe};
use crate::scene::Scene;

/// The pixel that is looked at, and what is known of it.
#[derive(Debug, Default)]
pub struct Probing {
    pixel: Option<[usize; 2]>,
    found: Option<Probe>,
}

impl Probing {
    /// Whether a pixel is looked at.
    pub fn is_open(&self) -> bool {
        self.pixel.is_some()
    }

    /// What is known of it.
    pub fn found(&self) -> Option<&Probe> {
        self.found.as_ref()
    }

    /// Looks at this pixel from now on, or at none.
    pub fn look_at(&mut self, pixel: Option<[usize; 2]>) {
        self.pixel = pixel;
        self.found = None;
    }

    /// Finds out about the pixel in the picture that `view` asks for; one outside is no longer looked at.
    ///
    /// # Errors
    /// When a row of the picture does not fit in memory.
    pub fn update(
        &mut self,
        scene: &mut Scene,
        view: &View,
        level: Level,
    ) -> Result<(), OutOfMemory> {
        let [width, height] = view.size;
        self.pixel.take_if(|[x, y]| *x >= width || *y >= height);
        self.found = match self.pixel {
            Some(pixel) => Some(probe::at(scene, view, pixel, Workers::alone(level))?),
            None => None,
        };
        Ok(())
    }
}
