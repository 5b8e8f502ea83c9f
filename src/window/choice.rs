//! The choice: the method of the next frame. With a budget it is the most exact measured one whose frames keep that, else the
//! viewer's own.

use hecs::World;

use super::canvas::Canvas;
use super::controls::{set_tolerance, step_tolerance};
use super::facts::Facts;
use super::widgets::rounded;
use crate::components::numbers::range_of;
use crate::components::{View, Viewer, common, viewer, viewer_mut};
use crate::questions::trade::budget::held;
use crate::shading::Method;

/// The factor of a press of a key.
const STEP: f64 = 1.25;
/// The budget where no time is known, in milliseconds.
const FIRST: f64 = 1.0;

/// The method that holds the budget: the machine's choice, and so no part of the scene.
#[derive(Default)]
pub struct Choice {
    held: Option<Method>,
}

impl Choice {
    /// With a budget, picks the next frame's method: the most exact one that fits, as measured last. Before any measurement the
    /// tolerance applies.
    pub fn hold(&mut self, budget: Option<f64>, facts: &Facts) {
        let measured = facts.trade.value.as_ref();
        let found = |budget| held(&measured?.methods, budget);
        self.held = budget.and_then(found).map(|(one, _)| one.method);
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

    /// Holds this time, in milliseconds, or the usual tolerance.
    pub fn set_budget(&self, world: &mut World, budget: Option<f64>) {
        set_tolerance(world, Viewer::TOLERANCE);
        let (least, most) = range_of("budget").into_inner();
        let legal = |budget: f64| rounded(budget.clamp(least, most), 1);
        viewer_mut(world).budget = budget.map(legal);
    }

    /// Holds the time that the method on screen takes, with a little room, or the error again.
    pub fn switch(&self, world: &mut World, facts: &Facts) {
        let time = facts.measured_time(self.method(world));
        let next = time.map_or(FIRST, |time| 1.1 * time);
        let has_budget = viewer(world).budget.is_some();
        self.set_budget(world, (!has_budget).then_some(next));
    }

    /// Goes to a coarser tolerance if `steps` is positive; with a budget, to a shorter time. Returns the limit that was reached.
    pub fn step(&self, world: &mut World, steps: i32) -> Option<String> {
        let held = viewer(world).budget;
        let Some(budget) = held else {
            return step_tolerance(world, steps);
        };
        self.set_budget(world, Some(budget * STEP.powi(-steps)));
        None
    }

}
