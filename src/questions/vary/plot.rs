//! `vary.svg`: a panel for each key, a line for each contender; times below errors, if they were measured.
//!
//! ```text
//!  error |\      Gouraud
//!    0.5 |- \ - - - - - -   tolerance
//!        |____\_________    Phong
//!        +-------------- key
//! ```

use std::ops::Range;

use plotters::prelude::*;

use super::export::number;
use super::{Curve, Panel, Point, Report, Variable};
use crate::output::chart::{self, Area, Axis, BLUE, FAINT, GREEN, INK, ORANGE, PURPLE, text_style};
use crate::output::words::rounded;
use crate::shading::limit;

/// The size of a panel, and the heights of the heading and of the times, in pixels.
const PANEL: (u32, u32) = (540, 400);
const HEADING: u32 = 92;
const TIMES: u32 = 150;
/// The axis of errors reaches from the least error, but not below this, to this, in levels.
const LEAST: f64 = 1e-15;
const MOST: f64 = 1e3;

const COLORS: [RGBColor; 6] = [ORANGE, BLUE, PURPLE, GREEN, INK, FAINT];

/// The plot as SVG.
///
/// # Errors
/// The plotting library gives none in practice.
pub fn svg(report: &Report) -> anyhow::Result<String> {
    let columns = report.keys.len().min(2) as u32;
    let rows = report.keys.len().div_ceil(2) as u32;
    let size = (columns.max(2) * PANEL.0, HEADING + rows * PANEL.1);
    chart::svg(size, |area| {
        let (header, panels) = area.split_vertically(HEADING);
        let about = format!(
            "{}: each pixel against an interval that encloses its exact level.",
            report.heading
        );
        let title = "The largest error against exact Phong, in levels of 255";
        chart::heading(&header, title, &[&about])?;
        key(&header, &report.keys[0].curves)?;
        let areas = panels.split_evenly((rows as usize, columns as usize));
        let mut panels = areas.iter().zip(&report.keys);
        panels.try_for_each(|(area, panel)| draw(area, panel, limit(report.tolerance)))
    })
}

/// Draws the legend of the colours.
fn key(area: &Area, curves: &[Curve]) -> anyhow::Result<()> {
    let mut x = 24;
    for (curve, color) in curves.iter().zip(COLORS.into_iter().cycle()) {
        let line = vec![(x, 78), (x + 22, 78)];
        area.draw(&PathElement::new(line, color.stroke_width(3)))?;
        area.draw_text(curve.method, &text_style(12.0, color), (x + 28, 71))?;
        x += 60 + 7 * curve.method.len() as i32;
    }
    Ok(())
}

/// Draws one panel.
fn draw(area: &Area, panel: &Panel, limit: f64) -> anyhow::Result<()> {
    let note = panel.emptiness().map(|note| format!(". {note}"));
    let name = format!("{}{}", panel.variable.key, note.unwrap_or_default());
    area.draw_text(&name, &text_style(13.0, INK), (58, 8))?;
    let has_times = panel.curves.iter().any(|it| it.milliseconds().is_some());
    let (errors, times) = area.split_vertically(if has_times { PANEL.1 - TIMES } else { PANEL.1 });
    let largest =
        |curve: &Curve| -> Vec<f64> { curve.points.iter().filter_map(Point::error).collect() };
    let all = panel.curves.iter().flat_map(largest).filter(|it| *it > 0.0);
    let least = all.fold(limit.max(1e-3), f64::min).log10().floor();
    let range = 10.0_f64.powf(least).max(LEAST)..MOST;
    let axis = ("levels", range);
    lines(&errors, panel, axis, Some(limit), &Point::error)?;
    if has_times {
        let spans = panel.curves.iter().filter_map(Curve::milliseconds);
        let ends = spans.fold([f64::INFINITY, 0.0], |[a, b], [c, d]| [a.min(c), b.max(d)]);
        let range = 0.8 * ends[0]..1.25 * ends[1];
        lines(&times, panel, ("ms", range), None, &|it| it.milliseconds)?;
    }
    Ok(())
}

/// Draws the axes, a limit, and the lines of all contenders.
fn lines(
    area: &Area,
    panel: &Panel,
    y: Axis,
    limit: Option<f64>,
    value: &dyn Fn(&Point) -> Option<f64>,
) -> anyhow::Result<()> {
    let least = y.1.start;
    let axis = Positions(&panel.variable);
    let label = |position: f64| axis.label(position);
    let marks = Some((axis.marks(), &label as &dyn Fn(f64) -> String));
    let area = area.margin(30, 6, 6, 14);
    let mut chart = chart::on(&area, [30, 52], 10.0, [("", POSITIONS), y], marks)?;
    if let Some(limit) = limit {
        let Range { start, end } = POSITIONS;
        let line = vec![(start, limit), (end, limit)];
        chart.draw_series([PathElement::new(line, INK.mix(0.6).stroke_width(1))])?;
    }
    for (curve, color) in panel.curves.iter().zip(COLORS.into_iter().cycle()) {
        let point = |it: &Point| Some((axis.of(it.value), value(it)?.max(least)));
        // A line ends where there is no evidence.
        let runs = curve.points.split(|it| value(it).is_none());
        for run in runs.filter(|run| run.len() > 1) {
            let line: Vec<(f64, f64)> = run.iter().filter_map(point).collect();
            chart.draw_series([PathElement::new(line, color.stroke_width(2))])?;
        }
    }
    Ok(())
}

/// Places of values on an axis from 1 to 10 that the plotting library takes for a logarithmic one.
struct Positions<'a>(&'a Variable);

const POSITIONS: Range<f64> = 1.0..10.0;

impl Positions<'_> {
    fn of(&self, value: f64) -> f64 {
        10.0_f64.powf(self.0.share(value))
    }

    fn label(&self, position: f64) -> String {
        number(rounded(self.0.at(position.log10()), 6))
    }

    /// The places of round values.
    fn marks(&self) -> Vec<f64> {
        let values = self.0.marks().into_iter();
        values.map(|value| self.of(value)).collect()
    }
}
