//! The picture of each method compared with the reference.
//!
//! ```text
//! scene, black background, specular lights alone --> the share of the highlight that each method keeps
//! scene --+-- exact Phong in f64 ----> error of each method
//!         '-- its own mode in f64 ---> in a report, own error
//! ```
//! Nothing here is timed. The figures do not depend on the number of threads.

use anyhow::Context;
use glam::DVec3;

use super::timing::Timing;
use super::{LeftOut, Measured, Measurement, Request, is_timed};
use crate::components::{Light, LightKind, ShadingMode, TriangleId, View};
use crate::output::Monitor;
use crate::output::memory::{self, Content, OutOfMemory};
use crate::questions::metrics::{Picture, compare};
use crate::reference::{self, Truth};
use crate::scene::Scene;
use crate::shading::Method;
use crate::systems;
use crate::systems::frame::{Counts, Frame, Keep, Workers, display_step};

/// The most bytes for a pixel: five pictures in f64, the rows of one more, a frame, and a list of errors.
const BYTES: usize = 5 * 28 + 32 + 17 + 8;

/// The errors of `methods` in the view of `request`, without times.
///
/// # Errors
/// If the pictures do not fit in memory, or the work is cancelled.
pub async fn errors(
    request: &Request,
    methods: &[Method],
    monitor: Monitor<'_>,
) -> anyhow::Result<Measured> {
    let mut found = Measured::default();
    if methods.is_empty() {
        return Ok(found);
    }
    let view = &request.drawing.view();
    memory::check(view.size, view.size[0] * view.size[1] * BYTES)
        .context("the methods cannot be compared")?;
    let mut frame = Frame::new(Keep::Levels, Workers::alone(request.drawing.level));
    let mut scene = request.drawing.scene.snapshot();
    let mut specular = scene.snapshot();
    for light in specular.world.query_mut::<&mut Light>() {
        light.on &= light.kind == LightKind::Specular;
    }
    let before_black = View {
        background: DVec3::ZERO,
        ..*view
    };
    let phong = Method::of(ShadingMode::Phong, 0.0);
    let highlight = reference(&specular, phong, &before_black, monitor).await?;
    let exact = reference(&scene, phong, view, monitor).await?;
    let progress = monitor.progress;
    // Pictures by the reference are a part of this step.
    let monitor = Monitor {
        progress: &|_, _| (),
        ..monitor
    };
    for (done, method) in (1..).zip(methods) {
        monitor.check()?;
        monitor.rest().await;
        progress("comparing pictures", f64::from(done) / methods.len() as f64);
        let pictures = async {
            anyhow::Ok([
                picture(&mut specular, *method, &before_black, &mut frame, monitor).await?,
                picture(&mut scene, *method, view, &mut frame, monitor).await?,
            ])
        };
        let [kept, drawn] = match pictures.await {
            Ok(pictures) => pictures,
            Err(error) => {
                found.left_out.push(left_out(*method, error)?);
                continue;
            }
        };
        let difference = compare(Picture::from(&drawn), Picture::from(&exact));
        let own_error = if !request.is_report {
            None
        } else if method.mode == ShadingMode::Phong {
            difference.error
        } else {
            let own = reference(&scene, *method, view, monitor).await?;
            compare(Picture::from(&drawn), Picture::from(&own)).error
        };
        found.methods.push(Measurement {
            method: *method,
            threads: request.drawing.threads,
            timing: Timing::default(),
            ns_per_covered_pixel: None,
            counts: counts(*method, &drawn, &frame),
            error: difference.error,
            own_error,
            edge_pixels: difference.edge_pixels,
            highlight_kept: share_kept(&kept.levels, &highlight.levels),
            on_front: false,
        });
    }
    Ok(found)
}

/// A method whose grids do not fit in memory.
///
/// # Errors
/// Any other error.
fn left_out(method: Method, error: anyhow::Error) -> anyhow::Result<LeftOut> {
    match error.downcast_ref::<OutOfMemory>() {
        Some(it) if matches!(it.content, Content::Grids(_)) => Ok(LeftOut {
            method,
            reason: it.to_string(),
        }),
        _ => Err(error),
    }
}

/// The picture of the definition of a method.
async fn reference(
    scene: &Scene,
    method: Method,
    view: &View,
    monitor: Monitor<'_>,
) -> anyhow::Result<Truth> {
    reference::picture(&scene.world, &method.view(view), 0..view.size[1], monitor).await
}

/// The picture of a method: by the renderer, or by the reference if that alone draws it.
async fn picture(
    scene: &mut Scene,
    method: Method,
    view: &View,
    frame: &mut Frame,
    monitor: Monitor<'_>,
) -> anyhow::Result<Truth> {
    if !is_timed(method) {
        return reference(scene, method, view, monitor).await;
    }
    systems::draw(&mut scene.world, &method.view(view), frame)?;
    let levels = frame.levels().iter().map(|it| it.map(f64::from));
    Ok(Truth {
        width: view.size[0],
        levels: levels.collect(),
        triangles: frame.triangles().to_vec(),
    })
}

/// The work for a picture, which is that of the `frame` if the renderer has drawn it.
fn counts(method: Method, drawn: &Truth, frame: &Frame) -> Counts {
    if is_timed(method) {
        return frame.counts();
    }
    let is_covered = |it: &&TriangleId| **it != TriangleId::NONE;
    Counts {
        covered_pixels: drawn.triangles.iter().filter(is_covered).count() as u64,
        ..Counts::default()
    }
}

/// The displayed light that both pictures show at the same pixel and channel, as a share of all that `whole` shows, 0..=1;
/// `None` if it shows none.
pub fn share_kept(kept: &[[f64; 3]], whole: &[[f64; 3]]) -> Option<f64> {
    let (mut common, mut all) = (0, 0);
    for levels in kept.as_flattened().iter().zip(whole.as_flattened()) {
        let [kept, whole] = [levels.0, levels.1].map(|it| u64::from(display_step(*it)));
        common += kept.min(whole);
        all += whole;
    }
    (all > 0).then(|| common as f64 / all as f64)
}
