//! Every method's picture against the reference's.
//!
//! ```text
//! method --draw--> levels, triangles --+-- exact Phong in f64 ------> error, FLIP, error map
//!                                      +-- its own mode in f64 -----> own error
//! specular lights alone: its bytes over those of exact Phong in f64 > share of the highlight that it keeps
//! ```
//!
//! Rule: nothing here is timed, so all cores work; the figures are the same however many there are.

use std::collections::{HashMap, HashSet};

use glam::DVec3;
use serde::Serialize;

use super::error_map::ErrorMap;
use super::flip;
use super::metrics::{self, Error, Picture};
use super::record::error_keys;
use super::{IsCancelled, TradeError};
use crate::components::{Light, LightKind, ShadingMode, View};
use crate::frame::{Frame, Keep, Workers, display_step};
use crate::memory::{self, OutOfMemory};
use crate::reference::{self, Truth};
use crate::scene::Scene;
use crate::shading::{METHODS, Method};
use crate::systems;

/// How true a method's picture is.
#[derive(Clone, Debug, Serialize)]
pub struct Accuracy {
    /// Against exact Phong.
    pub error: PhongError,
    /// Against the exact evaluation of its own mode; `None` where nothing can be compared.
    #[serde(serialize_with = "error_keys")]
    pub own_error: Option<Error>,
    /// How much of the highlight is where it ought to be, 0..=1; `None` where exact Phong shows none.
    pub highlight_kept: Option<f64>,
    /// Pixels where the method and exact Phong show different faces.
    pub edge_pixels: u64,
    /// Where the error against exact Phong lies.
    #[serde(skip)]
    pub map: ErrorMap,
}

/// How far a picture is from exact Phong; `None` where nothing can be compared.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PhongError {
    #[serde(flatten, serialize_with = "error_keys")]
    pub levels: Option<Error>,
    /// Mean FLIP, 0..=1, of the displayed bytes.
    pub flip_mean: Option<f64>,
}

/// What a pixel takes at most while pictures are compared, in bytes: three truths of 28, a frame with depths of 25, two lists
/// of errors of 16, and a map of 1 for every method.
const BYTES_PER_PIXEL: usize = 3 * 28 + 25 + 2 * 16 + METHODS.len();

/// Whether there is room to compare pictures of this size.
///
/// # Errors
/// When there is not.
pub(super) fn check_memory(size: [usize; 2]) -> Result<(), OutOfMemory> {
    let room: Vec<[u8; BYTES_PER_PIXEL]> = memory::reserve_pixels(size)?;
    // Without it the compiler may leave out an allocation that nobody uses.
    std::hint::black_box(&room);
    Ok(())
}

/// The accuracy of `methods`, in their order; `on_progress` is told, from any thread, the share done, 0..=1.
///
/// # Errors
/// When the picture does not fit in memory, or `cancelled` says yes.
pub(super) fn of_methods(
    methods: &[Method],
    scene: &mut Scene,
    view: &View,
    workers: Workers,
    cancelled: IsCancelled,
    on_progress: &(dyn Fn(f64) + Sync),
) -> Result<Vec<Accuracy>, TradeError> {
    let [_, height] = view.size;
    let mut frame = Frame::new(Keep::Levels, workers);
    let modes: HashSet<ShadingMode> = methods
        .iter()
        .map(|method| method.mode)
        .chain([ShadingMode::Phong])
        .collect();
    let steps = 1 + modes.len() + methods.len();
    let told = |done: usize, share: f64| on_progress((done as f64 + share) / steps as f64);
    let truth = |scene: &Scene, view: &View, done: usize| {
        let row_done = |rows| told(done, rows as f64 / height as f64);
        reference::picture(&scene.world, view, 0..height, cancelled, &row_done)
            .ok_or(TradeError::Cancelled)
    };
    let highlights = {
        let (mut scene, view) = highlight_of(scene, view);
        let whole = truth(&scene, &view.shaded(ShadingMode::Phong), 0)?;
        let kept = methods.iter().map(|method| {
            systems::draw(&mut scene.world, &method.view(&view), &mut frame)?;
            Ok(share_kept(frame.levels(), &whole.levels))
        });
        kept.collect::<Result<Vec<_>, OutOfMemory>>()?
    };
    let truths = (1..)
        .zip(modes)
        .map(|(done, mode)| Ok((mode, truth(scene, &view.shaded(mode), done)?)));
    let truths: HashMap<ShadingMode, Truth> = truths.collect::<Result<_, TradeError>>()?;
    let exact = Picture::from(&truths[&ShadingMode::Phong]);
    let mut accuracies = Vec::with_capacity(methods.len());
    for (method, highlight_kept) in methods.iter().zip(highlights) {
        if cancelled() {
            return Err(TradeError::Cancelled);
        }
        systems::draw(&mut scene.world, &method.view(view), &mut frame)?;
        let drawn = Picture::from(&frame);
        let own = Picture::from(&truths[&method.mode]);
        let (flip_mean, (error, own_error, map)) = rayon::join(
            || flip::mean(drawn, exact, flip::PIXELS_PER_DEGREE),
            || {
                let [error, own_error] = [exact, own].map(|truth| metrics::compare(drawn, truth));
                (error, own_error.error, ErrorMap::between(drawn, exact))
            },
        );
        accuracies.push(Accuracy {
            error: PhongError {
                levels: error.error,
                flip_mean,
            },
            own_error,
            highlight_kept,
            edge_pixels: error.edge_pixels,
            map,
        });
        told(1 + truths.len() + accuracies.len(), 0.0);
    }
    Ok(accuracies)
}

/// The scene with its specular lights alone, before black.
pub(super) fn highlight_of(scene: &Scene, view: &View) -> (Scene, View) {
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

/// The part of the displayed light of `whole` that `kept` shows too, at the same pixel and channel; `None` where there is
/// none.
pub fn share_kept(kept: &[[f32; 3]], whole: &[[f64; 3]]) -> Option<f64> {
    share(light_kept(kept, whole))
}

/// The first light as a share of the second, 0..=1; `None` where there is none.
pub(super) fn share([common, all]: [u64; 2]) -> Option<f64> {
    (all > 0).then(|| common as f64 / all as f64)
}

/// The displayed light that both pictures show, and all that `whole` shows, summed over pixels and channels.
pub(super) fn light_kept(kept: &[[f32; 3]], whole: &[[f64; 3]]) -> [u64; 2] {
    let (mut common, mut all) = (0, 0);
    for (kept, whole) in kept.as_flattened().iter().zip(whole.as_flattened()) {
        let [kept, whole] = [f64::from(*kept), *whole].map(|it| u64::from(display_step(it)));
        common += kept.min(whole);
        all += whole;
    }
    [common, all]
}
