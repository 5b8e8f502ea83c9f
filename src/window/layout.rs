//! The frame of the window: the panel on the left, the inspector on the right, the status line below, the picture between.
//!
//! Both sides together leave half of the width to the picture. A narrow window has room for one side.

use egui::{Align, Id, Label, Layout, Modal, Panel, RichText, ScrollArea, Ui};

use super::app::App;
use super::keys::{BINDINGS, caption_of};
use super::style::{BAD, GOOD, STALE};
use super::widgets::short;
use crate::components::{Inspector, Show, Side, Tab, ViewMode};

/// The least and the usual width of a side, in points.
const LEAST: f32 = 215.0;
const USUAL: f32 = 300.0;
/// The most that a side takes of a narrow window, as a share of its width.
const MOST: f32 = 0.6;
/// The least width and height of the help; a smaller window cuts it off.
const LEAST_HELP: f32 = 60.0;
/// The width of a folded side.
const FOLDED: f32 = 22.0;

const METHOD: &str = "The method on screen.";
const TIME: &str = "The median time of a warm frame, from the World to the picture's pixels; that of the last frame \
                    until it is measured.";
const ERROR: &str = "The largest error of a pixel against exact Phong, in levels of 255.";
const PROVEN: &str = "Pixels whose error is proven to be within the tolerance.";

impl App {
    /// Lays out the whole window, and lets keys, widgets and the mouse write into the World.
    pub fn ui(&mut self, ui: &mut Ui) {
        let width = ui.available_width();
        self.desk.has_both = width >= 4.0 * LEAST;
        self.take_keys(ui);
        Panel::bottom("status").show_inside(ui, |ui| self.status(ui));
        let Inspector(tab) = self.look();
        let has_inspector = tab.is_some();
        let is_hidden = has_inspector && !self.desk.has_both;
        let has_panel = !self.desk.panel_folded && !is_hidden;
        let both = has_panel && has_inspector;
        let least = LEAST.min(MOST * width);
        let most = (width / 2.0 - if both { LEAST } else { 0.0 }).max(least);
        let usual = USUAL.min(width / if both { 4.0 } else { 3.0 }).max(least);
        // Each usual width has a remembered one of its own, so that a window that was narrow for a while looks as before.
        let id = |name: &str| Id::new(name).with((both, usual as i32));
        let side = |panel: Panel| panel.size_range(least..=most).default_size(usual);
        if has_panel {
            side(Panel::left(id("panel"))).show_inside(ui, |ui| {
                let scroll = ScrollArea::vertical().auto_shrink(false);
                scroll.show(ui, |ui| self.panel(ui));
            });
        } else if is_opened(ui, Panel::left("folded panel"), "⏵", "Opens the panel (I).") {
            self.fold_panel();
        }
        let folded = Panel::right("folded inspector");
        if has_inspector {
            side(Panel::right(id("inspector"))).show_inside(ui, |ui| self.inspector(ui));
        } else if is_opened(ui, folded, "⏴", "Opens the inspector.") {
            self.set_look(Inspector(Some(Tab::Pixel)));
        }
        self.viewport(ui);
        if self.desk.help {
            self.help(ui);
        }
        if self.desk.asks_to_save {
            self.ask_to_save(ui);
        }
    }

    /// The status line: the facts about the picture, messages on the right, errors of the scene's file above.
    fn status(&mut self, ui: &mut Ui) {
        if let Some(error) = &self.desk.file_error {
            ui.label(RichText::new(error).monospace().color(BAD));
        }
        self.desk.message.take_if(|it| it.until <= self.now);
        if let Some(message) = &self.desk.message {
            ui.ctx()
                .request_repaint_after(message.until.saturating_sub(self.now));
        }
        ui.horizontal(|ui| {
            let width = ui.available_width();
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                if let Some(message) = &self.desk.message {
                    ui.add(Label::new(&message.text).truncate());
                }
                if self.desk.message.is_none() || width > 640.0 {
                    let layout = Layout::left_to_right(Align::Center);
                    ui.with_layout(layout, |ui| self.facts_line(ui, width));
                }
            });
        });
    }

    /// The facts about the picture. Facts about another picture are grey.
    fn facts_line(&self, ui: &mut Ui, width: f32) {
        let show: Show = self.look();
        let is_wipe = show.mode == ViewMode::Wipe;
        let (name, is_shown) = match self.turn() {
            Some(turn) if is_wipe => (self.side_name(&show.sides[turn]), false),
            Some(0) => (self.side_name(&Side::Reference), false),
            None if is_wipe => ("Two pictures".to_owned(), false),
            _ => (self.side_name(&Side::Picture), true),
        };
        ui.label(name).on_hover_text(METHOD);
        let (comparison, proof) = (&self.facts.comparison, &self.facts.proof);
        let text_ink = ui.visuals().text_color();
        let time = self.milliseconds().filter(|_| self.shows_times);
        let time = time.map(|time| (0.0, format!("{} ms", short(time)), text_ink, true, TIME));
        let error = comparison.value.as_ref().and_then(|it| it.error);
        let error = error.map(|error| {
            let text = format!("off by {} of 255", short(error));
            (400.0, text, text_ink, comparison.is_current, ERROR)
        });
        let proven = proof.value.as_ref().map(|it| {
            let pixels = it.proven + it.refuted + it.undecided;
            let (text, ink) = match pixels - it.proven {
                0 => ("every pixel proven".to_owned(), GOOD),
                _ => (format!("proven {} of {pixels}", it.proven), BAD),
            };
            (620.0, text, ink, proof.is_current, PROVEN)
        });
        for (least, text, ink, is_current, says) in [time, error, proven].into_iter().flatten() {
            if width > least {
                let ink = if is_shown && is_current { ink } else { STALE };
                ui.separator();
                ui.label(RichText::new(text).color(ink)).on_hover_text(says);
            }
        }
    }

    fn help(&mut self, ui: &Ui) {
        let screen = ui.ctx().content_rect().size();
        let modal = Modal::new(Id::new("help")).show(ui.ctx(), |ui| {
            ui.set_width((screen.x - 40.0).clamp(LEAST_HELP, 640.0));
            ui.heading("Keys");
            ui.weak("H or Esc closes this. A tooltip says what a thing is.");
            let height = (screen.y - 100.0).max(LEAST_HELP);
            let scroll = ScrollArea::vertical().max_height(height);
            let scroll = scroll.min_scrolled_height(height);
            scroll.show(ui, |ui| {
                ui.columns(if screen.x > 600.0 { 2 } else { 1 }, |columns| {
                    for (index, (section, rows)) in BINDINGS.iter().enumerate() {
                        let ui = &mut columns[index % columns.len()];
                        ui.add_space(6.0);
                        ui.strong(*section);
                        for row in *rows {
                            let keys: Vec<String> = row.keys.iter().map(caption_of).collect();
                            ui.horizontal(|ui| {
                                ui.label(row.name);
                                let right = Layout::right_to_left(Align::Center);
                                ui.with_layout(right, |ui| {
                                    ui.add_space(12.0);
                                    ui.weak(keys.join("  "));
                                });
                            });
                        }
                    }
                });
            });
        });
        if modal.should_close() {
            self.desk.help = false;
        }
    }

    fn ask_to_save(&mut self, ui: &Ui) {
        Modal::new(Id::new("save?")).show(ui.ctx(), |ui| {
            let name = &self.scene.name;
            ui.label(format!("{name} has changes that are not saved."));
            ui.horizontal(|ui| {
                if ui.button("save and quit").clicked() {
                    self.desk.asks_to_save = false;
                    self.quits = self.save(false);
                }
                if ui.button("quit without saving").clicked() {
                    self.file.saved = std::sync::Arc::clone(&self.state);
                    self.quits = true;
                }
                if ui.button("go on").clicked() {
                    self.desk.asks_to_save = false;
                }
            });
        });
    }
}

/// Lays out a folded side; whether its button was clicked.
fn is_opened(ui: &mut Ui, panel: Panel, arrow: &str, says: &str) -> bool {
    let folded = panel.exact_size(FOLDED).resizable(false);
    let button = folded.show_inside(ui, |ui| ui.button(arrow).on_hover_text(says));
    button.inner.clicked()
}
