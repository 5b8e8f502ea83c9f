//! The inspector: tabs for the probed pixel, the scene's numbers, the required parts of the model, the proof, and a number that
//! is varied.

mod pixel;
mod scene;
mod vary;

use egui::{Grid, Ui};

pub use self::pixel::section;
pub use self::scene::entity_of;
use super::app::App;
use super::desk::Desk;
use super::study::Study;
use super::widgets::{INK, scrolled, short, wait};
use crate::questions::requires::{PartChange, ranked};

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
    /// A number of the scene against error.
    Vary,
}

/// The width of a table's columns before the last, in points.
const NUMBERS: f32 = 100.0;

/// The tabs with their names and sentences.
#[rustfmt::skip]
const TABS: [(Tab, &str, &str); 5] = [
    (Tab::Pixel, "Pixel", "The computation at a pixel: click one in the picture."),
    (Tab::Scene, "Scene", "Every number of the scene (E)."),
    (Tab::Required, "Required", "The parts of the model that this picture requires (N)."),
    (Tab::Proof, "Proof", "The proof that the picture keeps its tolerance."),
    (Tab::Vary, "Vary", "A number of the scene against the error (V)."),
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
        Tab::Required => required_tab(ui, study, document.state.view.tolerance, desk),
        Tab::Proof => proof_tab(ui, study),
        Tab::Vary => vary::tab(ui, document, canvas, study, desk),
    });
}

/// A row for each part of the model, the one with the largest error first.
fn required_tab(ui: &mut Ui, study: &Study, tolerance: f64, desk: &mut Desk) {
    ui.label(format!(
        "Each row leaves out one part: the picture's largest error in levels of 255, proven, and whether tolerance \
         {tolerance} needs the part. A click on a part shows the picture without it, and another click the picture again."
    ));
    let facts = &study.facts;
    let required = &facts.required;
    let is_all = required.current().is_some_and(|it| it.is_all);
    wait(ui, study, is_all);
    let rows = required.value.as_ref().map(|it| it.rows.clone());
    table(ui, "required", |ui| {
        for head in ["error", "needed", "part"] {
            ui.colored_label(INK, head);
        }
        ui.end_row();
        let rows = rows.unwrap_or_default();
        // Rows stay in their places while others are added.
        let rows = if is_all { ranked(rows) } else { rows };
        for PartChange {
            part, name, change, ..
        } in rows
        {
            ui.colored_label(INK, short(change.most()));
            let is_kept = change.keeps(tolerance);
            ui.colored_label(INK, if is_kept { "no" } else { "yes" });
            let is_left_out = desk.left_out == Some(part);
            let row = ui.selectable_label(is_left_out, name);
            if row.on_hover_text(part.says()).clicked() {
                desk.left_out = (!is_left_out).then_some(part);
            }
            ui.end_row();
        }
    });
    if is_all {
        wait(ui, study, facts.segments.is_current);
    }
    for cuboid in facts.segments.value.iter().flatten() {
        let label = ui.label(format!(
            "{}: Gouraud needs {} segments.",
            cuboid.cuboid,
            cuboid.count()
        ));
        label.on_hover_text(
            "The fewest segments along an edge with which Gouraud keeps the tolerance against exact Phong, proven.",
        );
    }
}

/// Lays out the rows of a table. The words in its last column wrap.
fn table(ui: &mut Ui, name: &str, rows: impl FnOnce(&mut Ui)) {
    let words = (ui.available_width() - NUMBERS).max(NUMBERS);
    let table = Grid::new(name).striped(true).min_col_width(0.0);
    table.max_col_width(words).show(ui, rows);
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
            (proof.in_squares.to_string(), "of them in whole squares"),
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
    table(ui, "proof", |ui| {
        for (number, words) in rows {
            ui.colored_label(INK, number);
            ui.colored_label(INK, words);
            ui.end_row();
        }
    });
}
