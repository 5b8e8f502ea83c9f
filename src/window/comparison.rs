//! A picture compared with exact Phong, the best picture of the scene: the exact picture, the error map, the largest error.

use fearless_simd::Level;
use hecs::World;

use crate::components::{ShadingMode, View};
use crate::frame::{Frame, Keep, Workers, display_pixel};
use crate::memory::{self, OutOfMemory};
use crate::prove::{Proof, REFUTED, UNDECIDED, Verdict};
use crate::reference;
use crate::systems;
use crate::trade::error_map::{self, Scale};
use crate::trade::metrics::{self, Picture};

/// Rows that are compared at once, which bounds the memory that a comparison takes.
const BAND: usize = 64;

/// A picture against the reference in f64.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Exact Phong, 0x00RRGGBB.
    pub exact: Vec<u32>,
    /// The error against exact Phong in the colours of `scale`.
    pub error_map: Vec<u32>,
    pub scale: Scale,
    /// The largest error, in levels of 255; `None` where nothing can be compared.
    pub error: Option<f64>,
}

impl Comparison {
    /// Compares the picture of `view`; `None` as soon as `cancelled` says yes.
    ///
    /// # Errors
    /// When memory does not suffice.
    pub fn of(
        world: &mut World,
        view: &View,
        level: Level,
        cancelled: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Comparison>, OutOfMemory> {
        let height = view.size[1];
        let mut frame = Frame::new(Keep::Levels, Workers::alone(level));
        let phong = view.shaded(ShadingMode::Phong);
        let mut exact_pixels = memory::reserve_pixels(view.size)?;
        let mut errors = memory::reserve_pixels(view.size)?;
        let mut largest: Option<f64> = None;
        for start in (0..height).step_by(BAND) {
            let rows = start..(start + BAND).min(height);
            systems::draw_rows(world, view, rows.clone(), &mut frame)?;
            let exact = reference::picture(world, &phong, rows, cancelled, &|_| ());
            let Some(exact) = exact else {
                return Ok(None);
            };
            let (drawn, compared) = (Picture::from(&frame), Picture::from(&exact));
            let error = metrics::compare(drawn, compared).error;
            if let Some(error) = error {
                largest = Some(largest.map_or(error.max, |largest| largest.max(error.max)));
            }
            errors.extend(error_map::compared(drawn, compared));
            exact_pixels.extend(exact.levels.iter().copied().map(display_pixel));
        }
        let scale = Scale::holding(largest.unwrap_or(0.0));
        Ok(Some(Comparison {
            exact: exact_pixels,
            error_map: errors.into_iter().map(|it| scale.color(it)).collect(),
            scale,
            error: largest,
        }))
    }

    /// Marks the pixels that are not proven in the error map.
    pub fn mark(&mut self, proof: &Proof) {
        for (pixel, mark) in self.error_map.iter_mut().zip(&proof.marks) {
            match mark.verdict {
                Verdict::Proven => {}
                Verdict::Undecided => *pixel = UNDECIDED,
                Verdict::Refuted => *pixel = REFUTED,
            }
        }
    }
}
