//! The scene's tab: the list of entities, and a field for each key of the selected one in the scene file. It edits the
//! scene's record as TOML.

use std::ops::RangeInclusive;
use std::sync::Arc;

use egui::{Button, Grid, ScrollArea, TextEdit, TextStyle, Ui, vec2};
use glam::DVec3;
use hecs::{Component, World};
use toml::Value;

use crate::components::{names, range};
use crate::scene::SceneRecord;
use crate::scene::key::{Key, tree};
use crate::window::canvas::Canvas;
use crate::window::controls::step_back;
use crate::window::desk::{Desk, EntityPlace};
use crate::window::document::Document;
use crate::window::widgets::{color_button, number, vary_button};

/// The keys that have a colour picker.
const COLORS: [&str; 4] = ["ambient", "diffuse", "specular", "color"];
/// The keys whose value is one of these words.
const CHOICES: [(&str, &[&str]); 3] = [
    ("shading", &["flat", "gouraud", "phong"]),
    ("normals", &["corner", "face"]),
    ("kind", &["ambient", "diffuse", "specular"]),
];
/// In a narrower tab the letters are small, in points.
const NARROW: f32 = 240.0;
/// A typed number is checked when the edited record is read, whose message names the range.
pub const ANY: RangeInclusive<f64> = f64::MIN..=f64::MAX;

/// Lays out the tab. An edit replaces the World.
pub fn tab(ui: &mut Ui, document: &mut Document, canvas: &mut Canvas, desk: &mut Desk) {
    // The three numbers of a colour fit into a narrow inspector.
    let spacing = ui.spacing_mut();
    spacing.interact_size.x = 16.0;
    (spacing.item_spacing.x, spacing.button_padding.x) = (3.0, 1.0);
    if ui.available_width() < NARROW {
        ui.style_mut().override_text_style = Some(TextStyle::Small);
        ui.style_mut().drag_value_text_style = TextStyle::Small;
    }
    let record = Arc::clone(&document.state);
    let count = |kind: &str| names_of(&record, kind).len();
    // Undo and a new file may leave fewer entities, and no lights.
    let selected = desk.selected.filter(|it| count(it.0) > 0);
    let mut selected = selected.unwrap_or(("cuboid", 0));
    selected.1 = selected.1.min(count(selected.0) - 1);
    let known = selected;
    let can_delete = selected.0 == "light" || count(selected.0) > 1;
    let buttons = ui.horizontal(|ui| {
        let copy = ui.small_button("copy");
        let delete = ui.add_enabled(can_delete, Button::new("delete").small());
        let delete = delete.on_disabled_hover_text("A scene needs one.");
        let [cuboid, light] = ["new cuboid", "new light"].map(|name| ui.small_button(name));
        [copy, delete, cuboid, light].map(|button| button.clicked())
    });
    let [copies, deletes, adds_cuboid, adds_light] = buttons.inner;
    entity_list(ui, &record, &mut selected);
    ui.separator();
    let (kind, mut place) = selected;
    let before = [entity(&record, selected), tree(&record.background)];
    let [mut own, mut background] = before.clone();
    let name = own["name"].clone();
    let key = Key::from(kind).child(name.as_str().unwrap_or_default());
    let mut varied = None;
    Grid::new("table").show(ui, |ui| row(ui, &key, &mut own, &record, &mut varied));
    if kind == "light" {
        place_light(&mut own);
    }
    ui.separator();
    let key = Key::from("background");
    Grid::new("scene").show(ui, |ui| {
        row(ui, &key, &mut background, &record, &mut varied);
    });
    if let Some(key) = varied {
        desk.vary(key, &record);
    }
    let adds = copies || adds_cuboid || adds_light;
    if adds || deletes || [&own, &background] != [&before[0], &before[1]] {
        // With the changes of this layout.
        let mut edited = SceneRecord::of(&document.scene.world);
        let camera = &mut edited.view.camera;
        if kind == "camera" && camera.as_deref() == name.as_str() {
            *camera = own["name"].as_str().filter(|_| !deletes).map(str::to_owned);
        }
        let mut scene = tree(&edited);
        scene["background"] = background;
        if let Some(all) = scene[kind].as_array_mut() {
            all[place] = own;
            if copies {
                all.push(copy(kind, all, &all[place]));
                place = all.len() - 1;
            }
            if deletes {
                all.remove(place);
                place = place.min(all.len().saturating_sub(1));
            }
        }
        selected = (kind, place);
        if adds_light && let Some(lights) = scene["light"].as_array_mut() {
            selected = ("light", lights.len());
            lights.push(copy("light", lights, &new_light()));
        }
        if adds_cuboid && let Some(cuboids) = scene["cuboid"].as_array_mut() {
            selected = ("cuboid", cuboids.len());
            let mut new = copy("cuboid", cuboids, &cuboids[cuboids.len() - 1]);
            new["size"] = tree(&DVec3::ONE);
            cuboids.push(new);
        }
        match SceneRecord::from_tree(scene) {
            Ok(record) => {
                document.restore(&record);
                desk.message = None;
                if adds {
                    // What was added comes in sight.
                    canvas.fit_again();
                    step_back(&mut document.scene.world, canvas.wide_size());
                }
            }
            // A drag passes numbers that go together with others no longer, such as an `up` along the view.
            Err(_) if ui.ctx().dragged_id().is_some() => {}
            Err(error) => desk.say(error.to_string()),
        }
    }
    // After an undo the last entity may stand for one that a redo brings back.
    if selected != known {
        desk.selected = Some(selected);
    }
}

impl Desk {
    /// Selects the entity of a kind, in scene files `key`, that has this name.
    pub fn select<C: Component>(&mut self, world: &World, key: &'static str, name: &str) {
        let names = names::<C>(world);
        let place = names.iter().position(|own| own == name);
        self.selected = place.map(|place| (key, place)).or(self.selected);
    }
}

/// The names of the entities of a kind, in the order of the file.
fn names_of<'a>(
    record: &'a SceneRecord,
    kind: &str,
) -> Box<dyn ExactSizeIterator<Item = &'a str> + 'a> {
    match kind {
        "cuboid" => Box::new(record.cuboid.iter().map(|it| &*it.name)),
        "light" => Box::new(record.light.iter().map(|it| &*it.name)),
        _ => Box::new(record.camera.iter().map(|it| &*it.name)),
    }
}

/// An entity as TOML.
fn entity(record: &SceneRecord, (kind, place): EntityPlace) -> Value {
    match kind {
        "cuboid" => tree(&record.cuboid[place]),
        "light" => tree(&record.light[place]),
        _ => tree(&record.camera[place]),
    }
}

/// The original of new lights, with the keys that have no default. A copy has a name.
fn new_light() -> Value {
    Value::Table(toml::toml! {
        name = ""
        kind = "diffuse"
        color = [1.0, 1.0, 1.0]
        intensity = 100.0
        position = [10.0, 10.0, 10.0]
    })
}

/// A copy of an entity with a free name, beside it: a cuboid is moved along x by five quarters of its width, a light by a tenth
/// of its distance from the origin.
fn copy(kind: &str, all: &[Value], original: &Value) -> Value {
    let mut copy = original.clone();
    let vector = |key| copy.get(key)?.clone().try_into::<DVec3>().ok();
    let [position, size] = ["position", "size"].map(vector);
    if kind != "camera"
        && let Some(position) = position
    {
        let beside = |size: DVec3| DVec3::X * (size.x * 1.25);
        copy["position"] = tree(&(position + size.map_or(position / 10.0, beside)));
    }
    let mut names = (all.len() + 1..).map(|number| format!("{kind} {number}"));
    let is_free = |name: &String| all.iter().all(|it| it["name"].as_str() != Some(name));
    copy["name"] = names.find(is_free).unwrap_or_default().into();
    copy
}

/// An ambient light has no position, and every other light has one.
fn place_light(light: &mut Value) {
    let is_ambient = light["kind"].as_str() == Some("ambient");
    if let Some(table) = light.as_table_mut() {
        if is_ambient {
            table.remove("position");
        } else {
            table.entry("position").or_insert(tree(&DVec3::ZERO));
        }
    }
}

/// The names of the entities of all kinds, in the order of the file.
fn entity_list(ui: &mut Ui, record: &SceneRecord, selected: &mut EntityPlace) {
    let of_kind = |kind: &'static str| {
        let places = (0..).map(move |place| (kind, place));
        places.zip(names_of(record, kind))
    };
    let kinds = ["cuboid", "light", "camera"];
    let entities = || kinds.into_iter().flat_map(of_kind);
    let count = kinds.map(|kind| names_of(record, kind).len()).iter().sum();
    let height = ui.text_style_height(&TextStyle::Body) + 4.0;
    // The keys of an entity stay in sight below.
    let most = (ui.ctx().content_rect().height() - 420.0).max(150.0);
    let mut scroll = ScrollArea::vertical().id_salt("entities").max_height(most);
    // An entity that was selected elsewhere comes in sight.
    let id = ui.id().with("selected");
    if ui.data(|data| data.get_temp(id)) != Some(*selected) {
        let above = entities().take_while(|(place, _)| place != selected);
        let above = above.count() as f32 * (height + ui.spacing().item_spacing.y);
        scroll = scroll.vertical_scroll_offset((above - most / 2.0).max(0.0));
    }
    scroll.show_rows(ui, height, count, |ui, rows| {
        for (place, name) in entities().skip(rows.start).take(rows.len()) {
            let row = Button::selectable(*selected == place, name).shortcut_text(place.0);
            let row = row.min_size(vec2(ui.available_width(), 0.0));
            if ui.add(row).clicked() {
                *selected = place;
            }
        }
    });
    ui.data_mut(|data| data.insert_temp(id, *selected));
}

/// A row for the value of a key. A table has a row for each of its keys. `varied` is the number whose button is clicked.
fn row(ui: &mut Ui, key: &Key, value: &mut Value, record: &SceneRecord, varied: &mut Option<Key>) {
    if let Value::Table(table) = value {
        return table
            .iter_mut()
            .for_each(|(name, value)| row(ui, &key.child(name), value, record, varied));
    }
    ui.horizontal(|ui| {
        ui.label(key.last()).on_hover_ui(|ui| {
            ui.label(key.comment().unwrap_or_default());
            ui.weak(key.range(record).unwrap_or_default());
        });
        if COLORS.contains(&key.last()) && value.is_array() {
            let mut color = value.clone().try_into::<DVec3>().unwrap_or_default();
            color_button(ui, &mut color);
            *value = tree(&color);
        }
    });
    let names = key.names(value);
    ui.horizontal(|ui| match value {
        Value::Boolean(on) => drop(ui.checkbox(on, "")),
        Value::String(name) if key.last() == "name" => name_field(ui, name),
        Value::String(text) => {
            let choices = CHOICES.iter().find(|(own, _)| *own == key.last());
            for choice in choices.into_iter().flat_map(|it| it.1) {
                ui.selectable_value(text, (*choice).to_owned(), *choice);
            }
        }
        Value::Array(numbers) => {
            for (number, name) in numbers.iter_mut().zip(names) {
                let letter = Button::new(&name).small().frame_when_inactive(false);
                if vary_button(ui, letter) {
                    *varied = Some(key.child(&name));
                }
                number_field(ui, key.last(), number);
            }
        }
        value => {
            number_field(ui, key.last(), value);
            if vary_button(ui, Button::new("📈").small().frame(false)) {
                *varied = Some(key.clone());
            }
        }
    });
    ui.end_row();
}

fn number_field(ui: &mut Ui, key: &str, value: &mut Value) {
    let is_whole = value.is_integer();
    let mut float = value.clone().try_into().unwrap_or_default();
    let is_typed = number(ui, &mut float, ANY).lost_focus();
    if !is_typed {
        let (least, most) = range::of_key(key).into_inner();
        float = float.clamp(least, most);
        if is_whole {
            float = float.round();
        }
    }
    // A whole number stays one: as another type of TOML it would count as an edit.
    *value = if is_whole && float.fract() == 0.0 {
        Value::Integer(float as i64)
    } else {
        Value::Float(float)
    };
}

/// A text field for a name. The name changes when the field loses the focus.
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
