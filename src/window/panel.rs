//! The frame of the window: the panel on the left, the inspector on the right, the status line below, the picture in between.
//!
//! A panel is a query loop over the World: it reads components and writes them.

use std::path::PathBuf;

use egui::{
    Align, Align2, Area, Button, CollapsingHeader, ComboBox, DragValue, Frame, Grid, Id, Layout,
    Modal, Order, Panel, Response, RichText, ScrollArea, Slider, Ui,
};
use hecs::Entity;

use super::app::App;
use super::keys::{BINDINGS, Command, caption};
use super::style::{BAD, GOOD, STALE};
use super::viewport::method_name;
use crate::components::{
    ActiveCamera, Camera, Inspector, Light, LightKind, Name, Projection, ShadingMode, Show, Side,
    Spin, Tab, Tolerance, ViewMode, get, ordered,
};
use crate::scene::{BUILT_IN, Scene, range};

/// The least and the usual width of the panel and of the inspector, in points.
const LEAST: f32 = 215.0;
const USUAL: f32 = 300.0;
/// The least size of what lies over the picture; a smaller window cuts it off.
const LEAST_OVER: f32 = 60.0;
/// The width of a folded side.
const FOLDED: f32 = 22.0;

impl App {
    /// Lays out the whole window, and lets keys, widgets and the mouse write into the World.
    pub fn ui(&mut self, ui: &mut Ui) {
        let width = ui.available_width();
        // The picture keeps half of the width.
        let has_room = [width >= 2.0 * LEAST, width >= 4.0 * LEAST];
        for (over, has_room) in self.desk.over.iter_mut().zip(has_room) {
            *over &= !has_room;
        }
        self.desk.panel_folded &= has_room[0];
        self.take_keys(ui);
        let Inspector(tab) = self.look();
        let both = has_room[1] && tab.is_some() && !self.desk.panel_folded;
        let most = width / 2.0 - if both { LEAST } else { 0.0 };
        let usual = USUAL.min(width / if both { 4.0 } else { 3.0 }).max(LEAST);
        let sizes = LEAST..=most.max(LEAST);
        Panel::bottom("status").show_inside(ui, |ui| self.status(ui));
        if has_room[0] && !self.desk.panel_folded {
            let panel = Panel::left("panel")
                .size_range(sizes.clone())
                .default_size(usual);
            panel.show_inside(ui, |ui| scrolled(ui, |ui| self.panel(ui)));
        } else {
            let folded = Panel::left("folded panel")
                .exact_size(FOLDED)
                .resizable(false);
            let button =
                folded.show_inside(ui, |ui| ui.button("⏵").on_hover_text("Open the panel (I)"));
            if button.inner.clicked() {
                self.desk.panel_folded = false;
                self.desk.over[0] ^= true;
            }
        }
        if has_room[1] && tab.is_some() {
            let inspector = Panel::right("inspector")
                .size_range(sizes)
                .default_size(usual);
            inspector.show_inside(ui, |ui| self.inspector(ui));
        } else {
            let folded = Panel::right("folded inspector")
                .exact_size(FOLDED)
                .resizable(false);
            let button =
                folded.show_inside(ui, |ui| ui.button("⏴").on_hover_text("Open the inspector"));
            if button.inner.clicked() {
                self.desk.over[1] ^= true;
                let open = self.desk.over[1].then_some(tab.unwrap_or(Tab::Pixel));
                self.set_look(Inspector(open));
            }
        }
        self.viewport(ui);
        if !has_room[0] && self.desk.over[0] {
            let place = self.place.left_top();
            over(
                ui,
                "panel over",
                Align2::LEFT_TOP,
                place,
                self.place.size(),
                |ui| scrolled(ui, |ui| self.panel(ui)),
            );
        }
        if !has_room[1] && self.desk.over[1] && tab.is_some() {
            let place = self.place.right_top();
            over(
                ui,
                "inspector over",
                Align2::RIGHT_TOP,
                place,
                self.place.size(),
                |ui| self.inspector(ui),
            );
        }
        if self.desk.help {
            self.help(ui);
        }
        if self.desk.asks_to_save {
            self.ask_to_save(ui);
        }
    }

    fn panel(&mut self, ui: &mut Ui) {
        self.chart(ui);
        section(ui, "Shading", |ui| self.shading_rows(ui));
        section(ui, "Lights", |ui| self.light_rows(ui));
        section(ui, "View", |ui| self.view_rows(ui));
        section(ui, "Camera", |ui| self.camera_rows(ui));
        section(ui, "Scene", |ui| self.scene_rows(ui));
    }

    fn shading_rows(&mut self, ui: &mut Ui) {
        let shading = self.shading();
        ui.horizontal_wrapped(|ui| {
            for (mode, name, says) in [
                (
                    ShadingMode::Gouraud,
                    "Gouraud",
                    "Light is computed at the vertices, and its colours are interpolated.",
                ),
                (
                    ShadingMode::Phong,
                    "Phong",
                    "Normals are interpolated, and light is computed at every pixel.",
                ),
            ] {
                let command = Command::Shading(mode);
                if choice(ui, shading == Some(mode), name, command, says).clicked() {
                    self.run(command);
                }
            }
            let says = "Each cuboid is shaded as the scene's file says.";
            if keyed(ui, "as the file", Command::FileShading, says).clicked() {
                self.run(Command::FileShading);
            }
        });
        let Tolerance(mut tolerance) = self.look();
        let mut is_changed = false;
        let slider = Slider::new(&mut tolerance, 0.0..=255.0)
            .logarithmic(true)
            .smallest_positive(1e-4)
            .custom_formatter(|value, _| {
                if value == 0.0 {
                    "exact".to_owned()
                } else {
                    short(value)
                }
            })
            .custom_parser(|text| {
                if text == "exact" {
                    Some(0.0)
                } else {
                    text.parse().ok()
                }
            });
        ui.horizontal(|ui| {
            ui.label("tolerance").on_hover_text(TOLERANCE);
            is_changed = ui.add(slider).on_hover_text(TOLERANCE).changed();
            keys_of(ui, "[ ]");
        });
        let Tolerance(before) = self.look();
        if is_changed && short(tolerance) != short(before) {
            let levels = if tolerance < 1e-4 {
                0.0
            } else {
                two_digits(tolerance)
            };
            self.set_tolerance(levels.min(255.0));
        }
    }

    fn light_rows(&mut self, ui: &mut Ui) {
        if ordered::<Light>(&self.scene.world).is_empty() {
            ui.weak("The scene has no lights.");
        }
        let lights = ordered::<Light>(&self.scene.world);
        let rows = |ui: &mut Ui, places: std::ops::Range<usize>| {
            Grid::new("lights").num_columns(4).show(ui, |ui| {
                for place in places {
                    self.light_row(ui, lights[place], place);
                    ui.end_row();
                }
            });
        };
        if lights.len() <= 12 {
            return rows(ui, 0..lights.len());
        }
        let height = ui.spacing().interact_size.y;
        let scroll = ScrollArea::vertical().id_salt("lights").max_height(260.0);
        scroll.show_rows(ui, height, lights.len(), rows);
    }

    fn light_row(&self, ui: &mut Ui, entity: Entity, place: usize) {
        let mut query = self.scene.world.query_one::<(&Name, &mut Light)>(entity);
        let Ok((name, light)) = query.get() else {
            return;
        };
        let kind = match light.kind {
            LightKind::Ambient => "feeds the ambient term: it is the same everywhere.",
            LightKind::Diffuse => "feeds the diffuse term, max(0, n.l).",
            LightKind::Specular => "feeds the specular term, max(0, o.r)^shininess.",
        };
        ui.checkbox(&mut light.on, &name.0)
            .on_hover_text(format!("This light {kind}"));
        super::inspector::color_button(ui, &mut light.color);
        let before = light.intensity;
        let speed = (before * 0.01).max(0.01);
        ui.add(
            DragValue::new(&mut light.intensity)
                .range(range::STRENGTH)
                .speed(speed)
                .custom_formatter(|value, _| short(value)),
        )
        .on_hover_text("Intensity, 0 to 1e30. Drag it, or click to type.");
        // A number that was looked at is written back with the digits that are shown.
        if short(light.intensity) == short(before) {
            light.intensity = before;
        }
        let named = ["white", "red", "specular", "ambient"]
            .into_iter()
            .find(|own| *own == name.0);
        let command = named.map_or(Command::Light(place), Command::LightNamed);
        keys_of(ui, &caption(command));
    }

    fn view_rows(&mut self, ui: &mut Ui) {
        let show: Show = self.look();
        let exact = [Side::Picture, Side::Reference];
        let is_exact = show.sides == exact;
        for (command, is_chosen, name, says) in [
            (
                Command::View(ViewMode::Picture),
                show.mode == ViewMode::Picture,
                "picture",
                "The picture as it is shaded.",
            ),
            (
                Command::View(ViewMode::Wipe),
                show.mode == ViewMode::Wipe && !is_exact,
                "Gouraud | Phong",
                "Two methods, left and right of a divider.",
            ),
            (
                Command::WipeExact,
                show.mode == ViewMode::Wipe && is_exact,
                "picture | exact",
                "The picture, and exact Phong in f64.",
            ),
            (
                Command::View(ViewMode::Error),
                show.mode == ViewMode::Error,
                "error map",
                "The error of each pixel against exact Phong.",
            ),
            (
                Command::View(ViewMode::Tiles),
                show.mode == ViewMode::Tiles,
                "tiles",
                "The way in which each square was drawn.",
            ),
        ] {
            if choice(ui, is_chosen, name, command, says).clicked() {
                self.run(command);
            }
        }
        let says = "Hold the button or the key to see exact Phong.";
        let hold = keyed(ui, "show exact", Command::ShowExact, says);
        if hold.is_pointer_button_down_on() || hold.drag_stopped() || hold.clicked() {
            self.desk.shows_exact = hold.is_pointer_button_down_on();
        }
        self.legend(ui, &show);
    }

    fn camera_rows(&mut self, ui: &mut Ui) {
        let cameras = ordered::<Camera>(&self.scene.world);
        let ActiveCamera(active) = get(
            &self.scene.world,
            crate::components::viewer(&self.scene.world),
        )
        .unwrap_or(ActiveCamera(cameras[0]));
        ui.horizontal(|ui| {
            ui.label("camera")
                .on_hover_text("The camera that is looked through.");
            ComboBox::from_id_salt("camera")
                .selected_text(self.camera_name())
                .show_ui(ui, |ui| {
                    for camera in cameras {
                        let name = get(&self.scene.world, camera)
                            .map_or_else(String::new, |Name(name)| name);
                        if ui.selectable_label(camera == active, name).clicked() {
                            self.set_look(ActiveCamera(camera));
                        }
                    }
                });
            keys_of(ui, &caption(Command::NextCamera));
        });
        let mut projection: Projection = self.look();
        ui.horizontal_wrapped(|ui| {
            for each in Projection::ALL {
                ui.selectable_value(&mut projection, each, each.name())
                    .on_hover_text(match each {
                        Projection::Perspective => {
                            "Rays leave the eye; distant things are smaller."
                        }
                        Projection::Orthographic => "Rays are parallel to the view.",
                    });
            }
            keys_of(ui, &caption(Command::NextProjection));
        });
        if projection != self.look() {
            self.set_look(projection);
        }
        ui.horizontal_wrapped(|ui| {
            let mut rotates = self.look::<Spin>().on;
            let says = "The cuboids turn about their own x axes.";
            if ui
                .checkbox(&mut rotates, "rotate")
                .on_hover_text(says)
                .changed()
            {
                self.run(Command::Rotate);
            }
            keys_of(ui, "Space");
            let says = "The camera and the cuboids go back to their places in the file.";
            if keyed(ui, "reset view", Command::ResetView, says).clicked() {
                self.run(Command::ResetView);
            }
        });
        let scale = self.magnifier().scale;
        if scale > 1 {
            ui.horizontal(|ui| {
                ui.label(format!("magnified {scale} times"));
                if keyed(
                    ui,
                    "smaller",
                    Command::Magnify(-1),
                    "Half the magnification.",
                )
                .clicked()
                {
                    self.run(Command::Magnify(-1));
                }
            });
        }
    }

    fn scene_rows(&mut self, ui: &mut Ui) {
        let mut chosen: Option<PathBuf> = None;
        ComboBox::from_id_salt("scene")
            .selected_text(self.scene.name.clone())
            .width(ui.available_width() - 8.0)
            .show_ui(ui, |ui| {
                ui.weak("built in");
                for (name, _) in BUILT_IN {
                    if ui.selectable_label(self.scene.name == name, name).clicked() {
                        chosen = Some(name.into());
                    }
                }
                if !self.desk.recent.is_empty() {
                    ui.weak("opened last");
                }
                for path in &self.desk.recent {
                    if ui
                        .selectable_label(
                            self.scene.path.as_ref() == Some(path),
                            path.to_string_lossy(),
                        )
                        .clicked()
                    {
                        chosen = Some(path.clone());
                    }
                }
            });
        ui.horizontal(|ui| {
            let field = egui::TextEdit::singleline(&mut self.desk.path)
                .hint_text("FILE.toml")
                .desired_width(130.0);
            let entered =
                ui.add(field).lost_focus() && ui.input(|input| input.key_pressed(egui::Key::Enter));
            if ui
                .button("open")
                .on_hover_text("Opens the scene in this file.")
                .clicked()
                || entered
            {
                chosen = Some(PathBuf::from(&self.desk.path));
            }
        });
        if let Some(path) = chosen {
            match Scene::load_path(&path) {
                Ok(scene) => self.open(scene),
                Err(error) => self.desk.file_error = Some(error.to_string()),
            }
        }
        ui.horizontal_wrapped(|ui| {
            for (name, command, is_enabled, says) in [
                (
                    "edit",
                    Command::Tab(Tab::Scene),
                    true,
                    "Every number of the scene.",
                ),
                (
                    "undo",
                    Command::Undo,
                    self.history.has_undo(&self.state),
                    "Takes back the last change.",
                ),
                (
                    "redo",
                    Command::Redo,
                    self.history.has_redo(&self.state),
                    "Makes it again.",
                ),
                (
                    "save",
                    Command::Save,
                    true,
                    "Writes the scene and the view to the scene's file.",
                ),
                (
                    "save as new",
                    Command::SaveAs,
                    true,
                    "Writes the scene and the view to a new file.",
                ),
                ("help", Command::Help, true, "All keys."),
            ] {
                let button = Button::new(name).shortcut_text(caption(command));
                if ui
                    .add_enabled(is_enabled, button)
                    .on_hover_text(says)
                    .clicked()
                {
                    self.run(command);
                }
            }
        });
    }

    /// The status line: the method, its time, its error, its proof; messages on the right.
    fn status(&mut self, ui: &mut Ui) {
        if let Some(error) = &self.desk.file_error {
            let error = error.clone();
            ui.horizontal_top(|ui| {
                ui.label(RichText::new(&error).monospace().color(BAD));
                if ui.button("copy").clicked() {
                    ui.ctx().copy_text(error);
                }
            });
        }
        let until = self.desk.message.as_ref().and_then(|message| message.until);
        if until.is_some_and(|until| until <= self.now) {
            self.desk.message = None;
        }
        ui.horizontal(|ui| {
            let width = ui.available_width();
            let has_message = self.desk.message.is_some();
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                if let Some(message) = &self.desk.message {
                    if let Some(text) = &message.copy
                        && ui.button("copy command").on_hover_text(text).clicked()
                    {
                        ui.ctx().copy_text(text.clone());
                    }
                    ui.add(egui::Label::new(&message.text).truncate());
                    ui.ctx()
                        .request_repaint_after(std::time::Duration::from_millis(500));
                }
                if !has_message || width > 640.0 {
                    ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                        self.facts_line(ui, width)
                    });
                }
            });
        });
    }

    /// The facts about the picture; those of another picture than the one shown are grey.
    fn facts_line(&self, ui: &mut Ui, width: f32) {
        let show: Show = self.look();
        let Tolerance(tolerance) = self.look();
        let is_shown =
            !self.desk.shows_exact && self.desk.left_out.is_none() && show.mode != ViewMode::Wipe;
        let method = match (self.shading(), show.mode) {
            _ if self.desk.shows_exact => "exact Phong in f64".to_owned(),
            _ if self.desk.left_out.is_some() => "without a part, in f64".to_owned(),
            (_, ViewMode::Wipe) => "two pictures".to_owned(),
            (Some(mode), _) => method_name(mode, tolerance),
            (None, _) => format!("mixed within {tolerance}"),
        };
        ui.label(method).on_hover_text("The mode of the cuboids, and the largest error against its exact evaluation, in levels of 255.");
        let fact = |ui: &mut Ui, text: String, is_current: bool, says: &str| {
            let text = RichText::new(text);
            let text = if is_shown && is_current {
                text
            } else {
                text.color(STALE)
            };
            ui.separator();
            ui.label(text).on_hover_text(says);
        };
        if self.shows_times
            && let Some(time) = self.pictures.milliseconds(0)
        {
            let says = "The median time of a warm frame: every system, from the World to the window's pixels.";
            fact(ui, format!("{time:.3} ms"), true, says);
        }
        if width > 400.0 {
            let comparison = &self.facts.comparison;
            let errors = comparison.value.as_ref().and_then(|it| it.errors);
            let text = errors.map_or("error -".to_owned(), |it| {
                format!("off by {} of 255", short(it.max))
            });
            fact(
                ui,
                text,
                comparison.current().is_some(),
                "The largest error of a pixel against exact Phong, in levels of 255.",
            );
        }
        if width > 620.0
            && let Some(proof) = &self.facts.proof.value
        {
            let pixels = proof.proven + proof.refuted + proof.undecided;
            let is_proven = proof.proven == pixels;
            let text = if is_proven {
                "every pixel proven".to_owned()
            } else {
                format!("proven {} of {pixels}", proof.proven)
            };
            let text = RichText::new(text).color(match self.facts.proof.current() {
                None => STALE,
                Some(_) if !is_shown => STALE,
                Some(_) if is_proven => GOOD,
                Some(_) => BAD,
            });
            ui.separator();
            ui.label(text).on_hover_text(
                "Pixels whose error is proven to be within the tolerance, by interval arithmetic.",
            );
        }
    }

    fn help(&mut self, ui: &mut Ui) {
        let modal = Modal::new(Id::new("help")).show(ui.ctx(), |ui| {
            let screen = ui.ctx().content_rect().size();
            ui.set_max_width((screen.x - 40.0).clamp(LEAST_OVER, 640.0));
            ui.horizontal(|ui| {
                ui.heading("Keys");
                ui.weak("H or Esc closes this. Hover anything to learn what it is.");
            });
            ScrollArea::vertical()
                .max_height((screen.y - 90.0).max(LEAST_OVER))
                .show(ui, |ui| {
                    let mut rows: Vec<(&str, &str, Vec<String>)> = Vec::new();
                    for binding in BINDINGS {
                        match rows.iter_mut().find(|(section, says, _)| {
                            (*section, *says) == (binding.section, binding.says)
                        }) {
                            Some((.., keys)) => keys.extend(binding.captions()),
                            None => rows.push((binding.section, binding.says, binding.captions())),
                        }
                    }
                    let sections = ["Lights", "Shading", "Camera", "View", "Scene", "Window"];
                    ui.columns(if screen.x > 600.0 { 2 } else { 1 }, |columns| {
                        for (index, section) in sections.iter().enumerate() {
                            let column = index % columns.len();
                            let ui = &mut columns[column];
                            ui.add_space(6.0);
                            ui.strong(*section);
                            for (_, says, keys) in rows.iter().filter(|(own, ..)| own == section) {
                                ui.horizontal(|ui| {
                                    ui.label(*says);
                                    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                                        ui.weak(keys.join("  "))
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

    fn ask_to_save(&mut self, ui: &mut Ui) {
        Modal::new(Id::new("save?")).show(ui.ctx(), |ui| {
            ui.label(format!(
                "{} has changes that are not saved.",
                self.scene.name
            ));
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

const TOLERANCE: &str = "The largest error of a pixel against the exact evaluation of its mode, in levels of 255. A coarser \
                         tolerance is faster.";

/// A section of the panel that can be folded.
fn section(ui: &mut Ui, title: &str, rows: impl FnOnce(&mut Ui)) {
    CollapsingHeader::new(RichText::new(title).strong())
        .default_open(true)
        .show_unindented(ui, rows);
}

fn scrolled(ui: &mut Ui, content: impl FnOnce(&mut Ui)) {
    ScrollArea::vertical().auto_shrink(false).show(ui, content);
}

/// Lays out a side that has no room beside the picture over it.
fn over(
    ui: &Ui,
    id: &str,
    align: Align2,
    at: egui::Pos2,
    room: egui::Vec2,
    content: impl FnOnce(&mut Ui),
) {
    let area = Area::new(Id::new(id))
        .order(Order::Middle)
        .pivot(align)
        .fixed_pos(at)
        .constrain(false);
    area.show(ui.ctx(), |ui| {
        Frame::side_top_panel(ui.style()).show(ui, |ui| {
            ui.set_width((USUAL - 16.0).min(room.x - 16.0).max(LEAST_OVER));
            ui.set_height((room.y - 8.0).max(0.0));
            content(ui);
        });
    });
}

/// A row of which one is chosen, with its key on the right.
fn choice(ui: &mut Ui, is_chosen: bool, name: &str, command: Command, says: &str) -> Response {
    ui.add(Button::selectable(is_chosen, name).shortcut_text(caption(command)))
        .on_hover_text(says)
}

/// A button with its key on the right.
fn keyed(ui: &mut Ui, name: &str, command: Command, says: &str) -> Response {
    let button = Button::new(name)
        .shortcut_text(caption(command))
        .sense(egui::Sense::click_and_drag());
    ui.add(button).on_hover_text(says)
}

fn keys_of(ui: &mut Ui, keys: &str) {
    ui.weak(keys);
}

/// A number in a few letters.
pub fn short(value: f64) -> String {
    crate::trade::words::short(Some(value))
}

/// Rounded to two significant digits: more is not meant by the movement of a hand.
fn two_digits(value: f64) -> f64 {
    let step = 10.0_f64.powf(value.log10().floor() - 1.0);
    let rounded = (value / step).round() * step;
    format!("{rounded:.6}").parse().unwrap_or(rounded)
}
