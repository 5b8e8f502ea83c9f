//! `vary.svg`: a panel for each key, a line of errors for each contender.
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
use crate::output::chart::{self, Area, BLUE, FAINT, GREEN, INK, ORANGE, PURPLE, text_style};
use crate::output::words::rounded;
use crate::shading::limit;

/// The size of a panel, and the height of the heading, in pixels.
const PANEL: (u32, u32) = (540, 400);
const HEADING: u32 = 92;
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

/// Draws one panel: its axes, the limit, and the lines of all contenders.
fn draw(area: &Area, panel: &Panel, limit: f64) -> anyhow::Result<()> {
    let note = panel.emptiness().map(|note| format!(". {note}"));
    let name = format!("{}{}", panel.variable.key, note.unwrap_or_default());
    area.draw_text(&name, &text_style(13.0, INK), (58, 8))?;
    let points = panel.curves.iter().flat_map(|curve| &curve.points);
    let errors = points.filter_map(Point::error).filter(|it| *it > 0.0);
    let decade = errors.fold(limit.max(1e-3), f64::min).log10().floor();
    let least = 10.0_f64.powf(decade).max(LEAST);
    let axis = Positions(&panel.variable);
    let label = |position: f64| axis.label(position);
    let marks = Some((axis.marks(), &label as &dyn Fn(f64) -> String));
    let axes = [("", POSITIONS), ("levels", least..MOST)];
    let mut chart = chart::on(&area.margin(30, 6, 6, 14), [30, 52], 10.0, axes, marks)?;
    let Range { start, end } = POSITIONS;
    let line = vec![(start, limit), (end, limit)];
    chart.draw_series([PathElement::new(line, INK.mix(0.6).stroke_width(1))])?;
    for (curve, color) in panel.curves.iter().zip(COLORS.into_iter().cycle()) {
        let point = |it: &Point| Some((axis.of(it.value), it.error()?.max(least)));
        // A line ends where there is no evidence.
        let runs = curve.points.split(|it| it.error().is_none());
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
