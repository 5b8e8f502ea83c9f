//! The frame of the window: the panel on the left, the inspector on the right, the status line below, the picture between.
//!
//! In a wide window the inspector has a room of its own. In a narrower one it is a drawer over the picture. So the picture keeps its
//! size when something is opened.

use egui::{
    Area, Color32, Frame, Grid, Id, Label, Modal, Order, Panel, Popup, Rect, RichText, ScrollArea,
    Sense, TextWrapMode, Ui, Vec2, vec2,
};

use super::app::App;
use super::desk::Desk;
use super::facts::Facts;
use super::inspector::{Tab, inspector};
use super::keys::{Action, BINDINGS, Binding, caption_of};
use super::lesson::heading;
use super::panel::panel;
use super::study::Study;
use super::tags::side_name;
use super::widgets::{BAD, GOOD, INK, scrolled, short};
use super::words::{WORDS, about};
use crate::components::{Side, ViewMode, Viewer};
use crate::questions::trade::verdict::method_name;
use crate::shading::Method;

/// The least and the usual width of a side, in points.
const LEAST: f32 = 213.0;
const USUAL: f32 = 300.0;
/// The width of a window, in points, from which on the inspector has a room of its own.
const WIDE: f32 = 1200.0;
/// The width of the words in the help, in points.
const WORDS_WIDTH: f32 = 260.0;
/// The width of a folded side.
const FOLDED: f32 = 22.0;

const METHOD: &str = "The method on screen.";
const TIME: &str = "The median time of a frame on all cores, or as many as --threads says, without the window around it; that of \
                    the last frame until it is measured.";
const ERROR: &str = "The largest error of a pixel against exact Phong, in levels of 255. A click shows why the pixel errs.";

impl App {
    /// Lays out the whole window, lets keys, widgets and the mouse write into the World, and notes the changes.
    pub fn ui(&mut self, ui: &mut Ui) {
        let width = ui.available_width();
        self.desk.has_room = width >= WIDE;
        self.take_keys(ui);
        let was_drawn = self.is_drawn();
        if !self.is_lesson_alone() {
            self.sides(ui, width);
        }
        if !self.document.scene.lesson.is_empty() {
            let (document, desk) = (&self.document, &mut self.desk);
            Panel::top("lesson").show_inside(ui, |ui| heading(ui, document, desk));
            Panel::bottom("steps").show_inside(ui, |ui| self.lesson_controls(ui));
        }
        self.viewport(ui);
        if let Some(place) = self.drawer_place() {
            self.drawer(ui, place);
        }
        if self.desk.help {
            self.desk.help = help(ui);
        }
        self.desk.takes_escape = ui.ctx().text_edit_focused() || Popup::is_any_open(ui.ctx());
        for command in std::mem::take(&mut self.desk.commands) {
            self.carry_out(command);
        }
        self.note_changes();
        if was_drawn && !self.is_drawn() && self.study.facts.proof.is_current {
            // The status line tells of the proof of the picture before.
            ui.ctx().request_discard("the picture has changed");
        }
    }

    /// Lays out the status line, the panel and the inspector.
    fn sides(&mut self, ui: &mut Ui, width: f32) {
        Panel::bottom("status").show_inside(ui, |ui| self.status(ui));
        let usual = USUAL.min(width / 2.0);
        let most = if self.desk.has_room { 3.0 } else { 2.0 };
        // egui keeps a width by id. With an id of its own a narrow window does not change the width in a wider one.
        let id = |name: &str| Id::new((name, usual as u32));
        let side = |panel: Panel| {
            let panel = panel.default_size(usual);
            panel.size_range(LEAST.min(usual)..=width / most)
        };
        if !self.desk.panel_folded {
            let left = side(Panel::left(id("panel")));
            left.show_inside(ui, |ui| scrolled(ui, "panel", |ui| panel(ui, self)));
        } else if is_opened(ui, Panel::left("folded panel"), "⏵", "Opens the panel (I).") {
            self.desk.panel_folded = false;
        }
        if self.desk.has_room {
            let right = side(Panel::right(id("inspector")));
            right.show_inside(ui, |ui| inspector(ui, self, false));
        } else if is_opened(ui, Panel::right("drawer"), "⏴", "Opens the inspector.") {
            self.desk.tab = self.desk.tab.or(Some(Tab::Pixel));
        }
    }

    /// The part of the picture that the drawer covers. `None` while there is no drawer.
    pub(super) fn drawer_place(&self) -> Option<Rect> {
        if self.desk.has_room || self.desk.tab.is_none() || self.is_lesson_alone() {
            return None;
        }
        let picture = self.canvas.place;
        let usual = (picture.width() / 2.0).clamp(LEAST, USUAL);
        Some(picture.with_min_x((picture.max.x - usual).max(picture.min.x)))
    }

    /// Lays out the inspector over the picture.
    fn drawer(&mut self, ui: &Ui, place: Rect) {
        let ground = Frame::side_top_panel(ui.style());
        let room = (place.size() - ground.total_margin().sum()).max(Vec2::ZERO);
        let drawer = Area::new(Id::new("drawer")).fixed_pos(place.min);
        drawer.order(Order::Middle).show(ui.ctx(), |ui| {
            ground.show(ui, |ui| {
                ui.set_min_size(room);
                ui.set_max_size(room);
                inspector(ui, self, true);
            });
        });
    }

    /// The status line: the facts about the picture, or a message.
    fn status(&mut self, ui: &mut Ui) {
        ui.horizontal(|ui| {
            if !message(ui, &mut self.desk) {
                ui.style_mut().wrap_mode = Some(TextWrapMode::Extend);
                let (method, viewer) = (self.method(), self.viewer());
                let is_clicked = if let Some(name) = shown_beside(&viewer, method, &self.desk) {
                    ui.label(name).on_hover_text(METHOD);
                    false
                } else {
                    let time = self.milliseconds().filter(|_| self.desk.shows_times);
                    facts_line(ui, &self.study, self.is_drawn(), method, time)
                };
                drop(viewer);
                if is_clicked {
                    self.desk.wish(Action::Worst);
                }
            }
        });
    }
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

/// The name of what is shown in place of the picture: a picture that has its turn, or a wipe.
fn shown_beside(viewer: &Viewer, method: Option<Method>, desk: &Desk) -> Option<String> {
    if let Some(part) = desk.shown_without() {
        return Some(part.says().to_owned());
    }
    let is_wipe = viewer.show == ViewMode::Wipe;
    match desk.turn() {
        Some(turn) if is_wipe => Some(side_name(&viewer.sides[turn], method)),
        Some(0) => Some(side_name(&Side::Reference, method)),
        None if is_wipe => Some("Two pictures; drag the line".to_owned()),
        _ => None,
    }
}

/// The facts about the present picture; `is_drawn` says whether it is the one that was proven. `time` is that of a frame, in milliseconds, where times are shown. Returns whether the error was clicked.
fn facts_line(
    ui: &mut Ui,
    study: &Study,
    is_drawn: bool,
    method: Option<Method>,
    time: Option<f64>,
) -> bool {
    let name = side_name(&Side::Picture, method);
    ui.label(name).on_hover_text(METHOD);
    let mut fact = |text: String, ink: Color32, says: &str, sense: Sense| {
        ui.separator();
        let label = Label::new(RichText::new(text).color(ink)).sense(sense);
        ui.add(label).on_hover_text(says)
    };
    let mut is_clicked = false;
    if let Some(time) = time {
        fact(format!("{} ms", short(time)), INK, TIME, Sense::hover());
    }
    let Facts {
        comparison, proof, ..
    } = &study.facts;
    if let Some(Some(worst)) = study.facts.worst(&Side::Picture, method) {
        let text = format!("{} levels off exact Phong", short(worst.error));
        is_clicked = fact(text, INK, ERROR, Sense::click()).clicked();
    }
    if let Some(it) = proof.current().filter(|_| is_drawn) {
        let pixels = it.pixels as u64;
        let (share, ink) = match pixels - it.proven {
            0 => ("every pixel".to_owned(), GOOD),
            _ => (format!("{} of {pixels} pixels", it.proven), BAD),
        };
        let mode = method.map(|shown| Method::of(shown.mode, 0.0));
        let exact = mode.map_or("its exact mode".to_owned(), method_name);
        let text = format!("{share} proven within {} of {exact}", it.limit);
        fact(text, ink, about("proven"), Sense::hover());
    } else if study.is_live() {
        // There is no proof if there was too little memory for it.
        let text = if is_drawn && proof.is_current {
            "not proven"
        } else {
            "being proven"
        };
        fact(
            text.to_owned(),
            Color32::GRAY,
            about("proven"),
            Sense::hover(),
        );
    }
    let is_timed = time.is_none() || study.facts.measured_time(method).is_some();
    if study.is_live() && !(comparison.is_current && is_timed) {
        ui.weak("measuring");
    }
    is_clicked
}

/// Lays out the list of keys. Returns whether it stays open.
fn help(ui: &Ui) -> bool {
    let room = (ui.ctx().content_rect().size() - vec2(60.0, 120.0)).max(Vec2::ZERO);
    let modal = Modal::new(Id::new("help")).show(ui.ctx(), |ui| {
        ui.set_width(room.x.min(560.0 + WORDS_WIDTH));
        ui.heading("Keys and words");
        ui.weak("H or Esc closes this. Tab goes to the next control; most have a tooltip.");
        ui.weak("A click explains a pixel. Ctrl with +, - or 0 sizes the letters.");
        ui.weak("The divider of a wipe can be dragged. While the scene is edited (E),");
        ui.weak("the discs of lights in sight can be dragged, too.");
        let scroll = ScrollArea::both().max_height(room.y);
        scroll.min_scrolled_height(room.y).show(ui, |ui| {
            let (left, right) = BINDINGS.split_at(BINDINGS.len() / 2);
            ui.horizontal_top(|ui| {
                key_table(ui, left);
                ui.add_space(16.0);
                key_table(ui, right);
                ui.add_space(16.0);
                ui.vertical(|ui| {
                    ui.set_width(WORDS_WIDTH);
                    ui.strong("Words");
                    for (word, says) in WORDS {
                        ui.label(word);
                        ui.weak(says);
                    }
                });
            });
        });
    });
    !modal.should_close()
}

/// A table of keys; the name of its first section tells it from others.
fn key_table(ui: &mut Ui, sections: &[(&str, &[Binding])]) {
    Grid::new(sections[0].0).show(ui, |ui| {
        for (section, rows) in sections {
            ui.strong(*section);
            ui.end_row();
            for (name, _, keys) in *rows {
                let keys: Vec<String> = keys.iter().map(caption_of).collect();
                ui.label(*name);
                ui.weak(keys.join("  "));
                ui.end_row();
            }
        }
    });
}

/// Lays out a folded side. Returns whether its button was clicked.
fn is_opened(ui: &mut Ui, panel: Panel, arrow: &str, says: &str) -> bool {
    let folded = panel.exact_size(FOLDED).resizable(false);
    let button = folded.show_inside(ui, |ui| ui.button(arrow).on_hover_text(says));
    button.inner.clicked()
}
