//! The scene's tab: the list of entities, and a field for each key of the selected one in the scene file. It edits the
//! scene's record as TOML.

use std::sync::Arc;

use egui::{Button, ComboBox, Grid, Ui};
use glam::DVec3;
use hecs::{Component, World};
use toml::Value;

use super::row::row;
use crate::components::names;
use crate::scene::SceneRecord;
use crate::scene::key::{Key, tree};
use crate::window::canvas::Canvas;
use crate::window::controls::step_back;
use crate::window::desk::{Desk, EntityPlace};
use crate::window::document::Document;

/// A change of the list of entities.
#[derive(Clone, Copy, PartialEq)]
enum Edit {
    Copy,
    Delete,
    NewLight,
}

/// Lays out the tab. An edit replaces the World.
pub fn tab(ui: &mut Ui, document: &mut Document, canvas: &mut Canvas, desk: &mut Desk) {
    // Room for three numbers in a row.
    let spacing = ui.spacing_mut();
    spacing.interact_size.x = 16.0;
    (spacing.item_spacing.x, spacing.button_padding.x) = (3.0, 1.0);
    let record = Arc::clone(&document.state);
    let known = selected(desk, &record);
    let mut chosen = known;
    let edit = edit_buttons(
        ui,
        known.0 == "light" || names_of(&record, known.0).len() > 1,
    );
    entity_list(ui, &record, &mut chosen);
    ui.separator();
    let before = [entity(&record, chosen), tree(&record.background)];
    let [mut own, mut background] = before.clone();
    let mut varied = None;
    let name = own["name"].as_str().unwrap_or_default();
    let entity_key = Key::from(chosen.0).child(name);
    Grid::new("table").show(ui, |ui| {
        row(ui, &entity_key, &mut own, &mut varied);
    });
    if chosen.0 == "light" {
        place_light(&mut own);
    }
    ui.separator();
    Grid::new("scene").show(ui, |ui| {
        let key = Key::from("background");
        row(ui, &key, &mut background, &mut varied);
    });
    if let Some(key) = varied {
        desk.vary(key, &record);
    }
    if edit.is_some() || [&own, &background] != [&before[0], &before[1]] {
        let world = &document.scene.world;
        let (scene, place) = edited(world, chosen, [own, background], edit);
        chosen = place;
        match SceneRecord::from_tree(scene) {
            Ok(record) => {
                document.restore(&record);
                desk.message = None;
                if edit.is_some_and(|it| it != Edit::Delete) {
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
    if chosen != known {
        desk.selected = Some(chosen);
    }
}

/// The entity whose numbers are shown. Undo and a new file may leave fewer entities, and no lights.
fn selected(desk: &Desk, record: &SceneRecord) -> EntityPlace {
    let count = |kind: &str| names_of(record, kind).len();
    match desk.selected {
        Some((kind, place)) if count(kind) > 0 => (kind, place.min(count(kind) - 1)),
        _ => ("cuboid", 0),
    }
}

/// Lays out the buttons that change the list of entities.
fn edit_buttons(ui: &mut Ui, can_delete: bool) -> Option<Edit> {
    let buttons = ui.horizontal(|ui| {
        let copy = ui.small_button("copy");
        let delete = ui
            .add_enabled(can_delete, Button::new("delete").small())
            .on_disabled_hover_text("A scene needs one.");
        [
            (copy, Edit::Copy),
            (delete, Edit::Delete),
            (ui.small_button("new light"), Edit::NewLight),
        ]
    });
    let mut clicked = buttons.inner.into_iter().filter(|it| it.0.clicked());
    clicked.next().map(|it| it.1)
}

/// The scene with the changes of this layout, of the entity at a place, of the background, and of the list; and the place of
/// the entity that is selected then.
fn edited(
    world: &World,
    (kind, place): EntityPlace,
    [own, background]: [Value; 2],
    edit: Option<Edit>,
) -> (Value, EntityPlace) {
    let mut record = SceneRecord::of(world);
    let active = record.view.camera.as_deref();
    if kind == "camera" && active == names_of(&record, kind).nth(place) {
        let name = own["name"].as_str().filter(|_| edit != Some(Edit::Delete));
        record.view.camera = name.map(str::to_owned);
    }
    let mut scene = tree(&record);
    scene["background"] = background;
    scene[kind][place] = own.clone();
    let selected = match edit {
        None => (kind, place),
        Some(Edit::Copy) => push_copy(&mut scene, kind, &own),
        Some(Edit::Delete) => {
            let all = scene[kind].as_array_mut();
            let left = all.map_or(0, |all| {
                all.remove(place);
                all.len()
            });
            (kind, place.min(left.saturating_sub(1)))
        }
        Some(Edit::NewLight) => push_copy(&mut scene, "light", &new_light()),
    };
    (scene, selected)
}

/// Adds a copy of an entity, and returns its place.
fn push_copy(scene: &mut Value, kind: &'static str, original: &Value) -> EntityPlace {
    let Some(all) = scene[kind].as_array_mut() else {
        return (kind, 0);
    };
    all.push(copy(kind, all, original));
    (kind, all.len() - 1)
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

/// Lays out the list of the entities of all kinds, in the order of the file.
fn entity_list(ui: &mut Ui, record: &SceneRecord, selected: &mut EntityPlace) {
    let of_kind = |kind: &'static str| {
        let places = (0..).map(move |place| (kind, place));
        places.zip(names_of(record, kind))
    };
    let words = |kind: &str, name: &str| format!("{kind} {name}");
    let name = names_of(record, selected.0).nth(selected.1);
    let list = ComboBox::from_id_salt("entities");
    let list = list.selected_text(words(selected.0, name.unwrap_or_default()));
    list.show_ui(ui, |ui| {
        for (place, name) in ["cuboid", "light", "camera"].into_iter().flat_map(of_kind) {
            ui.selectable_value(selected, place, words(place.0, name));
        }
    });
}
