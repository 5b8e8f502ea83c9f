//! The most exact method that draws a frame within a budget of time.
//!
//! ```text
//! costs of the front, fastest first    0.2  0.31  0.36  0.41  1.0       the budget: 0.4 ms
//! at rest                                           *                    the last that fits
//! after a frame of 0.45 ms                   *                           the last that is predicted to fit
//! ```
//! The choice is a function of numbers; clocks are read elsewhere.

use std::time::Duration;

use super::timing::Batch;
use super::verdict::method_name;
use super::{Measured, Measurement, Request, front, is_timed, measure};
use crate::components::common;
use crate::output::Monitor;
use crate::output::progress::with_bar;
use crate::output::words::{capital, short};
use crate::questions::job::Drawing;
use crate::shading::{Method, methods};

/// The time for timing frames, of all methods together, before one picture is drawn.
const MEASURING_TIME: Duration = Duration::from_secs(1);

/// The best trades and their milliseconds, the fastest and least exact first.
pub fn best_trades(measured: &[Measurement]) -> (Vec<Method>, Vec<f64>) {
    let front = front(measured).into_iter();
    front.map(|it| (it.method, it.timing.median)).unzip()
}

/// The index of the most exact method that fits, or of the fastest if none fits.
pub fn fitting(costs: &[f64], budget: f64) -> usize {
    costs.iter().rposition(|cost| *cost <= budget).unwrap_or(0)
}

/// The index after a frame of `last` milliseconds: over the budget, the most exact of the faster methods that is predicted to
/// fit. The costs may be those of an earlier view; only their ratios count.
pub fn after(place: usize, last: f64, costs: &[f64], budget: f64) -> usize {
    if last <= budget || place == 0 {
        return place;
    }
    let cost = costs.get(place).unwrap_or(&0.0);
    fitting(costs, budget * cost / last).min(place - 1)
}

/// The method that holds a budget, and its time and error in words. `None` if nothing is drawn.
pub fn held(measured: &[Measurement], budget: f64) -> Option<(&Measurement, String)> {
    let (methods, costs) = best_trades(measured);
    let place = fitting(&costs, budget);
    let (method, cost) = (*methods.get(place)?, costs[place]);
    let chosen = measured.iter().find(|it| it.method == method)?;
    let name = capital(&method_name(method));
    let [time, error] = [Some(cost), chosen.largest_error()].map(short);
    let (over, nothing) = (over(cost, budget), "; nothing is faster");
    let nothing = if over.is_empty() { "" } else { nothing };
    let text = format!("{name}: {time} ms, off by {error} of 255{over}{nothing}");
    Some((chosen, text))
}

/// ", 0.2 ms over the budget", or nothing if a time keeps the budget; both in milliseconds.
pub fn over(time: f64, budget: f64) -> String {
    if time > budget {
        format!(", {} ms over the budget", short(time - budget))
    } else {
        String::new()
    }
}

/// Measures the methods for `drawing` and returns the one that holds a budget in milliseconds, as [`held`] does.
///
/// # Errors
/// If memory or threads do not suffice.
pub fn choose(
    drawing: &Drawing,
    budget: f64,
    time_batch: &impl AsyncFn(&Request, usize, Monitor<'_>) -> anyhow::Result<Batch>,
) -> anyhow::Result<Option<(Measurement, String)>> {
    let request = Request {
        drawing: drawing.snapshot(),
        methods: methods(common(&drawing.scene.world))
            .filter(|it| is_timed(*it))
            .collect(),
        time: MEASURING_TIME,
        is_report: false,
    };
    let none = Measured::default();
    let measured = with_bar(async |monitor| measure(&request, &none, time_batch, monitor).await)?;
    Ok(held(&measured.methods, budget).map(|(one, text)| (one.clone(), text)))
}
