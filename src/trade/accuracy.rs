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

use super::TradeError;
use super::error_map::ErrorMap;
use super::flip;
use super::metrics::{self, Error, Picture};
use super::record::error_keys;
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

/// What a pixel takes at most while pictures are compared, in bytes: three truths of 28, a frame with depths of 24, two
/// displayed pictures of 3, two lists of errors of 16, a highlight of 3, and a map of 1 for every method.
const BYTES_PER_PIXEL: usize = 3 * 28 + 24 + 2 * 3 + 2 * 16 + 3 + METHODS.len();

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
/// The scene is left with its specular lights alone.
///
/// # Errors
/// When the picture does not fit in memory, or `cancelled` says yes.
pub(super) fn of_methods(
    methods: &[Method],
    scene: &mut Scene,
    view: &View,
    workers: Workers,
    cancelled: &(dyn Fn() -> bool + Sync),
    on_progress: &(dyn Fn(f64) + Sync),
) -> Result<Vec<Accuracy>, TradeError> {
    let [_, height] = view.size;
    let mut frame = Frame::new(Keep::Levels, workers);
    let modes: HashSet<ShadingMode> = methods
        .iter()
        .map(|method| method.mode)
        .chain([ShadingMode::Phong])
        .collect();
    let steps = modes.len() + methods.len() + 1;
    let told = |done: usize, share: f64| on_progress((done as f64 + share) / steps as f64);
    let truths: HashMap<ShadingMode, Truth> = modes
        .iter()
        .enumerate()
        .map(|(done, &mode)| {
            let row_done = |rows| told(done, rows as f64 / height as f64);
            truth(scene, view, mode, cancelled, &row_done)
                .map(|truth| (mode, truth))
                .ok_or(TradeError::Cancelled)
        })
        .collect::<Result<_, _>>()?;
    let exact = Picture::from(&truths[&ShadingMode::Phong]);
    let exact_bytes = bytes(exact.levels);
    let mut accuracies = Vec::with_capacity(methods.len());
    for (index, method) in methods.iter().enumerate() {
        if cancelled() {
            return Err(TradeError::Cancelled);
        }
        systems::draw(&mut scene.world, &drawn_by(method, view), &mut frame)?;
        let own = Picture::from(&truths[&method.mode]);
        accuracies.push(accuracy(Picture::from(&frame), exact, &exact_bytes, own));
        told(modes.len() + index, 1.0);
    }
    // Their memory is needed for another.
    drop(truths);
    let row_done = |rows| told(steps - 1, rows as f64 / height as f64);
    let highlights = highlights_kept(methods, scene, view, &mut frame, cancelled, &row_done)?;
    for (accuracy, kept) in accuracies.iter_mut().zip(highlights) {
        accuracy.highlight_kept = kept;
    }
    Ok(accuracies)
}

/// Everything but the highlight.
fn accuracy(
    drawn: Picture<f32>,
    exact: Picture<f64>,
    exact_bytes: &[[u8; 3]],
    own: Picture<f64>,
) -> Accuracy {
    let flip = || {
        let drawn_bytes = bytes(drawn.levels);
        let shown = |levels, triangles| Picture {
            width: exact.width,
            levels,
            triangles,
        };
        flip::mean(
            shown(&drawn_bytes, drawn.triangles),
            shown(exact_bytes, exact.triangles),
            flip::PIXELS_PER_DEGREE,
        )
    };
    let compared_to = |truth| move || metrics::compare(drawn, truth);
    let differences = || rayon::join(compared_to(exact), compared_to(own));
    let map = || ErrorMap::between(drawn, exact);
    let (flip_mean, ((error, own_error), map)) =
        rayon::join(flip, || rayon::join(differences, map));
    Accuracy {
        error: PhongError {
            levels: error.error,
            flip_mean,
        },
        own_error: own_error.error,
        highlight_kept: None,
        edge_pixels: error.edge_pixels,
        map,
    }
}

/// `view` as `method` draws it.
pub(super) fn drawn_by(method: &Method, view: &View) -> View {
    View {
        tolerance: method.tolerance,
        ..view.shaded(method.mode)
    }
}

fn truth(
    scene: &Scene,
    view: &View,
    mode: ShadingMode,
    cancelled: &(dyn Fn() -> bool + Sync),
    progress: &(dyn Fn(usize) + Sync),
) -> Option<Truth> {
    let view = view.shaded(mode);
    reference::picture(&scene.world, &view, 0..view.size[1], cancelled, progress)
}

fn bytes<T: Into<f64> + Copy>(levels: &[[T; 3]]) -> Vec<[u8; 3]> {
    let shown = |levels: &[T; 3]| levels.map(|level| display_step(level.into()));
    levels.iter().map(shown).collect()
}

/// For each method the share of the highlight of exact Phong in f64 that it shows where exact Phong shows it.
fn highlights_kept(
    methods: &[Method],
    scene: &mut Scene,
    view: &View,
    frame: &mut Frame,
    cancelled: &(dyn Fn() -> bool + Sync),
    on_progress: &(dyn Fn(usize) + Sync),
) -> Result<Vec<Option<f64>>, TradeError> {
    for light in scene.world.query_mut::<&mut Light>() {
        light.on &= light.kind == LightKind::Specular;
    }
    let view = View {
        background: DVec3::ZERO,
        ..view.clone()
    };
    let exact = truth(scene, &view, ShadingMode::Phong, cancelled, on_progress);
    let whole = bytes(&exact.ok_or(TradeError::Cancelled)?.levels);
    methods
        .iter()
        .map(|method| {
            systems::draw(&mut scene.world, &drawn_by(method, &view), frame)?;
            Ok(share_kept(&bytes(frame.levels()), &whole))
        })
        .collect()
}

/// The part of the light in `whole` that is in `kept` too, at the same pixel and channel; `None` where there is none.
pub fn share_kept(kept: &[[u8; 3]], whole: &[[u8; 3]]) -> Option<f64> {
    let sum = |bytes: &mut dyn Iterator<Item = u8>| -> u64 { bytes.map(u64::from).sum() };
    let pairs = kept.as_flattened().iter().zip(whole.as_flattened());
    let all = sum(&mut whole.as_flattened().iter().copied());
    let common = sum(&mut pairs.map(|(kept, whole)| *kept.min(whole)));
    (all > 0).then(|| common as f64 / all as f64)
}
