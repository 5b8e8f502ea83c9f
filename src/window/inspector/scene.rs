//! The scene's tab: every number of every entity, and entities added, duplicated and deleted.

use std::ops::RangeInclusive;

use egui::{Button, ComboBox, DragValue, Grid, Response, ScrollArea, Slider, TextEdit, Ui};
use glam::DVec3;
use hecs::Entity;

use super::color_button;
use crate::components::{
    Background, Camera, Light, LightKind, Material, Mesh, Name, Orbit, ShadingMode, Transform,
    names, ordered,
};
use crate::scene::{CameraRecord, CuboidRecord, LightRecord, SceneRecord, range};
use crate::window::app::App;

/// The kinds of entities that a scene holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Cuboid,
    Light,
    Camera,
}

impl App {
    pub fn scene_tab(&mut self, ui: &mut Ui) {
        self.entity_list(ui);
        self.entity_buttons(ui);
        ui.separator();
        if let Some((kind, name)) = self.desk.selected.clone()
            && let Some(entity) = self.find(kind, &name)
        {
            self.name_row(ui, kind, entity, name);
            match kind {
                Kind::Cuboid => self.cuboid_rows(ui, entity),
                Kind::Light => self.light_numbers(ui, entity),
                Kind::Camera => self.camera_numbers(ui, entity),
            }
        }
        ui.separator();
        let Background(mut levels) = self.look();
        let before = levels;
        Grid::new("background").show(ui, |ui| {
            vector(
                ui,
                "background",
                &mut levels,
                range::LEVEL,
                "Levels where nothing is drawn",
            )
        });
        if levels != before {
            self.set_look(Background(levels));
        }
    }

    fn named(&self) -> Vec<(Kind, String)> {
        let world = &self.scene.world;
        let of = |kind, names: Vec<String>| names.into_iter().map(move |name| (kind, name));
        let cuboids = of(Kind::Cuboid, names::<Mesh>(world));
        let lights = of(Kind::Light, names::<Light>(world));
        cuboids
            .chain(lights)
            .chain(of(Kind::Camera, names::<Camera>(world)))
            .collect()
    }

    fn find(&self, kind: Kind, name: &str) -> Option<Entity> {
        let world = &self.scene.world;
        let entities = match kind {
            Kind::Cuboid => ordered::<Mesh>(world),
            Kind::Light => ordered::<Light>(world),
            Kind::Camera => ordered::<Camera>(world),
        };
        entities
            .into_iter()
            .find(|entity| world.get::<&Name>(*entity).is_ok_and(|own| own.0 == name))
    }

    fn entity_list(&mut self, ui: &mut Ui) {
        let all = self.named();
        if self.desk.selected.is_none() {
            self.desk.selected = all.first().cloned();
        }
        let height = ui.text_style_height(&egui::TextStyle::Body) + 4.0;
        let scroll = ScrollArea::vertical().id_salt("entities").max_height(150.0);
        scroll.show_rows(ui, height, all.len(), |ui, rows| {
            for each in &all[rows] {
                let (kind, name) = each;
                let is_chosen = self.desk.selected.as_ref() == Some(each);
                let kind = match kind {
                    Kind::Cuboid => "cuboid",
                    Kind::Light => "light",
                    Kind::Camera => "camera",
                };
                let row = Button::selectable(is_chosen, name)
                    .shortcut_text(kind)
                    .min_size(egui::vec2(ui.available_width(), 0.0));
                if ui.add(row).clicked() {
                    self.desk.selected = Some(each.clone());
                }
            }
        });
    }

    /// Buttons that add, duplicate and delete; they write a record, from which the World is spawned.
    fn entity_buttons(&mut self, ui: &mut Ui) {
        let mut record = SceneRecord::of(&self.scene.world);
        let selected = self.desk.selected.clone();
        let mut added = None;
        ui.horizontal_wrapped(|ui| {
            ui.weak("add");
            if ui.small_button("cuboid").clicked() {
                let name = unused("cuboid", record.cuboid.iter().map(|it| &it.name));
                record
                    .cuboid
                    .push(CuboidRecord::new(&name, [1.0; 3], record.camera[0].target));
                added = Some((Kind::Cuboid, name));
            }
            if ui.small_button("light").clicked() {
                let name = unused("light", record.light.iter().map(|it| &it.name));
                let position = record.camera[0].position;
                record
                    .light
                    .push(LightRecord::new(&name, LightKind::Diffuse, 100.0, position));
                added = Some((Kind::Light, name));
            }
            if ui.small_button("camera").clicked() {
                let mut camera: CameraRecord = record.camera[0].clone();
                camera.name = unused("camera", record.camera.iter().map(|it| &it.name));
                added = Some((Kind::Camera, camera.name.clone()));
                record.camera.push(camera);
            }
            let Some((kind, name)) = selected else {
                return;
            };
            if ui
                .small_button("duplicate")
                .on_hover_text("Adds a copy of the selected entity.")
                .clicked()
            {
                let copy = duplicate(&mut record, kind, &name);
                added = copy.map(|copy| (kind, copy));
            }
            let is_last = match kind {
                Kind::Cuboid => record.cuboid.len() == 1,
                Kind::Light => false,
                Kind::Camera => record.camera.len() == 1,
            };
            let delete = ui.add_enabled(!is_last, Button::new("delete").small());
            if delete
                .on_disabled_hover_text("A scene has at least one.")
                .clicked()
            {
                record
                    .cuboid
                    .retain(|it| kind != Kind::Cuboid || it.name != name);
                record
                    .light
                    .retain(|it| kind != Kind::Light || it.name != name);
                record
                    .camera
                    .retain(|it| kind != Kind::Camera || it.name != name);
                if record.view.camera.as_ref() == Some(&name) && kind == Kind::Camera {
                    record.view.camera = None;
                }
                self.desk.selected = None;
                self.restore(&record);
            }
        });
        if let Some(added) = added {
            self.restore(&record);
            self.desk.selected = Some(added);
        }
    }

    fn name_row(&mut self, ui: &mut Ui, kind: Kind, entity: Entity, name: String) {
        ui.horizontal(|ui| {
            ui.label("name")
                .on_hover_text("Unique among entities of its kind.");
            let id = ui.id().with(("name", &name));
            let mut text = ui
                .data_mut(|data| data.get_temp::<String>(id))
                .unwrap_or_else(|| name.clone());
            let field = ui.add(TextEdit::singleline(&mut text).desired_width(140.0));
            if field.lost_focus() {
                ui.data_mut(|data| data.remove::<String>(id));
                self.rename(kind, entity, text);
            } else {
                ui.data_mut(|data| data.insert_temp(id, text));
            }
        });
    }

    fn rename(&mut self, kind: Kind, entity: Entity, name: String) {
        if self
            .scene
            .world
            .get::<&Name>(entity)
            .is_ok_and(|own| own.0 == name)
        {
            return;
        }
        let is_free = self.find(kind, &name).is_none();
        let is_name = !name.is_empty()
            && (kind != Kind::Light || !name.contains(',') && name != "all" && name != "none");
        if !is_free || !is_name {
            return self.say(format!("{name:?} cannot be the name: it is empty, taken, or cannot be written in a list of lights"));
        }
        // The entity was just found.
        let _ = self.scene.world.insert_one(entity, Name(name.clone()));
        self.desk.selected = Some((kind, name));
    }

    fn cuboid_rows(&mut self, ui: &mut Ui, entity: Entity) {
        let mut query =
            self.scene
                .world
                .query_one::<(&mut Transform, &mut Mesh, &mut Material, &mut ShadingMode)>(entity);
        let Ok((transform, mesh, material, mode)) = query.get() else {
            return;
        };
        let mut size = mesh.size();
        Grid::new("cuboid").num_columns(4).show(ui, |ui| {
            vector(
                ui,
                "size",
                &mut size,
                range::LENGTH,
                "Edge lengths, in world units",
            );
            vector(
                ui,
                "position",
                &mut transform.position,
                range::COORDINATE,
                "Centre, in world units",
            );
            vector(
                ui,
                "rotation",
                &mut transform.rotation,
                range::ANGLE,
                "Degrees about the x, y and z axes, in this order",
            );
        });
        if size != mesh.size() {
            *mesh = Mesh::cuboid(size);
        }
        ui.horizontal(|ui| {
            ui.label("shading");
            ui.selectable_value(mode, ShadingMode::Gouraud, "Gouraud");
            ui.selectable_value(mode, ShadingMode::Phong, "Phong");
        });
        Grid::new("material").num_columns(5).show(ui, |ui| {
            coefficients(
                ui,
                "ambient",
                &mut material.ambient,
                "Reflected share of ambient light",
            );
            coefficients(
                ui,
                "diffuse",
                &mut material.diffuse,
                "Reflected share of diffuse light",
            );
            coefficients(
                ui,
                "specular",
                &mut material.specular,
                "Reflected share of specular light",
            );
        });
        ui.horizontal(|ui| {
            ui.label("shininess");
            let before = material.shininess;
            let slider = Slider::new(&mut material.shininess, range::SHININESS)
                .logarithmic(true)
                .smallest_positive(0.1);
            ui.add(slider.custom_formatter(format_number))
                .on_hover_text("The exponent of the highlight, 0 to 1e6.");
            if format_number(material.shininess, 0..=0) == format_number(before, 0..=0) {
                material.shininess = before;
            }
        });
    }

    fn light_numbers(&mut self, ui: &mut Ui, entity: Entity) {
        let mut query = self
            .scene
            .world
            .query_one::<(&mut Transform, &mut Light)>(entity);
        let Ok((transform, light)) = query.get() else {
            return;
        };
        ui.horizontal(|ui| {
            ui.checkbox(&mut light.on, "on");
            ComboBox::from_id_salt("kind")
                .selected_text(light.kind.name())
                .show_ui(ui, |ui| {
                    for kind in LightKind::ALL {
                        ui.selectable_value(&mut light.kind, kind, kind.name());
                    }
                });
        });
        Grid::new("light").num_columns(5).show(ui, |ui| {
            coefficients(
                ui,
                "color",
                &mut light.color,
                "Share of full strength by channel",
            );
            labelled(
                ui,
                "intensity",
                &mut light.intensity,
                range::STRENGTH,
                "Strength of the light",
            );
            labelled(
                ui,
                "gain",
                &mut light.gain,
                range::STRENGTH,
                "Levels of 255 for each unit of intensity",
            );
        });
        if light.kind != LightKind::Ambient {
            Grid::new("place").num_columns(4).show(ui, |ui| {
                vector(
                    ui,
                    "position",
                    &mut transform.position,
                    range::COORDINATE,
                    "World units; the disc in the picture can be dragged, with Shift in depth",
                );
            });
        }
    }

    fn camera_numbers(&mut self, ui: &mut Ui, entity: Entity) {
        let mut query = self
            .scene
            .world
            .query_one::<(&mut Transform, &mut Camera, &mut Orbit)>(entity);
        let Ok((transform, camera, orbit)) = query.get() else {
            return;
        };
        Grid::new("camera").num_columns(4).show(ui, |ui| {
            vector(
                ui,
                "position",
                &mut transform.position,
                range::COORDINATE,
                "The eye, in world units",
            );
            vector(
                ui,
                "target",
                &mut camera.target,
                range::COORDINATE,
                "The point it looks at, in world units",
            );
            vector(
                ui,
                "up",
                &mut camera.up,
                range::COORDINATE,
                "The direction that is up in the picture",
            );
            labelled(
                ui,
                "fov",
                &mut camera.fov,
                range::FIELD_OF_VIEW,
                "Vertical field of view in degrees; perspective",
            );
            labelled(
                ui,
                "height",
                &mut camera.height,
                range::LENGTH,
                "World units seen vertically; orthographic",
            );
            let mut has_near = camera.near.is_some();
            let says =
                "Distance of the near plane; else a thousandth of the distance to the target";
            ui.checkbox(&mut has_near, "near").on_hover_text(says);
            let own = camera
                .near
                .unwrap_or_else(|| camera.near_from(transform.position));
            camera.near = has_near.then_some(own);
            if let Some(near) = &mut camera.near {
                number(ui, near, range::LENGTH, says);
            }
            ui.end_row();
            labelled(
                ui,
                "azimuth",
                &mut orbit.azimuth,
                range::ORBIT,
                "Degrees that the camera was moved to the right",
            );
            labelled(
                ui,
                "elevation",
                &mut orbit.elevation,
                range::ORBIT,
                "Degrees that the camera was moved up",
            );
            labelled(
                ui,
                "zoom",
                &mut orbit.zoom,
                1e-3..=1e3,
                "Factor of the distance and of the height",
            );
        });
    }
}

/// Adds a copy of an entity, a cuboid beside itself; returns its name.
fn duplicate(record: &mut SceneRecord, kind: Kind, name: &str) -> Option<String> {
    match kind {
        Kind::Cuboid => {
            let mut copy = record.cuboid.iter().find(|it| it.name == name)?.clone();
            copy.name = unused(name, record.cuboid.iter().map(|it| &it.name));
            copy.position.x += 1.25 * copy.size.x;
            record.cuboid.push(copy);
            record.cuboid.last().map(|it| it.name.clone())
        }
        Kind::Light => {
            let mut copy = record.light.iter().find(|it| it.name == name)?.clone();
            copy.name = unused(name, record.light.iter().map(|it| &it.name));
            record.light.push(copy);
            record.light.last().map(|it| it.name.clone())
        }
        Kind::Camera => {
            let mut copy = record.camera.iter().find(|it| it.name == name)?.clone();
            copy.name = unused(name, record.camera.iter().map(|it| &it.name));
            record.camera.push(copy);
            record.camera.last().map(|it| it.name.clone())
        }
    }
}

/// `stem`, or the first of `stem 2`, `stem 3`, ... that no entity has.
fn unused<'a>(stem: &str, names: impl Iterator<Item = &'a String> + Clone) -> String {
    let candidates = (2..).map(|number| format!("{stem} {number}"));
    let mut candidates = std::iter::once(stem.to_owned()).chain(candidates);
    let is_free = |name: &String| names.clone().all(|taken| taken != name);
    candidates.find(is_free).unwrap_or_default()
}

/// A number that is dragged, or clicked and typed.
fn number(ui: &mut Ui, value: &mut f64, range: RangeInclusive<f64>, says: &str) -> Response {
    let (least, most) = (
        format_number(*range.start(), 0..=0),
        format_number(*range.end(), 0..=0),
    );
    let before = *value;
    // A drag changes a number by its own size, so that it reaches any magnitude.
    let speed = (value.abs() * 0.01).max(0.01);
    let drag = DragValue::new(value)
        .speed(speed)
        .range(range)
        .custom_formatter(format_number);
    let response = ui.add(drag).on_hover_text(format!(
        "{says}.\nDrag it, or click and type a number, {least} to {most}."
    ));
    // A number that was looked at is written back with the digits that are shown.
    if format_number(*value, 0..=0) == format_number(before, 0..=0) {
        *value = before;
    }
    response
}

fn labelled(ui: &mut Ui, name: &str, value: &mut f64, range: RangeInclusive<f64>, says: &str) {
    ui.label(name).on_hover_text(says);
    number(ui, value, range, says);
    ui.end_row();
}

fn vector(ui: &mut Ui, name: &str, value: &mut DVec3, range: RangeInclusive<f64>, says: &str) {
    ui.label(name).on_hover_text(says);
    for axis in 0..3 {
        number(ui, &mut value[axis], range.clone(), says);
    }
    ui.end_row();
}

fn coefficients(ui: &mut Ui, name: &str, value: &mut DVec3, says: &str) {
    ui.label(name).on_hover_text(says);
    for axis in 0..3 {
        number(ui, &mut value[axis], range::STRENGTH, says);
    }
    color_button(ui, value);
    ui.end_row();
}

/// Six significant digits at most, with an exponent where the number is very large or small.
fn format_number(value: f64, _: RangeInclusive<usize>) -> String {
    let rounded: f64 = format!("{value:.5e}").parse().unwrap_or(value);
    match rounded.abs() {
        0.0 => "0".to_owned(),
        1e-3..1e6 => rounded.to_string(),
        _ => format!("{rounded:e}"),
    }
}
