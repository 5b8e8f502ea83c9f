//! A measured scaling in, the text of `scale.svg` out: a panel for each quantity.
//!
//! ```text
//!  ms |       /   linear        faster |     /  all that threads can give
//!     |    o/                          |   /o
//!     |  o/                            | /o
//!     +-------- pixels                 +-------- threads
//! ```
//! Rule: all axes are logarithmic, so that what is linear is parallel to the grey line, whatever it costs.

use std::ops::Range;

use plotters::coord::combinators::BindKeyPoints;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::growth::{claim, summary};
use super::report::{place, subject};
use super::{Point, Quantity, Scaling, Series};
use crate::trade::plot::{Area, FAINT, GRID, INK, printable, text_style, ticks};

const SIZE: (u32, u32) = (960, 800);
const HEADER: u32 = 108;

/// Colours that people who see few colours tell apart (Okabe and Ito 2008), by method.
const COLORS: [RGBColor; 3] = [
    RGBColor(0x00, 0x72, 0xb2),
    RGBColor(0xd5, 0x5e, 0x00),
    RGBColor(0xcc, 0x79, 0xa7),
];

/// The plot as SVG.
///
/// # Errors
/// When the plotting library gives one; it has no reason to.
pub fn svg(scaling: &Scaling) -> anyhow::Result<String> {
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        area.fill(&WHITE)?;
        let (header, panels) = area.split_vertically(HEADER);
        title(&header, scaling)?;
        for (panel, series) in panels.split_evenly((2, 2)).iter().zip(&scaling.series) {
            draw(panel, scaling, series)?;
        }
        area.present()?;
    }
    Ok(text)
}

fn title(area: &Area, scaling: &Scaling) -> anyhow::Result<()> {
    for (text, pixels, color, y) in [
        ("How the time of a frame grows", 18.0, INK, 16),
        (&summary(scaling), 12.0, INK, 42),
        (&printable(&subject(scaling)), 12.0, FAINT, 60),
        (&printable(&place(scaling)), 12.0, FAINT, 78),
    ] {
        area.draw_text(text, &text_style(pixels, color), (24, y))?;
    }
    let mut x = 630;
    for (method, color) in scaling.methods.iter().zip(COLORS) {
        area.draw(&Circle::new((x, 24), 4, color.filled()))?;
        area.draw_text(method.id, &text_style(13.0, color), (x + 10, 17))?;
        x += 108;
    }
    Ok(())
}

/// What is drawn of a point: its number, and what the panel's other axis shows of a method.
fn value(series: &Series, point: &Point, method: usize) -> (f64, f64) {
    let value = match series.quantity {
        Quantity::Threads => series.cost(point, method).unwrap_or(0.0),
        _ => point.ms(method),
    };
    (point.number as f64, value)
}

/// One panel: the claim, the axes, a line of slope one, and a line for each method.
fn draw(area: &Area, scaling: &Scaling, series: &Series) -> anyhow::Result<()> {
    area.draw_text(&claim(scaling, series), &text_style(12.0, INK), (24, 8))?;
    // A time too short for the clock has no place on a logarithmic axis.
    let lines: Vec<Vec<(f64, f64)>> = (0..scaling.methods.len())
        .map(|method| {
            let values = series
                .points
                .iter()
                .map(|point| value(series, point, method));
            values.filter(|(_, value)| *value > 0.0).collect()
        })
        .collect();
    let all: Vec<(f64, f64)> = lines.concat();
    let ideal = series
        .points
        .iter()
        .filter(|_| series.quantity == Quantity::Threads);
    let ideal = ideal.map(|point| point.number as f64);
    let Some(values) = range(all.iter().map(|(_, value)| *value).chain(ideal)) else {
        let style = text_style(12.0, FAINT).pos(Pos::new(HPos::Left, VPos::Top));
        area.draw_text("too short for the clock", &style, (24, 40))?;
        return Ok(());
    };
    let numbers = range(all.iter().map(|(number, _)| *number)).unwrap_or(1.0..2.0);
    let mut chart = ChartBuilder::on(area)
        .margin_top(32)
        .margin_right(28)
        .margin_bottom(8)
        .margin_left(8)
        .x_label_area_size(44)
        .y_label_area_size(58)
        .build_cartesian_2d(
            numbers.clone().log_scale().with_key_points(marks(series)),
            values.clone().log_scale().with_key_points(ticks(&values)),
        )?;
    chart
        .configure_mesh()
        .bold_line_style(GRID)
        .light_line_style(TRANSPARENT)
        .axis_style(FAINT)
        .label_style(text_style(11.0, INK))
        .axis_desc_style(text_style(12.0, INK))
        .x_desc(series.quantity.name())
        .y_desc(match series.quantity {
            Quantity::Threads => "times as fast as one",
            _ => "ms a frame",
        })
        .x_label_formatter(&|number| label(series, *number))
        .y_label_formatter(&|value| value.to_string())
        .draw()?;
    if let Some(guide) = guide(series.quantity, &lines, &numbers, &values) {
        chart.draw_series([PathElement::new(guide, FAINT.mix(0.5).stroke_width(1))])?;
    }
    for (line, color) in lines.into_iter().zip(COLORS) {
        chart.draw_series([PathElement::new(line.clone(), color.stroke_width(2))])?;
        chart.draw_series(
            line.into_iter()
                .map(|at| Circle::new(at, 3, color.filled())),
        )?;
    }
    Ok(())
}

/// A little more than from the least to the greatest; `None` where there are none.
fn range(values: impl Iterator<Item = f64> + Clone) -> Option<Range<f64>> {
    let least = values.clone().reduce(f64::min)?;
    let most = values.reduce(f64::max)?;
    Some(least / 1.15..most * 1.15)
}

/// The line of slope one: through the dearest method's last point, or where every thread counts in full.
fn guide(
    quantity: Quantity,
    lines: &[Vec<(f64, f64)>],
    numbers: &Range<f64>,
    values: &Range<f64>,
) -> Option<Vec<(f64, f64)>> {
    let slope = if quantity == Quantity::Threads {
        1.0
    } else {
        let (number, value) = lines.last()?.last()?;
        value / number
    };
    let start = numbers.start.max(values.start / slope);
    let end = numbers.end.min(values.end / slope);
    (start < end).then(|| vec![(start, slope * start), (end, slope * end)])
}

/// The numbers that get a tick.
fn marks(series: &Series) -> Vec<f64> {
    let numbers = series.points.iter().map(|point| point.number);
    let marked = |number: &usize| match series.quantity {
        Quantity::Pixels | Quantity::Lights => true,
        Quantity::Cuboids => number.to_string().trim_end_matches('0') == "1",
        Quantity::Threads => number.is_power_of_two() || series.points.len() <= 8,
    };
    numbers.filter(marked).map(|number| number as f64).collect()
}

/// How a tick is called: pictures by their rows.
fn label(series: &Series, number: f64) -> String {
    let is_it = |point: &&Point| point.number as f64 == number;
    match series.quantity {
        Quantity::Pixels => series
            .points
            .iter()
            .find(is_it)
            .map_or(String::new(), |point| format!("{}p", point.size[1])),
        _ => number.to_string(),
    }
}
