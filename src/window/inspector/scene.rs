//! The scene's tab: the keys of an entity's table in the scene file, and entities added and deleted. It edits the scene's
//! record as JSON.

use std::ops::RangeInclusive;

use egui::{Button, ScrollArea, TextEdit, TextStyle, Ui, vec2};
use glam::DVec3;
use serde::Deserialize;
use serde_json::{Value, json};

use crate::components::{LightKind, Viewpoint, active_camera};
use crate::scene::{CameraRecord, LightRecord, SceneRecord};
use crate::window::app::App;
use crate::window::desk::Entity;
use crate::window::widgets::{color_button, number};

/// The kinds of entities, by their keys in a scene file.
const KINDS: [&str; 3] = ["cuboid", "light", "camera"];
/// The keys with three channels that a picker sets.
const COLORS: [&str; 4] = ["ambient", "diffuse", "specular", "color"];
/// The keys of words, with their words.
const CHOICES: [(&str, &[&str]); 2] = [
    ("shading", &["gouraud", "phong"]),
    ("kind", &["ambient", "diffuse", "specular"]),
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

/// A button that was clicked.
enum Clicked {
    Add(&'static str),
    Delete,
}

impl App {
    pub fn scene_tab(&mut self, ui: &mut Ui) {
        // A record can be written as JSON.
        let mut scene = json!(SceneRecord::of(&self.scene.world));
        let entities = entities(&scene);
        let selected = self.desk.selected.take();
        let selected = selected.filter(|it| entities.contains(it));
        let mut selected = selected.unwrap_or_else(|| entities[0].clone());
        entity_list(ui, &entities, &mut selected);
        self.desk.selected = Some(selected.clone());
        let (kind, name) = selected;
        let all = list(&mut scene, kind);
        let place = all.iter().position(|it| it["name"] == name);
        let place = place.unwrap_or_default();
        let clicked = buttons(ui, kind != "light" && all.len() == 1);
        ui.separator();
        let before = [scene[kind][place].clone(), scene["background"].clone()];
        let [mut own, mut background] = before.clone();
        row(ui, "", &mut own);
        ui.separator();
        row(ui, "background", &mut background);
        if kind == "camera" && scene["view"]["camera"] == name {
            scene["view"]["camera"] = match clicked {
                Some(Clicked::Delete) => Value::Null,
                _ => own["name"].clone(),
            };
        }
        let next = match clicked {
            Some(Clicked::Add(added)) => {
                let copied = Some(place).filter(|_| added == kind);
                let name = free_name(added, &entities);
                let new = self.new_entity(added, &name, list(&mut scene, added), copied);
                list(&mut scene, added).push(new);
                Some((added, name))
            }
            Some(Clicked::Delete) => {
                list(&mut scene, kind).remove(place);
                None
            }
            None if [&own, &background] == before.each_ref() => return,
            None => {
                if kind == "light" {
                    place_light(&mut own);
                }
                let name = own["name"].as_str().unwrap_or_default().to_owned();
                scene[kind][place] = own;
                scene["background"] = background;
                Some((kind, name))
            }
        };
        if let Err(error) = self.edit(scene, next) {
            self.say(error.to_string());
        }
    }

    /// Shows an edited scene. One that the scene format does not allow is refused.
    fn edit(&mut self, scene: Value, selected: Option<Entity>) -> anyhow::Result<()> {
        let record: SceneRecord = serde_json::from_value(scene)?;
        record.check()?;
        self.restore(&record);
        self.desk.selected = selected;
        Ok(())
    }

    /// A copy of an entity, or of the last one. A camera is placed where the picture is seen from.
    fn new_entity(&self, kind: &str, name: &str, all: &[Value], copied: Option<usize>) -> Value {
        let world = &self.scene.world;
        let seen = Viewpoint::of(world, active_camera(world));
        let copied = copied.map_or(all.last(), |place| all.get(place));
        let mut new = match (kind, copied) {
            ("camera", _) => {
                let sees = [seen.camera.fov, seen.camera.height];
                json!(CameraRecord {
                    up: seen.camera.up,
                    near: seen.camera.near,
                    ..CameraRecord::new(name, seen.position, seen.camera.target, sees)
                })
            }
            (_, Some(copied)) => copied.clone(),
            _ => json!(LightRecord::new(
                name,
                LightKind::Diffuse,
                100.0,
                seen.position
            )),
        };
        if let (Some(x), Some(size)) = (new["position"][0].as_f64(), new["size"][0].as_f64()) {
            new["position"][0] = json!(x + 1.25 * size);
        }
        new["name"] = json!(name);
        new
    }
}

/// The entities of a kind.
fn list<'a>(scene: &'a mut Value, kind: &str) -> &'a mut Vec<Value> {
    let list = scene[kind].as_array_mut();
    list.expect("a scene has a list of each kind")
}

/// The entities of all kinds, in the order of the file.
fn entities(scene: &Value) -> Vec<Entity> {
    let of_kind = |kind| {
        let all = scene[kind].as_array().into_iter().flatten();
        all.filter_map(move |it| Some((kind, it["name"].as_str()?.to_owned())))
    };
    KINDS.into_iter().flat_map(of_kind).collect()
}

/// A name that no entity of this kind has.
fn free_name(kind: &'static str, entities: &[Entity]) -> String {
    let numbered = (2..).map(|number| format!("{kind} {number}"));
    let mut names = std::iter::once(kind.to_owned()).chain(numbered);
    let name = names.find(|name| !entities.contains(&(kind, name.clone())));
    name.unwrap_or_default()
}

/// An ambient light has no position, and every other light has one.
fn place_light(light: &mut Value) {
    let is_ambient = light["kind"] == "ambient";
    if let Some(table) = light.as_object_mut() {
        if is_ambient {
            table.remove("position");
        } else {
            table.entry("position").or_insert(json!([0.0, 0.0, 0.0]));
        }
    }
}

/// Buttons that add and delete.
fn buttons(ui: &mut Ui, is_last: bool) -> Option<Clicked> {
    let mut clicked = None;
    ui.horizontal_wrapped(|ui| {
        for kind in KINDS {
            let add = ui.small_button(format!("add {kind}"));
            let says = "Adds a copy of the selected one beside it, or of the last. A camera is added where the \
                        picture is seen from now.";
            if add.on_hover_text(says).clicked() {
                clicked = Some(Clicked::Add(kind));
            }
        }
        let delete = ui.add_enabled(!is_last, Button::new("delete").small());
        let says = "A scene has at least one.";
        if delete.on_disabled_hover_text(says).clicked() {
            clicked = Some(Clicked::Delete);
        }
    });
    clicked
}

fn entity_list(ui: &mut Ui, entities: &[Entity], selected: &mut Entity) {
    let height = ui.text_style_height(&TextStyle::Body) + 4.0;
    let scroll = ScrollArea::vertical().id_salt("entities").max_height(150.0);
    scroll.show_rows(ui, height, entities.len(), |ui, rows| {
        for each in &entities[rows] {
            let row = Button::selectable(selected == each, &each.1).shortcut_text(each.0);
            let row = row.min_size(vec2(ui.available_width(), 0.0));
            if ui.add(row).clicked() {
                each.clone_into(selected);
            }
        }
    });
}

/// A row for the value of a key. A table has a row for each of its keys.
fn row(ui: &mut Ui, key: &str, value: &mut Value) {
    if let Value::Object(table) = value {
        table
            .iter_mut()
            .for_each(|(key, value)| row(ui, key, value));
        return;
    }
    ui.horizontal_wrapped(|ui| {
        let says = SAYS.iter().find(|(own, _)| *own == key);
        let says = says.map_or("", |it| it.1);
        let label = ui.label(key).on_hover_text(says);
        ui.add_space((NAMES - label.rect.width()).max(0.0));
        match value {
            Value::Bool(on) => drop(ui.checkbox(on, "")),
            Value::String(text) if key == "name" => name_field(ui, text),
            Value::String(text) => {
                let choices = CHOICES.iter().find(|(own, _)| *own == key);
                for choice in choices.into_iter().flat_map(|it| it.1) {
                    ui.radio_value(text, (*choice).to_owned(), *choice);
                }
            }
            value => {
                if COLORS.contains(&key) {
                    let mut channels = DVec3::deserialize(&*value).unwrap_or_default();
                    ui.spacing_mut().interact_size.x = 24.0;
                    color_button(ui, &mut channels);
                    *value = json!(channels);
                }
                let numbers = match value {
                    Value::Array(numbers) => numbers,
                    one => std::slice::from_mut(one),
                };
                for value in numbers {
                    let mut float = value.as_f64().unwrap_or_default();
                    number(ui, &mut float, ANY).on_hover_text(says);
                    *value = json!(float);
                }
            }
        }
    });
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
