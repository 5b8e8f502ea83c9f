//! A field for each value of an entity: a number, a word, a name.

use std::ops::RangeInclusive;

use egui::{Button, TextEdit, Ui};
use toml::Value;

use crate::components::numbers::{Number, range_of};
use crate::scene::key::Key;
use crate::window::widgets::{number, vary_button};

/// The keys whose value is one of these words.
const CHOICES: [(&str, &[&str]); 3] = [
    ("shading", &["flat", "gouraud", "phong"]),
    ("normals", &["corner", "face"]),
    ("kind", &["ambient", "diffuse", "specular"]),
];
/// A typed number is checked when the edited record is read, whose message names the range.
pub const ANY: RangeInclusive<f64> = f64::MIN..=f64::MAX;

/// A row for the value of a key. A table has a row for each of its keys. `varied` is the number whose button is clicked.
pub fn row(ui: &mut Ui, key: &Key, value: &mut Value, varied: &mut Option<Key>) {
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

/// A text field for a name. The name changes when the field loses the focus.
fn name_field(ui: &mut Ui, name: &mut String) {
    let id = ui.id().with(("name", &*name));
    let before = ui.data_mut(|data| data.remove_temp::<String>(id));
    let mut typed = before.unwrap_or_else(|| name.clone());
    let field = ui.add(TextEdit::singleline(&mut typed).desired_width(140.0));
    if field.lost_focus() {
        *name = typed;
    } else {
        ui.data_mut(|data| data.insert_temp(id, typed));
    }
}
