//! `trade.svg`: the largest error of each method against its time, and the front.
//!
//! ```text
//!  levels |----o gouraud                 o  on the front, which is the line
//!         |    |            x            x  beaten by another method
//!         |    +------o phong-0.5
//!         +--------------------- ms a frame
//! ```
//! Both axes are logarithmic. An error below [`FLOOR`], also zero, is drawn there.

use std::ops::Range;

use plotters::prelude::*;

use super::export::{place, subject};
use super::verdict::UNSEEN;
use super::{Measurement, Report, front, is_timed};
use crate::components::ShadingMode;
use crate::output::chart::{self, Area, BLUE, FAINT, GREEN, INK, ORANGE, PURPLE};

/// The least error with a place of its own, in levels.
pub const FLOOR: f64 = 1e-3;
/// The ends of the axis of errors: no point lies on the edge.
const ERRORS: Range<f64> = 5e-4..500.0;

const SIZE: (u32, u32) = (960, 600);

/// The place of a method: milliseconds of a frame, and levels. A method that is not timed lies at the `side`.
pub fn place_of(one: &Measurement, side: f64) -> (f64, f64) {
    let time = if is_timed(one.method) {
        one.timing.median
    } else {
        side
    };
    (time, one.largest_error().unwrap_or_default().max(FLOOR))
}

/// Gouraud within half a level, with ever more vertices.
pub fn vertices<'a>(measured: impl IntoIterator<Item = &'a Measurement>) -> Vec<&'a Measurement> {
    let is_one =
        |it: &&Measurement| it.method.mode == ShadingMode::Gouraud && it.method.tolerance == UNSEEN;
    let mut curve: Vec<_> = measured.into_iter().filter(is_one).collect();
    curve.sort_by_key(|it| it.counts.model_evaluations);
    curve
}

/// The hues of the window's chart, darker because the ground is white.
fn color(mode: ShadingMode) -> RGBColor {
    match mode {
        ShadingMode::Flat => BLUE,
        ShadingMode::Gouraud => ORANGE,
        ShadingMode::Phong => GREEN,
        ShadingMode::UnitVectors => PURPLE,
        ShadingMode::BlinnPhong => INK,
    }
}

/// The plot as SVG.
///
/// # Errors
/// The plotting library gives none in practice.
pub fn svg(report: &Report) -> anyhow::Result<String> {
    let has_place =
        |it: &&Measurement| it.error.is_some() && (it.timing.median > 0.0 || !is_timed(it.method));
    let methods: Vec<_> = report.methods.iter().filter(has_place).collect();
    let key = if methods.is_empty() {
        "No pixel of this view can be compared, so there is nothing to trade."
    } else {
        "Filled: a best trade; the grey line joins them. Orange line: Gouraud with more and more vertices. An error \
         below 0.001 is drawn at 0.001. At the right edge: not timed."
    };
    chart::svg(SIZE, |area| {
        let title = "The cost and the error of each shading method";
        chart::heading(area, title, &[&subject(report), &place(report), key])?;
        if methods.is_empty() {
            return Ok(());
        }
        draw(area, &methods)
    })
}

/// Draws axes, front, points and labels.
fn draw(area: &Area, methods: &[&Measurement]) -> anyhow::Result<()> {
    let timed = methods.iter().filter(|it| is_timed(it.method));
    let medians = timed.map(|it| it.timing.median);
    let least = medians.clone().reduce(f64::min).unwrap_or(1.0);
    // Room for labels.
    let times = least / 1.5..medians.fold(least, f64::max) * 2.0;
    let axes = [
        ("time: ms a frame", times.clone()),
        ("largest error against exact Phong: levels of 255", ERRORS),
    ];
    let mut chart = chart::on(&area.margin(108, 12, 12, 24), [52, 72], 12.0, axes, None)?;
    let line = front_line(methods, times.end);
    chart.draw_series([PathElement::new(line, FAINT.stroke_width(2))])?;
    let curve = vertices(methods.iter().copied()).into_iter();
    let points: Vec<_> = curve.map(|it| place_of(it, times.end)).collect();
    let line = color(ShadingMode::Gouraud).mix(0.5).stroke_width(1);
    chart.draw_series([PathElement::new(points, line)])?;
    let plot = chart.plotting_area();
    let columns = plot.get_pixel_range().0;
    let mut taken = Vec::new();
    for one in methods {
        let (at, color) = (
            plot.map_coordinate(&place_of(one, times.end)),
            color(one.method.mode),
        );
        let label = label(one, at, &columns, &taken);
        let style = ("monospace", chart::font(LABEL)).into_font().color(&color);
        area.draw_text(one.method.id, &style, (label[0], label[2]))?;
        let inside = if one.on_front { color } else { WHITE };
        area.draw(&Circle::new(at, 5, inside.filled()))?;
        area.draw(&Circle::new(at, 5, color.stroke_width(2)))?;
        taken.push(label);
    }
    Ok(())
}

/// The left, right and upper edge of a point's label, within these `columns`.
///
/// On the front a label is below its point, to the left: a point there would beat this one. Other labels are above their
/// points, to the right, or to the left at the right edge. A label that would cover one of the `taken` places moves further from its point.
fn label(
    one: &Measurement,
    (x, y): (i32, i32),
    columns: &Range<i32>,
    taken: &[[i32; 3]],
) -> [i32; 3] {
    // The letters of a monospaced font are 0.6 times as wide as high.
    let width = (0.6 * LABEL * one.method.id.len() as f64).ceil() as i32 + 4;
    let height = (1.25 * LABEL) as i32;
    let is_left = one.on_front || !is_timed(one.method);
    let left = if is_left { x - width - 4 } else { x + 6 };
    let (mut top, step) = if one.on_front {
        (y + 4, 1)
    } else {
        (y - 4 - height, -1)
    };
    let left = left.min(columns.end - width).max(columns.start + 2);
    let right = left + width;
    let is_taken = |top: i32| {
        taken.iter().any(|[start, end, other]| {
            left < *end && *start < right && (top - other).abs() < height
        })
    };
    while is_taken(top) {
        top += step;
    }
    [left, right, top]
}

/// The font size of a label, in pixels.
const LABEL: f64 = 12.0;

/// The least error for each time, as a line of steps from the top to the right `end`.
fn front_line(methods: &[&Measurement], end: f64) -> Vec<(f64, f64)> {
    let mut least = ERRORS.end;
    let mut line = Vec::new();
    // The slower of two best trades errs less.
    for (time, error) in front(methods.iter().copied())
        .into_iter()
        .map(|it| place_of(it, end))
    {
        line.extend([(time, least), (time, error)]);
        least = error;
    }
    line.push((end, least));
    line
}
