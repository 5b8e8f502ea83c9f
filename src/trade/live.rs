//! The trade of a view while it is looked at: the time and the error of every method, and nothing else.
//!
//! ```text
//! band of rows --reference--> exact Phong, its highlight --+--> largest error, highlight kept
//!              --each method--> levels --------------------+
//! ```
//! Two references serve all methods, a band of rows at a time, so that no picture is held. Errors that are known are not
//! computed again, and of two timings the one of more samples stays.

use super::accuracy::{highlight_of, light_kept, share};
use super::metrics::{self, Picture};
use super::record::MethodReport;
use super::timing::{self, Timing};
use super::{IsCancelled, Request, TradeError, front};
use crate::components::ShadingMode;
use crate::frame::{Frame, Keep, Workers};
use crate::reference;
use crate::shading::Method;
use crate::systems;

/// Rows that are compared at once.
const BAND: usize = 64;

/// What one method costs in a view, and how far it errs.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurement {
    pub method: Method,
    /// Milliseconds of a whole warm frame.
    pub timing: Timing,
    /// The largest error against exact Phong, in levels of 255; `None` where nothing can be compared.
    pub error: Option<f64>,
    /// Column and row of the first pixel that errs so far.
    pub worst: Option<[usize; 2]>,
    /// How much of the highlight is where it ought to be, 0..=1; `None` where exact Phong shows none.
    pub highlight_kept: Option<f64>,
    /// Whether no other method measured beats it in error and time both.
    pub on_front: bool,
}

impl From<&MethodReport> for Measurement {
    fn from(report: &MethodReport) -> Self {
        let error = report.accuracy.error.levels;
        Measurement {
            method: report.method,
            timing: report.timing.clone(),
            error: error.map(|error| error.max),
            worst: error.map(|error| error.max_pixel),
            highlight_kept: report.accuracy.highlight_kept,
            on_front: report.on_front,
        }
    }
}

/// Measures the methods of `request`, of which some are `known` of the same view; `on_progress` is told the share done,
/// 0..=1.
///
/// # Errors
/// When memory or threads do not suffice, or it is cancelled.
pub fn measure(
    request: &Request,
    known: &[Measurement],
    cancelled: IsCancelled,
    on_progress: &(dyn Fn(f64) + Sync),
) -> Result<Vec<Measurement>, TradeError> {
    let of_method = |method: &&Method| known.iter().find(|it| it.method == **method);
    let unknown = request.methods.iter().filter(|it| of_method(it).is_none());
    let told = |done| on_progress(done / 2.0);
    let mut errors = errors(request, unknown.copied(), cancelled, &told)?.into_iter();
    let batch = |number| super::time_batch(request, number, cancelled);
    let timings = timing::of_batches(batch, |done| on_progress(f64::midpoint(1.0, done)))?;
    let methods = request.methods.iter();
    let measured = methods.filter_map(|it| of_method(&it).cloned().or_else(|| errors.next()));
    let mut measured: Vec<Measurement> = measured.collect();
    for (one, timing) in measured.iter_mut().zip(timings) {
        if timing.samples >= one.timing.samples {
            one.timing = timing;
        }
    }
    let on_front = front::on_front(&measured);
    for (one, on_front) in measured.iter_mut().zip(on_front) {
        one.on_front = on_front;
    }
    Ok(measured)
}

/// The errors of these methods, which are not timed.
fn errors(
    request: &Request,
    methods: impl Iterator<Item = Method>,
    cancelled: IsCancelled,
    on_progress: &dyn Fn(f64),
) -> Result<Vec<Measurement>, TradeError> {
    let unknown = methods.map(|method| Measurement {
        method,
        timing: Timing::default(),
        error: None,
        worst: None,
        highlight_kept: None,
        on_front: false,
    });
    // With the light of the highlight that is kept, and all of it.
    let mut errors: Vec<(Measurement, [u64; 2])> = unknown.map(|it| (it, [0; 2])).collect();
    if errors.is_empty() {
        return Ok(Vec::new());
    }
    let view = request.view.shaded(ShadingMode::Phong);
    let mut scene = request.scene.snapshot();
    let (mut highlight, black) = highlight_of(&scene, &view);
    let mut frame = Frame::new(Keep::Levels, Workers::alone(request.level));
    let height = view.size[1];
    for start in (0..height).step_by(BAND) {
        let rows = start..(start + BAND).min(height);
        let exact = |scene: &crate::scene::Scene, view| {
            reference::picture(&scene.world, view, rows.clone(), cancelled, &|_| ())
                .ok_or(TradeError::Cancelled)
        };
        let (whole, lit) = (exact(&scene, &view)?, exact(&highlight, &black)?);
        for (one, kept) in &mut errors {
            if cancelled() {
                return Err(TradeError::Cancelled);
            }
            let drawn = one.method.view(&view);
            systems::draw_rows(&mut scene.world, &drawn, rows.clone(), &mut frame)?;
            let compared = metrics::compare(Picture::from(&frame), Picture::from(&whole));
            if let Some(error) = compared.error
                && one.error.is_none_or(|largest| error.max > largest)
            {
                let [x, y] = error.max_pixel;
                (one.error, one.worst) = (Some(error.max), Some([x, start + y]));
            }
            let drawn = one.method.view(&black);
            systems::draw_rows(&mut highlight.world, &drawn, rows.clone(), &mut frame)?;
            let [common, all] = light_kept(frame.levels(), &lit.levels);
            *kept = [kept[0] + common, kept[1] + all];
        }
        on_progress(rows.end as f64 / height as f64);
    }
    let measured = errors.into_iter().map(|(one, kept)| Measurement {
        highlight_kept: share(kept),
        ..one
    });
    Ok(measured.collect())
}
