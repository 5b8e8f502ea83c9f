//! A report in, the text of `trade.svg` out: the largest error of each method against its time, and the front.
//!
//! ```text
//!  levels |----o gouraud                 o  on the front, which is the line
//!         |    |            x            x  beaten by another method
//!         |    +------o phong-0.5
//!  <=0.001+--------------------- ns per covered pixel
//! ```
//! Rule: both axes are logarithmic; what lies below [`FLOOR`], zero included, stands on the floor, whose tick says so.

use std::ops::Range;

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::chart::{self, Area, Axis, BLUE, FAINT, GREEN, INK, ORANGE, text_style};
use super::export::{place, subject};
use super::record::{MethodReport, Report};
use crate::components::ShadingMode;

/// The least error that the plot tells from none, in levels.
pub const FLOOR: f64 = 1e-3;
/// A little below the floor and above 255 levels, so that no point lies on the edge.
const BOTTOM: f64 = 5e-4;
const CEILING: f64 = 500.0;
/// Errors that get a tick, in levels.
const ERRORS: [f64; 7] = [FLOOR, 0.01, 0.1, 1.0, 10.0, 100.0, 255.0];

const SIZE: (u32, u32) = (960, 600);

/// One method as it is drawn.
struct Point<'a> {
    measured: &'a MethodReport,
    /// ns per covered pixel.
    time: f64,
    /// Levels, at least [`FLOOR`].
    error: f64,
}

impl<'a> Point<'a> {
    /// `None` where there is no error or no time to draw.
    fn of(measured: &'a MethodReport) -> Option<Self> {
        Some(Point {
            measured,
            time: measured.ns_per_covered_pixel.filter(|time| *time > 0.0)?,
            error: measured.max_error()?.max(FLOOR),
        })
    }

    fn color(&self) -> RGBColor {
        color(self.measured.method.mode)
    }
}

fn color(mode: ShadingMode) -> RGBColor {
    match mode {
        ShadingMode::Gouraud => BLUE,
        ShadingMode::Phong => ORANGE,
        ShadingMode::UnitVectors => GREEN,
    }
}

/// The plot as SVG.
///
/// # Errors
/// When the plotting library gives one; it has no reason to.
pub fn svg(report: &Report) -> anyhow::Result<String> {
    let points: Vec<Point> = report.methods.iter().filter_map(Point::of).collect();
    chart::svg(SIZE, |area| {
        chart::heading(
            area,
            "What each shading method costs and errs",
            &[&subject(report), &place(report)],
        )?;
        if points.is_empty() {
            let style = text_style(16.0, INK).pos(Pos::new(HPos::Center, VPos::Center));
            let middle = (SIZE.0 as i32 / 2, SIZE.1 as i32 / 2);
            area.draw_text(
                "No pixel of this view can be compared, so there is nothing to trade.",
                &style,
                middle,
            )?;
            return Ok(());
        }
        draw(area, &points)
    })
}

/// Axes, front, points and labels.
fn draw(area: &Area, points: &[Point]) -> anyhow::Result<()> {
    let times = axis(points);
    let time = Axis {
        name: "time: ns per covered pixel",
        range: times.clone(),
        ticks: chart::ticks(&times),
        label: &|time| time.to_string(),
    };
    let error = Axis {
        name: "largest error against exact Phong: levels of 255",
        range: BOTTOM..CEILING,
        ticks: ERRORS.to_vec(),
        label: &|error| {
            if *error == FLOOR {
                format!("\u{2264} {FLOOR}")
            } else {
                error.to_string()
            }
        },
    };
    let mut chart = chart::on(&area.margin(108, 12, 12, 24), [52, 72], 12.0, time, error)?;
    let front = front(points, times.end);
    chart.draw_series([PathElement::new(front, FAINT.stroke_width(2))])?;
    for point in points {
        let timing = &point.measured.timing;
        let scale = point.time / timing.median;
        let within = |end: f64| ((end * scale).clamp(times.start, times.end), point.error);
        let ends = timing.interval.map(within);
        chart.draw_series([PathElement::new(ends, point.color().stroke_width(1))])?;
    }
    let plot = chart.plotting_area();
    let columns = plot.get_pixel_range().0;
    let mut taken = Vec::new();
    for point in points {
        let at = plot.map_coordinate(&(point.time, point.error));
        let label = label(point, at, &columns, &taken);
        let style = ("monospace", chart::font(LABEL))
            .into_font()
            .color(&point.color());
        area.draw_text(point.measured.method.id, &style, (label[0], label[2]))?;
        dot(area, at, point.color(), point.measured.on_front)?;
        taken.push(label);
    }
    key(area)
}

/// The left, right and upper edge of a point's label, within these `columns`.
///
/// On the front a label stands below its point, to the left, where no point is: it would beat this one. Others stand
/// above theirs, to the right. One that would cover a label that is there moves up until it does not.
fn label(point: &Point, (x, y): (i32, i32), columns: &Range<i32>, taken: &[[i32; 3]]) -> [i32; 3] {
    let (width, height) = (label_width(point.measured.method.id), (1.25 * LABEL) as i32);
    let (left, mut top) = if point.measured.on_front {
        (x - width - 4, y + 4)
    } else {
        (x + 6, y - 4 - height)
    };
    let left = left.min(columns.end - width).max(columns.start + 2);
    let right = left + width;
    let is_taken = |top: i32| {
        taken.iter().any(|[start, end, other]| {
            left < *end && *start < right && (top - other).abs() < height
        })
    };
    while is_taken(top) {
        top -= 1;
    }
    [left, right, top]
}

/// The size of a label's letters, in pixels.
const LABEL: f64 = 12.0;

/// Letters of a monospaced font are 0.6 times as wide as high.
fn label_width(text: &str) -> i32 {
    (0.6 * LABEL * text.len() as f64).ceil() as i32 + 4
}

fn dot(area: &Area, at: (i32, i32), color: RGBColor, filled: bool) -> anyhow::Result<()> {
    area.draw(&Circle::new(
        at,
        5,
        if filled { color } else { WHITE }.filled(),
    ))?;
    area.draw(&Circle::new(at, 5, color.stroke_width(2)))?;
    Ok(())
}

/// What colours, dots and lines mean.
fn key(area: &Area) -> anyhow::Result<()> {
    let mode = |mode| Some((color(mode), true));
    let mut x = 30;
    for (meaning, dot_like) in [
        ("Gouraud", mode(ShadingMode::Gouraud)),
        ("Phong", mode(ShadingMode::Phong)),
        (
            "unit vectors, not renormalised",
            mode(ShadingMode::UnitVectors),
        ),
        ("on the front", Some((FAINT, true))),
        ("beaten by another", Some((FAINT, false))),
        ("where the time may lie", None),
    ] {
        if let Some((color, filled)) = dot_like {
            dot(area, (x, 90), color, filled)?;
        } else {
            let ends = [(x - 8, 90), (x + 6, 90)];
            area.draw(&PathElement::new(ends, FAINT.stroke_width(1)))?;
        }
        area.draw_text(meaning, &text_style(12.0, INK), (x + 11, 84))?;
        x += 38 + label_width(meaning) * 4 / 5;
    }
    Ok(())
}

/// The times shown: all of them, with room for labels.
fn axis(points: &[Point]) -> Range<f64> {
    let times = points.iter().map(|point| point.time);
    let least = times.clone().fold(f64::INFINITY, f64::min);
    least / 1.5..times.fold(0.0, f64::max) * 1.5
}

/// The least error that is to be had for each time, as a line of steps from the top to the right `end`.
fn front(points: &[Point], end: f64) -> Vec<(f64, f64)> {
    let mut best: Vec<&Point> = points
        .iter()
        .filter(|point| point.measured.on_front)
        .collect();
    best.sort_by(|a, b| a.time.total_cmp(&b.time));
    let mut error = CEILING;
    let mut line = Vec::new();
    for point in best {
        if point.error < error {
            line.extend([(point.time, error), (point.time, point.error)]);
            error = point.error;
        }
    }
    line.push((end, error));
    line
}
