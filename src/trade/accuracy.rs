//! The picture of each method compared with the reference.
//!
//! ```text
//! scene, black background, specular lights alone --> the share of the highlight that each method keeps
//! scene --+-- exact Phong in f64 ----> error of each method; in a report also FLIP and the error map
//!         '-- its own mode in f64 ---> in a report, own error
//! ```
//! Nothing here is timed. The figures do not depend on the number of threads.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::ops::Range;

use anyhow::Context;
use glam::DVec3;
use hecs::World;

use super::error_map::Scale;
use super::flip;
use super::measurement::{Measurement, Request};
use super::metrics::{Picture, compare, compared};
use super::timing::Timing;
use crate::components::{Light, LightKind, ShadingMode, View};
use crate::frame::{Frame, Keep, Workers, display_step};
use crate::memory;
use crate::reference::{self, Truth};
use crate::report::{CANCELLED, Monitor};
use crate::shading::{METHODS, Method};
use crate::systems;

/// The most bytes for a pixel: a reference picture, a frame with depths, and a list of errors.
const BYTES: usize = 28 + 25 + 16;
/// The bytes that a report adds: two reference pictures, a map for each method, and FLIP.
const BYTES_OF_REPORT: usize = 2 * 28 + 4 * METHODS.len() + flip::BYTES_PER_PIXEL;

/// Rows of the reference in `mode`.
///
/// # Errors
/// If the work is cancelled.
pub fn exact(
    world: &World,
    view: &View,
    mode: ShadingMode,
    rows: Range<usize>,
    monitor: Monitor,
) -> anyhow::Result<Truth> {
    let all = rows.len() as f64;
    let row_done = |done| (monitor.progress)("drawing the reference", done as f64 / all);
    let view = view.shaded(mode);
    let exact = reference::picture(world, &view, rows, monitor.is_cancelled, &row_done);
    exact.context(CANCELLED)
}

/// The errors of `methods` in the view of `request`, without times.
///
/// # Errors
/// If the pictures do not fit in memory, or the work is cancelled.
pub fn errors(
    request: &Request,
    methods: &[Method],
    monitor: Monitor,
) -> anyhow::Result<Vec<Measurement>> {
    let (view, rows) = (&request.view, 0..request.view.size[1]);
    if methods.is_empty() {
        return Ok(Vec::new());
    }
    let bytes = BYTES + usize::from(request.is_report) * BYTES_OF_REPORT;
    memory::check(view.size, view.size[0] * view.size[1] * bytes)
        .context("the methods cannot be compared")?;
    let mut frame = Frame::new(Keep::Levels, Workers::alone(request.level));
    let kept = highlights_kept(request, methods, &mut frame, monitor)?;
    let mut scene = request.scene.snapshot();
    let own_modes = methods.iter().filter(|_| request.is_report);
    let mut truths = HashMap::new();
    for mode in own_modes.map(|it| it.mode).chain([ShadingMode::Phong]) {
        if let Entry::Vacant(unknown) = truths.entry(mode) {
            unknown.insert(exact(&scene.world, view, mode, rows.clone(), monitor)?);
        }
    }
    let exact = Picture::from(&truths[&ShadingMode::Phong]);
    let mut measured = Vec::new();
    for (method, highlight_kept) in methods.iter().zip(kept) {
        monitor.check()?;
        systems::draw(&mut scene.world, &method.view(view), &mut frame)?;
        let drawn = Picture::from(&frame);
        let mut difference = compare(drawn, exact);
        let (mut own_error, mut map) = (None, Vec::new());
        if request.is_report {
            if let Some(error) = &mut difference.error {
                error.flip_mean = flip::mean(drawn, exact, flip::PIXELS_PER_DEGREE);
            }
            own_error = compare(drawn, Picture::from(&truths[&method.mode])).error;
            map.extend(compared(drawn, exact).map(|it| Scale::WIDEST.color(it)));
        }
        measured.push(Measurement {
            method: *method,
            threads: request.threads,
            timing: Timing::default(),
            ns_per_covered_pixel: None,
            counts: frame.counts(),
            error: difference.error,
            own_error,
            edge_pixels: difference.edge_pixels,
            highlight_kept,
            on_front: false,
            map,
        });
        let share = measured.len() as f64 / methods.len() as f64;
        (monitor.progress)("comparing pictures", share);
    }
    Ok(measured)
}

/// The share of the highlight that each of `methods` keeps: of the light of specular lights before a black background.
fn highlights_kept(
    request: &Request,
    methods: &[Method],
    frame: &mut Frame,
    monitor: Monitor,
) -> anyhow::Result<Vec<Option<f64>>> {
    let mut scene = request.scene.snapshot();
    for light in scene.world.query_mut::<&mut Light>() {
        light.on &= light.kind == LightKind::Specular;
    }
    let view = View {
        background: DVec3::ZERO,
        ..request.view.clone()
    };
    let rows = 0..view.size[1];
    let whole = exact(&scene.world, &view, ShadingMode::Phong, rows, monitor)?;
    let kept = methods.iter().map(|method| {
        monitor.check()?;
        systems::draw(&mut scene.world, &method.view(&view), frame)?;
        Ok(share_kept(frame.levels(), &whole.levels))
    });
    kept.collect()
}

/// The displayed light that both pictures show at the same pixel and channel, as a share of all that `whole` shows, 0..=1;
/// `None` if it shows none.
pub fn share_kept(kept: &[[f32; 3]], whole: &[[f64; 3]]) -> Option<f64> {
    let (mut common, mut all) = (0, 0);
    for (kept, whole) in kept.as_flattened().iter().zip(whole.as_flattened()) {
        let [kept, whole] = [f64::from(*kept), *whole].map(|it| u64::from(display_step(it)));
        common += kept.min(whole);
        all += whole;
    }
    (all > 0).then(|| common as f64 / all as f64)
}
