//! The frame of the window: the panel on the left, the inspector on the right, the status line below, the picture between.
//!
//! In a wide window the inspector has a room of its own. In a narrower one it is a drawer over the picture. So the picture keeps its
//! size when something is opened.

use egui::{
    Align2, Area, Color32, Frame, Grid, Id, Label, Modal, Order, Panel, Popup, RichText,
    ScrollArea, Sense, TextWrapMode, Ui, Vec2, vec2,
};

use super::app::App;
use super::inspector::Tab;
use super::keys::{BINDINGS, Binding, caption_of};
use super::widgets::{BAD, GOOD, INK, scrolled, short};
use crate::components::{Side, ViewMode};
use crate::shading::Method;
use crate::trade::verdict::method_name;

/// The least and the usual width of a side, in points.
const LEAST: f32 = 213.0;
const USUAL: f32 = 300.0;
/// The width of a window, in points, from which on the inspector has a room of its own.
const WIDE: f32 = 1200.0;
/// The width of a folded side.
const FOLDED: f32 = 22.0;

const METHOD: &str = "The method on screen.";
const TIME: &str = "The median time of a frame on all cores, or as many as --threads says, without the window around it; that of \
                    the last frame until it is measured.";
const ERROR: &str = "The largest error of a pixel against exact Phong, in levels of 255. A click shows why the pixel errs.";
const PROVEN: &str = "Pixels whose error against the exact evaluation of their own mode is proven to be within the tolerance, \
                      or within 0.05 if that is 0.";

impl App {
    /// Lays out the whole window, and lets keys, widgets and the mouse write into the World.
    pub fn ui(&mut self, ui: &mut Ui) {
        let width = ui.available_width();
        self.desk.has_room = width >= WIDE;
        self.take_keys(ui);
        Panel::bottom("status").show_inside(ui, |ui| self.status(ui));
        if !self.scene.lesson.is_empty() {
            Panel::bottom("lesson").show_inside(ui, |ui| self.lesson(ui));
        }
        let usual = USUAL.min(width / 2.0);
        let most = if self.desk.has_room { 3.0 } else { 2.0 };
        // egui keeps a width by id. With an id of its own a narrow window does not change the width in a wider one.
        let id = |name: &str| Id::new((name, usual as u32));
        let side = |panel: Panel| {
            let panel = panel.default_size(usual);
            panel.size_range(LEAST.min(usual)..=width / most)
        };
        if !self.desk.panel_folded {
            let panel = side(Panel::left(id("panel")));
            panel.show_inside(ui, |ui| scrolled(ui, "panel", |ui| self.panel(ui)));
        } else if is_opened(ui, Panel::left("folded panel"), "⏵", "Opens the panel (I).") {
            self.desk.panel_folded = false;
        }
        if self.desk.has_room {
            let inspector = side(Panel::right(id("inspector")));
            inspector.show_inside(ui, |ui| self.inspector(ui, false));
        } else if is_opened(ui, Panel::right("drawer"), "⏴", "Opens the inspector.") {
            self.desk.tab = self.desk.tab.or(Some(Tab::Pixel));
        }
        self.viewport(ui);
        if !self.desk.has_room && self.desk.tab.is_some() {
            self.drawer(ui, usual);
        }
        if self.desk.help {
            self.help(ui);
        }
        self.takes_escape = ui.ctx().text_edit_focused() || Popup::is_any_open(ui.ctx());
    }

    /// Lays out the inspector over the picture, on the side where it does not hide the explained pixel.
    fn drawer(&mut self, ui: &Ui, usual: f32) {
        let place = self.place;
        let is_left = self
            .pixel()
            .is_some_and(|it| self.place_of(it).x > place.center().x);
        let (pivot, corner) = if is_left {
            (Align2::LEFT_TOP, place.left_top())
        } else {
            (Align2::RIGHT_TOP, place.right_top())
        };
        let ground = Frame::side_top_panel(ui.style());
        let width = usual.min(LEAST.max(place.width() / 2.0)).min(place.width());
        let room = (vec2(width, place.height()) - ground.total_margin().sum()).max(Vec2::ZERO);
        let drawer = Area::new(Id::new("drawer")).pivot(pivot).fixed_pos(corner);
        drawer.order(Order::Middle).show(ui.ctx(), |ui| {
            ground.show(ui, |ui| {
                ui.set_min_size(room);
                ui.set_max_size(room);
                self.inspector(ui, true);
            });
        });
    }

    /// The status line: the facts about the picture, or a message.
    fn status(&mut self, ui: &mut Ui) {
        self.desk.message.take_if(|(_, until)| *until <= self.now);
        ui.horizontal(|ui| {
            if let Some((text, until)) = &self.desk.message {
                let rest = until.saturating_sub(self.now);
                ui.ctx().request_repaint_after(rest);
                let text = RichText::new(text).strong();
                ui.add(Label::new(text).truncate());
            } else {
                ui.style_mut().wrap_mode = Some(TextWrapMode::Extend);
                if self.facts_line(ui) {
                    self.explain_worst();
                }
            }
        });
    }

    /// The facts about the picture; those of the picture before stay until they are found again. Returns whether the error was
    /// clicked.
    fn facts_line(&self, ui: &mut Ui) -> bool {
        let is_wipe = self.viewer().show == ViewMode::Wipe;
        let (name, is_shown) = match self.turn() {
            Some(turn) if is_wipe => (self.side_name(&self.viewer().sides[turn]), false),
            Some(0) => (self.side_name(&Side::Reference), false),
            None if is_wipe => ("Two pictures; drag the line".to_owned(), false),
            _ => (self.side_name(&Side::Picture), true),
        };
        ui.label(name).on_hover_text(METHOD);
        if !is_shown {
            return false;
        }
        let mut fact = |text: String, ink: Color32, says: &str, sense: Sense| {
            ui.separator();
            let label = Label::new(RichText::new(text).color(ink)).sense(sense);
            ui.add(label).on_hover_text(says)
        };
        let mut is_clicked = false;
        if let Some(time) = self.milliseconds().filter(|_| self.shows_times) {
            fact(format!("{} ms", short(time)), INK, TIME, Sense::hover());
        }
        let comparison = &self.facts.comparison;
        if let Some(error) = comparison.value.as_ref().and_then(|it| it.error) {
            let text = format!("{} levels off exact Phong", short(error));
            is_clicked = fact(text, INK, ERROR, Sense::click()).clicked();
        }
        if let Some(it) = self.facts.proof.current() {
            let pixels = it.pixels as u64;
            let (share, ink) = match pixels - it.proven {
                0 => ("every pixel".to_owned(), GOOD),
                _ => (format!("{} of {pixels} pixels", it.proven), BAD),
            };
            let mode = self.method().map(|it| Method::of(it.mode, 0.0));
            let exact = mode.map_or("its exact mode".to_owned(), method_name);
            let text = format!("{share} proven within {} of {exact}", it.limit);
            fact(text, ink, PROVEN, Sense::hover());
        } else if self.pool.is_some() {
            let text = "not proven yet".to_owned();
            fact(text, Color32::GRAY, PROVEN, Sense::hover());
        }
        let is_measured =
            comparison.is_current && (self.measured_time().is_some() || !self.shows_times);
        if self.pool.is_some() && !is_measured {
            ui.weak("measuring");
        }
        is_clicked
    }

    fn help(&mut self, ui: &Ui) {
        let room = (ui.ctx().content_rect().size() - vec2(60.0, 120.0)).max(Vec2::ZERO);
        let modal = Modal::new(Id::new("help")).show(ui.ctx(), |ui| {
            ui.set_width(room.x.min(540.0));
            ui.heading("Keys");
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
                });
            });
        });
        if modal.should_close() {
            self.desk.help = false;
        }
    }
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
