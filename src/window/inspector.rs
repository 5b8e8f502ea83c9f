//! The inspector: one side with tabs for the probed pixel, the scene's numbers, the parts that are required, and the proof.

mod pixel;
mod scene;
mod section;

use std::iter;

use egui::{Color32, Grid, ProgressBar, RichText, ScrollArea, Ui};

use super::app::App;
use super::facts::Fact;
use super::style::{BAD, GOOD, INK, STALE};
use super::widgets::{ink, short};
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
        let next = (!is_folded).then_some(tab);
        if next != open {
            self.set_look(Inspector(next));
        }
        ui.separator();
        let scroll = ScrollArea::both().auto_shrink(false).id_salt(tab);
        scroll.show(ui, |ui| match tab {
            Tab::Pixel => self.pixel_tab(ui),
            Tab::Scene => self.scene_tab(ui),
            Tab::Required => self.required_tab(ui),
            Tab::Proof => self.proof_tab(ui),
        });
    }

    /// A row for each part of the model, the one that matters most first.
    fn required_tab(&self, ui: &mut Ui) {
        let Tolerance(tolerance) = self.look();
        ui.label(format!(
            "The largest error of the picture without a part, in levels of 255, proven; and whether \
             tolerance {tolerance} requires the part."
        ));
        self.wait(ui, &self.facts.required);
        let ink = ink(&self.facts.required);
        let parts = self.facts.required.value.iter().flatten();
        Grid::new("required").striped(true).show(ui, |ui| {
            for part in parts {
                let is_kept = part.change.keeps(tolerance);
                ui.colored_label(ink, if is_kept { "not required" } else { "required" });
                ui.colored_label(ink, short(part.change.most()));
                ui.label(&part.name);
                ui.end_row();
            }
        });
        ui.separator();
        self.bits_section(ui);
    }

    /// A row for each stage of the model: the fewest bits, and the errors of three formats.
    fn bits_section(&self, ui: &mut Ui) {
        ui.label(
            "The fewest bits of significand that each stage needs, with the largest error in levels of \
             255, proven; and whether f16, bf16 and f32 keep the tolerance. The other stages are in f64.",
        );
        self.wait(ui, &self.facts.bits);
        let ink = ink(&self.facts.bits);
        let stages = self.facts.bits.value.iter().flatten().map(StageBits::cells);
        let head = ["stage", "bits", "error", "f16", "bf16", "f32"].map(str::to_owned);
        Grid::new("bits").striped(true).show(ui, |ui| {
            for cells in iter::once(head.to_vec()).chain(stages) {
                for cell in cells {
                    ui.colored_label(ink, cell);
                }
                ui.end_row();
            }
        });
    }

    /// Tells how far the work in the background is, while a fact is not known.
    fn wait<T>(&self, ui: &mut Ui, fact: &Fact<T>) {
        match self.progress() {
            _ if fact.is_current => {}
            None => drop(ui.weak("waits until nothing moves")),
            Some((step, share)) => {
                let text = format!("{step}, {:.0} %", share * 100.0);
                ui.add(ProgressBar::new(share as f32).text(text));
            }
        }
    }

    fn proof_tab(&self, ui: &mut Ui) {
        let Fact { value, is_current } = &self.facts.proof;
        self.wait(ui, &self.facts.proof);
        Grid::new("proof").striped(true).show(ui, |ui| {
            for (name, number, own_ink, says) in value.iter().flat_map(proof_rows) {
                let ink = if *is_current { own_ink } else { STALE };
                ui.label(name).on_hover_text(says);
                ui.label(RichText::new(number).monospace().color(ink));
                ui.end_row();
            }
        });
        for example in value.iter().flat_map(|proof| &proof.examples) {
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
