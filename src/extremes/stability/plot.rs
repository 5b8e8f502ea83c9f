//! `stability.svg`: a panel for each number, a line for each evaluation.
//!
//! ```text
//!  error |      /   f32     
//!   0.05 |- - -/- - - - - -    limit
//!        |____/_________       ours
//!        +-------------- number
//! ```
//! All axes are logarithmic, and all panels have the same axis of errors. A panel is shaded at undecided points.

use std::ops::Range;

use plotters::prelude::*;

use super::curve::{CurvePoint, EVALUATIONS, ErrorCurve};
use crate::prove::Verdict;
use crate::report::chart::{self, Area, BLUE, FAINT, GREEN, INK, ORANGE, PURPLE, text_style};

const SIZE: (u32, u32) = (1080, 900);
const HEADER: u32 = 84;

const ABOUT: &str = "Phong, each pixel against an interval that encloses its exact value; one number of a scene \
    varies in each panel.";

/// In the order of [`EVALUATIONS`].
const COLORS: [RGBColor; 4] = [ORANGE, BLUE, PURPLE, GREEN];

/// The axis of errors, in levels. Smaller errors are drawn at its lower end.
const ERRORS: Range<f64> = 1e-15..1e3;

/// The plot as SVG.
///
/// # Errors
/// The plotting library gives none in practice.
pub fn svg(curves: &[ErrorCurve]) -> anyhow::Result<String> {
    chart::svg(SIZE, |area| {
        let (header, panels) = area.split_vertically(HEADER);
        let title = "How far a picture errs at most, in levels of 255";
        chart::heading(&header, title, &[ABOUT])?;
        key(&header)?;
        let panels = panels.split_evenly((2, 2)).into_iter();
        let mut panels = panels.zip(curves.chunks(EVALUATIONS.len()));
        panels.try_for_each(|(panel, curves)| draw(&panel, curves))
    })
}

/// Draws the legend of the colours.
fn key(area: &Area) -> anyhow::Result<()> {
    let mut x = 24;
    for ((id, limit), color) in EVALUATIONS.into_iter().zip(COLORS) {
        let line = vec![(x, 70), (x + 22, 70)];
        area.draw(&PathElement::new(line, color.stroke_width(3)))?;
        let text = format!("{id}, limit {limit}");
        area.draw_text(&text, &text_style(12.0, color), (x + 28, 63))?;
        x += 200;
    }
    area.draw(&Rectangle::new([(x, 63), (x + 22, 77)], UNDECIDED.filled()))?;
    area.draw_text("not decided", &text_style(12.0, FAINT), (x + 28, 63))?;
    Ok(())
}

/// The shade at undecided points.
const UNDECIDED: RGBColor = RGBColor(0xdd, 0xdf, 0xe2);

/// Draws one panel: its number, the axes, the limits and the lines.
fn draw(area: &Area, curves: &[ErrorCurve]) -> anyhow::Result<()> {
    area.draw_text(curves[0].number, &text_style(13.0, INK), (58, 8))?;
    let [from, to] = curves[0].range();
    let axes = [(curves[0].unit, from..to * 1.0001), ("levels", ERRORS)];
    let mut chart = chart::on(&area.margin(30, 6, 6, 34), [40, 52], 10.0, axes)?;
    let undecided = curves.iter().flat_map(|curve| &curve.points);
    let undecided = undecided.filter(|point| point.verdict == Verdict::Undecided);
    let step = (to / from).powf(0.5 / (curves[0].points.len() - 1) as f64);
    chart.draw_series(undecided.map(|point| {
        let sides = [(point.value / step).max(from), (point.value * step).min(to)];
        let corners = [(sides[0], ERRORS.start), (sides[1], ERRORS.end)];
        Rectangle::new(corners, UNDECIDED.filled())
    }))?;
    let (columns, rows) = area.get_pixel_range();
    for limit in [0.05, 0.5] {
        let line = vec![(from, limit), (to, limit)];
        chart.draw_series([PathElement::new(line, INK.mix(0.6).stroke_width(1))])?;
        let (x, y) = chart.backend_coord(&(to, limit));
        let beside = (x - columns.start + 4, y - rows.start - 6);
        area.draw_text(&limit.to_string(), &text_style(9.0, INK), beside)?;
    }
    // The reference is below the others.
    for (curve, color) in curves.iter().zip(COLORS).rev() {
        let at = |point: &CurvePoint| (point.value, point.error[1].max(ERRORS.start));
        let line: Vec<(f64, f64)> = curve.points.iter().map(at).collect();
        chart.draw_series([PathElement::new(line, color.stroke_width(2))])?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use serde::Deserialize;

    use super::*;
    use crate::extremes::stability::sweeps::SWEEPS;

    #[derive(Deserialize)]
    struct Svg {
        text: Vec<Element>,
    }

    #[derive(Debug, Deserialize)]
    struct Element {
        #[serde(rename = "@x")]
        x: u32,
        #[serde(rename = "@y")]
        y: u32,
        #[serde(rename = "$text", default)]
        text: String,
    }

    #[test]
    fn the_plot_names_every_evaluation_in_its_key_and_every_number_and_limit() {
        let errors = [(1e-3, [[1e-9; 2]; 4]), (1e3, [[0.1, 1.0]; 4])];
        let curves = SWEEPS.iter().flat_map(|sweep| {
            [0, 1, 2, 3].map(|evaluation| ErrorCurve::new(sweep, evaluation, &errors))
        });
        let curves: Vec<ErrorCurve> = curves.collect();
        let text = svg(&curves).expect("it is drawn");
        let Svg { text } = quick_xml::de::from_str(&text).expect("it is XML");
        assert!(
            text.iter().all(|it| it.x < SIZE.0 && it.y < SIZE.1),
            "{text:?}"
        );
        let place = |part: &str| {
            let found = text.iter().find(|it| it.text.contains(part));
            found.map(|it| (it.x, it.y)).expect(part)
        };
        let keys = EVALUATIONS.map(|(id, _)| format!("{id}, limit"));
        let keys = keys
            .iter()
            .map(|it| place(it))
            .chain([place("not decided")]);
        let keys: Vec<(u32, u32)> = keys.collect();
        assert!(
            keys.is_sorted_by(|a, b| a.0 + 100 < b.0 && a.1 == b.1),
            "{keys:?}"
        );
        let numbers = SWEEPS.iter().map(|sweep| place(sweep.number));
        assert!(numbers.is_sorted_by_key(|(x, y)| (y, x)));
        let limits = text.iter().filter(|it| it.text.trim() == "0.05");
        assert_eq!(limits.count(), SWEEPS.len());
    }
}
