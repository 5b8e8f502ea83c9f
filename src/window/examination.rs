//! A picture that rests in; what the reference says of it out: exact Phong, the error map, the errors.
//!
//! Rule: the best picture of the scene is exact Phong, whatever mode draws it; a mode's own truth gives its own error only.

use fearless_simd::Level;

use super::session::Snapshot;
use crate::components::ShadingMode;
use crate::frame::{Frame, Keep, Workers, display_pixel};
use crate::memory::{self, OutOfMemory};
use crate::prove::{Proof, REFUTED, UNDECIDED, Verdict};
use crate::reference;
use crate::systems;
use crate::trade::error_map::{self, Scale};
use crate::trade::metrics::{self, Difference, Picture};

/// Rows that are compared at once: what a picture of any size takes beside the two that are kept.
const BAND: usize = 64;

/// Largest and mean error in levels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    pub max: f64,
    pub mean: f64,
}

/// What the reference says of one state of the session.
#[derive(Clone, Debug, PartialEq)]
pub struct ReferenceResult {
    /// Exact Phong in f64, 0x00RRGGBB.
    pub reference: Vec<u32>,
    /// Where the picture errs from exact Phong, in the colours of the scale.
    pub error_map: Vec<u32>,
    pub scale: Scale,
    /// Against exact Phong; `None` where nothing can be compared.
    pub errors: Option<Errors>,
    /// Against the picture's own mode; `None` where nothing can be compared.
    pub own_errors: Option<Errors>,
    /// The proof that the picture keeps its tolerance, which takes longest; `None` until it is there.
    pub proof: Option<Proof>,
}

/// Compares the picture with the reference; `None` as soon as `cancelled` says yes.
///
/// # Errors
/// When memory does not suffice.
pub fn examine(
    Snapshot { scene, view, .. }: &mut Snapshot,
    level: Level,
    cancelled: &(dyn Fn() -> bool + Sync),
) -> Result<Option<ReferenceResult>, OutOfMemory> {
    let [_, height] = view.size;
    let mut frame = Frame::new(Keep::Levels, Workers::alone(level));
    let phong = view.shaded(ShadingMode::Phong);
    let mut reference = memory::reserve_pixels(view.size)?;
    let mut pixels = memory::reserve_pixels(view.size)?;
    let modes = scene.world.query_mut::<&ShadingMode>();
    let is_phong = modes.into_iter().all(|mode| *mode == ShadingMode::Phong);
    let (mut errors, mut own_errors) = (Sum::default(), Sum::default());
    for start in (0..height).step_by(BAND) {
        let rows = start..(start + BAND).min(height);
        systems::draw_rows(&mut scene.world, view, rows.clone(), &mut frame)?;
        let truth = |view| {
            let rows = rows.clone();
            reference::picture(&scene.world, view, rows, cancelled, &|_| ())
        };
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
        reference.extend(exact.levels.iter().copied().map(display_pixel));
    }
    let errors = errors.statistics();
    let scale = Scale::holding(errors.map_or(0.0, |errors| errors.max));
    Ok(Some(ReferenceResult {
        reference,
        error_map: pixels.into_iter().map(|it| scale.color(it)).collect(),
        scale,
        errors,
        own_errors: if is_phong {
            errors
        } else {
            own_errors.statistics()
        },
        proof: None,
    }))
}

impl ReferenceResult {
    /// Takes the proof, and marks in the error map what it lacks.
    pub fn add_proof(&mut self, proof: Proof) {
        for (pixel, mark) in self.error_map.iter_mut().zip(&proof.marks) {
            match mark.verdict {
                Verdict::Proven => {}
                Verdict::Undecided => *pixel = UNDECIDED,
                Verdict::Refuted => *pixel = REFUTED,
            }
        }
        self.proof = Some(proof);
    }
}

/// The errors of bands, as those of the whole.
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
