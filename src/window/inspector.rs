//! The inspector: one side with tabs for the probed pixel, the scene's numbers, the parts that are required, and the proof.

mod pixel;
mod scene;

use egui::{Color32, ProgressBar, RichText, ScrollArea, Ui};
use glam::DVec3;

pub use self::scene::Kind;
use super::app::App;
use super::jobs::State;
use super::style::{BAD, GOOD, STALE};
use crate::components::{Inspector, Tab, Tolerance};

impl App {
    /// Lays out the tabs and the one that is open.
    pub fn inspector(&mut self, ui: &mut Ui) {
        let Inspector(open) = self.look();
        let mut tab = open.unwrap_or(Tab::Pixel);
        ui.add_space(4.0);
        let mut is_folded = false;
        ui.horizontal_wrapped(|ui| {
            for (each, name, says) in [
                (
                    Tab::Pixel,
                    "Pixel",
                    "The computation at a pixel: click one in the picture.",
                ),
                (Tab::Scene, "Scene", "Every number of the scene (E)."),
                (
                    Tab::Required,
                    "Required",
                    "The parts of the model that this picture requires (N).",
                ),
                (
                    Tab::Proof,
                    "Proof",
                    "The proof that the picture keeps its tolerance.",
                ),
            ] {
                ui.selectable_value(&mut tab, each, name)
                    .on_hover_text(says);
            }
            is_folded = ui
                .small_button("⏵")
                .on_hover_text("Fold the inspector (Esc)")
                .clicked();
        });
        if is_folded {
            self.desk.over[1] = false;
            return self.set_look(Inspector(None));
        }
        if Some(tab) != open {
            self.set_look(Inspector(Some(tab)));
        }
        ui.separator();
        let scroll = ScrollArea::both().auto_shrink(false).id_salt(tab.name());
        scroll.show(ui, |ui| match tab {
            Tab::Pixel => self.pixel_tab(ui),
            Tab::Scene => self.scene_tab(ui),
            Tab::Required => self.required_tab(ui),
            Tab::Proof => self.proof_tab(ui),
        });
    }

    /// A row for each part of the model, the one that matters most first; a click shows the picture without it.
    fn required_tab(&mut self, ui: &mut Ui) {
        let Tolerance(tolerance) = self.look();
        ui.label(format!("The largest error of the picture without a part, and whether tolerance {tolerance} requires it. A click leaves the part out."));
        progress(ui, &self.facts.required.state, "leaving out part by part");
        let is_current = self.facts.required.current().is_some();
        let mut left_out = self.desk.left_out;
        if let Some(parts) = &self.facts.required.value {
            egui::Grid::new("required")
                .num_columns(3)
                .striped(true)
                .show(ui, |ui| {
                    for part in parts {
                        let is_left_out = left_out == Some(part.part);
                        if ui.selectable_label(is_left_out, &part.name).clicked() {
                            left_out = (!is_left_out).then_some(part.part);
                        }
                        let ink = |text: String| {
                            RichText::new(text).color(if is_current {
                                Color32::from_gray(220)
                            } else {
                                STALE
                            })
                        };
                        ui.label(ink(short(part.change.most())))
                            .on_hover_text("Levels of 255, proven.");
                        let is_required = !part.change.keeps(tolerance);
                        ui.label(ink(if is_required {
                            "required"
                        } else {
                            "not required"
                        }
                        .to_owned()));
                        ui.end_row();
                    }
                });
        }
        if left_out != self.desk.left_out {
            self.desk.left_out = left_out;
            self.facts.without = super::jobs::Job::default();
        }
        if self.desk.left_out.is_some() && ui.button("show the whole picture").clicked() {
            self.desk.left_out = None;
        }
    }

    fn proof_tab(&mut self, ui: &mut Ui) {
        progress(ui, &self.facts.proof.state, "enclosing every pixel");
        let is_current = self.facts.proof.current().is_some();
        let Some(proof) = &self.facts.proof.value else {
            return;
        };
        let mut text = String::new();
        egui::Grid::new("proof").num_columns(2).striped(true).show(ui, |ui| {
            let mut row = |name: &str, value: String, ink: Color32, says: &str| {
                ui.label(name).on_hover_text(says);
                let ink = if is_current { ink } else { STALE };
                ui.label(RichText::new(&value).monospace().color(ink)).on_hover_text(says);
                ui.end_row();
                text += &format!("{name}\t{value}\n");
            };
            let grey = Color32::from_gray(220);
            let bad = |count: u64| if count > 0 { BAD } else { grey };
            row("proven", proof.proven.to_string(), GOOD, "Pixels whose error is within the tolerance for every value of their enclosure.");
            row("undecided", proof.undecided.to_string(), bad(proof.undecided), "Pixels whose enclosure holds values on both sides of the tolerance.");
            row("refuted", proof.refuted.to_string(), bad(proof.refuted), "Pixels whose error is above the tolerance for every value of their enclosure.");
            row("on an outline", proof.outline.to_string(), grey, "Pixels within 0.01 pixel of an edge: they may show either side.");
            row("with a cuboid", proof.covered.to_string(), grey, "Pixels that show a cuboid.");
            row("largest error", format!("{:.6}", proof.worst), grey, "The largest error that the enclosures leave possible, in levels of 255.");
            row("widest enclosure", format!("{:.1e}", proof.widest_enclosure), grey, "Levels of 255.");
            row("error of f64", format!("{:.1e}", proof.reference_error), grey, "The largest error of the reference in f64 that the enclosures leave possible, in levels of 255.");
        });
        if ui.button("copy").clicked() {
            ui.ctx().copy_text(text);
        }
        for example in &proof.examples {
            ui.monospace(format!("{example:?}"));
        }
    }
}

/// Tells how far a job is, or why it failed.
pub fn progress(ui: &mut Ui, state: &State, words: &str) {
    match state {
        State::Done => {}
        State::Idle => drop(ui.weak("waits until nothing moves")),
        State::Running(share) => {
            drop(ui.add(
                ProgressBar::new(*share as f32).text(format!("{words}, {:.0} %", share * 100.0)),
            ))
        }
        State::Failed(reason) => drop(ui.colored_label(BAD, reason)),
    }
}

/// A button with a colour whose click opens a picker; channels are shares of full strength.
pub fn color_button(ui: &mut Ui, channels: &mut DVec3) {
    let mut bytes = channels
        .to_array()
        .map(|it| (it.clamp(0.0, 1.0) * 255.0).round() as u8);
    let response = ui.color_edit_button_srgb(&mut bytes);
    if response
        .on_hover_text("Colour; each channel is a share of full strength.")
        .changed()
    {
        *channels = DVec3::from(bytes.map(|it| f64::from(it) / 255.0));
    }
}

/// Three digits that matter, or fewer.
pub fn short(value: f64) -> String {
    crate::trade::words::short(Some(value))
}

/// Six significant digits at most, with an exponent where the number is very large or small.
pub fn format_number(value: f64, _: std::ops::RangeInclusive<usize>) -> String {
    let rounded: f64 = format!("{value:.5e}").parse().unwrap_or(value);
    match rounded.abs() {
        0.0 => "0".to_owned(),
        1e-3..1e6 => rounded.to_string(),
        _ => format!("{rounded:e}"),
    }
}
