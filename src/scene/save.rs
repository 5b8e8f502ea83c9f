//! Writes a record into the text of its file. Values that differ are set; everything else stays as it was written.
//!
//! ```text
//! text --read--> old record --+
//!      new record ------------+--> differences --set in the document--> text
//! ```
//! A key that the text lacks is added only if its value has changed. Defaults stay out of the text.

use serde_json::{Value as Json, json};
use toml_edit::{ArrayOfTables, DocumentMut, Item, Table, TableLike, Value};

use super::key::tree;
use super::read::with_floats;
use super::record::SceneRecord;
use crate::components::Orbit;

/// Changes a text so that it reads as `record`. A text that is not a scene is replaced.
pub fn updated(text: &str, record: &SceneRecord) -> String {
    let (old, mut document) = match (SceneRecord::read("", text), with_floats(text).parse()) {
        (Ok(old), _) if old == *record => return text.to_owned(),
        (Ok(old), Ok(document)) => (old, document),
        _ => (SceneRecord::default(), DocumentMut::new()),
    };
    let [mut old, mut new] = [&old, record].map(|it| json!(tree(it)));
    // A text has one of the two.
    if let (Some(_), Json::Object(view)) = (record.view.budget, &mut new["view"]) {
        view.remove("tolerance");
    }
    // A text that names its camera follows that name, even if the camera is the first.
    let named = document.get("view").and_then(|view| view.get("camera"));
    if let Some(name) = named.and_then(Item::as_str) {
        old["view"]["camera"] = json!(name);
        new["view"]["camera"] = json!(record.active_camera().map(|it| &it.name));
    }
    for kind in ["cuboid", "light", "camera"] {
        let [old, new] = [&mut old, &mut new].map(|tree| tree[kind].take());
        if let (Json::Array(old), Json::Array(new)) = (old, new) {
            amend_list(&mut document, kind, &old, &new);
        }
    }
    amend_table(&mut *document, &old, &new);
    let written = document.to_string();
    if text.contains("\r\n") {
        return written.replace("\r\n", "\n").replace('\n', "\r\n");
    }
    written.trim_start_matches('\n').to_owned()
}

/// Changes the tables of a kind from `old` to `new`. A changed list in brackets becomes tables under headers.
fn amend_list(document: &mut DocumentMut, kind: &str, old: &[Json], new: &[Json]) {
    if old == new {
        return;
    }
    let list = document.entry(kind).or_insert(Item::None);
    let written = std::mem::take(list)
        .into_array_of_tables()
        .unwrap_or_default();
    // A new table leaves this key out.
    let unsaid = json!({ "orbit": Orbit::default() });
    let mut amended = ArrayOfTables::new();
    for (new, place) in new.iter().zip(places(old, new)) {
        let found = place.and_then(|place| Some((written.get(place)?.clone(), &old[place])));
        let (mut table, old) = found.unwrap_or_else(|| (headed(), &unsaid));
        amend_table(&mut table, old, new);
        amended.push(table);
    }
    // Without a position a table is written after the last one of the kind before, which may stand after later ones of this.
    let first = amended.iter().find_map(Table::position);
    let unplaced = amended.iter_mut().take_while(|it| it.position().is_none());
    for table in unplaced {
        table.set_position(first);
    }
    *list = Item::ArrayOfTables(amended);
}

/// An empty table under a header, after an empty line.
fn headed() -> Table {
    let mut table = Table::new();
    table.decor_mut().set_prefix("\n");
    table
}

/// The old index of each new table: the table of the same name, else the table at the same index if its name is gone.
/// `None` is new.
fn places(old: &[Json], new: &[Json]) -> Vec<Option<usize>> {
    let find = |list: &[Json], table: &Json| list.iter().position(|it| it["name"] == table["name"]);
    let place = |(index, table): (usize, _)| {
        let is_renamed = old.get(index).is_some_and(|it| find(new, it).is_none());
        find(old, table).or(is_renamed.then_some(index))
    };
    let places: Vec<_> = new.iter().enumerate().map(place).collect();
    // Tables stay in the order of the text.
    if places.iter().flatten().is_sorted() {
        places
    } else {
        vec![None; new.len()]
    }
}

/// Changes a table from `old` to `new`.
fn amend_table(table: &mut dyn TableLike, old: &Json, new: &Json) {
    for (key, value) in new.as_object().into_iter().flatten() {
        let before = &old[key];
        if before == value {
            continue;
        }
        let Some(item) = table.get_mut(key) else {
            table.insert(key, created(key, before, value));
            continue;
        };
        if let Some(table) = item.as_table_like_mut() {
            amend_table(table, before, value);
        } else if let Some(item) = item.as_value_mut() {
            amend_value(item, before, value);
        }
    }
    for (key, _) in old.as_object().into_iter().flatten() {
        if new.get(key).is_none() {
            table.remove(key);
        }
    }
}

/// Changes a value. In an array only the elements that differ are set.
fn amend_value(value: &mut Value, old: &Json, new: &Json) {
    if let (Value::Array(array), Json::Array(old), Json::Array(new)) = (&mut *value, old, new)
        && old.len() == new.len()
    {
        for (element, (old, new)) in array.iter_mut().zip(old.iter().zip(new)) {
            if old != new {
                amend_value(element, old, new);
            }
        }
        return;
    }
    let decor = value.decor().clone();
    *value = written(new);
    *value.decor_mut() = decor;
}

/// The value of a new key. A large table stands under a header.
fn created(key: &str, old: &Json, new: &Json) -> Item {
    if !new.is_object() {
        return Item::Value(written(new));
    }
    let mut table = headed();
    amend_table(&mut table, old, new);
    match key {
        "orbit" => Item::Value(table.into_inline_table().into()),
        _ => Item::Table(table),
    }
}

/// A value in TOML, with numbers in the shortest form: 1e100 has no hundred zeros.
fn written(value: &Json) -> Value {
    match value {
        Json::String(text) => text.into(),
        Json::Array(list) => list.iter().map(written).collect(),
        // In place of an array of the table's values, which serde reads as the table.
        Json::Object(table) => table.iter().map(|(key, it)| (key, written(it))).collect(),
        other => {
            let text = match other.as_f64() {
                Some(float) if other.is_f64() => format!("{float:?}"),
                _ => other.to_string(),
            };
            text.parse().expect("a record holds finite numbers")
        }
    }
}
