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
use super::measurement::{Measurement, Report};
use crate::components::ShadingMode;
use crate::report::chart::{self, Area, BLUE, FAINT, GREEN, ORANGE};

/// The least error with a place of its own, in levels.
pub const FLOOR: f64 = 1e-3;
/// The ends of the axis of errors: no point lies on the edge.
const ERRORS: Range<f64> = 5e-4..500.0;

const SIZE: (u32, u32) = (960, 600);

/// One method in the plot.
struct Dot<'a> {
    measured: &'a Measurement,
    /// Milliseconds of a frame.
    time: f64,
    /// Levels, at least [`FLOOR`].
    error: f64,
    color: RGBColor,
}

impl<'a> Dot<'a> {
    /// `None` without an error or a time.
    fn of(measured: &'a Measurement) -> Option<Self> {
        Some(Dot {
            measured,
            time: Some(measured.timing.median).filter(|time| *time > 0.0)?,
            error: measured.largest_error()?.max(FLOOR),
            color: match measured.method.mode {
                ShadingMode::Gouraud => BLUE,
                ShadingMode::Phong => ORANGE,
                ShadingMode::UnitVectors => GREEN,
            },
        })
    }
}

/// The plot as SVG.
///
/// # Errors
/// The plotting library gives none in practice.
pub fn svg(report: &Report) -> anyhow::Result<String> {
    let points: Vec<Dot> = report.methods.iter().filter_map(Dot::of).collect();
    let key = if points.is_empty() {
        "No pixel of this view can be compared, so there is nothing to trade."
    } else {
        "Filled: a best trade; the line joins them. Bar: the range of a method's time. An error below 0.001 is drawn \
         at 0.001."
    };
    chart::svg(SIZE, |area| {
        let title = "The cost and the error of each shading method";
        chart::heading(area, title, &[&subject(report), &place(report), key])?;
        if points.is_empty() {
            return Ok(());
        }
        draw(area, &points)
    })
}

/// Draws axes, front, points and labels.
fn draw(area: &Area, points: &[Dot]) -> anyhow::Result<()> {
    let times = points.iter().map(|point| point.time);
    let least = times.clone().fold(f64::INFINITY, f64::min);
    // Room for labels.
    let times = least / 1.5..times.fold(0.0, f64::max) * 1.5;
    let axes = [
        ("time: ms a frame", times.clone()),
        ("largest error against exact Phong: levels of 255", ERRORS),
    ];
    let mut chart = chart::on(&area.margin(108, 12, 12, 24), [52, 72], 12.0, axes)?;
    let front = front(points, times.end);
    chart.draw_series([PathElement::new(front, FAINT.stroke_width(2))])?;
    for point in points {
        let within = |end: f64| (end.clamp(times.start, times.end), point.error);
        let ends = point.measured.timing.interval.map(within);
        chart.draw_series([PathElement::new(ends, point.color.stroke_width(1))])?;
    }
    let plot = chart.plotting_area();
    let columns = plot.get_pixel_range().0;
    let mut taken = Vec::new();
    for point in points {
        let at = plot.map_coordinate(&(point.time, point.error));
        let label = label(point, at, &columns, &taken);
        let style = ("monospace", chart::font(LABEL)).into_font();
        let style = style.color(&point.color);
        area.draw_text(point.measured.method.id, &style, (label[0], label[2]))?;
        let is_filled = point.measured.on_front;
        let inside = if is_filled { point.color } else { WHITE };
        area.draw(&Circle::new(at, 5, inside.filled()))?;
        area.draw(&Circle::new(at, 5, point.color.stroke_width(2)))?;
        taken.push(label);
    }
    Ok(())
}

/// The left, right and upper edge of a point's label, within these `columns`.
///
/// On the front a label is below its point, to the left: a point there would beat this one. Other labels are above their
/// points, to the right. A label that would cover one of the `taken` places moves away
/// from the points.
fn label(point: &Dot, (x, y): (i32, i32), columns: &Range<i32>, taken: &[[i32; 3]]) -> [i32; 3] {
    // The letters of a monospaced font are 0.6 times as wide as high.
    let width = (0.6 * LABEL * point.measured.method.id.len() as f64).ceil() as i32 + 4;
    let height = (1.25 * LABEL) as i32;
    let (left, mut top, step) = if point.measured.on_front {
        (x - width - 4, y + 4, 1)
    } else {
        (x + 6, y - 4 - height, -1)
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
fn front(points: &[Dot], end: f64) -> Vec<(f64, f64)> {
    let on_front = points.iter().filter(|point| point.measured.on_front);
    let mut best: Vec<&Dot> = on_front.collect();
    best.sort_by(|a, b| a.time.total_cmp(&b.time));
    let mut error = ERRORS.end;
    let mut line = Vec::new();
    // Of two best trades the slower errs less, or as much.
    for point in best {
        line.extend([(point.time, error), (point.time, point.error)]);
        error = point.error;
    }
    line.push((end, error));
    line
}
