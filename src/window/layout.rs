//! The frame of the window: the panel on the left, or below the picture in a narrow window, the question above the picture, the
//! result below, the picture between.
//!
//! What opens, opens under a heading of the panel, so the picture keeps its size.

use egui::{Color32, Id, Label, Panel, Popup, RichText, Ui, Vec2};

use super::app::App;
use super::controls::has_face_normals;
use super::desk::Desk;
use super::facts::Worst;
use super::help::{about, help};
use super::keys::{Action, binding};
use super::labels::side_name;
use super::lesson::heading;
use super::panel::{panel, path_row};
use super::pictures::{side_method, sides};
use super::widgets::{BAD, GOOD, INK, short, text};
use crate::components::{Light, LightKind, Mesh, Side, ViewMode, Viewer, names};
use crate::output::words::capital;
use crate::questions::trade::verdict::method_name;
use crate::shading::Method;

/// The least and the usual width of the panel, in points, and that in a window so wide that every number has its row.
const LEAST: f32 = 213.0;
const USUAL: f32 = 300.0;
const USUAL_WIDE: f32 = 346.0;
const WIDE: f32 = 960.0;
/// In a narrower window, in points, the panel is below the picture.
pub const NARROW: f32 = 560.0;
/// In a lower window, in points, the panel is folded where it would be below the picture, and nothing stands above that.
pub const LOW: f32 = 450.0;
/// In a higher window, in points, several headings are open at once.
const HIGH: f32 = 900.0;
/// The width of the folded panel.
const FOLDED: f32 = 22.0;
/// The height of a row below the picture, in points.
const ROW: f32 = 20.0;
/// The letters above the picture, in points, and those of the longest sentence.
const LETTERS: f32 = 15.0;
const LONGEST: usize = 72;

const QUESTION: &str = "Same box: where is the bright spot on the left?";
/// Half of all levels.
const HALF: f64 = 127.5;
const MIXED: &str = "The cuboids are shaded in different modes.";
const METHOD: &str = "The method on screen.";
const ERROR: &str = "The largest error of a pixel against exact Phong, in levels of 255. A click shows why the pixel errs.";

impl App {
    /// Lays out the whole window, lets keys, widgets and the mouse write into the World, and notes the changes.
    pub fn ui(&mut self, ui: &mut Ui) {
        let size = ui.available_size();
        self.desk.is_high = size.y >= HIGH;
        self.take_keys(ui);
        let was_drawn = self.is_drawn();
        if !self.is_lesson_alone() {
            self.sides(ui, size);
        }
        if !self.document.scene.lesson.is_empty() {
            let (document, desk) = (&self.document, &mut self.desk);
            Panel::top("lesson").show_inside(ui, |ui| heading(ui, document, desk));
            Panel::bottom("steps").show_inside(ui, |ui| self.lesson_controls(ui));
        } else if size.y >= LOW {
            let question = self.question();
            Panel::top("headline").show_inside(ui, |ui| text(ui, question, LONGEST, LETTERS));
        }
        self.viewport(ui);
        if self.desk.help {
            self.desk.help = help(ui);
        }
        self.desk.takes_escape = ui.ctx().text_edit_focused() || Popup::is_any_open(ui.ctx());
        for action in std::mem::take(&mut self.desk.wishes) {
            self.run(action);
        }
        self.note_changes();
        if was_drawn && !self.is_drawn() && self.study.facts.proof.is_current {
            // The status line tells of the proof of the picture before.
            ui.ctx().request_discard("the picture has changed");
        }
    }

    /// Lays out the result, and the panel.
    fn sides(&mut self, ui: &mut Ui, size: Vec2) {
        // Room for two rows in a narrow window, so that the picture keeps its size.
        let is_below = size.x < NARROW;
        let rows = if is_below { 2.0 } else { 1.0 };
        let status = Panel::bottom("status").exact_size(rows * ROW + 4.0);
        status
            .resizable(false)
            .show_inside(ui, |ui| ui.horizontal_wrapped(|ui| self.status(ui)));
        if self.desk.panel_folded {
            let folded = Panel::left("folded panel").exact_size(FOLDED);
            let shown = folded.resizable(false).show_inside(ui, |ui| ui.button("⏵"));
            let opens = shown.inner.on_hover_text("Opens the panel (I).").clicked();
            self.desk.panel_folded = !opens;
            return;
        }
        let [usual, most] = if is_below {
            [size.y / 2.0; 2]
        } else {
            let usual = if size.x < WIDE { USUAL } else { USUAL_WIDE };
            [usual.min(size.x / 2.0), size.x / 2.0]
        };
        // egui keeps a width by id. With an id of its own a narrow window does not change the width in a wider one.
        let id = Id::new(("panel", is_below, usual as u32));
        let side = if is_below {
            Panel::bottom(id)
        } else {
            Panel::left(id)
        };
        side.default_size(usual)
            .size_range(LEAST.min(usual)..=most)
            .show_inside(ui, |ui| panel(ui, self));
    }

    /// The question that the picture raises: where a highlight is that one of two pictures lacks. Else the sentence about what is
    /// shown.
    fn question(&self) -> &'static str {
        let viewer = self.viewer();
        match viewer.show {
            ViewMode::Wipe if self.lacks_highlight(&viewer) => QUESTION,
            ViewMode::Picture => self
                .method()
                .map_or(MIXED, |it| says(Action::Shading(it.mode))),
            mode => says(Action::View(mode)),
        }
    }

    /// Whether the left side of Gouraud and Phong lacks a highlight: it is off by more than half of all levels, or it is not known
    /// yet how far.
    fn lacks_highlight(&self, viewer: &Viewer) -> bool {
        let world = &self.document.scene.world;
        let is_highlight = |it: &Light| it.on && it.kind == LightKind::Specular;
        let worst = self.study.facts.worst(&viewer.sides[0], self.method());
        viewer.sides == Side::gouraud_phong(viewer.tolerance)
            && names::<Mesh>(world).len() == 1
            && !has_face_normals(world)
            && world.query::<&Light>().iter().any(is_highlight)
            && worst.is_none_or(|it| it.is_some_and(|it| it.error > HALF))
    }

    /// The line below the picture: a message, the name of what is shown in its place, or the result; and the file of edits.
    fn status(&mut self, ui: &mut Ui) {
        if message(ui, &mut self.desk) {
            return;
        }
        let beside = shown_beside(&self.viewer(), self.method(), &self.desk);
        match beside {
            Some(name) => drop(ui.label(name).on_hover_text(METHOD)),
            None if self.result(ui) => self.desk.wish(Action::Worst),
            None => {}
        }
        if self.document.is_edited() {
            path_row(ui, Action::Save, &self.document.target(false));
        }
    }

    /// Lays out how far the picture, or the side of a wipe that errs more, is off, and whether it is proven to be drawn right.
    /// Returns whether the error was clicked.
    fn result(&self, ui: &mut Ui) -> bool {
        let shown = self.method();
        let worst = self.worst();
        let side = sides(&self.viewer())[worst.map_or(0, |it| it.0)];
        let method = side_method(&side, shown);
        let is_clicked = match worst {
            Some((_, Some(Worst { error, .. }))) => {
                let name = method.map_or("The picture".to_owned(), |it| capital(&method_name(it)));
                let error = short(error);
                let text = format!("{name} errs by up to {error} of 255.");
                let link = ui.link(RichText::new(text).color(INK));
                link.on_hover_text(ERROR).clicked()
            }
            Some((_, None)) => ui.label("Nothing is drawn that could err.").clicked(),
            None => ui.weak("The error is being measured.").clicked(),
        };
        if let Some((text, ink)) = self.proof_says() {
            ui.colored_label(ink, text).on_hover_text(about("proven"));
        }
        is_clicked
    }

    /// The sentence about the proof, and its colour. While things move, it is about the last proof, and stays the same for several
    /// pictures, so that it can be read.
    fn proof_says(&self) -> Option<(String, Color32)> {
        let (study, fact) = (&self.study, &self.study.facts.proof);
        let moves = !(self.canvas.rests() && self.is_drawn());
        let known = if moves {
            study.last_proof()
        } else {
            fact.current().map(|(_, proof)| proof)
        };
        let Some(proof) = known else {
            let text = match moves {
                // There was too little memory.
                false if fact.is_current => "It is not proven.",
                _ if !study.is_live() => return None,
                true if !study.follows() => "It is proven once nothing moves.",
                _ => "It is being proven.",
            };
            return Some((text.to_owned(), Color32::GRAY));
        };
        let (proven, pixels) = (proof.proven, proof.pixels as u64);
        let text = if moves {
            format!("The last proof held for {proven} of {pixels} pixels.")
        } else if proven < pixels {
            format!("Drawn as defined, proven: {proven} of {pixels} pixels.")
        } else {
            "Drawn as defined, proven.".to_owned()
        };
        Some((text, if proven == pixels { GOOD } else { BAD }))
    }
}

/// The sentence about an action.
fn says(action: Action) -> &'static str {
    binding(action).map_or("", |it| it.1)
}

/// Lays out the message of the desk until its time is over. Returns whether there is one.
pub fn message(ui: &mut Ui, desk: &mut Desk) -> bool {
    let now = desk.now;
    desk.message.take_if(|(_, until)| *until <= now);
    if let Some((text, until)) = &desk.message {
        ui.ctx().request_repaint_after(until.saturating_sub(now));
        let text = RichText::new(text).strong();
        ui.add(Label::new(text).truncate());
    }
    desk.message.is_some()
}

/// The name of what is shown in place of the picture: one without a part, or one that has its turn.
fn shown_beside(viewer: &Viewer, method: Option<Method>, desk: &Desk) -> Option<String> {
    if let Some(part) = desk.shown_without() {
        return Some(part.says().to_owned());
    }
    let turn = desk.turn()?;
    match (viewer.show, turn) {
        (ViewMode::Wipe, _) => Some(side_name(&viewer.sides[turn], method)),
        (_, 0) => Some(side_name(&Side::Reference, method)),
        _ => Some(side_name(&Side::Picture, method)),
    }
}
