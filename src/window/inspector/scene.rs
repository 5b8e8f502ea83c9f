//! The scene's tab: one entity, and a field for each of its keys in the scene file. It edits the scene's record as TOML.

use std::ops::RangeInclusive;
use std::sync::Arc;

use egui::{Button, ComboBox, Grid, Ui};
use toml::Value;

use crate::components::numbers::{Number, range_of};
use crate::scene::SceneRecord;
use crate::scene::key::{Key, tree};
use crate::window::desk::{Desk, EntityPlace};
use crate::window::document::Document;
use crate::window::widgets::{number, vary_button};

/// The keys whose value is one of these words.
const CHOICES: [(&str, &[&str]); 2] = [
    ("shading", &["flat", "gouraud", "phong"]),
    ("normals", &["corner", "face"]),
];
/// A typed number is checked when the edited record is read, whose message names the range.
pub const ANY: RangeInclusive<f64> = f64::MIN..=f64::MAX;

/// Lays out the tab. An edit replaces the World.
pub fn tab(ui: &mut Ui, document: &mut Document, desk: &mut Desk) {
    // Room for three numbers in a row.
    let spacing = ui.spacing_mut();
    spacing.interact_size.x = 16.0;
    (spacing.item_spacing.x, spacing.button_padding.x) = (3.0, 1.0);
    let record = Arc::clone(&document.state);
    let (kind, place) = chosen(ui, &record, desk);
    let before = [
        match kind {
            "light" => tree(&record.light[place]),
            "camera" => tree(&record.camera[place]),
            _ => tree(&record.cuboid[place]),
        },
        tree(&record.background),
    ];
    let name = before[0]["name"].as_str().unwrap_or_default();
    let keys = [Key::from(kind).child(name), Key::from("background")];
    let mut values = before.clone();
    let mut varied = None;
    Grid::new("table").show(ui, |ui| {
        for (key, value) in keys.iter().zip(&mut values) {
            row(ui, key, value, &mut varied);
        }
    });
    if let Some(key) = varied {
        desk.vary(key, &record);
    }
    if values == before {
        return;
    }
    // With the changes of this layout.
    let mut scene = tree(&SceneRecord::of(&document.scene.world));
    [scene[kind][place], scene["background"]] = values;
    match SceneRecord::from_tree(scene) {
        Ok(record) => {
            document.restore(&record);
            desk.message = None;
        }
        // A drag passes numbers that go together with others no longer, such as an `up` along the view.
        Err(_) if ui.ctx().dragged_id().is_some() => {}
        Err(error) => desk.say(error.to_string()),
    }
}

/// Lays out the list of entities. Returns the chosen one: the first cuboid, until another one is chosen.
fn chosen(ui: &mut Ui, record: &SceneRecord, desk: &mut Desk) -> EntityPlace {
    let cuboids = record.cuboid.iter().map(|it| &it.name).enumerate();
    let lights = record.light.iter().map(|it| &it.name).enumerate();
    let cameras = record.camera.iter().map(|it| &it.name).enumerate();
    let all: Vec<(EntityPlace, String)> = cuboids
        .map(|it| ("cuboid", it))
        .chain(lights.map(|it| ("light", it)))
        .chain(cameras.map(|it| ("camera", it)))
        .map(|(kind, (place, name))| ((kind, place), format!("{kind} {name}")))
        .collect();
    let present = all.iter().find(|it| Some(it.0) == desk.selected);
    let (place, words) = present.unwrap_or(&all[0]);
    let mut chosen = *place;
    let list = ComboBox::from_id_salt("entity").selected_text(words);
    list.show_ui(ui, |ui| {
        for (place, words) in &all {
            ui.selectable_value(&mut chosen, *place, words);
        }
    });
    desk.selected = Some(chosen);
    chosen
}

/// A row for the value of a key. A table has a row for each of its keys. `varied` is the number whose button is clicked.
fn row(ui: &mut Ui, key: &Key, value: &mut Value, varied: &mut Option<Key>) {
    if let Value::Table(table) = value {
        return table
            .iter_mut()
            .for_each(|(name, value)| row(ui, &key.child(name), value, varied));
    }
    ui.label(key.last()).on_hover_ui(|ui| {
        ui.label(key.comment().unwrap_or_default());
        ui.weak(key.number().map(Number::words).unwrap_or_default());
    });
    let names = key.names(value);
    ui.horizontal(|ui| match value {
        Value::Boolean(on) => drop(ui.checkbox(on, "")),
        Value::String(text) => match CHOICES.iter().find(|(own, _)| *own == key.last()) {
            Some((_, words)) => {
                for word in *words {
                    ui.selectable_value(text, (*word).to_owned(), *word);
                }
            }
            None => drop(ui.label(&*text)),
        },
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
        let (least, most) = range_of(key).into_inner();
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
