//! The inspector: tabs for the probed pixel, the scene's numbers, the required parts of the model, and the proof.

mod pixel;
mod scene;

use std::iter;

use egui::{Grid, Ui};

pub use self::scene::entity_of;
use super::app::App;
use super::study::Study;
use super::widgets::{INK, scrolled, short, wait};
use crate::requires::{PartChange, ranked};

/// A page of the inspector.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Tab {
    /// The evaluation of the explained pixel.
    Pixel,
    /// Every number of the scene.
    Scene,
    /// The parts of the model that the picture requires.
    Required,
    /// The number of proven pixels.
    Proof,
}

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

/// Lays out the tabs and the one that is open, of a drawer with a button that folds it.
pub fn inspector(ui: &mut Ui, app: &mut App, is_drawer: bool) {
    let App {
        document,
        canvas,
        study,
        desk,
        ..
    } = app;
    let tab = desk.tab.unwrap_or(Tab::Pixel);
    ui.add_space(4.0);
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 1.0;
        ui.spacing_mut().button_padding.x = 3.0;
        for (each, name, says) in TABS {
            let choice = ui.selectable_label(tab == each, name);
            if choice.on_hover_text(says).clicked() {
                desk.tab = Some(each);
            }
        }
        if is_drawer {
            let fold = ui.small_button("⏵");
            if fold.on_hover_text("Folds the inspector (Esc).").clicked() {
                desk.tab = None;
            }
        }
    });
    ui.separator();
    scrolled(ui, tab, |ui| match tab {
        Tab::Pixel => pixel::tab(ui, &mut document.scene.world, canvas, study),
        Tab::Scene => scene::tab(ui, document, desk),
        Tab::Required => required_tab(ui, study, document.state.view.tolerance),
        Tab::Proof => proof_tab(ui, study),
    });
}

/// A row for each part of the model, the one with the largest error first.
fn required_tab(ui: &mut Ui, study: &Study, tolerance: f64) {
    ui.label(format!(
        "Each row leaves out one part: the picture's largest error in levels of 255, proven, and whether tolerance \
         {tolerance} needs the part. Tooltips describe the picture without it."
    ));
    let facts = &study.facts;
    let required = &facts.required;
    let is_all = required.current().is_some_and(|it| it.is_all);
    wait(ui, study, is_all);
    let part = |part: &PartChange| {
        let says = part.part.says();
        let is_kept = part.change.keeps(tolerance);
        let verdict = if is_kept { "no" } else { "yes" };
        let most = short(part.change.most());
        (vec![most, verdict.to_owned(), part.name.clone()], says)
    };
    let head = ["error", "needed", "part"].map(str::to_owned).to_vec();
    let head = (head, "");
    let rows = required.value.as_ref().map(|it| it.rows.clone());
    let ranked = ranked(rows.unwrap_or_default());
    let rows = iter::once(head).chain(ranked.iter().map(part));
    table(ui, "required", rows);
    if is_all {
        wait(ui, study, facts.segments.is_current);
    }
    for cuboid in facts.segments.value.iter().flatten() {
        let label = ui.label(format!(
            "{}: Gouraud needs {} cells.",
            cuboid.cuboid,
            cuboid.cells()
        ));
        label.on_hover_text(
            "The fewest cells of each face with which Gouraud keeps the tolerance against exact Phong, proven.",
        );
    }
}

/// Lays out a table with a tooltip for each row. The words in its last column wrap.
fn table(ui: &mut Ui, name: &str, rows: impl Iterator<Item = (Vec<String>, &'static str)>) {
    let words = (ui.available_width() - NUMBERS).max(NUMBERS);
    let table = Grid::new(name).striped(true).min_col_width(0.0);
    table.max_col_width(words).show(ui, |ui| {
        for (row, says) in rows {
            for cell in row {
                let label = ui.colored_label(INK, cell);
                if !says.is_empty() {
                    label.on_hover_text(says);
                }
            }
            ui.end_row();
        }
    });
}

/// The counts of the proof.
fn proof_tab(ui: &mut Ui, study: &Study) {
    ui.label(
        "An interval encloses the exact level of each pixel. A pixel is proven if the drawn level is within the \
         tolerance of all of its interval, refuted if of none of it, else undecided.",
    );
    let fact = &study.facts.proof;
    wait(ui, study, fact.is_current);
    let rows = fact.value.iter().flat_map(|proof| {
        let [worst, widest] = [proof.worst, proof.widest_enclosure];
        let off = proof.reference_error;
        [
            (proof.proven.to_string(), "pixels proven"),
            (proof.undecided.to_string(), "pixels undecided"),
            (proof.gaps.to_string(), "pixels in gaps of touching faces"),
            (proof.refuted.to_string(), "pixels refuted"),
            (proof.outline.to_string(), "pixels within 0.01 of an edge"),
            (proof.covered.to_string(), "pixels with a cuboid"),
            (format!("{worst:.6}"), "levels, the largest proven error"),
            (format!("{widest:.1e}"), "levels, the longest interval"),
            (
                format!("{off:.1e}"),
                "levels, the error of the reference in f64",
            ),
        ]
    });
    let rows = rows.map(|(number, words)| (vec![number, words.to_owned()], ""));
    table(ui, "proof", rows);
}
