//! The inspector: tabs for the probed pixel, the scene's numbers, the required parts of the model, and the proof.

mod pixel;
mod scene;
mod section;

use std::iter;

use egui::{Grid, ProgressBar, ScrollArea, Ui};

use super::app::App;
use super::facts::Latest;
use super::widgets::{ink, short};
use crate::components::Tab;
use crate::requires::PartChange;

/// The width of a table's columns before the last, in points.
const NUMBERS: f32 = 100.0;

/// The tabs with their names and sentences.
#[rustfmt::skip]
const TABS: [(Tab, &str, &str); 4] = [
    (Tab::Pixel, "Pixel", "The computation at a pixel: click one in the picture."),
    (Tab::Scene, "Scene", "Every number of the scene (E)."),
    (Tab::Required, "Required", "The parts of the model that this picture requires (N)."),
    (Tab::Proof, "Proof", "The proof that the picture keeps its tolerance."),
];

/// The rows of the proof, with their sentences.
#[rustfmt::skip]
const PROOF: [(&str, &str); 8] = [
    ("pixels proven within the tolerance", "What is drawn is within the tolerance of all values of the interval."),
    ("pixels undecided", "It is within the tolerance of some values of the interval only."),
    ("pixels refuted: above the tolerance", "It is within the tolerance of no value of the interval."),
    ("pixels within 0.01 of an edge", "They may show either side of the edge."),
    ("pixels with a cuboid", "All others show the background."),
    ("levels, the largest proven error", "The largest distance from a drawn level to an end of its interval."),
    ("levels, the widest enclosure", "The length of the longest interval."),
    ("levels, the error of the reference in f64", "The distance of the reference from the intervals."),
];

impl App {
    /// Lays out the tabs and the one that is open.
    pub fn inspector(&mut self, ui: &mut Ui) {
        let open = self.viewer().inspector;
        let mut tab = open.unwrap_or(Tab::Pixel);
        ui.add_space(4.0);
        let mut is_folded = false;
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing.x = 1.0;
            ui.spacing_mut().button_padding.x = 3.0;
            for (each, name, says) in TABS {
                let choice = ui.selectable_value(&mut tab, each, name);
                choice.on_hover_text(says);
            }
            let fold = ui.small_button("⏵");
            is_folded = fold.on_hover_text("Folds the inspector (Esc).").clicked();
        });
        let next = (!is_folded).then_some(tab);
        if next != open {
            self.viewer_mut().inspector = next;
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

    /// A row for each part of the model, the one with the largest error first.
    fn required_tab(&self, ui: &mut Ui) {
        let tolerance = self.viewer().tolerance;
        ui.label(format!(
            "The largest error of the picture if one part of the model is left out, in levels of 255, proven; and \
             whether tolerance {tolerance} needs that part."
        ));
        let facts = &self.facts;
        self.wait(ui, &facts.required);
        let part = |part: &PartChange| {
            let says = part.part.without();
            let is_kept = part.change.keeps(tolerance);
            let verdict = if is_kept { "no" } else { "yes" };
            let most = short(part.change.most());
            (vec![most, verdict.to_owned(), part.name.clone()], says)
        };
        let head = ["error", "needed", "part"].map(str::to_owned).to_vec();
        let head = (head, "A part has a tooltip.");
        let parts = facts.required.value.iter().flatten().map(part);
        let rows = iter::once(head).chain(parts);
        Self::table(ui, "required", &facts.required, rows);
    }

    /// Lays out a table about a fact, with a tooltip for each row. The words in its last column wrap.
    fn table<T>(
        ui: &mut Ui,
        name: &str,
        fact: &Latest<T>,
        rows: impl Iterator<Item = (Vec<String>, &'static str)>,
    ) {
        let words = (ui.available_width() - NUMBERS).max(NUMBERS);
        let table = Grid::new(name).striped(true).min_col_width(0.0);
        table.max_col_width(words).show(ui, |ui| {
            for (row, says) in rows {
                for cell in row {
                    ui.colored_label(ink(fact), cell).on_hover_text(says);
                }
                ui.end_row();
            }
        });
    }

    /// Shows the progress of the work in the background until a fact is known.
    pub fn wait<T>(&self, ui: &mut Ui, fact: &Latest<T>) {
        match self.progress() {
            _ if fact.is_current => {}
            None => drop(ui.weak("waits until nothing moves")),
            Some((step, share)) => drop(ui.add(ProgressBar::new(share as f32).text(step))),
        }
    }

    fn proof_tab(&self, ui: &mut Ui) {
        ui.label("The exact level of each pixel is enclosed by an interval and compared with the level that is drawn.");
        let fact = &self.facts.proof;
        self.wait(ui, fact);
        let rows = fact.value.iter().flat_map(|proof| {
            let numbers = [
                proof.proven.to_string(),
                proof.undecided.to_string(),
                proof.refuted.to_string(),
                proof.outline.to_string(),
                proof.covered.to_string(),
                format!("{:.6}", proof.worst),
                format!("{:.1e}", proof.widest_enclosure),
                format!("{:.1e}", proof.reference_error),
            ];
            numbers.into_iter().zip(PROOF)
        });
        let rows = rows.map(|(number, (words, says))| (vec![number, words.to_owned()], says));
        Self::table(ui, "proof", fact, rows);
    }
}
