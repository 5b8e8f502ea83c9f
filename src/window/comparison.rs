//! A picture compared with exact Phong: the exact picture, the error map, the errors.
//!
//! Exact Phong is the best picture of the scene, whatever mode draws it. A mode's own exact picture gives its own error only.

use fearless_simd::Level;
use hecs::World;

use crate::components::{ShadingMode, View};
use crate::frame::{Frame, Keep, Workers, display_pixel};
use crate::memory::{self, OutOfMemory};
use crate::prove::{Proof, REFUTED, UNDECIDED, Verdict};
use crate::reference;
use crate::systems;
use crate::trade::error_map::{self, Scale};
use crate::trade::metrics::{self, Difference, Picture};

/// Rows that are compared at once, which bounds the memory that a comparison takes.
const BAND: usize = 64;

/// Largest and mean error, in levels of 255.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    pub max: f64,
    pub mean: f64,
}

/// A picture against the reference in f64.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Exact Phong, 0x00RRGGBB.
    pub exact: Vec<u32>,
    /// The error against exact Phong in the colours of `scale`.
    pub error_map: Vec<u32>,
    pub scale: Scale,
    /// Against exact Phong; `None` where nothing can be compared.
    pub errors: Option<Errors>,
    /// Against the picture's own mode; `None` where nothing can be compared.
    pub own_errors: Option<Errors>,
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
        let mut pixels = memory::reserve_pixels(view.size)?;
        let mut modes = world.query_mut::<&ShadingMode>().into_iter();
        let is_phong = modes.all(|own| view.mode(*own) == ShadingMode::Phong);
        let (mut errors, mut own_errors) = (Sum::default(), Sum::default());
        for start in (0..height).step_by(BAND) {
            let rows = start..(start + BAND).min(height);
            systems::draw_rows(world, view, rows.clone(), &mut frame)?;
            let truth = |view| reference::picture(world, view, rows.clone(), cancelled, &|_| ());
            let Some(exact) = truth(&phong) else {
                return Ok(None);
            };
            let (drawn, compared) = (Picture::from(&frame), Picture::from(&exact));
            errors.add(&metrics::compare(drawn, compared));
            if !is_phong {
                let Some(own) = truth(view) else {
                    return Ok(None);
                };
                own_errors.add(&metrics::compare(drawn, Picture::from(&own)));
            }
            pixels.extend(error_map::compared(drawn, compared));
            exact_pixels.extend(exact.levels.iter().copied().map(display_pixel));
        }
        let errors = errors.statistics();
        let scale = Scale::holding(errors.map_or(0.0, |errors| errors.max));
        Ok(Some(Comparison {
            exact: exact_pixels,
            error_map: pixels.into_iter().map(|it| scale.color(it)).collect(),
            scale,
            errors,
            own_errors: if is_phong {
                errors
            } else {
                own_errors.statistics()
            },
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

/// The errors of bands, added up.
#[derive(Default)]
struct Sum {
    max: f64,
    total: f64,
    pixels: u64,
}

impl Sum {
    fn add(&mut self, difference: &Difference) {
        if let Some(error) = difference.error {
            self.max = self.max.max(error.max);
            self.total += error.mean * difference.compared_pixels as f64;
            self.pixels += difference.compared_pixels;
        }
    }

    fn statistics(&self) -> Option<Errors> {
        (self.pixels > 0).then(|| Errors {
            max: self.max,
            mean: self.total / self.pixels as f64,
        })
    }
}
