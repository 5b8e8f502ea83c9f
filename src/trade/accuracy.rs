//! The picture of each method compared with the reference.
//!
//! ```text
//! band of rows --reference--> exact Phong, its highlight --+--> largest error, highlight kept    (errors)
//!              --each method--> levels --------------------+
//! whole picture --+-- exact Phong in f64 ----> statistics, FLIP, error map                      (details)
//!                 '-- its own mode in f64 ---> own error
//! ```
//! A live trade needs the errors alone. Two references serve all methods, a band of rows at a time, so no picture is held.
//! Nothing here is timed, so all cores work on the details. The figures do not depend on their number.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
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
use crate::shading::{METHODS, Method};
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

/// The largest errors of `methods` and their shares of the highlight, without times.
///
/// # Errors
/// If the pictures do not fit in memory, or the work is cancelled.
pub fn errors(
    request: &Request,
    methods: Vec<Method>,
    monitor: Monitor,
) -> anyhow::Result<Vec<Measurement>> {
    if methods.is_empty() {
        return Ok(Vec::new());
    }
    // With the light of the highlight that is kept, and the whole light of the highlight.
    let unknown = |method| (Measurement::new(method, request.threads), [0; 2]);
    let mut errors: Vec<(_, [u64; 2])> = methods.into_iter().map(unknown).collect();
    let view = &request.view;
    let mut scene = request.scene.snapshot();
    let (mut highlight, black) = highlight_of(&scene, view);
    let mut frame = Frame::new(Keep::Levels, Workers::alone(request.level));
    monitor.in_bands("comparing pictures", view.size[1], |rows| {
        let truth = |world: &World, view: &View| {
            exact(
                world,
                view,
                ShadingMode::Phong,
                rows.clone(),
                monitor,
                |_| (),
            )
        };
        let (whole, lit) = (truth(&scene.world, view)?, truth(&highlight.world, &black)?);
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

/// The figures of whole pictures, in the order of the methods of `request`.
///
/// # Errors
/// If the pictures do not fit in memory, or the work is cancelled.
pub fn details(request: &Request, monitor: Monitor) -> anyhow::Result<Vec<Details>> {
    let Request { methods, view, .. } = request;
    let height = view.size[1];
    let workers = Workers::new(all_cores(), request.level);
    let workers = workers.context("cannot start the threads that draw")?;
    let mut frame = Frame::new(Keep::Levels, workers);
    let mut scene = request.scene.snapshot();
    let mut truths = HashMap::new();
    let modes = methods.iter().map(|method| method.mode);
    for mode in modes.chain([ShadingMode::Phong]) {
        if let Entry::Vacant(unknown) = truths.entry(mode) {
            let row_done = |rows| {
                (monitor.progress)("drawing the reference", rows as f64 / height as f64);
            };
            let truth = exact(&scene.world, view, mode, 0..height, monitor, row_done)?;
            unknown.insert(truth);
        }
    }
    let exact = Picture::from(&truths[&ShadingMode::Phong]);
    let mut details = Vec::with_capacity(methods.len());
    for method in methods {
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
        let error = difference.error.zip(flip_mean);
        details.push(Details {
            counts: frame.counts(),
            error: error.map(|(levels, flip_mean)| PhongError { levels, flip_mean }),
            own_error: own.error,
            edge_pixels: difference.edge_pixels,
            map,
        });
        let share = details.len() as f64 / methods.len() as f64;
        (monitor.progress)("measuring errors", share);
    }
    Ok(details)
}

/// The scene with only its specular lights on, and the view with a black background.
fn highlight_of(scene: &Scene, view: &View) -> (Scene, View) {
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
