//! The scene's tab: the keys of an entity's table in the scene file, and entities added and deleted.

use std::ops::RangeInclusive;

use egui::{Button, ScrollArea, TextEdit, TextStyle, Ui, vec2};
use glam::DVec3;
use serde::Deserialize;
use serde_json::{Value, json};

use crate::components::{Background, LightKind, Viewpoint, active_camera};
use crate::scene::{CameraRecord, LightRecord, SceneRecord};
use crate::window::app::App;
use crate::window::desk::Kind;
use crate::window::widgets::{color_button, number};

const KINDS: [(Kind, &str); 3] = [
    (Kind::Cuboid, "cuboid"),
    (Kind::Light, "light"),
    (Kind::Camera, "camera"),
];
/// The keys with three channels that a picker sets.
const COLORS: [&str; 4] = ["ambient", "diffuse", "specular", "color"];
/// The keys of words, with a word each.
const CHOICES: [(&str, &str); 5] = [
    ("shading", "gouraud"),
    ("shading", "phong"),
    ("kind", "ambient"),
    ("kind", "diffuse"),
    ("kind", "specular"),
];
/// Ranges are checked when a table is read.
const ANY: RangeInclusive<f64> = f64::MIN..=f64::MAX;
/// The width of a key, in points.
const NAMES: f32 = 66.0;
/// The keys and a sentence about each.
#[rustfmt::skip]
const SAYS: [(&str, &str); 22] = [
    ("background", "Levels of 255 where nothing is drawn."),
    ("name", "Unique among entities of its kind."),
    ("size", "Edge lengths, in world units, 1e-100 to 1e100."),
    ("position", "In world units. The disc of a light in the picture can be dragged, with Shift in depth."),
    ("rotation", "Degrees about the x, y and z axes, in this order."),
    ("shading", "Light is computed at the vertices (gouraud), or at every pixel (phong)."),
    ("ambient", "Reflected share of ambient light, by channel, 0 to 1e30."),
    ("diffuse", "Reflected share of diffuse light, by channel, 0 to 1e30."),
    ("specular", "Reflected share of specular light, by channel, 0 to 1e30."),
    ("shininess", "The exponent of the highlight, 0 to 1e6."),
    ("kind", "The term of the model that the light feeds."),
    ("color", "Share of full strength by channel, 0 to 1e30."),
    ("intensity", "Strength of the light, 0 to 1e30."),
    ("gain", "Levels of 255 for each unit of intensity, 0 to 1e30."),
    ("target", "The point that the camera looks at, in world units."),
    ("up", "The direction that is up in the picture."),
    ("fov", "Vertical field of view in degrees, up to 179; perspective."),
    ("height", "World units seen vertically; orthographic."),
    ("near", "Distance of the near plane; usually a thousandth of the distance to the target."),
    ("azimuth", "Degrees that the camera was moved to the right, -180 to 180."),
    ("elevation", "Degrees that the camera was moved up, -180 to 180."),
    ("zoom", "Factor of the distance and of the height."),
];

impl App {
    pub fn scene_tab(&mut self, ui: &mut Ui) {
        let record = SceneRecord::of(&self.scene.world);
        let names = names(&record);
        let selected = self.desk.selected.take().filter(|it| names.contains(it));
        let mut selected = selected.unwrap_or_else(|| names[0].clone());
        entity_list(ui, &names, &mut selected);
        let own = names.iter().filter(|(kind, _)| *kind == selected.0);
        let place = own.clone().position(|it| *it == selected);
        let is_last = selected.0 != Kind::Light && own.count() == 1;
        self.desk.selected = Some(selected.clone());
        self.entity_buttons(ui, &record, &selected, is_last);
        ui.separator();
        self.entity(ui, record, selected.0, place.unwrap_or_default());
        ui.separator();
        let Background(before) = self.look();
        let mut background = json!({ "background": before });
        rows(ui, &mut background);
        let levels = DVec3::deserialize(&background["background"]).unwrap_or(before);
        let levels = levels.clamp(DVec3::ZERO, DVec3::splat(255.0));
        if levels != before {
            self.set_look(Background(levels));
        }
    }

    /// Buttons that add and delete.
    fn entity_buttons(
        &mut self,
        ui: &mut Ui,
        record: &SceneRecord,
        selected: &(Kind, String),
        is_last: bool,
    ) {
        ui.horizontal_wrapped(|ui| {
            for (kind, name) in KINDS {
                let add = ui.small_button(format!("add {name}"));
                let says = "Adds a copy of the selected one beside it, or of the last. A camera is added where the \
                            picture is seen from now.";
                if add.on_hover_text(says).clicked() {
                    self.add(kind, name, record.clone(), selected);
                }
            }
            let delete = ui.add_enabled(!is_last, Button::new("delete").small());
            let says = "A scene has at least one.";
            if delete.on_disabled_hover_text(says).clicked() {
                self.delete(record.clone(), selected);
            }
        });
    }

    fn add(&mut self, kind: Kind, noun: &str, mut record: SceneRecord, selected: &(Kind, String)) {
        let names = names(&record);
        let numbered = (2..).map(|number| format!("{noun} {number}"));
        let mut free = std::iter::once(noun.to_owned()).chain(numbered);
        let name = free.find(|name| !names.contains(&(kind, name.clone())));
        let name = name.unwrap_or_default();
        let mut own = names.iter().filter(|(own, _)| *own == kind);
        let place = own.position(|it| it == selected);
        let world = &self.scene.world;
        let seen = Viewpoint::of(world, active_camera(world));
        match kind {
            Kind::Cuboid => {
                let copied = &record.cuboid[place.unwrap_or(record.cuboid.len() - 1)];
                let mut copy = copied.clone();
                copy.position.x += 1.25 * copy.size.x;
                copy.name.clone_from(&name);
                record.cuboid.push(copy);
            }
            Kind::Light => {
                let copied = place.map_or(record.light.last(), |place| record.light.get(place));
                let new = || LightRecord::new("", LightKind::Diffuse, 100.0, seen.position);
                let copy = copied.cloned().unwrap_or_else(new);
                let name = name.clone();
                record.light.push(LightRecord { name, ..copy });
            }
            Kind::Camera => {
                let sees = [seen.camera.fov, seen.camera.height];
                let camera = CameraRecord::new(&name, seen.position, seen.camera.target, sees);
                record.camera.push(CameraRecord {
                    up: seen.camera.up,
                    near: seen.camera.near,
                    ..camera
                });
            }
        }
        self.restore(&record);
        self.desk.selected = Some((kind, name));
    }

    fn delete(&mut self, mut record: SceneRecord, (kind, name): &(Kind, String)) {
        match kind {
            Kind::Cuboid => record.cuboid.retain(|it| it.name != *name),
            Kind::Light => record.light.retain(|it| it.name != *name),
            Kind::Camera => {
                record.camera.retain(|it| it.name != *name);
                record.view.camera.take_if(|camera| camera == name);
            }
        }
        self.restore(&record);
        self.desk.selected = None;
    }

    /// The keys of an entity. A value that the scene format does not allow is refused.
    fn entity(&mut self, ui: &mut Ui, mut record: SceneRecord, kind: Kind, place: usize) {
        let table = match kind {
            Kind::Cuboid => serde_json::to_value(&record.cuboid[place]),
            Kind::Light => serde_json::to_value(&record.light[place]),
            Kind::Camera => serde_json::to_value(&record.camera[place]),
        };
        // Records can be written as JSON.
        let before = table.unwrap_or_default();
        let mut table = before.clone();
        rows(ui, &mut table);
        if table == before {
            return;
        }
        match edit(&mut record, kind, place, table) {
            Ok(name) => {
                self.desk.selected = Some((kind, name));
                self.restore(&record);
            }
            Err(error) => self.say(error.to_string()),
        }
    }
}

/// Overwrites an entity, and returns its name.
fn edit(
    record: &mut SceneRecord,
    kind: Kind,
    place: usize,
    table: Value,
) -> anyhow::Result<String> {
    let name = table["name"].as_str().unwrap_or_default().to_owned();
    match kind {
        Kind::Cuboid => record.cuboid[place] = serde_json::from_value(table)?,
        Kind::Light => {
            let mut light: LightRecord = serde_json::from_value(table)?;
            let has_place = light.kind != LightKind::Ambient;
            light.position = has_place.then(|| light.position.unwrap_or_default());
            record.light[place] = light;
        }
        Kind::Camera => {
            let before = &record.camera[place].name;
            if let Some(active) = record.view.camera.as_mut().filter(|it| *it == before) {
                active.clone_from(&name);
            }
            record.camera[place] = serde_json::from_value(table)?;
        }
    }
    record.check()?;
    Ok(name)
}

/// The kinds and names of all entities, in the order of the file.
fn names(record: &SceneRecord) -> Vec<(Kind, String)> {
    let cuboids = record.cuboid.iter().map(|it| (Kind::Cuboid, &it.name));
    let lights = record.light.iter().map(|it| (Kind::Light, &it.name));
    let cameras = record.camera.iter().map(|it| (Kind::Camera, &it.name));
    let all = cuboids.chain(lights).chain(cameras);
    all.map(|(kind, name)| (kind, name.clone())).collect()
}

fn entity_list(ui: &mut Ui, names: &[(Kind, String)], selected: &mut (Kind, String)) {
    let height = ui.text_style_height(&TextStyle::Body) + 4.0;
    let scroll = ScrollArea::vertical().id_salt("entities").max_height(150.0);
    scroll.show_rows(ui, height, names.len(), |ui, rows| {
        for each in &names[rows] {
            let noun = KINDS.iter().find(|(kind, _)| *kind == each.0);
            let row = Button::selectable(selected == each, &each.1);
            let row = row.shortcut_text(noun.map_or("", |it| it.1));
            let row = row.min_size(vec2(ui.available_width(), 0.0));
            if ui.add(row).clicked() {
                each.clone_into(selected);
            }
        }
    });
}

/// A row for each key of a table, and for those of the tables in it.
fn rows(ui: &mut Ui, table: &mut Value) {
    for (key, value) in table.as_object_mut().into_iter().flatten() {
        if value.is_object() {
            rows(ui, value);
            continue;
        }
        ui.horizontal_wrapped(|ui| {
            let says = SAYS
                .iter()
                .find(|(own, _)| own == key)
                .map_or("", |it| it.1);
            let label = ui.label(key).on_hover_text(says);
            ui.add_space((NAMES - label.rect.width()).max(0.0));
            match value {
                Value::Bool(on) => drop(ui.checkbox(on, "")),
                Value::String(text) if key == "name" => name_field(ui, text),
                Value::String(text) => {
                    for (_, choice) in CHOICES.iter().filter(|(own, _)| own == key) {
                        ui.radio_value(text, (*choice).to_owned(), *choice);
                    }
                }
                Value::Number(_) => {
                    let before = value.as_f64().unwrap_or_default();
                    let mut after = before;
                    number(ui, &mut after, ANY).on_hover_text(says);
                    if after != before {
                        *value = json!(after);
                    }
                }
                _ => {
                    let before = DVec3::deserialize(&*value).unwrap_or_default();
                    let mut after = before;
                    if COLORS.contains(&key.as_str()) {
                        ui.spacing_mut().interact_size.x = 24.0;
                        color_button(ui, &mut after);
                    }
                    for axis in 0..3 {
                        number(ui, &mut after[axis], ANY).on_hover_text(says);
                    }
                    if after != before {
                        *value = json!(after);
                    }
                }
            }
        });
    }
}

/// The field of a name, which is taken once the field has lost the focus.
fn name_field(ui: &mut Ui, name: &mut String) {
    let id = ui.id().with(("name", &*name));
    let typed = ui.data_mut(|data| data.remove_temp::<String>(id));
    let mut typed = typed.unwrap_or_else(|| name.clone());
    let field = ui.add(TextEdit::singleline(&mut typed).desired_width(140.0));
    if field.lost_focus() {
        *name = typed;
    } else {
        ui.data_mut(|data| data.insert_temp(id, typed));
    }
}
