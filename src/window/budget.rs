//! The budget of a frame: the method that holds it, and its widgets.

use std::sync::Arc;

use egui::Ui;

use super::app::App;
use super::keys::Action;
use super::widgets::{rounded, short, slider};
use crate::components::Viewer;
use crate::components::range::Milliseconds;
use crate::trade::budget::{after, best_trades, fitting, held, over};
use crate::trade::verdict::method_name;

/// The factor of a press of a key.
const STEP: f64 = 1.25;
/// The budget where no time is known, in milliseconds.
const FIRST: f64 = 1.0;
/// The height of the outcome, in points: room for two lines, so that the rows below do not move.
const OUTCOME: f32 = 34.0;
const BUDGET: [&str; 3] = [
    "budget, ms",
    "[ ]",
    "The longest time that a frame may take. The most exact method that keeps it is chosen.",
];

impl App {
    /// With a budget, picks the next frame's method: the most exact measured one that fits. While the view moves, a frame over
    /// the budget makes it a faster one; at rest all are measured again. Before any measurement the tolerance applies.
    pub fn hold_time(&mut self) {
        let budget = self.viewer().budget;
        let measured = self.facts.trade.value.as_deref().unwrap_or_default();
        let (methods, costs) = best_trades(measured);
        self.held = budget.filter(|_| !methods.is_empty()).map(|budget| {
            let held = methods.iter().position(|it| Some(*it) == self.held);
            let place = match held.filter(|_| !self.facts.trade.is_current) {
                None => fitting(&costs, budget),
                Some(place) => {
                    let last = self.last_frame().unwrap_or_default();
                    after(place, last, &costs, budget)
                }
            };
            methods[place]
        });
    }

    /// The milliseconds of the last frame, where another one is to be drawn now.
    fn last_frame(&self) -> Option<f64> {
        let (drawn, _) = self.drawn.as_ref()?;
        let is_another = !Arc::ptr_eq(drawn, &self.state);
        self.pictures.time.filter(|_| is_another)
    }

    /// Holds this time, in milliseconds, or the error again: that of the method on screen.
    pub fn set_budget(&mut self, budget: Option<f64>) {
        match (budget, self.held) {
            (None, Some(method)) => self.choose_method(method),
            (None, None) => self.viewer_mut().budget = None,
            (Some(budget), _) => {
                let (least, most) = Milliseconds::RANGE.into_inner();
                self.set_tolerance(Viewer::TOLERANCE);
                self.viewer_mut().budget = Some(rounded(budget.clamp(least, most), 1));
            }
        }
    }

    /// Holds the time that the method on screen takes, with a little room, or the error again.
    pub fn switch_budget(&mut self) {
        let time = self.measured_time();
        let next = time.map_or(FIRST, |time| 1.1 * time);
        let budget = self.viewer().budget;
        self.set_budget(budget.is_none().then_some(next));
    }

    /// Goes to a shorter time if `steps` is positive, which is coarser.
    pub fn step_budget(&mut self, budget: f64, steps: i32) {
        self.set_budget(Some(budget * STEP.powi(-steps)));
    }

    /// The switch between error and time, and the budget's slider and outcome.
    pub fn budget_rows(&mut self, ui: &mut Ui) {
        let budget = self.viewer().budget;
        ui.horizontal_wrapped(|ui| {
            let error = ui.selectable_label(budget.is_none(), "hold the error");
            let says = "Every picture is drawn within the tolerance, however long it takes.";
            if error.on_hover_text(says).clicked() {
                self.set_budget(None);
            }
            self.offer(ui, Action::HoldTime, budget.is_some());
        });
        let Some(before) = budget else {
            return;
        };
        let mut budget = before;
        slider(ui, BUDGET, &mut budget, Milliseconds::RANGE, 0.001);
        if budget != before {
            self.set_budget(Some(budget));
        }
        ui.scope(|ui| {
            ui.set_min_height(OUTCOME);
            ui.label(self.outcome(before));
        });
    }

    /// The method that holds the budget, its time and its error.
    fn outcome(&self, budget: f64) -> String {
        let Some(method) = self.held else {
            return "The methods are not measured yet.".to_owned();
        };
        let measured = self.facts.trade.current();
        let held = measured.and_then(|measured| held(measured, budget));
        let unmeasured = || {
            let time = self.milliseconds().unwrap_or_default();
            let (name, over) = (method_name(method), over(time, budget));
            let time = short(time);
            format!("Not measured yet: {name}, last frame {time} ms{over}")
        };
        held.map_or_else(unmeasured, |(_, text)| text)
    }
}
