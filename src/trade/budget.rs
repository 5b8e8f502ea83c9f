//! The most exact method that draws a frame in a time.
//!
//! ```text
//! costs of the front, fastest first    0.2  0.31  0.36  0.41  1.0       the budget: 0.4 ms
//! at rest                                           *                    the last that fits
//! a frame of 0.5 ms                          *                           at once: the method predicted to fit, with room
//! frames of 0.2 ms                                  *                    after enough of them
//! ```
//! The choice is a function of numbers: clocks are read elsewhere.

use std::time::Duration;

use super::Request;
use super::live::{self, Measurement};
use super::progress::with_bar;
use super::words::{capital, method_name, short};
use crate::components::ShadingMode;
use crate::drawing::Drawing;
use crate::shading::Method;

/// The share of the budget that the prediction for another method must keep. The rest is for the noise of two frames.
const ROOM: f64 = 0.8;
/// The frames that must leave room for a more exact method until it is taken.
const PATIENCE: u32 = 45;
/// How many of these frames one without room takes back. A more exact method is thus taken where more than four of five
/// frames leave room; a lone interruption does not keep it away.
const SETBACK: u32 = 4;
/// How long the frames of all methods are timed together before one picture is drawn.
const MEASURING_TIME: Duration = Duration::from_secs(1);

/// The methods of the front and their milliseconds, the fastest and least exact first. The assignment's shortcut, which no
/// scene asks for, is left out.
pub fn ladder(measured: &[Measurement]) -> (Vec<Method>, Vec<f64>) {
    let is_step = |it: &&Measurement| it.on_front && it.method.mode != ShadingMode::UnitVectors;
    let mut steps: Vec<_> = measured.iter().filter(is_step).collect();
    steps.sort_by(|one, other| one.timing.median.total_cmp(&other.timing.median));
    let steps = steps.iter().map(|it| (it.method, it.timing.median));
    steps.unzip()
}

/// The place of the most exact method that fits; that of the fastest where none does.
pub fn fitting(costs: &[f64], budget: f64) -> usize {
    costs.iter().rposition(|cost| *cost <= budget).unwrap_or(0)
}

/// The choice of a method from frame to frame while things move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hold {
    /// The place among the costs.
    pub place: usize,
    /// The frames that left room for a more exact method, less the setbacks.
    calm: u32,
    /// The least exact of those methods.
    least: usize,
}

impl Hold {
    /// Begins at a place.
    pub fn at(place: usize) -> Hold {
        Hold {
            place,
            calm: 0,
            least: usize::MAX,
        }
    }

    /// The choice after a frame at [`Hold::place`] took `last`, in milliseconds as the budget. Costs are those of a view
    /// before, of which the ratios still count.
    #[must_use]
    pub fn after(self, last: f64, costs: &[f64], budget: f64) -> Hold {
        let place = self.place.min(costs.len().saturating_sub(1));
        let fits = fitting(
            costs,
            ROOM * budget * costs.get(place).unwrap_or(&0.0) / last,
        );
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

/// The method that holds a budget, and what is to be said of it.
pub fn held(measured: &[Measurement], budget: f64) -> Option<(&Measurement, String)> {
    let (methods, costs) = ladder(measured);
    let place = fitting(&costs, budget);
    let (method, cost) = (*methods.get(place)?, costs[place]);
    let chosen = measured.iter().find(|it| it.method == method)?;
    let name = capital(&method_name(method));
    let [time, error] = [Some(cost), chosen.error].map(short);
    let over = if cost > budget {
        format!(
            ", {} ms over the budget; nothing is faster",
            short(Some(cost - budget))
        )
    } else {
        String::new()
    };
    Some((
        chosen,
        format!("{name}: {time} ms, off by {error} of 255{over}"),
    ))
}

/// Measures the methods of `drawing`; returns the one that holds the budget, in milliseconds, and what is to be said of
/// it. `None` where nothing is drawn.
///
/// # Errors
/// When memory or threads do not suffice.
pub fn choose(drawing: &Drawing, budget: f64) -> anyhow::Result<Option<(Method, String)>> {
    let drawn = Drawing {
        scene: drawing.scene.snapshot(),
        ..*drawing
    };
    let request = Request::new(drawn, MEASURING_TIME, String::new());
    let measured = with_bar(|on_progress| {
        let told = |share| on_progress("measuring", share);
        live::measure(&request, &[], &|| false, &told)
    })?;
    Ok(held(&measured, budget).map(|(one, text)| (one.method, text)))
}
