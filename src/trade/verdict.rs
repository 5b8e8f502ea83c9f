//! The trade of a method in a sentence.
//!
//! Every word follows from a measured number. Times with overlapping intervals are called the same.

use super::measurement::Measurement;
use crate::components::ShadingMode::{self, Gouraud, Phong, UnitVectors};
use crate::report::words::{capital, short};
use crate::shading::Method;

/// An error that changes a displayed byte by one at most, in levels.
pub const UNSEEN: f64 = 0.5;
/// Times with a larger ratio are not called alike, however wide their intervals are.
const ALIKE: f64 = 1.2;
/// Smaller errors are those of f32, in levels.
const ROUNDING: f64 = 1e-3;
const NOTHING: &str = "Nothing is drawn in this view, so there is nothing to trade.";

/// The sentences about Gouraud, exact Phong and the assignment's shortcut, if they were measured.
pub fn verdict(measured: &[Measurement]) -> String {
    if measured.iter().all(|it| it.error.is_none()) {
        return NOTHING.to_owned();
    }
    let [exact, shortcut] = [Phong, UnitVectors].map(|mode| find(measured, mode, 0.0));
    let subjects = [gouraud(measured), exact, shortcut];
    let sentences = subjects.into_iter().flatten().map(|it| of(measured, it));
    sentences.collect::<Vec<String>>().join(" ")
}

/// The cost and the error of `shown` against its alternatives; `None` if it was not measured.
pub fn sentence(measured: &[Measurement], shown: Method) -> Option<String> {
    let shown = find(measured, shown.mode, shown.tolerance)?;
    Some(match shown.error {
        Some(_) => of(measured, shown),
        None => NOTHING.to_owned(),
    })
}

fn find(measured: &[Measurement], mode: ShadingMode, tolerance: f64) -> Option<&Measurement> {
    let method = Method::of(mode, tolerance);
    measured.iter().find(|it| it.method == method)
}

/// Gouraud at its usual tolerance.
fn gouraud(measured: &[Measurement]) -> Option<&Measurement> {
    find(measured, Gouraud, UNSEEN).or_else(|| find(measured, Gouraud, 0.0))
}

fn of(measured: &[Measurement], shown: &Measurement) -> String {
    let is_phong = shown.method.mode == Phong;
    let [exact, half] = [0.0, UNSEEN].map(|tolerance| find(measured, Phong, tolerance));
    let error = shown.largest_error().unwrap_or_default();
    let is_seen = error > UNSEEN;
    let rival = if is_phong && !is_seen {
        gouraud(measured)
    } else {
        // Half a level is worth its error where it saves time.
        let worth = |half: &&Measurement| exact.is_none_or(|exact| is_faster(half, exact));
        half.filter(worth).or(exact)
    };
    let rival = rival.filter(|rival| rival.method != shown.method);
    let its_error = rival
        .and_then(Measurement::largest_error)
        .unwrap_or_default();
    let errs = match times(its_error, error) {
        _ if is_seen || its_error <= UNSEEN => format!("off by {} of 255", short(Some(error))),
        Some(more) if error > ROUNDING => format!("{more} times more exact"),
        _ => "off by no more than rounding".to_owned(),
    };
    let against = rival.map_or_else(String::new, |rival| {
        let is_trade = is_seen && is_faster(shown, rival);
        let but = if is_trade { "but" } else { "and" };
        let name = method_name(rival.method);
        format!("{} {name}, {but} ", pace(shown, rival))
    });
    let remark = match (exact, half) {
        (Some(exact), Some(half)) if exact.method == shown.method => {
            let (name, pace) = (capital(&method_name(half.method)), pace(half, exact));
            let verdict = if saves_nothing(half, exact) {
                ": nothing to trade here"
            } else {
                ""
            };
            format!(" {name} is {pace} it{verdict}.")
        }
        (Some(exact), _) if is_phong && rival != Some(exact) && saves_nothing(shown, exact) => {
            let pace = pace(exact, shown);
            format!(" Exact Phong is {pace} it: nothing to trade here.")
        }
        _ => String::new(),
    };
    let name = capital(&method_name(shown.method));
    if shown.method.mode == UnitVectors {
        // It is evaluated by its definition, so its time is not that of a renderer that uses it.
        return format!("{name}: {errs}.");
    }
    format!("{name}: {against}{errs}.{remark}")
}

/// Whether a frame of `one` takes measurably less time.
fn is_faster(one: &Measurement, other: &Measurement) -> bool {
    one.timing.is_measurably_less_than(&other.timing)
}

/// Whether `one` takes as long as `exact`, or longer, wherever in their intervals both times are. Wide intervals do not say
/// so.
fn saves_nothing(one: &Measurement, exact: &Measurement) -> bool {
    let ([least, _], [_, most]) = (one.timing.interval, exact.timing.interval);
    !is_faster(one, exact) && least * ALIKE >= most
}

/// "2.3 times faster than", "about as fast as", "not measurably faster than".
fn pace(one: &Measurement, other: &Measurement) -> String {
    let [mine, its] = [one, other].map(|it| it.timing.median);
    let (ratio, word) = if is_faster(one, other) {
        (times(its, mine), "faster")
    } else if is_faster(other, one) {
        (times(mine, its), "slower")
    } else if mine * ALIKE < its {
        return "not measurably faster than".to_owned();
    } else if its * ALIKE < mine {
        return "not measurably slower than".to_owned();
    } else {
        return "about as fast as".to_owned();
    };
    // If the smaller time is too short for the clock, the ratio is not finite.
    let ratio = ratio.map_or(String::new(), |ratio| format!("{ratio} times "));
    format!("{ratio}{word} than")
}

/// `value` / `base` in two significant digits; `None` if it is not finite.
fn times(value: f64, base: f64) -> Option<String> {
    let ratio = value / base;
    let digits = if ratio < 1.1 { 2 } else { 1 };
    let rounded: f64 = format!("{ratio:.digits$e}").parse().ok()?;
    ratio.is_finite().then(|| rounded.to_string())
}

/// A method in words: "Phong within half a level".
pub fn method_name(method: Method) -> String {
    match (method.mode, method.tolerance) {
        (UnitVectors, _) => "interpolated unit vectors".to_owned(),
        (Gouraud, 0.0) => "exact Gouraud".to_owned(),
        // Its tolerance is against itself, and says nothing about its error against Phong.
        (Gouraud, UNSEEN) => "Gouraud".to_owned(),
        (Gouraud, levels) => format!("Gouraud ({levels} of its own)"),
        (Phong, 0.0) => "exact Phong".to_owned(),
        (Phong, UNSEEN) => "Phong within half a level".to_owned(),
        (Phong, 1.0) => "Phong within 1 level".to_owned(),
        (Phong, levels) => format!("Phong within {levels} levels"),
    }
}
