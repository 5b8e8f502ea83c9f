//! The frame of the window: the panel on the left, the inspector on the right, the status line below, the picture between.
//!
//! The sides leave at least half of the width to the picture. In a narrow window the inspector takes the panel's place.

use egui::{
    Color32, Grid, Id, Label, Modal, Panel, Popup, RichText, ScrollArea, Sense, TextWrapMode, Ui,
    Vec2, vec2,
};

use super::app::App;
use super::keys::{BINDINGS, Binding, caption_of};
use super::widgets::{BAD, GOOD, INK, STALE, scrolled, short};
use crate::components::{Side, Tab, ViewMode};
use crate::shading::Method;
use crate::trade::verdict::method_name;

/// The least and the usual width of a side, in points.
const LEAST: f32 = 213.0;
const USUAL: f32 = 300.0;
/// By default each of two sides takes the width over this, and at most a quarter: 960x720 shows the whole default scene.
const SHARED: f32 = 4.5;
/// The width of a folded side.
const FOLDED: f32 = 22.0;

const METHOD: &str = "The method on screen.";
const TIME: &str =
    "The median time of a frame, without the window around it. Grey: the time of the last frame.";
const ERROR: &str = "The largest error of a pixel against exact Phong, in levels of 255. A click shows why the pixel errs.";
const PROVEN: &str = "Pixels whose error against the exact evaluation of their own mode is proven to be within the tolerance, \
                      or within 0.05 if that is 0.";

impl App {
    /// Lays out the whole window, and lets keys, widgets and the mouse write into the World.
    pub fn ui(&mut self, ui: &mut Ui) {
        let width = ui.available_width();
        self.desk.has_both = width >= SHARED * LEAST;
        self.take_keys(ui);
        Panel::bottom("status").show_inside(ui, |ui| self.status(ui));
        if !self.scene.lesson.is_empty() {
            Panel::bottom("lesson").show_inside(ui, |ui| self.lesson(ui));
        }
        let has_inspector = self.viewer().inspector.is_some();
        let has_panel = !self.desk.panel_folded && (self.desk.has_both || !has_inspector);
        let is_shared = has_panel && has_inspector;
        let most = width / if is_shared { 4.0 } else { 2.0 };
        let usual = USUAL.min(if is_shared { width / SHARED } else { most });
        // egui keeps a width by id. With an id of its own a narrow window does not change the width in a wider one.
        let id = |name: &str| Id::new((name, usual as u32));
        let side = |panel: Panel| {
            panel
                .default_size(usual)
                .size_range(LEAST.min(usual)..=most)
        };
        if has_panel {
            let panel = side(Panel::left(id("panel")));
            panel.show_inside(ui, |ui| scrolled(ui, "panel", |ui| self.panel(ui)));
        } else if is_opened(ui, Panel::left("folded panel"), "⏵", "Opens the panel (I).") {
            self.fold_panel();
        }
        let folded = Panel::right("folded inspector");
        if has_inspector {
            side(Panel::right(id("inspector"))).show_inside(ui, |ui| self.inspector(ui));
        } else if is_opened(ui, folded, "⏴", "Opens the inspector.") {
            self.viewer_mut().inspector = Some(Tab::Pixel);
        }
        self.viewport(ui);
        if self.desk.help {
            self.help(ui);
        }
        self.takes_escape = ui.ctx().text_edit_focused() || Popup::is_any_open(ui.ctx());
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

    /// The facts about the picture. Facts about another picture are grey. Returns whether the error was clicked.
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
        let mut fact = |text: String, ink: Color32, is_current: bool, says: &str, sense: Sense| {
            let ink = if is_current { ink } else { STALE };
            ui.separator();
            let label = Label::new(RichText::new(text).color(ink)).sense(sense);
            ui.add(label).on_hover_text(says)
        };
        let mut is_clicked = false;
        if let Some(time) = self.milliseconds().filter(|_| self.shows_times) {
            let is_measured = self.measured_time().is_some();
            let time = format!("{} ms", short(time));
            fact(time, INK, is_measured, TIME, Sense::hover());
        }
        let comparison = &self.facts.comparison;
        if let Some(error) = comparison.value.as_ref().and_then(|it| it.error) {
            let text = format!("{} levels off exact Phong", short(error));
            let is_current = comparison.is_current;
            is_clicked = fact(text, INK, is_current, ERROR, Sense::click()).clicked();
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
            fact(text, ink, true, PROVEN, Sense::hover());
        } else if self.pool.is_some() {
            let text = "not proven yet".to_owned();
            fact(text, STALE, false, PROVEN, Sense::hover());
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
