//! The ranges in which contenders keep the tolerance, as text for a terminal.

use super::{Curve, Panel, Point, Report};
use crate::output::words::{aligned, capital, joined, rounded, short, wrapped};
use crate::questions::trade::verdict::method_name;
use crate::shading::{METHODS, limit};

const LEGEND: &str = "The range in which the largest error of the picture against exact Phong is proven to be within the \
    tolerance, which is 0.05 if it is 0. Errors are upper bounds, in levels of 255. own: against the method's own \
    definition. textbook-f32: the formula in f32 throughout; reference: in f64.";

/// A number with four digits at most.
pub fn number(value: f64) -> String {
    let rounded = rounded(value, 3);
    match rounded.abs() {
        0.0 => "0".to_owned(),
        1e-3..1e6 => rounded.to_string(),
        _ => format!("{rounded:e}"),
    }
}

/// The name of a contender in a sentence.
fn name(id: &str) -> String {
    let mut methods = METHODS.iter();
    let method = methods.find(|it| it.id == id && it.mode.is_drawn());
    capital(&method.map_or_else(|| id.to_owned(), |it| method_name(*it)))
}

/// A table and a sentence for each key.
pub fn text(report: &Report) -> String {
    let of_panel = |panel| of_panel(panel, limit(report.tolerance));
    let panels = joined(report.keys.iter().map(of_panel), "\n\n");
    let [width, height] = report.heading.size;
    let legend = format!("{LEGEND} Every pixel of {width}x{height} is compared.");
    format!("{panels}\n\n{}", wrapped(&legend))
}

fn of_panel(panel: &Panel, limit: f64) -> String {
    let variable = &panel.variable;
    let [from, to] = [variable.from, variable.to].map(number);
    let at = [&from, &to].map(|end| format!("at {end}"));
    let keeps = format!("keeps {limit}");
    let has_times = panel.curves.iter().any(|it| it.milliseconds().is_some());
    let mut head = vec!["method", &keeps, &at[0], &at[1], "own"];
    head.extend(has_times.then_some("ms"));
    let rows = panel.curves.iter().map(|curve| {
        let ends = [curve.points.first(), curve.points.last()];
        let [first, last] = ends.map(|it| short(it.and_then(Point::error)));
        let own = curve
            .points
            .iter()
            .map(|it| it.found.own_error[1])
            .fold(0.0, f64::max);
        let times = has_times.then(|| {
            let ends = curve.milliseconds();
            ends.map_or_else(|| "-".to_owned(), |ends| ends.map(short).join(" to "))
        });
        let cells = [
            curve.method.to_owned(),
            curve.places(&curve.keeps),
            first,
            last,
            short(own),
        ];
        cells.into_iter().chain(times)
    });
    let table = aligned(&head, rows);
    // The table has those that keep it everywhere or nowhere.
    let key = &variable.key;
    let ends = panel.curves.iter().filter(|it| it.has_end(limit));
    let says = ends.map(|curve| {
        let (name, kept) = (name(curve.method), curve.kept());
        format!("{name} keeps {} {kept}.", levels(limit))
    });
    let says = joined(says.chain(panel.emptiness()), " ");
    let text = format!("{key} from {from} to {to}\n\n{table}");
    if says.is_empty() {
        return text;
    }
    format!("{text}\n\n{}", wrapped(&says))
}

fn levels(limit: f64) -> String {
    match limit {
        0.5 => "half a level".to_owned(),
        1.0 => "1 level".to_owned(),
        _ => format!("{limit} levels"),
    }
}

impl Curve {
    /// Whether the limit is kept somewhere, but not wherever a cuboid is drawn.
    fn has_end(&self, limit: f64) -> bool {
        let is_lost = |it: &Point| it.found.pixels > 0 && !it.found.keeps(limit);
        !self.keeps.is_empty() && self.points.iter().any(is_lost)
    }

    /// The least and the largest time of a frame, if times were measured.
    pub fn milliseconds(&self) -> Option<[f64; 2]> {
        let times = || self.points.iter().filter_map(|it| it.milliseconds);
        let least = times().reduce(f64::min)?;
        Some([least, times().fold(least, f64::max)])
    }
}
