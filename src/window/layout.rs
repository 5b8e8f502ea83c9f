//! The frame of the window: the panel on the left, the inspector on the right, the status line below, the picture between.
//!
//! The picture keeps half of the width. A side for which there is no room folds; opened, it lies over the picture.

use egui::{
    Align, Align2, Area, Frame, Id, Label, Layout, Modal, Order, Panel, Pos2, RichText, ScrollArea,
    Ui, Vec2,
};

use super::app::App;
use super::inspector::short;
use super::keys::{BINDINGS, SECTIONS, caption_of};
use super::style::{BAD, GOOD, STALE};
use crate::components::{Inspector, Show, Side, Tab, ViewMode};
use crate::report::words::capital;
use crate::trade::verdict::method_name;

/// The least and the usual width of a side, in points.
const LEAST: f32 = 215.0;
const USUAL: f32 = 300.0;
/// The least width and height of a panel over the picture; a smaller window cuts it off.
const LEAST_OVER: f32 = 60.0;
/// The width of a folded side.
const FOLDED: f32 = 22.0;

impl App {
    /// Lays out the whole window, and lets keys, widgets and the mouse write into the World.
    pub fn ui(&mut self, ui: &mut Ui) {
        let width = ui.available_width();
        let has_room = [width >= 2.0 * LEAST, width >= 4.0 * LEAST];
        for side in 0..2 {
            self.desk.over[side] &= !has_room[side];
        }
        self.desk.has_room = has_room;
        self.desk.panel_folded &= has_room[0];
        self.take_keys(ui);
        Panel::bottom("status").show_inside(ui, |ui| self.status(ui));
        let Inspector(tab) = self.look();
        let is_open = [
            has_room[0] && !self.desk.panel_folded,
            has_room[1] && tab.is_some(),
        ];
        let both = is_open == [true; 2];
        let most = (width / 2.0 - if both { LEAST } else { 0.0 }).max(LEAST);
        let usual = USUAL.min(width / if both { 4.0 } else { 3.0 }).max(LEAST);
        // Each usual width has a remembered one of its own, so that a window that was narrow for a while looks as before.
        let id = |name: &str| Id::new(name).with((both, usual as i32));
        let side = |panel: Panel| panel.size_range(LEAST..=most).default_size(usual);
        if is_open[0] {
            side(Panel::left(id("panel"))).show_inside(ui, |ui| self.scrolled_panel(ui));
        } else if is_opened(ui, Panel::left("folded panel"), "⏵", "Opens the panel (I).") {
            self.desk.panel_folded = false;
            self.desk.over[0] ^= true;
        }
        if is_open[1] {
            side(Panel::right(id("inspector"))).show_inside(ui, |ui| self.inspector(ui));
        } else if is_opened(
            ui,
            Panel::right("folded inspector"),
            "⏴",
            "Opens the inspector.",
        ) {
            self.desk.over[1] ^= true;
            let open = self.desk.over[1].then_some(tab.unwrap_or(Tab::Pixel));
            self.set_look(Inspector(open));
        }
        self.viewport(ui);
        let (room, place) = (self.place.size(), self.place);
        if !has_room[0] && self.desk.over[0] {
            let at = (Align2::LEFT_TOP, place.left_top());
            over(ui, "panel over", at, room, |ui| self.scrolled_panel(ui));
        }
        if !has_room[1] && self.desk.over[1] && tab.is_some() {
            let at = (Align2::RIGHT_TOP, place.right_top());
            over(ui, "inspector over", at, room, |ui| self.inspector(ui));
        }
        if self.desk.help {
            self.help(ui);
        }
        if self.desk.asks_to_save {
            self.ask_to_save(ui);
        }
    }

    fn scrolled_panel(&mut self, ui: &mut Ui) {
        let scroll = ScrollArea::vertical().auto_shrink(false);
        scroll.show(ui, |ui| self.panel(ui));
    }

    /// The status line: the facts about the picture, messages on the right, errors of the scene's file above.
    fn status(&mut self, ui: &mut Ui) {
        if let Some(error) = self.desk.file_error.clone() {
            ui.horizontal_top(|ui| {
                if ui.button("copy").clicked() {
                    ui.ctx().copy_text(error.clone());
                }
                ui.label(RichText::new(error).monospace().color(BAD));
            });
        }
        let until = self.desk.message.as_ref().map(|message| message.until);
        if let Some(until) = until {
            match until.checked_sub(self.now) {
                Some(rest) => ui.ctx().request_repaint_after(rest),
                None => self.desk.message = None,
            }
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
        let (name, is_shown) = match (self.desk.left_out, self.turn(), self.desk.preview) {
            (Some(_), ..) => ("Without a part, in f64".to_owned(), false),
            (_, Some(turn), _) if is_wipe => (self.side_name(&show.sides[turn]), false),
            (_, Some(0), _) => (self.side_name(&Side::Reference), false),
            (_, None, Some(method)) => (capital(&method_name(method)), false),
            (_, None, None) if is_wipe => ("Two pictures".to_owned(), false),
            _ => (self.side_name(&Side::Picture), true),
        };
        ui.label(name).on_hover_text(
            "The method on screen, and its largest error against its own exact evaluation, in levels of 255.",
        );
        let fact = |ui: &mut Ui, text: String, ink, is_current: bool, says: &str| {
            let ink = if is_shown && is_current { ink } else { STALE };
            ui.separator();
            ui.label(RichText::new(text).color(ink)).on_hover_text(says);
        };
        let ink = ui.visuals().text_color();
        if let Some(time) = self.milliseconds().filter(|_| self.shows_times) {
            let says = "The median time of a warm frame, from the World to the picture's pixels; \
                        that of the last frame until it is measured.";
            fact(ui, format!("{} ms", short(time)), ink, true, says);
        }
        let comparison = &self.facts.comparison;
        let error = comparison.value.as_ref().and_then(|it| it.error);
        if let Some(error) = error.filter(|_| width > 400.0) {
            let says = "The largest error of a pixel against exact Phong, in levels of 255.";
            let text = format!("off by {} of 255", short(error));
            fact(ui, text, ink, comparison.current().is_some(), says);
        }
        if let Some(proof) = self.facts.proof.value.as_ref().filter(|_| width > 620.0) {
            let pixels = proof.proven + proof.refuted + proof.undecided;
            let (text, ink) = match pixels - proof.proven {
                0 => ("every pixel proven".to_owned(), GOOD),
                _ => (format!("proven {} of {pixels}", proof.proven), BAD),
            };
            let says = "Pixels whose error is proven to be within the tolerance.";
            fact(ui, text, ink, self.facts.proof.current().is_some(), says);
        }
    }

    fn help(&mut self, ui: &Ui) {
        let screen = ui.ctx().content_rect().size();
        let modal = Modal::new(Id::new("help")).show(ui.ctx(), |ui| {
            ui.set_width((screen.x - 40.0).clamp(LEAST_OVER, 640.0));
            ui.heading("Keys");
            ui.weak("H or Esc closes this. A tooltip says what a thing is.");
            let height = (screen.y - 100.0).max(LEAST_OVER);
            let scroll = ScrollArea::vertical().max_height(height);
            scroll.show(ui, |ui| {
                ui.columns(if screen.x > 600.0 { 2 } else { 1 }, |columns| {
                    for (index, section) in SECTIONS.iter().enumerate() {
                        let ui = &mut columns[index % columns.len()];
                        ui.add_space(6.0);
                        ui.strong(*section);
                        for row in BINDINGS.iter().filter(|row| row.section == *section) {
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

/// Lays out a side over the picture, with its corner at `at`.
fn over(ui: &Ui, id: &str, at: (Align2, Pos2), room: Vec2, content: impl FnOnce(&mut Ui)) {
    let area = Area::new(Id::new(id)).order(Order::Middle).constrain(false);
    area.pivot(at.0).fixed_pos(at.1).show(ui.ctx(), |ui| {
        Frame::side_top_panel(ui.style()).show(ui, |ui| {
            ui.set_width((room.x - 16.0).clamp(LEAST_OVER, USUAL - 16.0));
            ui.set_height((room.y - 8.0).max(LEAST_OVER));
            content(ui);
        });
    });
}
