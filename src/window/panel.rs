//! The panel on the left: shading, lights, views, camera, scene.
//!
//! It shows widgets for components of the World, and writes their new values.

use egui::{
    Button, CollapsingHeader, ComboBox, Grid, Response, RichText, ScrollArea, Sense, TextWrapMode,
    Ui,
};
use hecs::Entity;

use super::app::App;
use super::inspector::Tab;
use super::keys::{Action, EXACT_SIDES, binding, caption, keys};
use super::widgets::{color_button, number, slider};
use crate::components::range::Strength;
use crate::components::{
    Camera, Light, LightKind, Name, Projection, ShadingMode, Side, ViewMode, Viewer, names, ordered,
};
use crate::drawing::camera_name;
use crate::scene::{BUILT_IN, EXTREMES, LESSONS, Scene};

const TOLERANCE: [&str; 3] = [
    "tolerance",
    "[ ]",
    "The largest error of a pixel against the exact evaluation of its mode, in levels of 255. \
     A coarser tolerance is faster, and 0 is exact.",
];

/// The room of a light's colour, strength and key, in points.
const OF_LIGHT: f32 = 112.0;

const NEW_NAME: &str = "The name of the next new file, without .toml; a path is allowed. \
                        A number is added if the name is taken.";

impl App {
    pub fn panel(&mut self, ui: &mut Ui) {
        self.chart(ui);
        section(ui, "Shading", |ui| self.shading_rows(ui));
        section(ui, "Lights", |ui| self.light_rows(ui));
        section(ui, "View", |ui| self.view_rows(ui));
        section(ui, "Camera", |ui| self.camera_rows(ui));
        section(ui, "Scene", |ui| self.scene_rows(ui));
    }

    /// A button with the name, the key and the sentence of an action, which a click runs.
    pub fn offer(&mut self, ui: &mut Ui, action: Action, is_chosen: bool) {
        if action_button(ui, action, is_chosen).clicked() {
            self.run(action);
        }
    }

    fn shading_rows(&mut self, ui: &mut Ui) {
        let shading = self.method().map(|method| method.mode);
        ui.horizontal_wrapped(|ui| {
            for mode in [ShadingMode::Gouraud, ShadingMode::Phong] {
                self.offer(ui, Action::Shading(mode), shading == Some(mode));
            }
        });
        self.budget_rows(ui);
        if self.viewer().budget.is_some() {
            return;
        }
        let before = self.viewer().tolerance;
        let mut tolerance = before;
        let least = Viewer::LEAST_TOLERANCE;
        slider(ui, TOLERANCE, &mut tolerance, 0.0..=255.0, least);
        if tolerance != before {
            self.set_tolerance(if tolerance < least { 0.0 } else { tolerance });
        }
    }

    fn light_rows(&mut self, ui: &mut Ui) {
        let lights = ordered::<Light>(&self.scene.world);
        if lights.is_empty() {
            ui.weak("The scene has no lights.");
        }
        let rows = |ui: &mut Ui, places: std::ops::Range<usize>| {
            // Long names are cut, so that colour, strength and key keep their room.
            let name = ui.available_width() - OF_LIGHT;
            let grid = Grid::new("lights").num_columns(4).min_col_width(0.0);
            grid.max_col_width(name).show(ui, |ui| {
                ui.style_mut().wrap_mode = Some(TextWrapMode::Truncate);
                for place in places {
                    self.light_row(ui, lights[place], place);
                    ui.end_row();
                }
            });
        };
        let height = ui.spacing().interact_size.y;
        let scroll = ScrollArea::vertical().id_salt("lights").max_height(260.0);
        scroll.show_rows(ui, height, lights.len(), rows);
    }

    fn light_row(&self, ui: &mut Ui, entity: Entity, place: usize) {
        let mut query = self.scene.world.query_one::<(&Name, &mut Light)>(entity);
        let Ok((name, light)) = query.get() else {
            return;
        };
        ui.checkbox(&mut light.on, &name.0)
            .on_hover_text(match light.kind {
                LightKind::Ambient => "Feeds the ambient term, which is the same everywhere.",
                LightKind::Diffuse => "Feeds the diffuse term, max(0, n.l).",
                LightKind::Specular => "Feeds the specular term, max(0, o.r)^shininess.",
            });
        color_button(ui, &mut light.color);
        let says = "Strength of the light, 0 to 1e30.";
        number(ui, &mut light.intensity, Strength::RANGE).on_hover_text(says);
        let is_named = |it: &Action| matches!(it, Action::LightNamed(own) if *own == name.0);
        let named = keys().map(|key| key.2).find(is_named);
        ui.weak(caption(named.unwrap_or(Action::Light(place))));
    }

    fn view_rows(&mut self, ui: &mut Ui) {
        let viewer = Viewer::clone(&self.viewer());
        // Sides that the tags chose belong to none of the buttons.
        let shown = match viewer.show {
            ViewMode::Wipe if viewer.sides == EXACT_SIDES => Some(Action::WipeExact),
            ViewMode::Wipe if viewer.sides != Side::gouraud_phong(viewer.tolerance) => None,
            mode => Some(Action::View(mode)),
        };
        ui.horizontal_wrapped(|ui| {
            for action in [
                Action::View(ViewMode::Picture),
                Action::View(ViewMode::Wipe),
                Action::WipeExact,
                Action::View(ViewMode::Error),
                Action::View(ViewMode::Tiles),
            ] {
                self.offer(ui, action, Some(action) == shown);
            }
            let hold = action_button(ui, Action::Blink, self.desk.blinks.is_some());
            let is_held = hold.is_pointer_button_down_on();
            if is_held || ui.input(|input| input.pointer.any_released()) {
                self.blink_while(is_held);
            }
        });
    }

    fn camera_rows(&mut self, ui: &mut Ui) {
        let world = &self.scene.world;
        let cameras = names::<Camera>(world);
        let mut active = camera_name(world);
        ui.horizontal(|ui| {
            let says = "The camera that is looked through.";
            ui.label("camera").on_hover_text(says);
            let choices = ComboBox::from_id_salt("camera").selected_text(&active);
            choices.show_ui(ui, |ui| {
                for name in cameras {
                    ui.selectable_value(&mut active, name.clone(), name);
                }
            });
            ui.weak(caption(Action::NextCamera));
        });
        self.viewer_mut().camera = Some(active);
        let mut projection = self.viewer().projection;
        ui.horizontal_wrapped(|ui| {
            for each in Projection::ALL {
                ui.selectable_value(&mut projection, each, each.name());
            }
            ui.weak(caption(Action::NextProjection));
        });
        self.viewer_mut().projection = projection;
        let turns = self.viewer().turns;
        ui.horizontal_wrapped(|ui| {
            self.offer(ui, Action::Rotate, turns);
            self.offer(ui, Action::ResetView, false);
        });
    }

    fn scene_rows(&mut self, ui: &mut Ui) {
        let mut chosen = None;
        let scenes = ComboBox::from_id_salt("scene").selected_text(self.scene.name.clone());
        scenes.width(ui.available_width() - 8.0).show_ui(ui, |ui| {
            for (name, _) in BUILT_IN.iter().chain(LESSONS).chain(EXTREMES) {
                if ui
                    .selectable_label(self.scene.name == *name, *name)
                    .clicked()
                {
                    chosen = Some(Scene::load(Some(name)));
                }
            }
        });
        match chosen {
            Some(Ok(scene)) => self.choose(scene),
            Some(Err(error)) => self.say(error.to_string()),
            None => {}
        }
        ui.horizontal(|ui| {
            let label = ui.label("new file").on_hover_text(NEW_NAME).id;
            let field = ui.text_edit_singleline(&mut self.file.new_name);
            field.on_hover_text(NEW_NAME).labelled_by(label);
        });
        ui.horizontal_wrapped(|ui| {
            for action in [
                Action::Tab(Tab::Scene),
                Action::Undo,
                Action::Redo,
                Action::Save,
                Action::SaveAs,
                Action::Help,
            ] {
                self.offer(ui, action, false);
            }
        });
    }
}

/// A button with the name and the key of an action, and its sentence as a tooltip.
fn action_button(ui: &mut Ui, action: Action, is_chosen: bool) -> Response {
    let (name, says) = binding(action).map_or(("", ""), |it| (it.0, it.1));
    let button = Button::selectable(is_chosen, name).shortcut_text(caption(action));
    let button = button.sense(Sense::click_and_drag());
    ui.add(button).on_hover_text(says)
}

/// A section of the panel that can be folded.
fn section(ui: &mut Ui, title: &str, rows: impl FnOnce(&mut Ui)) {
    let header = CollapsingHeader::new(RichText::new(title).strong()).default_open(true);
    header.show_unindented(ui, rows);
}
