//! Axes and a heading in, the paper that plots are drawn on out: SVG of one look.
//!
//! Rule: both axes are logarithmic, every tick prints as it is written, and colours can be told apart by people who see
//! few of them (Okabe and Ito 2008).

use std::ops::Range;

use plotters::coord::Shift;
use plotters::coord::combinators::{BindKeyPoints, LogCoord, WithKeyPoints};
use plotters::prelude::*;

pub const INK: RGBColor = RGBColor(0x22, 0x26, 0x2b);
pub const FAINT: RGBColor = RGBColor(0x6b, 0x72, 0x7a);
const GRID: RGBColor = RGBColor(0xe4, 0xe6, 0xe9);

pub const BLUE: RGBColor = RGBColor(0x00, 0x72, 0xb2);
pub const ORANGE: RGBColor = RGBColor(0xd5, 0x5e, 0x00);
pub const GREEN: RGBColor = RGBColor(0x00, 0x9e, 0x73);
pub const PURPLE: RGBColor = RGBColor(0xcc, 0x79, 0xa7);

/// What is drawn on.
pub type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

type Logarithmic = WithKeyPoints<LogCoord<f64>>;

/// An area with its axes.
pub type Chart<'a> = ChartContext<'a, SVGBackend<'a>, Cartesian2d<Logarithmic, Logarithmic>>;

/// A picture of `size` pixels as SVG.
///
/// # Errors
/// Those of `draw`, and of the plotting library, which has no reason to give one.
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

/// Letters of a size in pixels.
pub fn text_style(pixels: f64, color: RGBColor) -> TextStyle<'static> {
    ("sans-serif", font(pixels)).into_font().color(&color)
}

/// What a plot is about, in the upper left corner: a title, and lines that may hold names out of files.
pub fn heading(area: &Area, title: &str, lines: &[&str]) -> anyhow::Result<()> {
    area.draw_text(title, &text_style(18.0, INK), (24, 16))?;
    for (line, y) in lines.iter().zip((42..).step_by(18)) {
        // What XML has no place for.
        let line = line.replace(
            |letter: char| letter.is_control() || "\u{fffe}\u{ffff}".contains(letter),
            "\u{fffd}",
        );
        area.draw_text(&line, &text_style(12.0, FAINT), (24, y))?;
    }
    Ok(())
}

/// One of the two axes.
pub struct Axis<'a> {
    /// What it shows, and in what unit.
    pub name: &'a str,
    /// Where it begins and ends, above 0.
    pub range: Range<f64>,
    /// Where lines cross it.
    pub ticks: Vec<f64>,
    /// What is written there.
    pub label: &'a dyn Fn(&f64) -> String,
}

/// Draws the axes and their grid, so many pixels left for the labels below and for those on the left, whose ticks have
/// letters of this size; an axis' name is a pixel larger.
///
/// # Errors
/// Those of the plotting library, which has no reason to give one.
pub fn on<'a>(
    area: &Area<'a>,
    [below, left]: [u32; 2],
    letters: f64,
    x: Axis,
    y: Axis,
) -> anyhow::Result<Chart<'a>> {
    let mut chart = ChartBuilder::on(area)
        .x_label_area_size(below)
        .y_label_area_size(left)
        .build_cartesian_2d(
            x.range.log_scale().with_key_points(x.ticks),
            y.range.log_scale().with_key_points(y.ticks),
        )?;
    chart
        .configure_mesh()
        .bold_line_style(GRID)
        .light_line_style(TRANSPARENT)
        .axis_style(FAINT)
        .label_style(text_style(letters, INK))
        .axis_desc_style(text_style(letters + 1.0, INK))
        .x_desc(x.name)
        .y_desc(y.name)
        .x_label_formatter(x.label)
        .y_label_formatter(y.label)
        .draw()?;
    Ok(chart)
}

/// Round numbers within the axis: 1, 2 and 5 times the powers of ten, or every digit where these are too few.
pub fn ticks(axis: &Range<f64>) -> Vec<f64> {
    let decades = axis.start.log10().floor() as i32..=axis.end.log10().floor() as i32;
    let of = |digits: &[f64]| -> Vec<f64> {
        let all = decades
            .clone()
            .flat_map(|decade| digits.iter().map(move |digit| scaled(*digit, decade)));
        all.filter(|number| axis.contains(number)).collect()
    };
    let few = of(&[1.0, 2.0, 5.0]);
    if few.len() < 3 {
        of(&[1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0])
    } else {
        few
    }
}

/// `digit` times a power of ten, rounded once, so that it prints as it is written.
fn scaled(digit: f64, decade: i32) -> f64 {
    if decade < 0 {
        digit / 10_f64.powi(-decade)
    } else {
        digit * 10_f64.powi(decade)
    }
}
