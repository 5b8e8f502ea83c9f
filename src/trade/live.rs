//! The trade of a view while it is looked at: the time and the largest error of every method.
//!
//! ```text
//! band of rows --reference--> exact Phong, its highlight --+--> largest error, highlight kept
//!              --each method--> levels --------------------+
//! ```
//! Two references serve all methods, a band of rows at a time, so no picture is held. Known errors are not computed again,
//! and of two timings the one with more samples stays.

use super::accuracy::{exact, highlight_of, light_kept, share};
use super::batch;
use super::measurement::{Measurement, Request, mark_front};
use super::metrics::{self, Picture};
use super::timing;
use crate::components::ShadingMode;
use crate::frame::{Frame, Keep, Workers};
use crate::report::Monitor;
use crate::shading::Method;
use crate::systems;

/// Measures the methods of `request`. Some of them are already `known` from the same view.
///
/// # Errors
/// If memory or threads do not suffice, or the work is cancelled.
pub fn measure(
    request: &Request,
    known: &[Measurement],
    monitor: Monitor,
) -> anyhow::Result<Vec<Measurement>> {
    let progress = |_, share| (monitor.progress)("measuring", share / 2.0);
    let first_half = Monitor {
        progress: &progress,
        ..monitor
    };
    let of_method = |method: &Method| known.iter().find(|it| it.method == *method);
    let unknown = request.methods.iter().copied();
    let unknown = unknown.filter(|it| of_method(it).is_none()).collect();
    let mut errors = errors(request, unknown, first_half)?.into_iter();
    let timings = timing::of_batches(
        |number| batch::time_here(request, number, monitor),
        |share| (monitor.progress)("measuring", f64::midpoint(1.0, share)),
    )?;
    let methods = request.methods.iter();
    let measured = methods.filter_map(|it| of_method(it).cloned().or_else(|| errors.next()));
    let mut measured: Vec<Measurement> = measured.collect();
    for (one, timing) in measured.iter_mut().zip(timings) {
        if timing.samples >= one.timing.samples {
            one.timing = timing;
        }
    }
    mark_front(&mut measured);
    Ok(measured)
}

/// The errors of `methods`, without times.
fn errors(
    request: &Request,
    methods: Vec<Method>,
    monitor: Monitor,
) -> anyhow::Result<Vec<Measurement>> {
    let unknown = methods.into_iter();
    let unknown = unknown.map(|method| Measurement::new(method, request.threads));
    // With the light of the highlight that is kept, and the whole light of the highlight.
    let mut errors: Vec<(Measurement, [u64; 2])> = unknown.map(|it| (it, [0; 2])).collect();
    if errors.is_empty() {
        return Ok(Vec::new());
    }
    let view = &request.view;
    let mut scene = request.scene.snapshot();
    let (mut highlight, black) = highlight_of(&scene, view);
    let mut frame = Frame::new(Keep::Levels, Workers::alone(request.level));
    let phong = ShadingMode::Phong;
    monitor.in_bands("comparing pictures", view.size[1], |rows| {
        let whole = exact(&scene.world, view, phong, rows.clone(), monitor, |_| ())?;
        let lit = exact(
            &highlight.world,
            &black,
            phong,
            rows.clone(),
            monitor,
            |_| (),
        )?;
        for (one, kept) in &mut errors {
            monitor.check()?;
            let drawn = one.method.view(view);
            systems::draw_rows(&mut scene.world, &drawn, rows.clone(), &mut frame)?;
            let compared = metrics::compare(Picture::from(&frame), Picture::from(&whole));
            if let Some(error) = compared.error
                && one.error.is_none_or(|largest| error.max > largest)
            {
                let [x, y] = error.max_pixel;
                (one.error, one.worst) = (Some(error.max), Some([x, rows.start + y]));
            }
            let drawn = one.method.view(&black);
            systems::draw_rows(&mut highlight.world, &drawn, rows.clone(), &mut frame)?;
            let [common, all] = light_kept(frame.levels(), &lit.levels);
            *kept = [kept[0] + common, kept[1] + all];
        }
        Ok(())
    })?;
    let measured = errors.into_iter().map(|(one, kept)| Measurement {
        highlight_kept: share(kept),
        ..one
    });
    Ok(measured.collect())
}
