//! Sentences that compare the times and the errors of methods.
//!
//! Every word follows from a measured number.

use super::{Measurement, is_timed};
use crate::components::Segments;
use crate::components::ShadingMode::{BlinnPhong, Flat, Gouraud, Phong, UnitVectors};
use crate::output::words::{capital, counted, is_narrow, joined, pace, short, sure_pace};
use crate::shading::Method;

/// An error that changes a displayed byte by one at most, in levels.
pub const UNSEEN: f64 = 0.5;
const NOTHING: &str = "Nothing is drawn in this view, so there is nothing to trade.";

/// The sentences about Gouraud, Phong within half a level, the assignment's shortcut and Gouraud with enough vertices, if they
/// were measured.
pub fn verdict(measured: &[Measurement]) -> String {
    if measured.iter().all(|it| it.error.is_none()) {
        return NOTHING.to_owned();
    }
    let subjects = [(Gouraud, UNSEEN), (Phong, UNSEEN), (UnitVectors, 0.0)];
    let of = |(mode, tolerance)| find(measured, Method::of(mode, tolerance));
    // The fewest vertices whose error is not visible, or else the most.
    let mut grids = measured.iter().filter(|it| it.method.segments.is_some());
    let is_unseen = |it: &&Measurement| it.largest_error().is_some_and(|it| it <= 2.0 * UNSEEN);
    let mut enough = grids.clone().find(is_unseen).or_else(|| grids.next_back());
    // More cells are not worth a word if one suffices.
    let one = find(measured, Method::of(Gouraud, UNSEEN));
    if one.is_some_and(|it| is_unseen(&it)) {
        enough = None;
    }
    let told = subjects.into_iter().filter_map(of).chain(enough);
    joined(told.filter_map(|it| against_phong(measured, it, pace)), " ")
}

/// The time and the error of `shown`, against Phong and, where it is Phong, against Gouraud; `None` if it was not measured.
/// A ratio of times is told once it is sure.
pub fn sentence(measured: &[Measurement], shown: Method) -> Option<String> {
    let shown = find(measured, shown)?;
    let Some(text) = against_phong(measured, shown, sure_pace) else {
        return Some(NOTHING.to_owned());
    };
    Some(match gouraud_beside(measured, shown) {
        Some(gouraud) => {
            let pace = sure_pace(gouraud.timing.interval, shown.timing.interval);
            let error = short(gouraud.largest_error());
            format!("{text} Gouraud: {pace} this, off by {error}.")
        }
        None => text,
    })
}

/// Whether every ratio of times in [`sentence`] is sure.
pub fn is_sure(measured: &[Measurement], shown: Method) -> bool {
    let Some(shown) = find(measured, shown) else {
        return true;
    };
    let compared = [rival(measured, shown), gouraud_beside(measured, shown)];
    let mut others = compared.into_iter().flatten();
    others.all(|it| is_narrow(it.timing.interval, shown.timing.interval))
}

/// Gouraud, for Phong.
fn gouraud_beside<'a>(measured: &'a [Measurement], shown: &Measurement) -> Option<&'a Measurement> {
    if shown.method.mode != Phong {
        return None;
    }
    find(measured, Method::of(Gouraud, UNSEEN))
}

/// Phong within half a level; exact Phong for that itself, or if it was not measured. `None` for what is not timed.
fn rival<'a>(measured: &'a [Measurement], shown: &Measurement) -> Option<&'a Measurement> {
    let [half, exact] = [UNSEEN, 0.0].map(|tolerance| find(measured, Method::of(Phong, tolerance)));
    let mut rivals = [half, exact].into_iter().flatten();
    rivals.find(|it| it.method != shown.method && is_timed(shown.method))
}

fn find(measured: &[Measurement], method: Method) -> Option<&Measurement> {
    measured.iter().find(|it| it.method == method)
}

/// The time of `shown` compared with its rival, and its error; `None` if nothing is drawn.
fn against_phong(
    measured: &[Measurement],
    shown: &Measurement,
    pace: fn([f64; 2], [f64; 2]) -> String,
) -> Option<String> {
    let error = format!("off by {} of 255", short(shown.largest_error()?));
    let name = capital(&method_name(shown.method));
    Some(match rival(measured, shown) {
        Some(rival) => {
            let pace = pace(shown.timing.interval, rival.timing.interval);
            format!("{name}: {pace} {}, {error}.", method_name(rival.method))
        }
        None => format!("{name}: {error}."),
    })
}

/// A method in words: "Phong within half a level".
pub fn method_name(method: Method) -> String {
    if let Some(count) = method.segments.map(Segments::count) {
        let own = method_name(Method::of(method.mode, method.tolerance));
        return format!("{own} with {}", counted(count, "segment"));
    }
    match (method.mode, method.tolerance) {
        (Flat, _) => "flat shading".to_owned(),
        (BlinnPhong, _) => "Blinn-Phong with four times the shininess".to_owned(),
        (UnitVectors, _) => "interpolated unit vectors".to_owned(),
        (Gouraud, 0.0) => "exact Gouraud".to_owned(),
        // Its tolerance is against itself, and says nothing about its error against Phong.
        (Gouraud, UNSEEN) => "Gouraud".to_owned(),
        (Gouraud, levels) => format!("Gouraud within {levels} of exact Gouraud"),
        (Phong, 0.0) => "exact Phong".to_owned(),
        (Phong, UNSEEN) => "Phong within half a level".to_owned(),
        (Phong, 1.0) => "Phong within 1 level".to_owned(),
        (Phong, levels) => format!("Phong within {levels} levels"),
    }
}
