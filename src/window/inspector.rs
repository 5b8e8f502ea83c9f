//! What stands under the headings of the panel: pictures, camera, the scene's numbers, the explained pixel, the needed parts of the
//! model, the proof, a number that is varied.

mod pixel;
mod row;
mod scene;
mod vary;

use egui::{Grid, Ui};
use hecs::World;

pub use self::pixel::{SECTION, section};
pub use self::vary::Varied;
use super::app::App;
use super::chart;
use super::desk::Desk;
use super::keys::{Action, EXACT_SIDES};
use super::panel::{file_rows, scene_rows};
use super::study::Study;
use super::widgets::{INK, action_button, offer, short, wait};
use crate::components::{Side, ViewMode, Viewer, viewer};
use crate::questions::job::camera_name;
use crate::questions::requires::{PartChange, ranked};
use crate::scene::{LESSONS, title};

/// A heading of the panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Tab {
    /// The built-in lessons.
    Lessons,
    /// The chart of the methods, and what is held: the error or the time.
    Time,
    /// The ways to show the picture.
    Pictures,
    Camera,
    /// Every number of the scene, and its file.
    Scene,
    /// The evaluation of the explained pixel.
    Pixel,
    /// The parts of the model that the picture needs.
    Required,
    /// The number of proven pixels.
    Proof,
    /// A number of the scene against the error.
    Vary,
}

/// The width of a table's columns before the last, in points.
const NUMBERS: f32 = 100.0;

/// The headings in their order, each with the keys that act under it and its sentence.
#[rustfmt::skip]
pub const HEADINGS: [(Tab, &str, &str, &str); 9] = [
    (Tab::Lessons, "Lessons", "L", "A few steps each, with a question."),
    (Tab::Time, "Time and error", "M", "The time of a frame and the error by each method."),
    (Tab::Pictures, "Pictures", "F2-F7", "Other pictures, and files of them."),
    (Tab::Camera, "Camera", "C O", "The camera, its projection, and what turns."),
    (Tab::Scene, "Scene", "E", "Every number of the scene, and its file."),
    (Tab::Pixel, "Numbers", "click", "The computation at a pixel: click one in the picture."),
    (Tab::Required, "Needed parts", "N", "The parts of the model that this picture needs."),
    (Tab::Proof, "Proof", "K", "The proof that the picture keeps its tolerance."),
    (Tab::Vary, "Try a range", "V", "A number of the scene against the error."),
];

/// Lays out what stands under a heading.
pub fn content(ui: &mut Ui, app: &mut App, tab: Tab) {
    let App {
        document,
        canvas,
        study,
        desk,
        ..
    } = app;
    let world = &mut document.scene.world;
    match tab {
        Tab::Time => chart::tab(ui, app),
        Tab::Lessons => scene_rows(ui, &LESSONS, title, &document.scene.name, desk),
        Tab::Pictures => pictures_tab(ui, world, desk),
        Tab::Camera => camera_tab(ui, world, desk),
        Tab::Scene => {
            file_rows(ui, document, desk);
            ui.separator();
            scene::tab(ui, document, canvas, desk);
        }
        Tab::Pixel => pixel::tab(ui, world, canvas, study),
        Tab::Required => required_tab(ui, study, document.state.view.tolerance, desk),
        Tab::Proof => proof_tab(ui, study),
        Tab::Vary => vary::tab(ui, document, canvas, study, desk),
    }
}

/// The action that shows what is shown now. Sides that the tags chose belong to none.
pub fn picture_action(viewer: &Viewer) -> Option<Action> {
    match viewer.show {
        ViewMode::Wipe if viewer.sides == EXACT_SIDES => Some(Action::WipeExact),
        ViewMode::Wipe if viewer.sides != Side::gouraud_phong(viewer.tolerance) => None,
        mode => Some(Action::View(mode)),
    }
}

/// The ways to show the picture, and the files of it.
fn pictures_tab(ui: &mut Ui, world: &World, desk: &mut Desk) {
    let shown = picture_action(&viewer(world));
    ui.horizontal_wrapped(|ui| {
        for action in [
            Action::View(ViewMode::Picture),
            Action::View(ViewMode::Wipe),
            Action::WipeExact,
            Action::View(ViewMode::Error),
            Action::View(ViewMode::Tiles),
            Action::View(ViewMode::Terms),
        ] {
            offer(ui, desk, action, Some(action) == shown);
        }
        let hold = action_button(ui, Action::Blink, desk.blinks.is_some());
        let is_held = hold.is_pointer_button_down_on();
        if is_held || ui.input(|input| input.pointer.any_released()) {
            desk.blink_while(is_held);
        }
        for action in [Action::SavePicture, Action::Screenshot, Action::Panel] {
            offer(ui, desk, action, false);
        }
    });
}

/// The active camera and its projection.
fn camera_tab(ui: &mut Ui, world: &World, desk: &mut Desk) {
    let Viewer {
        projection, turns, ..
    } = *viewer(world);
    let camera = camera_name(world);
    ui.label(format!("camera {camera}, {}", projection.name()));
    ui.horizontal_wrapped(|ui| {
        offer(ui, desk, Action::NextCamera, false);
        offer(ui, desk, Action::NextProjection, false);
        offer(ui, desk, Action::Rotate, turns);
        offer(ui, desk, Action::ShowAll, false);
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
         tolerance of all of its interval, refuted if of none of it, else undecided. Both sides of a wipe count.",
    );
    let fact = &study.facts.proof;
    wait(ui, study, fact.is_current);
    let rows = fact.value.iter().flat_map(|(_, proof)| {
        let worst = proof.worst;
        [
            (proof.proven.to_string(), "pixels proven"),
            (proof.in_squares.to_string(), "of them in whole squares"),
            (proof.undecided.to_string(), "pixels undecided"),
            (proof.gaps.to_string(), "pixels in gaps of touching faces"),
            (proof.refuted.to_string(), "pixels refuted"),
            (format!("{worst:.6}"), "levels, the largest proven error"),
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
