//! A measured scaling in; text for a terminal and Markdown out.
//!
//! Rule: pure; a table for each quantity, its verdict above it, and "-" for what does not exist.

use super::growth::{summary, verdict};
use super::{Point, Quantity, Scaling, Series};
use crate::trade::tables::{self, aligned, wrapped};
use crate::trade::words::{counted, short};

/// What a terminal shows.
pub fn table(scaling: &Scaling) -> String {
    let mut paragraphs = vec![
        wrapped(&summary(scaling)),
        wrapped(&subject(scaling)) + "\n" + &wrapped(&place(scaling)),
    ];
    for series in &scaling.series {
        paragraphs.push(wrapped(&verdict(scaling, series)));
        paragraphs.push(aligned(
            &head(scaling, series, ["\n", "\n"]),
            &rows(scaling, series),
        ));
    }
    paragraphs.push(wrapped(LEGEND));
    paragraphs.join("\n\n") + "\n"
}

/// The same for a README.
pub fn markdown(scaling: &Scaling) -> String {
    let series = scaling.series.iter().map(|series| {
        let table = tables::markdown(&head(scaling, series, [" ", ""]), &rows(scaling, series));
        format!("{}\n\n{table}\n", verdict(scaling, series))
    });
    format!(
        "{}\n\n{}  \n{}  \n`{}`\n\n{}{LEGEND}\n",
        summary(scaling),
        subject(scaling),
        place(scaling),
        scaling.subject.command,
        series.collect::<String>(),
    )
}

const LEGEND: &str = "ms: the least time of a whole frame. ns/px: the same for each covered pixel. \u{b5}s each: the same \
    for each light or cuboid. faster: times as fast as one thread. An exponent is fitted by least squares on logarithms to \
    the upper half of the range; up to 0.1 it may be chance. Lights: places, each with a diffuse and a specular light, round \
    one cuboid. Cuboids: alike, none before another. Pixels and threads: the scene named above. One thread where it is not \
    threads that vary.";

/// What was measured.
pub(super) fn subject(scaling: &Scaling) -> String {
    format!(
        "{} where it is not pixels that vary",
        scaling.subject.view()
    )
}

/// Where it was measured.
pub(super) fn place(scaling: &Scaling) -> String {
    let points = scaling.series.iter().flat_map(|series| &series.points);
    let most = points.map(|point| point.threads).max().unwrap_or(1);
    let threads = match most {
        1 => counted(1, "thread", "threads"),
        _ => format!("1 to {most} threads"),
    };
    scaling.subject.place(&threads)
}

/// Two columns for each method, called after it: beside their units, or above the first of them.
fn head(scaling: &Scaling, series: &Series, [before_time, before_cost]: [&str; 2]) -> Vec<String> {
    let cost = match series.quantity {
        Quantity::Pixels => "ns/px",
        Quantity::Lights | Quantity::Cuboids => "\u{b5}s each",
        Quantity::Threads => "faster",
    };
    let columns = scaling.methods.iter().flat_map(|method| {
        [
            format!("{}{before_time}ms", method.id),
            format!("{before_cost}{cost}"),
        ]
    });
    std::iter::once(series.quantity.name().to_owned())
        .chain(columns)
        .collect()
}

fn rows(scaling: &Scaling, series: &Series) -> Vec<Vec<String>> {
    let row = |point: &Point| {
        let cells = (0..scaling.methods.len()).flat_map(|method| {
            [
                short(Some(point.ms(method))),
                short(series.cost(point, method)),
            ]
        });
        std::iter::once(series.number(point)).chain(cells).collect()
    };
    series.points.iter().map(row).collect()
}
