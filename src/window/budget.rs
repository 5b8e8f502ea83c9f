//! The budget of a frame: the method that holds it, and its widgets.

use egui::{Slider, Ui};

use super::app::App;
use super::inspector::{format_number, keep_digits, short};
use super::keys::Command;
use super::style::BAD;
use crate::components::{Budget, ShadingMode, Show, Tolerance, ViewMode};
use crate::trade::budget::{Hold, fitting, ladder};
use crate::trade::words::{capital, method_name};

/// The slider's ends, in milliseconds.
const USUAL: [f64; 2] = [0.01, 100.0];
/// The factor of a press of a key.
const STEP: f64 = 1.25;
/// The budget where no time is known, in milliseconds.
const FIRST: f64 = 1.0;
const SAYS: &str = "The longest time of a frame. The most exact method that holds it draws.";

impl App {
    /// Chooses the method of the next picture where there is a budget. At rest it is the most exact one that was measured to
    /// fit; while things move, the last frame decides. Where nothing was measured the tolerance is drawn.
    pub fn hold_time(&mut self) {
        let Budget(budget) = self.look();
        let ladder = ladder(self.facts.trade.value.as_deref().unwrap_or_default());
        let costs: Vec<f64> = ladder.iter().map(|(_, cost)| *cost).collect();
        let place = ladder
            .iter()
            .position(|(method, _)| Some(*method) == self.held);
        let held = budget.filter(|_| !ladder.is_empty()).map(|budget| {
            self.hold = match place {
                Some(place) if self.facts.trade.current().is_none() => {
                    let hold = if self.hold.place == place {
                        self.hold
                    } else {
                        Hold::at(place)
                    };
                    match self.last_frame() {
                        Some(last) => hold.after(last, &costs, budget),
                        None => hold,
                    }
                }
                _ => Hold::at(fitting(&costs, budget)),
            };
            ladder[self.hold.place].0
        });
        if held != self.held {
            self.held = held;
            self.picture_changed(true);
        }
    }

    /// The milliseconds of the last frame, where another one is to be drawn now.
    fn last_frame(&self) -> Option<f64> {
        let (state, ..) = self.drawn.as_ref()?;
        let is_another = !std::sync::Arc::ptr_eq(state, &self.state);
        let is_wipe = self.look::<Show>().mode == ViewMode::Wipe;
        self.pictures
            .milliseconds(0)
            .filter(|_| is_another && !is_wipe)
    }

    /// Holds this time, in milliseconds, or the error again: that of the method on screen.
    pub fn set_budget(&mut self, budget: Option<f64>) {
        let [least, most] = [Budget::RANGE.start(), Budget::RANGE.end()];
        match (budget, self.held) {
            (None, Some(method)) => self.choose_method(method),
            (None, None) => self.set_look(Budget(None)),
            (Some(budget), _) => {
                self.set_tolerance(Tolerance::default().0);
                self.set_look(Budget(Some(budget.clamp(*least, *most))));
            }
        }
    }

    /// Holds the time that the method on screen takes, or the error again.
    pub fn switch_budget(&mut self) {
        let Budget(budget) = self.look();
        let time = || {
            let method = self.method()?;
            let known = self.measured(method.mode, method.tolerance)?;
            // A little more, so that it holds.
            format!("{:.1e}", 1.1 * known.timing.median).parse().ok()
        };
        let next = budget.is_none().then(|| time().unwrap_or(FIRST));
        self.set_budget(next);
    }

    /// Goes to a shorter time if `steps` is positive, which is coarser.
    pub fn step_budget(&mut self, budget: f64, steps: i32) {
        let next = budget * STEP.powi(-steps);
        self.set_budget(Some(format!("{next:.1e}").parse().unwrap_or(next)));
    }

    /// The switch between error and time, and the budget's slider and outcome.
    pub fn budget_rows(&mut self, ui: &mut Ui) {
        let Budget(before) = self.look();
        ui.horizontal_wrapped(|ui| {
            let error = ui.selectable_label(before.is_none(), "hold the error");
            let says = "Every picture is drawn within the tolerance, however long it takes.";
            if error.on_hover_text(says).clicked() {
                self.set_budget(None);
            }
            self.offer(ui, Command::HoldTime, before.is_some());
        });
        let Some(mut budget) = before else {
            return;
        };
        let before = budget;
        ui.horizontal(|ui| {
            ui.label("budget").on_hover_text(SAYS);
            let slider = Slider::new(&mut budget, USUAL[0]..=USUAL[1]).logarithmic(true);
            let slider = slider.custom_formatter(format_number).suffix(" ms");
            let slider = slider.clamping(egui::SliderClamping::Never);
            ui.add(slider).on_hover_text(SAYS);
            ui.weak("[ ]");
        });
        keep_digits(before, &mut budget);
        if budget != before {
            // The movement of a hand means no more than two digits.
            self.set_budget(Some(format!("{budget:.1e}").parse().unwrap_or(budget)));
        }
        self.outcome(ui, before);
    }

    /// The method chosen, its time and its error: the proven one as soon as it is known.
    fn outcome(&self, ui: &mut Ui, budget: f64) {
        let Some(method) = self.held else {
            ui.weak("Each method is measured once nothing moves.");
            return;
        };
        let is_current = self.facts.trade.current().is_some();
        let known = self.measured(method.mode, method.tolerance);
        let known = known.filter(|_| is_current);
        let time = known.map(|it| it.timing.median);
        let time = time.or_else(|| self.pictures.milliseconds(0));
        let time = time.unwrap_or_default();
        let proof = self.facts.proof.current();
        let proof = proof.filter(|_| method.mode == ShadingMode::Phong);
        let error = match (proof, known.and_then(|it| it.error)) {
            (Some(proof), _) => format!(", proven within {} of 255", short(proof.worst)),
            (None, Some(error)) => format!(", off by {} of 255", short(error)),
            (None, None) => String::new(),
        };
        let name = capital(&method_name(method));
        ui.label(format!("{name}: {} ms{error}", short(time)));
        if time > budget && is_current {
            let over = short(time - budget);
            ui.colored_label(
                BAD,
                format!("Nothing is faster: {over} ms over the budget."),
            );
        }
    }
}
