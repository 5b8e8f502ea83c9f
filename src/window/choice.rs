//! The choice: the method of the next frame. With a budget it is the most exact measured one whose frames keep that, else the
//! viewer's own.

use hecs::World;

use super::canvas::Canvas;
use super::controls::{set_tolerance, step_tolerance};
use super::facts::Facts;
use super::widgets::{rounded, short};
use crate::components::numbers::range_of;
use crate::components::{View, Viewer, common, viewer, viewer_mut};
use crate::questions::trade::budget::{after, best_trades, fitting, held, over};
use crate::questions::trade::verdict::method_name;
use crate::shading::Method;

/// The factor of a press of a key.
const STEP: f64 = 1.25;
/// The budget where no time is known, in milliseconds.
const FIRST: f64 = 1.0;

/// The method that holds the budget: the machine's choice, and so no part of the scene.
#[derive(Default)]
pub struct Choice {
    held: Option<Method>,
    /// The tolerance before the budget, which comes back when the error is held again.
    before: Option<f64>,
}

impl Choice {
    /// With a budget, picks the next frame's method: the most exact measured one that fits. While the view moves, a frame over
    /// the budget makes it a faster one; at rest all are measured again. Before any measurement the tolerance applies.
    /// `last` are the milliseconds of the last frame, where another one is to be drawn now.
    pub fn hold(&mut self, budget: Option<f64>, facts: &Facts, last: Option<f64>) {
        let measured = facts.trade.value.as_ref().map(|it| &it.methods[..]);
        let (methods, costs) = best_trades(measured.unwrap_or_default());
        self.held = budget.filter(|_| !methods.is_empty()).map(|budget| {
            let held = methods.iter().position(|it| Some(*it) == self.held);
            let place = match held.filter(|_| !facts.trade.is_current) {
                None => fitting(&costs, budget),
                Some(place) => after(place, last.unwrap_or_default(), &costs, budget),
            };
            methods[place]
        });
    }

    /// The view of the picture on a canvas.
    pub fn view(&self, world: &World, canvas: &Canvas) -> View {
        let mut view = View::of(world, canvas.size());
        view.camera = view.camera.widened(canvas.fit);
        let held = self.held.map(|method| method.view(&view));
        held.unwrap_or(view)
    }

    /// The method on screen; `None` where the cuboids have different modes.
    pub fn method(&self, world: &World) -> Option<Method> {
        let own = || Some(Method::of(common(world)?, viewer(world).tolerance));
        self.held.or_else(own)
    }

    /// Holds this time, in milliseconds, or the error again, as before.
    pub fn set_budget(&mut self, world: &mut World, budget: Option<f64>) {
        let (before, tolerance) = (viewer(world).budget, viewer(world).tolerance);
        if let Some(budget) = budget {
            self.before = before.map_or(Some(tolerance), |_| self.before);
            set_tolerance(world, Viewer::TOLERANCE);
            let (least, most) = range_of("budget").into_inner();
            viewer_mut(world).budget = Some(rounded(budget.clamp(least, most), 1));
        } else {
            set_tolerance(world, self.before.take().unwrap_or(tolerance));
        }
    }

    /// Holds the time that the method on screen takes, with a little room, or the error again.
    pub fn switch(&mut self, world: &mut World, facts: &Facts) {
        let time = facts.measured_time(self.method(world));
        let next = time.map_or(FIRST, |time| 1.1 * time);
        let has_budget = viewer(world).budget.is_some();
        self.set_budget(world, (!has_budget).then_some(next));
    }

    /// Goes to a coarser tolerance if `steps` is positive; with a budget, to a shorter time. Returns the limit that was reached.
    pub fn step(&mut self, world: &mut World, steps: i32) -> Option<String> {
        let held = viewer(world).budget;
        let Some(budget) = held else {
            return step_tolerance(world, steps);
        };
        self.set_budget(world, Some(budget * STEP.powi(-steps)));
        None
    }

    /// The method that holds the budget, its time and its error. `time` is that of a frame on screen, in milliseconds.
    pub fn outcome(&self, facts: &Facts, time: Option<f64>, budget: f64) -> String {
        let Some(method) = self.held else {
            return "The methods are not measured yet.".to_owned();
        };
        let measured = facts.trade.current();
        let held = measured.and_then(|it| held(&it.methods, budget));
        let unmeasured = || {
            let time = time.unwrap_or_default();
            let (name, over) = (method_name(method), over(time, budget));
            let time = short(time);
            format!("Not measured yet: {name}, last frame {time} ms{over}")
        };
        held.map_or_else(unmeasured, |(_, text)| text)
    }
}
