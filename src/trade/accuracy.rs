//! The picture of each method compared with the reference.
//!
//! ```text
//! method --draw--> levels, triangles --+-- exact Phong in f64 ----> error, FLIP, error map
//!                                      +-- its own mode in f64 ---> own error
//! its highlights --draw--> bytes --------- those of exact Phong --> share of the highlight that it keeps
//! ```
//! Nothing here is timed, so all cores work. The figures do not depend on their number.

use std::collections::HashMap;
use std::ops::Range;

use anyhow::Context;
use glam::DVec3;
use hecs::World;

use super::error_map::{Scale, compared};
use super::flip;
use super::measurement::{Details, Measurement, PhongError, Request};
use super::metrics::{self, Picture};
use crate::components::{Light, LightKind, ShadingMode, View};
use crate::drawing::all_cores;
use crate::frame::{Frame, Keep, Workers, display_step};
use crate::memory;
use crate::reference::{self, Truth};
use crate::report::{CANCELLED, Monitor};
use crate::scene::Scene;
use crate::shading::METHODS;
use crate::systems;

/// The most bytes for a pixel during the comparison: three reference pictures of 28, a frame with depths of 25, two lists
/// of errors of 16, a map of 4 for each method, and FLIP.
const BYTES_PER_PIXEL: usize = 3 * 28 + 25 + 2 * 16 + 4 * METHODS.len() + flip::BYTES_PER_PIXEL;

/// # Errors
/// If pictures of this size cannot be compared for lack of memory.
pub fn check_memory(size: [usize; 2]) -> anyhow::Result<()> {
    let room = memory::reserve_pixels::<[u8; BYTES_PER_PIXEL]>(size);
    let room = room.context("the methods cannot be compared")?;
    // Otherwise the compiler may remove an allocation that nobody uses.
    std::hint::black_box(&room);
    Ok(())
}

/// Rows of the reference in `mode`; `progress` receives the number of finished rows.
///
/// # Errors
/// If the work is cancelled.
pub fn exact(
    world: &World,
    view: &View,
    mode: ShadingMode,
    rows: Range<usize>,
    monitor: Monitor,
    progress: impl Fn(usize) + Sync,
) -> anyhow::Result<Truth> {
    let view = view.shaded(mode);
    let exact = reference::picture(world, &view, rows, monitor.is_cancelled, &progress);
    exact.context(CANCELLED)
}

/// The methods of `request` with the accuracy of their pictures, without times.
///
/// # Errors
/// If the pictures do not fit in memory, or the work is cancelled.
pub fn of_methods(request: &Request, monitor: Monitor) -> anyhow::Result<Vec<Measurement>> {
    let Request { methods, view, .. } = request;
    let height = view.size[1];
    let workers = Workers::new(all_cores(), request.level);
    let workers = workers.context("cannot start the threads that draw")?;
    let mut frame = Frame::new(Keep::Levels, workers);
    let mut scene = request.scene.snapshot();
    let (mut highlight, black) = highlight_of(&scene, view);
    let mut modes = vec![ShadingMode::Phong];
    for method in methods {
        if !modes.contains(&method.mode) {
            modes.push(method.mode);
        }
    }
    let steps = 1 + modes.len() + methods.len();
    let told = |done: usize, share: f64| {
        (monitor.progress)("comparing pictures", (done as f64 + share) / steps as f64);
    };
    let truth = |done: usize, world: &World, view: &View, mode| {
        let row_done = |rows| told(done, rows as f64 / height as f64);
        exact(world, view, mode, 0..height, monitor, row_done)
    };
    let mut kept = Vec::new();
    let whole = truth(0, &highlight.world, &black, ShadingMode::Phong)?;
    for method in methods {
        systems::draw(&mut highlight.world, &method.view(&black), &mut frame)?;
        kept.push(share(light_kept(frame.levels(), &whole.levels)));
    }
    drop(whole);
    let truths = (1..)
        .zip(&modes)
        .map(|(done, mode)| Ok((*mode, truth(done, &scene.world, view, *mode)?)));
    let truths: HashMap<ShadingMode, Truth> = truths.collect::<anyhow::Result<_>>()?;
    let exact = Picture::from(&truths[&ShadingMode::Phong]);
    let mut measured = Vec::with_capacity(methods.len());
    for (method, highlight_kept) in methods.iter().zip(kept) {
        monitor.check()?;
        systems::draw(&mut scene.world, &method.view(view), &mut frame)?;
        let drawn = Picture::from(&frame);
        let own = Picture::from(&truths[&method.mode]);
        let (flip_mean, (difference, own, map)) = rayon::join(
            || flip::mean(drawn, exact, flip::PIXELS_PER_DEGREE),
            || {
                let [difference, own] = [exact, own].map(|truth| metrics::compare(drawn, truth));
                let map = compared(drawn, exact).map(|it| Scale::WIDEST.color(it));
                (difference, own, map.collect())
            },
        );
        let error = difference.error;
        measured.push(Measurement {
            error: error.map(|error| error.max),
            worst: error.map(|error| error.max_pixel),
            highlight_kept,
            details: Some(Details {
                counts: frame.counts(),
                error: error
                    .zip(flip_mean)
                    .map(|(levels, flip_mean)| PhongError { levels, flip_mean }),
                own_error: own.error,
                edge_pixels: difference.edge_pixels,
                map,
            }),
            ..Measurement::new(*method, request.threads)
        });
        told(1 + truths.len() + measured.len(), 0.0);
    }
    Ok(measured)
}

/// The scene with only its specular lights on, and the view with a black background.
pub fn highlight_of(scene: &Scene, view: &View) -> (Scene, View) {
    let mut scene = scene.snapshot();
    for light in scene.world.query_mut::<&mut Light>() {
        light.on &= light.kind == LightKind::Specular;
    }
    let view = View {
        background: DVec3::ZERO,
        ..view.clone()
    };
    (scene, view)
}

/// The first light as a share of the second, 0..=1; `None` if the second is 0.
pub fn share([common, all]: [u64; 2]) -> Option<f64> {
    (all > 0).then(|| common as f64 / all as f64)
}

/// The displayed light that both pictures show at the same pixel and channel, and all that `whole` shows.
pub fn light_kept(kept: &[[f32; 3]], whole: &[[f64; 3]]) -> [u64; 2] {
    let (mut common, mut all) = (0, 0);
    for (kept, whole) in kept.as_flattened().iter().zip(whole.as_flattened()) {
        let [kept, whole] = [f64::from(*kept), *whole].map(|it| u64::from(display_step(it)));
        common += kept.min(whole);
        all += whole;
    }
    [common, all]
}
