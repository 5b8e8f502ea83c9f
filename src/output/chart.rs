//! The style of all charts in files: SVG with a heading, logarithmic axes and a grid.
//!
//! The colours can be told apart by colour-blind people (Okabe and Ito 2008).

use std::ops::Range;

use plotters::coord::Shift;
use plotters::coord::combinators::{BindKeyPoints, LogCoord, WithKeyPoints};
use plotters::prelude::*;

use super::words::scientific;

pub const INK: RGBColor = RGBColor(0x22, 0x26, 0x2b);
pub const FAINT: RGBColor = RGBColor(0x6b, 0x72, 0x7a);
const GRID: RGBColor = RGBColor(0xe4, 0xe6, 0xe9);

pub const BLUE: RGBColor = RGBColor(0x00, 0x72, 0xb2);
pub const ORANGE: RGBColor = RGBColor(0xd5, 0x5e, 0x00);
pub const GREEN: RGBColor = RGBColor(0x00, 0x9e, 0x73);
pub const PURPLE: RGBColor = RGBColor(0xcc, 0x79, 0xa7);

/// A part of the picture.
pub type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

type Logarithmic = WithKeyPoints<LogCoord<f64>>;

/// An area with its axes.
pub type Chart<'a> = ChartContext<'a, SVGBackend<'a>, Cartesian2d<Logarithmic, Logarithmic>>;

/// A picture of `size` pixels as SVG.
///
/// # Errors
/// The errors of `draw`. The plotting library gives none in practice.
pub fn svg(
    size: (u32, u32),
    draw: impl FnOnce(&Area) -> anyhow::Result<()>,
) -> anyhow::Result<String> {
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, size).into_drawing_area();
        area.fill(&WHITE)?;
        draw(&area)?;
        area.present()?;
    }
    Ok(text)
}

/// The plotting library's font sizes are 1.24 times those it writes.
pub const fn font(pixels: f64) -> f64 {
    1.24 * pixels
}

/// The font of a text, with a size in pixels.
pub fn text_style(pixels: f64, color: RGBColor) -> TextStyle<'static> {
    ("sans-serif", font(pixels)).into_font().color(&color)
}

/// Writes a title and the lines below it into the upper left corner. The lines may contain names from files.
///
/// # Errors
/// The plotting library gives none in practice.
pub fn heading(area: &Area, title: &str, lines: &[&str]) -> anyhow::Result<()> {
    area.draw_text(title, &text_style(18.0, INK), (24, 16))?;
    // XML does not allow these characters.
    let is_illegal = |it: char| it.is_control() || "\u{fffe}\u{ffff}".contains(it);
    for (line, y) in lines.iter().zip((42..).step_by(18)) {
        let line = line.replace(is_illegal, "\u{fffd}");
        area.draw_text(&line, &text_style(12.0, FAINT), (24, y))?;
    }
    Ok(())
}

/// The quantity of an axis and its unit, and its ends, which are above 0.
pub type Axis<'a> = (&'a str, Range<f64>);

/// The places of the marks of an axis, and their labels.
pub type Marks<'a> = (Vec<f64>, &'a dyn Fn(f64) -> String);

/// Draws the axes and their grid, with other marks than [`ticks`] on the axis below if they are given. The labels take `below`
/// and `left` pixels, and the labels of the marks have this font size; the names of the axes are a pixel larger.
///
/// # Errors
/// The plotting library gives none in practice.
pub fn on<'a>(
    area: &Area<'a>,
    [below, left]: [u32; 2],
    letters: f64,
    axes: [Axis; 2],
    marks: Option<Marks>,
) -> anyhow::Result<Chart<'a>> {
    let [x, y] = [axes[0].0, axes[1].0];
    let (places_across, name) = marks.unwrap_or_else(|| (ticks(&axes[0].1), &label));
    let mut places = [places_across, ticks(&axes[1].1)].into_iter();
    let [columns, rows] = axes.map(|(_, range)| {
        range
            .log_scale()
            .with_key_points(places.next().unwrap_or_default())
    });
    let mut chart = ChartBuilder::on(area)
        .x_label_area_size(below)
        .y_label_area_size(left)
        .build_cartesian_2d(columns, rows)?;
    chart
        .configure_mesh()
        .bold_line_style(GRID)
        .light_line_style(TRANSPARENT)
        .axis_style(FAINT)
        .label_style(text_style(letters, INK))
        .axis_desc_style(text_style(letters + 1.0, INK))
        .x_desc(x)
        .y_desc(y)
        .x_label_formatter(&|value| name(*value))
        .y_label_formatter(&|value| label(*value))
        .draw()?;
    Ok(chart)
}

/// Round numbers on the axis: powers of ten, at most eight, or 1, 2 and 5 times them on a short axis, or more
/// digits on a shorter one.
pub fn ticks(axis: &Range<f64>) -> Vec<f64> {
    let [start, end] = [axis.start, axis.end].map(f64::log10);
    let steps = [1, 2, 3, 5, 10, 20, 30, 50];
    let step = steps
        .into_iter()
        .find(|step| end - start <= f64::from(7 * step));
    let of = |digits: &[f64]| -> Vec<f64> {
        let is_marked = |decade: &i32| decade % step.unwrap_or(100) == 0;
        let decades = (start.floor() as i32..=end.floor() as i32).filter(is_marked);
        let all = decades.flat_map(|decade| digits.iter().map(move |digit| scaled(*digit, decade)));
        all.filter(|number| (axis.start..=axis.end).contains(number))
            .collect()
    };
    if end - start >= 3.0 {
        return of(&[1.0]);
    }
    let few = [&[1.0, 2.0, 5.0][..], &[1.0, 2.0, 3.0, 5.0, 7.0]].map(of);
    let enough = few.into_iter().find(|ticks| ticks.len() >= 2);
    enough.unwrap_or_else(|| of(&[1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]))
}

/// `digit` times a power of ten, rounded once, so that its decimal form is short.
fn scaled(digit: f64, decade: i32) -> f64 {
    let decimal = format!("{digit}e{decade}");
    decimal.parse().expect("a decimal number")
}

/// A tick as text; a power of ten with its exponent where it is long.
fn label(value: f64) -> String {
    if (0.001..=1000.0).contains(&value) {
        value.to_string()
    } else {
        scientific(value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_numbers_with_short_labels() {
        for (axis, expected) in [
            (2.0..30.0, "2 5 10 20"),
            (3.0..4.5, "3 4"),
            (0.3..0.9, "0.3 0.5 0.7"),
            (0.06..0.28, "0.1 0.2"),
            (1.0..1000.0, "1 10 100 1000"),
            (5e-4..500.0, "0.001 0.01 0.1 1 10 100"),
            (1.5e4..9e5, "2e4 5e4 1e5 2e5 5e5"),
            (1e-97..1e97, "1e-90 1e-60 1e-30 1 1e30 1e60 1e90"),
        ] {
            let labels: Vec<String> = ticks(&axis).into_iter().map(label).collect();
            assert_eq!(labels.join(" "), expected, "{axis:?}");
        }
    }
}
