//! Writes a record into the text of its file. Values that differ are set; everything else stays as it was written.
//!
//! ```text
//! text --read--> old record --+
//!      new record ------------+--> differences --set in the document--> text
//! ```
//! A key that the text lacks is added only if its value has changed. Defaults stay out of the text.

use serde_json::{Map, Value as Json, json};
use toml_edit::{ArrayOfTables, DocumentMut, Item, Table, TableLike, Value};

use super::record::SceneRecord;
use crate::components::Orbit;

/// A table of a record.
type Tree = Map<String, Json>;

/// Changes a text so that it reads as `record`. A text that is not a scene is replaced.
pub fn updated(text: &str, record: &SceneRecord) -> String {
    // `parse` refuses integers of more than 64 bits, which a scene takes for floats.
    let (old, mut document) = match (SceneRecord::read(text), text.parse()) {
        (Ok(old), _) if old == *record => return text.to_owned(),
        (Ok(old), Ok(document)) => (old, document),
        _ => (SceneRecord::default(), DocumentMut::new()),
    };
    let [mut old, mut new] = [&old, record].map(tree);
    // A text that names its camera follows that name, even if the camera is the first.
    let named = document.get("view").and_then(|view| view.get("camera"));
    if let Some(name) = named.and_then(Item::as_str) {
        old["view"]["camera"] = json!(name);
        new["view"]["camera"] = json!(
            record
                .active_camera()
                .map(|active| &record.camera[active].name)
        );
    }
    for kind in ["cuboid", "light", "camera"] {
        let [old, new] = [&mut old, &mut new].map(|tree| tables(tree.remove(kind)));
        amend_list(&mut document, kind, &old, &new);
    }
    amend_table(&mut *document, &old, &new);
    let written = document.to_string();
    if text.contains("\r\n") {
        return written.replace("\r\n", "\n").replace('\n', "\r\n");
    }
    written.trim_start_matches('\n').to_owned()
}

fn tree(record: &SceneRecord) -> Tree {
    let tree = serde_json::to_value(record).and_then(serde_json::from_value);
    tree.unwrap_or_default()
}

fn tables(list: Option<Json>) -> Vec<Tree> {
    let tables = list.and_then(|list| serde_json::from_value(list).ok());
    tables.unwrap_or_default()
}

/// Changes the tables of a kind from `old` to `new`. A changed list in brackets becomes tables under headers.
fn amend_list(document: &mut DocumentMut, kind: &str, old: &[Tree], new: &[Tree]) {
    if old == new {
        return;
    }
    let list = document.entry(kind).or_insert(Item::None);
    let written = std::mem::take(list).into_array_of_tables();
    let written = written.unwrap_or_default();
    let mut amended = ArrayOfTables::new();
    for (new, place) in new.iter().zip(places(old, new)) {
        let (written, old) = match place {
            Some(place) => (written.get(place).cloned(), old[place].clone()),
            None => (None, unsaid(kind)),
        };
        let mut table = written.unwrap_or_else(headed);
        amend_table(&mut table, &old, new);
        amended.push(table);
    }
    *list = Item::ArrayOfTables(amended);
}

/// An empty table under a header, after an empty line.
fn headed() -> Table {
    let mut table = Table::new();
    table.decor_mut().set_prefix("\n");
    table
}

/// The keys that a new table of a kind can leave out.
fn unsaid(kind: &str) -> Tree {
    let mut unsaid = Tree::new();
    if kind == "camera" {
        unsaid.insert("orbit".to_owned(), json!(Orbit::default()));
    }
    unsaid
}

/// The old index of each new table: the table of the same name, else the next one with a name that is gone. `None` is new.
fn places(old: &[Tree], new: &[Tree]) -> Vec<Option<usize>> {
    let find = |table: &Tree| old.iter().position(|other| other["name"] == table["name"]);
    let mut named: Vec<_> = new.iter().map(find).collect();
    // Tables stay in the order of the text. If names have changed places, only the order counts.
    if !named.iter().flatten().is_sorted() {
        named.fill(None);
    }
    let mut next = 0;
    let mut places = Vec::with_capacity(new.len());
    for place in &named {
        let is_free = next < old.len() && !named.contains(&Some(next));
        let place = place.or(is_free.then_some(next));
        next = place.map_or(next, |place| place + 1);
        places.push(place);
    }
    places
}

/// Changes a table from `old` to `new`.
fn amend_table(table: &mut dyn TableLike, old: &Tree, new: &Tree) {
    for (key, value) in new {
        let before = old.get(key).unwrap_or(&Json::Null);
        if before == value {
            continue;
        }
        match table.get_mut(key) {
            Some(item) => amend(item, before, value),
            None => {
                table.insert(key, created(key, before, value));
            }
        }
    }
    for key in old.keys().filter(|key| !new.contains_key(*key)) {
        table.remove(key);
    }
}

fn amend(item: &mut Item, old: &Json, new: &Json) {
    match (item.as_table_like_mut(), old, new) {
        (Some(table), Json::Object(old), Json::Object(new)) => amend_table(table, old, new),
        _ => {
            if let Some(value) = item.as_value_mut() {
                amend_value(value, old, new);
            }
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
    match (key, new) {
        ("material" | "view", Json::Object(new)) => {
            let mut table = headed();
            amend_table(&mut table, old.as_object().unwrap_or(&Tree::new()), new);
            Item::Table(table)
        }
        _ => Item::Value(written(new)),
    }
}

fn written(value: &Json) -> Value {
    let text = toml_text(value);
    text.parse()
        .expect("a record holds texts and finite numbers")
}

/// A value in TOML, with numbers in the shortest form: 1e100 has no hundred zeros.
fn toml_text(value: &Json) -> String {
    match value {
        Json::Number(number) if number.is_f64() => {
            format!("{:?}", number.as_f64().unwrap_or_default())
        }
        Json::String(text) => Value::from(text).to_string(),
        Json::Array(list) => {
            let list: Vec<String> = list.iter().map(toml_text).collect();
            format!("[{}]", list.join(", "))
        }
        Json::Object(table) => {
            let pair = |(key, value): (&String, _)| format!("{key} = {}", toml_text(value));
            let pairs: Vec<String> = table.iter().map(pair).collect();
            format!("{{ {} }}", pairs.join(", "))
        }
        other => other.to_string(),
    }
}
