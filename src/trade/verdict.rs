//! The measured trade in a sentence.
//!
//! Rule: every word follows from a measured number; what was not measured or cannot be told apart is not claimed.

use super::record::{MethodReport, Report};
use super::words::{levels, listed, ratio, short};
use crate::components::ShadingMode;

/// The tolerance the verdict is about, in levels: a displayed byte is then off by one at most.
const HALF_A_LEVEL: f64 = 0.5;

/// Pictures nearer than this, in levels, are called the same.
const SAME: f64 = 1e-3;

/// What Phong costs and what Gouraud errs here; and what the assignment's shortcut does, if it was measured.
pub fn verdict(report: &Report) -> String {
    if report.covered_pixels == 0 {
        return "Nothing is drawn in this view, so there is no error to trade for time.".to_owned();
    }
    let within_half_a_level = |mode| {
        report
            .methods
            .iter()
            .find(|one| one.method.mode == mode && one.method.tolerance == HALF_A_LEVEL)
    };
    let (Some(gouraud), Some(phong)) = (
        within_half_a_level(ShadingMode::Gouraud),
        within_half_a_level(ShadingMode::Phong),
    ) else {
        return "Gouraud and Phong within half a level were not measured both.".to_owned();
    };
    let mut text = format!(
        "{} costs {}; {}.",
        phong_and_its_promise(phong),
        cost(phong, gouraud, " here"),
        gouraud_and_its_error(gouraud)
    );
    let shortcut = report
        .methods
        .iter()
        .find(|one| one.method.mode == ShadingMode::UnitVectors);
    if let Some((shortcut, error)) = shortcut.and_then(|one| Some((one, one.max_error()?))) {
        let mut clauses = vec![format!("costs {}", cost(shortcut, gouraud, ""))];
        clauses.extend(errs_and_misses(error, shortcut));
        text += " The assignment's shortcut, unit vectors interpolated and not renormalised, ";
        text += &listed(&clauses);
        text += ".";
    }
    text
}

fn phong_and_its_promise(phong: &MethodReport) -> String {
    match phong.accuracy.own_error.map(|error| error.max) {
        Some(error) if error > HALF_A_LEVEL => format!(
            "Phong, meant to stay within half a level but {} off,",
            levels(error)
        ),
        _ => "Phong within half a level".to_owned(),
    }
}

fn gouraud_and_its_error(gouraud: &MethodReport) -> String {
    match gouraud.max_error() {
        None => "no pixel of it can be compared with the reference".to_owned(),
        Some(error) if error <= SAME => "Gouraud draws the same picture".to_owned(),
        Some(error) if error <= HALF_A_LEVEL => {
            format!(
                "Gouraud errs by {} at most, which nobody sees",
                levels(error)
            )
        }
        Some(error) => format!("Gouraud {}", listed(&errs_and_misses(error, gouraud))),
    }
}

/// How far it errs, and what of the highlight is not where it belongs, if that is worth a word.
fn errs_and_misses(error: f64, of: &MethodReport) -> Vec<String> {
    let errs = if error <= SAME {
        "does not err".to_owned()
    } else {
        format!("errs up to {}", levels(error))
    };
    let missing = of.accuracy.highlight_kept.map(|kept| 1.0 - kept);
    let misses = match missing {
        Some(share) if share > 0.995 => Some("misses the highlight".to_owned()),
        Some(share) if share > 0.05 => {
            Some(format!("misses {:.0} % of the highlight", 100.0 * share))
        }
        _ => None,
    };
    std::iter::once(errs).chain(misses).collect()
}

/// What `one` costs next to `gouraud`, followed by the place.
fn cost(one: &MethodReport, gouraud: &MethodReport, place: &str) -> String {
    let [time, base] = [&one.timing, &gouraud.timing];
    if time.is_measurably_less_than(base) || base.is_measurably_less_than(time) {
        // The smaller of two times may be too short for the clock, and then there is no ratio.
        match ratio(time.median, base.median) {
            Some(times) => format!("{times}x Gouraud{place}"),
            None => format!("{} ms{place}", short(Some(time.median))),
        }
    } else {
        format!("as much as Gouraud{place} (no measurable difference)")
    }
}
