//! The picture of each method compared with the reference.
//!
//! ```text
//! scene, black background, specular lights alone --> the share of the highlight that each method keeps
//! scene --+-- exact Phong in f64 ----> error of each method
//!         '-- its own mode in f64 ---> in a report, own error
//! ```
//! Nothing here is timed. The figures do not depend on the number of threads.

use std::collections::{HashMap, HashSet};

use anyhow::Context;
use glam::DVec3;

use super::is_timed;
use super::measurement::{LeftOut, Measured, Measurement, Request};
use super::timing::Timing;
use crate::components::{Light, LightKind, ShadingMode, TriangleId, View};
use crate::output::Monitor;
use crate::output::memory::{self, Content, OutOfMemory};
use crate::questions::metrics::{Picture, compare};
use crate::reference::{self, Truth};
use crate::scene::Scene;
use crate::shading::Method;
use crate::systems;
use crate::systems::frame::{Counts, Frame, Keep, Workers, display_step};

/// The most bytes for a pixel: four reference pictures, a frame, and a list of errors.
const BYTES: usize = 4 * 28 + 17 + 8;
/// The bytes that a report adds: three reference pictures.
const BYTES_OF_REPORT: usize = 3 * 28;

/// The errors of `methods` in the view of `request`, without times.
///
/// # Errors
/// If the pictures do not fit in memory, or grids that must, or the work is cancelled.
pub async fn errors(
    request: &Request,
    methods: &[Method],
    monitor: Monitor<'_>,
) -> anyhow::Result<Measured> {
    let view = &request.drawing.view();
    let mut found = Measured::default();
    if methods.is_empty() {
        return Ok(found);
    }
    let bytes = BYTES + usize::from(request.is_report) * BYTES_OF_REPORT;
    memory::check(view.size, view.size[0] * view.size[1] * bytes)
        .context("the methods cannot be compared")?;
    let mut frame = Frame::new(Keep::Levels, Workers::alone(request.drawing.level));
    let mut scene = request.drawing.scene.snapshot();
    let shares_kept = highlight_kept(&scene, view, methods, &mut frame, monitor).await?;
    let truths = truths(request, methods, monitor).await?;
    let exact = Picture::from(&truths[&ShadingMode::Phong]);
    for (done, (method, highlight_kept)) in (1..).zip(methods.iter().zip(shares_kept)) {
        monitor.check()?;
        monitor.rest().await;
        (monitor.progress)("comparing pictures", f64::from(done) / methods.len() as f64);
        let drawn = highlight_kept.and_then(|kept| {
            if is_timed(*method) {
                systems::draw(&mut scene.world, &method.view(view), &mut frame)?;
            }
            Ok(kept)
        });
        let highlight_kept = match drawn {
            Err(error) if !request.must_fit && matches!(error.content, Content::Grids(_)) => {
                found.left_out.push(LeftOut {
                    method: *method,
                    reason: error.to_string(),
                });
                continue;
            }
            drawn => drawn?,
        };
        let mut counts = Counts::default();
        if is_timed(*method) {
            counts = frame.counts();
        } else {
            let triangles = truths[&method.mode].triangles.iter();
            let covered = triangles.filter(|it| **it != TriangleId::NONE).count();
            counts.covered_pixels = covered as u64;
        }
        let against = |other| {
            if is_timed(*method) {
                compare(Picture::from(&frame), other)
            } else {
                compare(Picture::from(&truths[&method.mode]), other)
            }
        };
        let difference = against(exact);
        let mut own_error = None;
        if request.is_report {
            let rows = 0..view.size[1];
            let own = match method.segments {
                None => &truths[&method.mode],
                Some(_) => {
                    &reference::picture(&scene.world, &method.view(view), rows, monitor).await?
                }
            };
            own_error = against(Picture::from(own)).error;
        }
        found.methods.push(Measurement {
            method: *method,
            threads: request.drawing.threads,
            timing: Timing::default(),
            ns_per_covered_pixel: None,
            counts,
            error: difference.error,
            own_error,
            edge_pixels: difference.edge_pixels,
            highlight_kept,
            on_front: false,
        });
    }
    Ok(found)
}

/// Exact Phong, and the other modes whose own pictures are compared.
async fn truths(
    request: &Request,
    methods: &[Method],
    monitor: Monitor<'_>,
) -> anyhow::Result<HashMap<ShadingMode, Truth>> {
    let has_own_truth =
        |it: &&Method| it.segments.is_none() && (request.is_report || !it.mode.is_drawn());
    let own_modes = methods.iter().filter(has_own_truth).map(|it| it.mode);
    let modes: HashSet<ShadingMode> = own_modes.chain([ShadingMode::Phong]).collect();
    let (world, view) = (&request.drawing.scene.world, request.drawing.view());
    let mut truths = HashMap::new();
    for mode in modes {
        let truth = reference::picture(world, &view.shaded(mode), 0..view.size[1], monitor).await?;
        truths.insert(mode, truth);
    }
    Ok(truths)
}

/// The share of the highlight that each method keeps, where its grids fit in memory.
async fn highlight_kept(
    scene: &Scene,
    view: &View,
    methods: &[Method],
    frame: &mut Frame,
    monitor: Monitor<'_>,
) -> anyhow::Result<Vec<Result<Option<f64>, OutOfMemory>>> {
    let mut specular = scene.snapshot();
    for light in specular.world.query_mut::<&mut Light>() {
        light.on &= light.kind == LightKind::Specular;
    }
    let dark = View {
        background: DVec3::ZERO,
        ..view.shaded(ShadingMode::Phong)
    };
    let highlight = reference::picture(&specular.world, &dark, 0..view.size[1], monitor).await?;
    let mut shares = Vec::with_capacity(methods.len());
    for method in methods {
        monitor.check()?;
        monitor.rest().await;
        let kept = if is_timed(*method) {
            systems::draw(&mut specular.world, &method.view(&dark), frame)
                .map(|()| share_kept(frame.levels().iter().copied(), &highlight.levels))
        } else {
            let view = method.view(&dark);
            let kept = reference::picture(&specular.world, &view, 0..view.size[1], monitor).await?;
            let kept = kept
                .levels
                .into_iter()
                .map(|it| it.map(|level| level as f32));
            Ok(share_kept(kept, &highlight.levels))
        };
        shares.push(kept);
    }
    Ok(shares)
}

/// The displayed light that both pictures show at the same pixel and channel, as a share of all that `whole` shows, 0..=1;
/// `None` if it shows none.
pub fn share_kept(kept: impl Iterator<Item = [f32; 3]>, whole: &[[f64; 3]]) -> Option<f64> {
    let (mut common, mut all) = (0, 0);
    for (kept, whole) in kept.flatten().zip(whole.as_flattened()) {
        let [kept, whole] = [f64::from(kept), *whole].map(|it| u64::from(display_step(it)));
        common += kept.min(whole);
        all += whole;
    }
    (all > 0).then(|| common as f64 / all as f64)
}
