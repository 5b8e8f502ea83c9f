//! The most exact method that draws a frame within a budget of time.
//!
//! ```text
//! costs of the front, fastest first    0.2  0.31  0.36  0.41  1.0       the budget: 0.4 ms
//! at rest                                           *                    the last that fits
//! after a frame of 0.5 ms                    *                           the last that is predicted to fit, with room
//! after many frames of 0.2 ms                       *
//! ```
//! The choice is a function of numbers; clocks are read elsewhere.

use std::time::Duration;

use super::batch::time_here;
use super::verdict::method_name;
use super::{Measurement, Request, front, measure};
use crate::drawing::Drawing;
use crate::report::progress::with_bar;
use crate::report::words::{capital, short};
use crate::shading::{METHODS, Method};

/// The predicted time of another method must be within this share of the budget. The rest is for noise.
const ROOM: f64 = 0.8;
/// A more exact method is taken after this number of frames that leave room for it.
const PATIENCE: u32 = 45;
/// A frame without room takes back this number of them, so that more than four of five frames must leave room. A lone
/// interruption does not keep a more exact method away.
const SETBACK: u32 = 4;
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

/// The choice of a method from frame to frame while things move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hold {
    /// The index of its cost.
    pub place: usize,
    /// The frames that left room for a more exact method, less the setbacks.
    calm: u32,
    /// The least exact of those methods.
    least: usize,
}

impl Hold {
    /// Begins with the method at `place`.
    pub fn at(place: usize) -> Hold {
        Hold {
            place,
            calm: 0,
            least: usize::MAX,
        }
    }

    /// The choice after a frame of `last` milliseconds. The costs may be those of an earlier view; only their ratios count.
    #[must_use]
    pub fn after(self, last: f64, costs: &[f64], budget: f64) -> Hold {
        let place = self.place.min(costs.len().saturating_sub(1));
        let cost = costs.get(place).unwrap_or(&0.0);
        let fits = fitting(costs, ROOM * budget * cost / last);
        if last > budget && place > 0 {
            return Hold::at(fits.min(place - 1));
        }
        let (calm, least) = if fits > place {
            (self.calm + 1, self.least.min(fits))
        } else {
            (self.calm.saturating_sub(SETBACK), self.least)
        };
        match calm {
            0 => Hold::at(place),
            PATIENCE.. => Hold::at(least),
            _ => Hold { place, calm, least },
        }
    }
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

/// Measures the methods of `drawing` and returns the result of [`held`] for a budget in milliseconds.
///
/// # Errors
/// If memory or threads do not suffice.
pub fn choose(drawing: &Drawing, budget: f64) -> anyhow::Result<Option<(Method, String)>> {
    let request = Request {
        drawing: Drawing {
            scene: drawing.scene.snapshot(),
            ..*drawing
        },
        methods: METHODS.to_vec(),
        time: MEASURING_TIME,
        is_report: false,
    };
    let measured = with_bar(|monitor| measure(&request, &[], time_here, monitor))?;
    Ok(held(&measured, budget).map(|(one, text)| (one.method, text)))
}
