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

use plotters::prelude::*;

use super::growth::{claim, summary};
use super::report::{place, subject};
use super::{Point, Quantity, Scaling, Series};
use crate::trade::chart::{
    self, Area, Axis, BLUE, Borders, FAINT, INK, ORANGE, PURPLE, text_style,
};

const SIZE: (u32, u32) = (960, 800);
const HEADER: u32 = 108;

const BORDERS: Borders = Borders {
    top: 32,
    right: 28,
    other: 8,
    labels: [44, 58],
    letters: 11.0,
};

/// By method.
const COLORS: [RGBColor; 3] = [BLUE, ORANGE, PURPLE];

/// The plot as SVG.
///
/// # Errors
/// When the plotting library gives one; it has no reason to.
pub fn svg(scaling: &Scaling) -> anyhow::Result<String> {
    chart::svg(SIZE, |area| {
        let (header, panels) = area.split_vertically(HEADER);
        let about = [
            (&*summary(scaling), INK),
            (&subject(scaling), FAINT),
            (&place(scaling), FAINT),
        ];
        chart::heading(&header, "How the time of a frame grows", &about)?;
        key(&header, scaling)?;
        let mut panels = panels.split_evenly((2, 2)).into_iter().zip(&scaling.series);
        panels.try_for_each(|(panel, series)| draw(&panel, scaling, series))
    })
}

/// Which colour is which method.
fn key(area: &Area, scaling: &Scaling) -> anyhow::Result<()> {
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
        area.draw_text(
            "too short for the clock",
            &text_style(12.0, FAINT),
            (24, 40),
        )?;
        return Ok(());
    };
    let numbers = range(all.iter().map(|(number, _)| *number)).unwrap_or(1.0..2.0);
    let across = Axis {
        name: series.quantity.name(),
        range: numbers.clone(),
        ticks: marks(series),
        label: &|number| label(series, *number),
    };
    let up = Axis {
        name: match series.quantity {
            Quantity::Threads => "times as fast as one",
            _ => "ms a frame",
        },
        range: values.clone(),
        ticks: chart::ticks(&values),
        label: &|value| value.to_string(),
    };
    let mut chart = chart::on(area, &BORDERS, across, up)?;
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
