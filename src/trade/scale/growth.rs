//! Times against a quantity in, the exponent with which they grow and a verdict in a line out.
//!
//! Rule: exponents are fitted to the upper half of the points, where what a frame costs without any of the quantity no longer counts;
//! those within [`MARGIN`] of each other are not told apart.

use super::{Point, Quantity, Scaling, Series};
use crate::trade::words::{listed, short};

/// How far an exponent may be off: over the eightfold range that is the least fitted here, a quarter more or less time.
pub const MARGIN: f64 = 0.1;

/// From here on a growth is nearer to the square than to the quantity itself.
const NEARER_TO_QUADRATIC: f64 = 1.5;

/// The exponent e of y = c x^e by least squares on the logarithms; `None` where fewer than two x differ, or something is
/// not positive.
pub fn exponent(points: &[[f64; 2]]) -> Option<f64> {
    if points.iter().flatten().any(|value| *value <= 0.0) {
        return None;
    }
    let logs: Vec<[f64; 2]> = points.iter().map(|point| point.map(f64::ln)).collect();
    let mean = |axis: usize| logs.iter().map(|log| log[axis]).sum::<f64>() / logs.len() as f64;
    let means = [mean(0), mean(1)];
    let sum = |axis: usize| -> f64 {
        let products = logs
            .iter()
            .map(|log| (log[0] - means[0]) * (log[axis] - means[axis]));
        products.sum()
    };
    let slope = sum(1) / sum(0);
    slope.is_finite().then_some(slope)
}

/// The upper half of the points.
pub fn upper_range(points: &[Point]) -> &[Point] {
    &points[points.len() / 2..]
}

/// The exponents of a series' upper range by method; `None` where there is none to be had, or threads share the work.
pub fn exponents(series: &Series, methods: usize) -> Vec<Option<f64>> {
    let of = |method: usize| {
        let points = upper_range(&series.points).iter();
        let points: Vec<[f64; 2]> = points
            .map(|point| [point.number as f64, point.ms(method)])
            .collect();
        exponent(&points)
    };
    (0..methods)
        .map(|method| (series.quantity != Quantity::Threads).then(|| of(method))?)
        .collect()
}

/// What all series show together.
pub fn summary(scaling: &Scaling) -> String {
    let all = scaling.series.iter().flat_map(|series| {
        let known = known(scaling, series).into_iter();
        known.map(|(exponent, id)| (exponent, id, series.quantity))
    });
    let Some((exponent, id, quantity)) = all.max_by(|one, other| one.0.total_cmp(&other.0)) else {
        return "There is too little to see how time grows.".to_owned();
    };
    let growth = match exponent {
        NEARER_TO_QUADRATIC.. => "Something grows nearly as a square",
        _ if exponent > 1.0 + MARGIN => {
            "Something grows faster than what is drawn, though not as its square"
        }
        _ => "Nothing grows faster than what is drawn",
    };
    format!(
        "{growth}: the steepest is {id}, with {}.",
        power(quantity, exponent)
    )
}

/// What one series shows, and the figures behind it.
pub fn verdict(scaling: &Scaling, series: &Series) -> String {
    let claim = claim(scaling, series);
    let figures = |figures: Vec<(f64, &str)>, words: &dyn Fn(f64) -> String| -> String {
        let figure = |(figure, id)| format!("{} ({id})", words(figure));
        listed(&figures.into_iter().map(figure).collect::<Vec<_>>())
    };
    let (powers, speed_ups) = (known(scaling, series), speed_ups(scaling, series));
    if series.quantity == Quantity::Threads && !speed_ups.is_empty() {
        let times = figures(speed_ups, &|times| format!("{}x", short(Some(times))));
        format!("{claim}: {times}.")
    } else if powers.is_empty() {
        format!("{claim}.")
    } else {
        let from = series.number(&upper_range(&series.points)[0]);
        let powers = figures(powers, &|exponent| power(series.quantity, exponent));
        format!("{claim}: time goes as {powers}, from {from} on.")
    }
}

/// What one series shows, in a few words.
pub fn claim(scaling: &Scaling, series: &Series) -> String {
    let (quantity, name) = (series.quantity, series.quantity.name());
    if quantity == Quantity::Threads {
        let speed_ups = ends(&speed_ups(scaling, series));
        return match speed_ups.zip(series.points.last()) {
            None => "One thread draws, so there is no speed-up to see".to_owned(),
            Some(([least, most], last)) => format!(
                "{} threads are {} to {} times as fast as one",
                last.number,
                short(Some(least)),
                short(Some(most))
            ),
        };
    }
    let Some([least, most]) = ends(&known(scaling, series)) else {
        return format!("There is too little to see how time grows with the {name}");
    };
    if most >= NEARER_TO_QUADRATIC {
        return format!("Time is nearer to the square of the {name} than to their number");
    }
    if most > 1.0 + MARGIN {
        return format!("Time grows faster than the {name}");
    }
    let proportional = least >= 1.0 - MARGIN;
    match (quantity, proportional) {
        (Quantity::Pixels, true) => "Cost per pixel is flat".to_owned(),
        (Quantity::Pixels, false) => "Cost per pixel is flat or falls".to_owned(),
        (_, true) => format!("Time is linear in the {name}"),
        (_, false) => format!("Time is linear in the {name} at most"),
    }
}

/// The least and the greatest of the figures.
fn ends(figures: &[(f64, &str)]) -> Option<[f64; 2]> {
    let all = figures.iter().map(|(figure, _)| *figure);
    Some([all.clone().reduce(f64::min)?, all.reduce(f64::max)?])
}

/// The exponents that exist, each with its method.
fn known(scaling: &Scaling, series: &Series) -> Vec<(f64, &'static str)> {
    let exponents = exponents(series, scaling.methods.len()).into_iter();
    exponents
        .zip(&scaling.methods)
        .filter_map(|(exponent, method)| Some((exponent?, method.id)))
        .collect()
}

fn power(quantity: Quantity, exponent: f64) -> String {
    format!("{}^{exponent:.2}", quantity.name())
}

/// How many times faster the most threads are than the first, by method.
fn speed_ups(scaling: &Scaling, series: &Series) -> Vec<(f64, &'static str)> {
    let last = series.points.last().filter(|point| point.number > 1);
    let methods = scaling.methods.iter().enumerate();
    methods
        .filter_map(|(index, method)| Some((series.cost(last?, index)?, method.id)))
        .collect()
}
