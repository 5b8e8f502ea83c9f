//! The inspector: one side with tabs for the probed pixel, the scene's numbers, the parts that are required, and the proof.

mod pixel;
mod scene;
mod section;

use std::ops::RangeInclusive;

use egui::{Color32, Grid, ProgressBar, RichText, ScrollArea, Ui};
use glam::DVec3;

pub use self::scene::{Kind, intensity};
pub use self::section::CHANNELS;
use super::app::App;
use super::jobs::{Job, State};
use super::style::{BAD, GOOD, INK, STALE};
use crate::components::{Inspector, Tab, Tolerance};
use crate::prove::Proof;
use crate::requires::bits::StageBits;

/// The tabs with their names and sentences.
#[rustfmt::skip]
const TABS: [(Tab, &str, &str); 4] = [
    (Tab::Pixel, "Pixel", "The computation at a pixel: click one in the picture."),
    (Tab::Scene, "Scene", "Every number of the scene (E)."),
    (Tab::Required, "Required", "The parts of the model that this picture requires (N)."),
    (Tab::Proof, "Proof", "The proof that the picture keeps its tolerance."),
];

impl App {
    /// Lays out the tabs and the one that is open.
    pub fn inspector(&mut self, ui: &mut Ui) {
        let Inspector(open) = self.look();
        let mut tab = open.unwrap_or(Tab::Pixel);
        ui.add_space(4.0);
        let mut is_folded = false;
        ui.horizontal_wrapped(|ui| {
            for (each, name, says) in TABS {
                let choice = ui.selectable_value(&mut tab, each, name);
                choice.on_hover_text(says);
            }
            let fold = ui.small_button("⏵");
            is_folded = fold.on_hover_text("Folds the inspector (Esc).").clicked();
        });
        if is_folded {
            self.desk.over[1] = false;
        }
        let next = (!is_folded).then_some(tab);
        if next != open {
            self.set_look(Inspector(next));
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
        ui.label(format!(
            "The largest error of the picture without a part, and whether tolerance {tolerance} \
             requires the part. A click leaves it out."
        ));
        progress(ui, &self.facts.required.state, "leaving out part by part");
        let ink = ink(&self.facts.required);
        let before = self.desk.left_out;
        let parts = self.facts.required.value.iter().flatten();
        Grid::new("required").striped(true).show(ui, |ui| {
            for part in parts {
                let is_left_out = before == Some(part.part);
                if ui.selectable_label(is_left_out, &part.name).clicked() {
                    self.desk.left_out = (!is_left_out).then_some(part.part);
                }
                let error = ui.colored_label(ink, short(part.change.most()));
                error.on_hover_text("Levels of 255, proven.");
                let is_kept = part.change.keeps(tolerance);
                ui.colored_label(ink, if is_kept { "not required" } else { "required" });
                ui.end_row();
            }
        });
        if before.is_some() && ui.button("show the whole picture").clicked() {
            self.desk.left_out = None;
        }
        if self.desk.left_out != before {
            self.facts.without = Job::default();
        }
        ui.separator();
        self.bits_section(ui);
    }

    /// A row for each stage of the model: the fewest bits, and the errors of three formats.
    fn bits_section(&self, ui: &mut Ui) {
        ui.label(
            "The fewest bits of significand that each stage needs, with the largest error in levels of \
             255, proven; and whether f16, bf16 and f32 keep the tolerance. The other stages are in f64.",
        );
        progress(ui, &self.facts.bits.state, "rounding stage by stage");
        let ink = ink(&self.facts.bits);
        let stages = self.facts.bits.value.iter().flatten();
        let head = ["stage", "bits", "error", "f16", "bf16", "f32"].map(str::to_owned);
        Grid::new("bits").striped(true).show(ui, |ui| {
            for cells in [head.to_vec()]
                .into_iter()
                .chain(stages.map(StageBits::cells))
            {
                for cell in cells {
                    ui.colored_label(ink, cell);
                }
                ui.end_row();
            }
        });
    }

    fn proof_tab(&mut self, ui: &mut Ui) {
        progress(ui, &self.facts.proof.state, "enclosing every pixel");
        let Some(proof) = &self.facts.proof.value else {
            return;
        };
        let rows = proof_rows(proof);
        let is_current = self.facts.proof.current().is_some();
        Grid::new("proof").striped(true).show(ui, |ui| {
            for (name, value, ink, says) in &rows {
                ui.label(*name).on_hover_text(*says);
                let ink = if is_current { *ink } else { STALE };
                let value = RichText::new(value).monospace().color(ink);
                ui.label(value).on_hover_text(*says);
                ui.end_row();
            }
        });
        if ui.button("copy").clicked() {
            let line = |(name, value, ..): &Row| format!("{name}\t{value}\n");
            ui.ctx().copy_text(rows.iter().map(line).collect());
        }
        for example in &proof.examples {
            ui.monospace(format!("{example:?}"));
        }
    }
}

type Row = (&'static str, String, Color32, &'static str);

#[rustfmt::skip]
fn proof_rows(proof: &Proof) -> [Row; 8] {
    let bad = |count: u64| if count > 0 { BAD } else { INK };
    [
        ("proven", proof.proven.to_string(), GOOD, "Pixels whose error is within the tolerance for every value of their enclosure."),
        ("undecided", proof.undecided.to_string(), bad(proof.undecided), "Pixels whose enclosure holds values on both sides of the tolerance."),
        ("refuted", proof.refuted.to_string(), bad(proof.refuted), "Pixels whose error is above the tolerance for every value of their enclosure."),
        ("on an outline", proof.outline.to_string(), INK, "Pixels within 0.01 pixel of an edge: they may show either side."),
        ("with a cuboid", proof.covered.to_string(), INK, "Pixels that show a cuboid."),
        ("largest error", format!("{:.6}", proof.worst), INK, "The largest error that the enclosures leave possible, in levels of 255."),
        ("widest enclosure", format!("{:.1e}", proof.widest_enclosure), INK, "In levels of 255."),
        ("error of f64", format!("{:.1e}", proof.reference_error), INK, "The largest error of the reference in f64 that the enclosures leave possible, in levels of 255."),
    ]
}

/// The ink of an answer: grey if it is that of an earlier picture.
pub fn ink<T>(job: &Job<T>) -> Color32 {
    if job.current().is_some() { INK } else { STALE }
}

/// Tells how far a job is, or why it failed.
pub fn progress(ui: &mut Ui, state: &State, words: &str) {
    match state {
        State::Done => {}
        State::Idle => drop(ui.weak("waits until nothing moves")),
        State::Running(share) => {
            let text = format!("{words}, {:.0} %", share * 100.0);
            ui.add(ProgressBar::new(*share as f32).text(text));
        }
        State::Failed(reason) => drop(ui.colored_label(BAD, reason)),
    }
}

/// A button with a colour whose click opens a picker; channels are shares of full strength.
pub fn color_button(ui: &mut Ui, channels: &mut DVec3) {
    let byte = |share: f64| (share.clamp(0.0, 1.0) * 255.0).round() as u8;
    let bytes = channels.to_array().map(byte);
    let mut picked = bytes;
    let response = ui.color_edit_button_srgb(&mut picked);
    response.on_hover_text("Colour; each channel is a share of full strength.");
    if picked != bytes {
        *channels = DVec3::from(picked.map(|it| f64::from(it) / 255.0));
    }
}

/// Three digits that matter, or fewer.
pub fn short(value: f64) -> String {
    crate::report::words::short(Some(value))
}

/// Two digits that matter: the movement of a hand means no more.
pub fn two_digits(value: f64) -> f64 {
    format!("{value:.1e}").parse().unwrap_or(value)
}

/// Six significant digits at most, with an exponent where the number is very large or small.
pub fn format_number(value: f64, _: RangeInclusive<usize>) -> String {
    let rounded: f64 = format!("{value:.5e}").parse().unwrap_or(value);
    match rounded.abs() {
        0.0 => "0".to_owned(),
        1e-3..1e6 => rounded.to_string(),
        _ => format!("{rounded:e}"),
    }
}

/// Keeps the digits of a number that was only looked at: a widget writes back the digits that it shows.
pub fn keep_digits(before: f64, value: &mut f64) {
    if format_number(*value, 0..=0) == format_number(before, 0..=0) {
        *value = before;
    }
}
