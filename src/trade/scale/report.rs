//! A measured scaling in, text for a terminal out.
//!
//! Rule: pure; a table for each quantity, its exponents below it, and "-" for what does not exist.

use super::growth::Fit;
use super::{Point, Quantity, Scaling, Series};
use crate::trade::tables::{aligned, wrapped};
use crate::trade::words::{counted, listed, short};

/// What a terminal shows.
pub fn table(scaling: &Scaling) -> String {
    let view = scaling.subject.view() + " where it is not pixels that vary";
    let mut paragraphs = vec![wrapped(&view) + "\n" + &wrapped(&place(scaling))];
    for series in &scaling.series {
        let rows: Vec<_> = series.points.iter().map(|one| row(series, one)).collect();
        paragraphs.push(aligned(&head(series), &rows));
        if !series.fits.is_empty() {
            paragraphs.push(wrapped(&growth(series)));
        }
    }
    paragraphs.push(wrapped(LEGEND));
    paragraphs.join("\n\n") + "\n"
}

const LEGEND: &str = "ms: the least time of a whole frame. ns/px: the same for each covered pixel. \u{b5}s each: the same \
    for each light or cuboid. faster: times as fast as one thread. An exponent is fitted by least squares on logarithms to \
    the upper half of the range; 1 is linear; \u{b1} is its standard error. Lights: places, each with a diffuse and a specular \
    light of one strength, round one cuboid. Cuboids: alike, none before another. Pixels and threads: the scene named above. \
    One thread where it is not threads that vary.";

/// How time grows with a quantity, by method.
fn growth(series: &Series) -> String {
    let exponent = |fit: &Fit| match (fit.exponent, fit.standard_error) {
        (None, _) => format!("- ({})", fit.id),
        (Some(exponent), None) => format!("{exponent:.2} ({})", fit.id),
        (Some(exponent), Some(error)) => format!("{exponent:.2} \u{b1} {error:.2} ({})", fit.id),
    };
    let exponents: Vec<String> = series.fits.iter().map(exponent).collect();
    let from = series.fits.first().map_or(0, |fit| fit.from);
    let [name, ..] = series.quantity.words();
    format!(
        "Time grows as {name} to the power of {}, from {from} on.",
        listed(&exponents)
    )
}

/// Where it was measured.
fn place(scaling: &Scaling) -> String {
    let points = scaling.series.iter().flat_map(|series| &series.points);
    let most = points.map(|point| point.threads).max().unwrap_or(1);
    let threads = match most {
        1 => counted(1, "thread"),
        _ => format!("1 to {most} threads"),
    };
    scaling.subject.place(&threads)
}

/// Two columns for each method, which stands above the first of them.
fn head(series: &Series) -> Vec<String> {
    let methods = series
        .points
        .iter()
        .take(1)
        .flat_map(|point| &point.methods);
    let columns =
        methods.flat_map(|times| [format!("{}\nms", times.id), format!("\n{}", series.unit)]);
    let [name, ..] = series.quantity.words();
    [name.to_owned()].into_iter().chain(columns).collect()
}

/// For pixels, the first cell is the picture's size.
fn row(series: &Series, point: &Point) -> Vec<String> {
    let number = match series.quantity {
        Quantity::Pixels => format!("{}x{}", point.size[0], point.size[1]),
        _ => point.number.to_string(),
    };
    let times = point.methods.iter();
    let cells = times.flat_map(|times| [short(Some(times.ms())), short(times.cost)]);
    std::iter::once(number).chain(cells).collect()
}
